// SPDX-License-Identifier: MIT
#pragma once

#include "engine/vulkan/vulkan.h"

namespace geotherm::engine {

/// The Vulkan loader of the system, opened while the program runs and closed with the last
/// instance.
class Loader {
 public:
  /// Throws Failure where there is none.
  Loader();
  ~Loader();
  Loader(Loader&& other) noexcept;
  Loader& operator=(Loader&&) = delete;

  PFN_vkGetInstanceProcAddr entry() const { return entry_; }

 private:
  void* library_ = nullptr;
  PFN_vkGetInstanceProcAddr entry_ = nullptr;
};

}  // namespace geotherm::engine
