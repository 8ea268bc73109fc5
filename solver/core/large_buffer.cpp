// SPDX-License-Identifier: MIT
#include "solver/core/large_buffer.h"

#include <cstdint>
#include <cstdlib>
#include <new>

#ifdef __linux__
#include <sys/mman.h>
#endif

namespace geotherm {
namespace {

constexpr std::size_t kLine = 64;
constexpr std::size_t kLargePage = 2UL << 20;

}  // namespace

void prefer_large_pages(void* data, std::size_t bytes) {
#ifdef __linux__
  const auto begin = reinterpret_cast<std::uintptr_t>(data);
  const std::uintptr_t first = (begin + kLargePage - 1) / kLargePage * kLargePage;
  const std::uintptr_t end = (begin + bytes) / kLargePage * kLargePage;
  if (first < end) madvise(reinterpret_cast<void*>(first), end - first, MADV_HUGEPAGE);
#else
  static_cast<void>(data), static_cast<void>(bytes);
#endif
}

LargeBuffer::LargeBuffer(std::size_t bytes) : bytes_(bytes) {
  const std::size_t alignment = bytes >= 2 * kLargePage ? kLargePage : kLine;
  const std::size_t whole = (bytes + alignment) / alignment * alignment;
  data_ = static_cast<std::byte*>(std::aligned_alloc(alignment, whole));
  if (data_ == nullptr) throw std::bad_alloc();
  prefer_large_pages(data_, whole);
}

LargeBuffer::~LargeBuffer() { std::free(data_); }

}  // namespace geotherm
