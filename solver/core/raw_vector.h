// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <type_traits>
#include <utility>
#include <vector>

namespace geotherm {

/// Leaves numbers that nobody gave a value unwritten.
template <class T>
struct RawAllocator : std::allocator<T> {
  template <class U>
  struct rebind {
    using other = RawAllocator<U>;
  };

  template <class U>
  void construct(U* at) noexcept {
    static_assert(std::is_trivially_destructible_v<U>);
    ::new (static_cast<void*>(at)) U;
  }
  template <class U, class... Arguments>
  void construct(U* at, Arguments&&... arguments) {
    std::construct_at(at, std::forward<Arguments>(arguments)...);
  }
};

/// A vector for results that several threads fill: resize() touches none of the memory, so that the
/// system hands out its pages to all of them, and nothing is written twice.
template <class T>
using RawVector = std::vector<T, RawAllocator<T>>;

}  // namespace geotherm
