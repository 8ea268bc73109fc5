// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "engine/vulkan/loader.h"
#include "engine/vulkan/presentation.h"
#include "engine/vulkan/vulkan.h"

namespace geotherm::engine {

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

}  // namespace geotherm::engine
