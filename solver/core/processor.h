// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>

namespace geotherm {

/// An instruction set that inner loops are compiled for; all give the same answer to round-off.
enum class InstructionSet { kPlain, kAvx2, kAvx512 };

/// The best one that this build and this processor have.
InstructionSet best_instruction_set();

/// The widest group of columns, 16, 8, 4, 2 or 1, that kernels take at once out of so many.
inline int column_group(std::ptrdiff_t columns) {
  int width = 16;
  while (width > 1 && columns < width) width /= 2;
  return width;
}

/// Asks for as many numbers that lie so many bytes from these, into the second cache. They may lie
/// beyond the array. Never a function of its own: kernels of all instruction sets include it.
template <class T>
[[gnu::always_inline]] inline void prefetch_beside(const T* values, std::ptrdiff_t bytes,
                                                   std::ptrdiff_t count) {
  constexpr std::size_t kLine = 64;
  const auto first = reinterpret_cast<std::uintptr_t>(values) + static_cast<std::size_t>(bytes);
  const std::size_t size = static_cast<std::size_t>(count) * sizeof(T);
  for (std::size_t k = 0; k < size; k += kLine) {
    __builtin_prefetch(reinterpret_cast<const void*>(first + k), 0, 2);
  }
}

/// For a pass along memory that reads `count` numbers now: what the processor itself asks for ahead
/// ends with the page.
template <class T>
[[gnu::always_inline]] inline void prefetch_ahead(const T* now, std::ptrdiff_t count) {
  constexpr std::ptrdiff_t kAhead = 4096;
  prefetch_beside(now, kAhead, count);
}

/// While this lives, results of this thread that are too small for a normal double become 0, and
/// such operands count as 0. Processors take a hundred times as long over them, and heat that has
/// fallen by 308 decades is full of them. Where there is no such switch, nothing happens.
class FlushDenormals {
 public:
#if defined(__x86_64__)
  FlushDenormals() : before_(__builtin_ia32_stmxcsr()) {
    __builtin_ia32_ldmxcsr(before_ | kFlushResults | kOperandsAreZero);
  }
  ~FlushDenormals() { __builtin_ia32_ldmxcsr(before_); }
#else
  FlushDenormals() = default;
  ~FlushDenormals() = default;
#endif
  FlushDenormals(const FlushDenormals&) = delete;
  FlushDenormals& operator=(const FlushDenormals&) = delete;

 private:
#if defined(__x86_64__)
  static constexpr unsigned kFlushResults = 0x8000, kOperandsAreZero = 0x0040;
  unsigned before_;
#endif
};

}  // namespace geotherm
