// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <stdexcept>
#include <utility>

#include "engine/device.h"
#include "geotherm/error.h"

namespace geotherm::test {

/// The one device of this process, with validation and synchronization validation; opened when a
/// test first needs it, closed after the last one. Where none can be opened tests that need it are
/// skipped, or fail when `required`.
std::unique_ptr<testing::Environment> make_gpu_environment(bool required);

/// Whether tests that need a device must not be skipped.
bool vulkan_is_required();

/// With validation, and with a limit in bytes (0: none).
engine::DeviceOptions validated(std::uint64_t memory_limit = 0);

/// A test that draws. It fails when validation has anything to say about what it did.
class GpuTest : public testing::Test {
 protected:
  void SetUp() override;
  void TearDown() override;

  static const engine::Device& device();

 private:
  std::size_t messages_before_ = 0;
};

/// The value, or a failed test with the reason.
template <class T>
T must(Result<T> result) {
  if (!result) throw std::runtime_error(result.error().message);
  return *std::move(result);
}
inline void must(const Result<void>& result) {
  if (!result) throw std::runtime_error(result.error().message);
}

}  // namespace geotherm::test
