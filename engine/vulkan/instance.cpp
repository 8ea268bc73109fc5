// SPDX-License-Identifier: MIT
#include "engine/vulkan/instance.h"

#include <algorithm>
#include <array>
#include <cstring>

#include "engine/vulkan/vulkan_error.h"

namespace geotherm::engine {
namespace {

constexpr const char* kValidationLayer = "VK_LAYER_KHRONOS_validation";

VKAPI_ATTR VkBool32 VKAPI_CALL take_message(VkDebugUtilsMessageSeverityFlagBitsEXT /*severity*/,
                                            VkDebugUtilsMessageTypeFlagsEXT /*type*/,
                                            const VkDebugUtilsMessengerCallbackDataEXT* data,
                                            void* log) {
  static_cast<MessageLog*>(log)->add(data->pMessage);
  return VK_FALSE;
}

vk::DebugUtilsMessengerCreateInfoEXT messenger_info(MessageLog& log) {
  using Severity = vk::DebugUtilsMessageSeverityFlagBitsEXT;
  using Type = vk::DebugUtilsMessageTypeFlagBitsEXT;
  return {{}, Severity::eWarning | Severity::eError, Type::eValidation, take_message, &log};
}

vk::raii::Instance make_instance(const vk::raii::Context& context, bool validation,
                                 const Presentation* presentation, MessageLog& log) {
  const vk::ApplicationInfo application("geotherm", 1, "geotherm", 1, VK_API_VERSION_1_3);
  if (context.enumerateInstanceVersion() < VK_API_VERSION_1_1) {
    throw Failure({ErrorCode::kNoDevice,
                   "the Vulkan loader knows version 1.0 alone and 1.3 is needed; install a newer "
                   "one"});
  }
  std::vector<const char*> extensions;
  if (presentation != nullptr) extensions = presentation->instance_extensions();
  vk::InstanceCreateInfo info({}, &application);
  info.setPEnabledExtensionNames(extensions);
  if (!validation) return {context, info};

  const auto layers = context.enumerateInstanceLayerProperties();
  if (std::none_of(layers.begin(), layers.end(), [](const vk::LayerProperties& layer) {
        return std::strcmp(layer.layerName, kValidationLayer) == 0;
      })) {
    throw Failure({ErrorCode::kNoDevice,
                   "validation was asked for and its layer is not installed (Debian: "
                   "vulkan-validationlayers)"});
  }
  extensions.push_back(VK_EXT_DEBUG_UTILS_EXTENSION_NAME);
  const std::array enabled = {vk::ValidationFeatureEnableEXT::eSynchronizationValidation};
  const auto messenger = messenger_info(log);
  const vk::ValidationFeaturesEXT features(enabled, {}, &messenger);
  info.setPEnabledLayerNames(kValidationLayer).setPEnabledExtensionNames(extensions);
  info.setPNext(&features);
  return {context, info};
}

}  // namespace

void MessageLog::add(std::string message) {
  const std::lock_guard lock(mutex_);
  messages_.push_back(std::move(message));
}

std::vector<std::string> MessageLog::messages() const {
  const std::lock_guard lock(mutex_);
  return messages_;
}

Instance::Instance(bool validation, const Presentation* presentation)
    : log(std::make_unique<MessageLog>()),
      context(loader.entry()),
      instance(make_instance(context, validation, presentation, *log)),
      messenger(nullptr) {
  if (validation) messenger = vk::raii::DebugUtilsMessengerEXT(instance, messenger_info(*log));
}

}  // namespace geotherm::engine
