// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "geotherm/error.h"

namespace geotherm::engine {

class Window;

struct DeviceOptions {
  std::string name;         ///< part of the device's name, in any case; empty: the best one
  bool validation = false;  ///< Khronos validation with synchronization validation
  bool staging = false;     ///< write through copies, as where the host cannot see device memory
  std::uint64_t memory_limit = 0;  ///< bytes of device memory that may be used; 0: what there is
  /// Chooses among the devices that can show pictures in this window; null: in none.
  const Window* window = nullptr;
};

/// A device of this machine, and whether it can be used.
struct DeviceInfo {
  std::string name;
  std::string kind;  ///< "discrete GPU", "integrated GPU", "virtual GPU", "software", "other"
  std::string driver;
  std::uint32_t api_major = 0, api_minor = 0, api_patch = 0;
  std::uint64_t memory = 0;  ///< bytes of its largest device-local heap
  bool software = false;
  bool chosen = false;             ///< the one that is used when no name is given
  std::vector<std::string> lacks;  ///< why it cannot be used, one reason each; empty: it can
};

/// All devices, in the order of preference. Errors: kNoDevice (no loader, no driver).
Result<std::vector<DeviceInfo>> list_devices();

/// A Vulkan device that is ready to draw. Several may exist; handles to one share it. A device, its
/// renderers and its targets are for one thread at a time; different devices may be used at once.
class Device {
 public:
  /// Errors: kNoDevice (no loader, no device, none of that name, none that can do what is
  /// needed; each with the devices there are and why they were refused), kOutOfMemory.
  static Result<Device> open(const DeviceOptions& options = {});

  const DeviceInfo& info() const;
  /// What validation has reported so far; always empty without it.
  std::vector<std::string> validation_messages() const;
  std::uint64_t memory_used() const;  ///< bytes of device memory allocated now
  std::uint64_t peak_memory() const;
  int largest_picture() const;  ///< pixels on a side that can be drawn without tiles

  struct State;
  const std::shared_ptr<State>& state() const { return state_; }

 private:
  explicit Device(std::shared_ptr<State> state) : state_(std::move(state)) {}
  std::shared_ptr<State> state_;
};

}  // namespace geotherm::engine
