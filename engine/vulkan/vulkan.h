// SPDX-License-Identifier: MIT
#pragma once

#include <exception>
#include <new>
#include <string>
#include <string_view>
#include <type_traits>

#include "geotherm/error.h"

// The loader is opened when an instance is made, so that a machine without it still runs everything
// that draws nothing. Included by sources of the engine only: it is expensive.
#define VULKAN_HPP_ENABLE_DYNAMIC_LOADER_TOOL 0
#include <vulkan/vulkan_raii.hpp>

namespace geotherm::engine {

/// How a failure travels inside the engine; guarded() turns it into a Result for those outside.
class Failure : public std::exception {
 public:
  explicit Failure(Error error) : error_(std::move(error)) {}
  const Error& error() const { return error_; }
  const char* what() const noexcept override { return error_.message.c_str(); }

 private:
  Error error_;
};

/// What to do where the device's memory does not suffice.
Hint less_memory();

/// What a status of Vulkan means to people. `what`: what was being done ("drawing").
Error error_of(vk::Result status, std::string_view what);

/// Runs `work`, which returns a Result, or nothing for a Result<void>; no exception leaves.
template <class Work, class Out = std::invoke_result_t<Work>>
auto guarded(std::string_view what, Work&& work)
    -> std::conditional_t<std::is_void_v<Out>, Result<void>, Out> {
  try {
    if constexpr (std::is_void_v<Out>) {
      work();
      return {};
    } else {
      return work();
    }
  } catch (const Failure& failure) {
    return failure.error();
  } catch (const vk::SystemError& error) {
    return error_of(static_cast<vk::Result>(error.code().value()), what);
  } catch (const std::bad_alloc&) {
    return error_of(vk::Result::eErrorOutOfHostMemory, what);
  }
}

/// Throws a status that is not success.
inline void check(vk::Result status, const char* what) {
  if (status != vk::Result::eSuccess) vk::throwResultException(status, what);
}

}  // namespace geotherm::engine
