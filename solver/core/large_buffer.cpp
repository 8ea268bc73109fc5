// SPDX-License-Identifier: MIT
#include "solver/core/large_buffer.h"

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

LargeBuffer::LargeBuffer(std::size_t bytes) : bytes_(bytes) {
  const std::size_t alignment = bytes >= 2 * kLargePage ? kLargePage : kLine;
  const std::size_t whole = (bytes + alignment) / alignment * alignment;
  data_ = static_cast<std::byte*>(std::aligned_alloc(alignment, whole));
  if (data_ == nullptr) throw std::bad_alloc();
#ifdef __linux__
  if (alignment == kLargePage) madvise(data_, whole, MADV_HUGEPAGE);  // a wish
#endif
}

LargeBuffer::~LargeBuffer() { std::free(data_); }

}  // namespace geotherm
