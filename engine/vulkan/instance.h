// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "engine/device.h"
#include "engine/vulkan/vulkan.h"

namespace geotherm::engine {

/// What the window system knows of Vulkan. Implemented by windows; all that opens a device or shows
/// pictures knows windows only as this.
class Presentation {
 public:
  /// Instance extensions without which there are no surfaces; valid as long as the window.
  virtual std::vector<const char*> instance_extensions() const = 0;
  virtual bool can_present(vk::Instance instance, vk::PhysicalDevice device,
                           std::uint32_t queue_family) const = 0;
  /// The window's surface; the caller owns it. Throws.
  virtual vk::SurfaceKHR make_surface(vk::Instance instance) const = 0;

 protected:
  ~Presentation() = default;
};

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

/// What the validation layer says, collected from any thread.
class MessageLog {
 public:
  void add(std::string message);
  std::vector<std::string> messages() const;

 private:
  mutable std::mutex mutex_;
  std::vector<std::string> messages_;
};

/// The loader, an instance, and its messages. Members are destroyed from the last to the first.
struct Instance {
  /// `presentation`: of the window that will be drawn to; null: of none.
  /// Throws Failure: no loader, no driver, validation asked for and not installed.
  explicit Instance(bool validation, const Presentation* presentation = nullptr);

  std::unique_ptr<MessageLog> log;
  Loader loader;
  vk::raii::Context context;
  vk::raii::Instance instance;
  vk::raii::DebugUtilsMessengerEXT messenger;
};

/// A device with what it is and what it lacks.
struct Candidate {
  vk::raii::PhysicalDevice device;
  DeviceInfo info;
  std::uint32_t queue_family = 0;  ///< one that draws and copies, and presents where that is needed
};

/// What pictures need: Vulkan 1.3, dynamic rendering, synchronization2, a queue that draws, four
/// samples a pixel; with `presentation` a queue that draws and presents as well, and swapchains. In
/// the order of preference: GPUs before software.
std::vector<Candidate> examine_devices(const vk::raii::Instance& instance,
                                       const Presentation* presentation = nullptr);

/// The index of the first that can be used and whose name contains `name` (in any case).
/// Throws Failure that lists all of them with what they lack.
std::size_t choose_device(const std::vector<Candidate>& candidates, const std::string& name);

}  // namespace geotherm::engine
