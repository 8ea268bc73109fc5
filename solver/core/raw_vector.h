// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <memory>
#include <type_traits>
#include <utility>
#include <vector>

#include "solver/core/large_buffer.h"

namespace geotherm {

/// Leaves numbers that nobody gave a value unwritten. Keeps what is long in large pages.
template <class T>
struct RawAllocator : std::allocator<T> {
  template <class U>
  struct rebind {
    using other = RawAllocator<U>;
  };

  T* allocate(std::size_t count) {
    T* const data = std::allocator<T>::allocate(count);
    if (count * sizeof(T) >= kLong) prefer_large_pages(data, count * sizeof(T));
    return data;
  }

  template <class U>
  void construct(U* at) noexcept {
    static_assert(std::is_trivially_destructible_v<U>);
    ::new (static_cast<void*>(at)) U;
  }
  template <class U, class... Arguments>
  void construct(U* at, Arguments&&... arguments) {
    std::construct_at(at, std::forward<Arguments>(arguments)...);
  }

 private:
  static constexpr std::size_t kLong = 4UL << 20;  ///< bytes: two large pages
};

/// A vector for results that several threads fill: resize() touches none of the memory, so that the
/// system hands out its pages to all of them, and nothing is written twice.
template <class T>
using RawVector = std::vector<T, RawAllocator<T>>;

}  // namespace geotherm
