// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <utility>

namespace geotherm {

/// Wishes that the system keep what is in here of large pages (2 MiB) as such, before it is first
/// touched: what is read here and there would wait for the tables of small ones.
void prefer_large_pages(void* data, std::size_t bytes);

/// Uninitialised memory for what is read from end to end: aligned to a cache line, and in large
/// pages where the system has them, so that reading does not wait for the tables of pages.
class LargeBuffer {
 public:
  LargeBuffer() = default;
  /// Throws std::bad_alloc.
  explicit LargeBuffer(std::size_t bytes);
  ~LargeBuffer();
  LargeBuffer(LargeBuffer&& other) noexcept
      : data_(std::exchange(other.data_, nullptr)), bytes_(std::exchange(other.bytes_, 0)) {}
  LargeBuffer& operator=(LargeBuffer&& other) noexcept {
    std::swap(data_, other.data_);
    std::swap(bytes_, other.bytes_);
    return *this;
  }

  std::byte* data() { return data_; }
  const std::byte* data() const { return data_; }
  std::size_t size() const { return bytes_; }

 private:
  std::byte* data_ = nullptr;
  std::size_t bytes_ = 0;
};

}  // namespace geotherm
