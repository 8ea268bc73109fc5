// SPDX-License-Identifier: MIT
#include "engine/vulkan/loader.h"

#include <dlfcn.h>

#include <utility>

#include "engine/vulkan/vulkan_error.h"

namespace geotherm::engine {

Loader::Loader() {
  library_ = ::dlopen("libvulkan.so.1", RTLD_NOW | RTLD_LOCAL);
  if (library_ != nullptr) {
    entry_ =
        reinterpret_cast<PFN_vkGetInstanceProcAddr>(::dlsym(library_, "vkGetInstanceProcAddr"));
  }
  if (entry_ != nullptr) return;
  const char* const reason = ::dlerror();
  throw Failure(
      {ErrorCode::kNoDevice, "the Vulkan loader cannot be opened (" +
                                 std::string(reason ? reason : "libvulkan.so.1 is no loader") +
                                 "); install it (Debian: libvulkan1 mesa-vulkan-drivers)"});
}

Loader::Loader(Loader&& other) noexcept
    : library_(std::exchange(other.library_, nullptr)), entry_(other.entry_) {}

Loader::~Loader() {
  if (library_ != nullptr) ::dlclose(library_);
}

}  // namespace geotherm::engine
