// SPDX-License-Identifier: MIT
#pragma once

namespace geotherm {

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
