// SPDX-License-Identifier: MIT
#include "engine/vulkan/instance.h"

#include <dlfcn.h>
#include <algorithm>
#include <array>
#include <cstring>
#include <string_view>
#include <utility>

#include "engine/vulkan/vulkan.h"
#include "solver/core/text.h"

namespace geotherm::engine {

Hint less_memory() {
  return {"try a smaller picture, ", SettingHint{"samples", {"1"}}, " or a mesh with fewer faces"};
}

Error error_of(vk::Result status, std::string_view what) {
  const std::string doing(what);
  switch (status) {
    case vk::Result::eErrorOutOfDeviceMemory:
      return {ErrorCode::kOutOfMemory, doing + ": the device is out of memory", less_memory()};
    case vk::Result::eErrorOutOfHostMemory:
      return {
          ErrorCode::kOutOfMemory, doing + ": out of memory", {"try a smaller picture or mesh"}};
    case vk::Result::eErrorDeviceLost:
      return {ErrorCode::kNoDevice,
              doing + ": the device was lost (its driver has given up)",
              {"try again, or another device"}};
    case vk::Result::eErrorIncompatibleDriver:
      return {ErrorCode::kNoDevice,
              doing + ": the Vulkan loader found no driver",
              {"install one (Debian: mesa-vulkan-drivers, which also draws without a GPU)"}};
    default:
      return {ErrorCode::kNoDevice,
              doing + ": Vulkan answered " + vk::to_string(status),
              {"try another device"}};
  }
}

Loader::Loader() {
  library_ = ::dlopen("libvulkan.so.1", RTLD_NOW | RTLD_LOCAL);
  if (library_ != nullptr) {
    entry_ =
        reinterpret_cast<PFN_vkGetInstanceProcAddr>(::dlsym(library_, "vkGetInstanceProcAddr"));
  }
  if (entry_ != nullptr) return;
  const char* const reason = ::dlerror();
  throw Failure({ErrorCode::kNoDevice,
                 "the Vulkan loader cannot be opened (" +
                     std::string(reason ? reason : "libvulkan.so.1 is no loader") + ")",
                 {"install it (Debian: libvulkan1 mesa-vulkan-drivers)"}});
}

Loader::Loader(Loader&& other) noexcept
    : library_(std::exchange(other.library_, nullptr)), entry_(other.entry_) {}

Loader::~Loader() {
  if (library_ != nullptr) ::dlclose(library_);
}

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
                   "the Vulkan loader knows version 1.0 alone and 1.3 is needed",
                   {"install a newer one"}});
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

namespace {

constexpr vk::Format kColour = vk::Format::eR8G8B8A8Unorm;
constexpr vk::Format kDepth = vk::Format::eD32Sfloat;

std::string kind_of(vk::PhysicalDeviceType type) {
  switch (type) {
    case vk::PhysicalDeviceType::eDiscreteGpu:
      return "discrete GPU";
    case vk::PhysicalDeviceType::eIntegratedGpu:
      return "integrated GPU";
    case vk::PhysicalDeviceType::eVirtualGpu:
      return "virtual GPU";
    case vk::PhysicalDeviceType::eCpu:
      return "software";
    default:
      return "other";
  }
}

/// Smaller comes first.
int rank_of(const DeviceInfo& info) {
  const std::array kinds = {"discrete GPU", "integrated GPU", "virtual GPU", "software"};
  const auto place = std::find(kinds.begin(), kinds.end(), info.kind);
  return static_cast<int>(place - kinds.begin()) + (info.lacks.empty() ? 0 : 100);
}

std::uint64_t largest_heap(const vk::raii::PhysicalDevice& device) {
  const auto memory = device.getMemoryProperties();
  std::uint64_t most = 0;
  for (std::uint32_t i = 0; i < memory.memoryHeapCount; ++i) {
    const vk::MemoryHeap& heap = memory.memoryHeaps[i];
    if (heap.flags & vk::MemoryHeapFlagBits::eDeviceLocal) {
      most = std::max<std::uint64_t>(most, heap.size);
    }
  }
  return most;
}

bool can(const vk::raii::PhysicalDevice& device, vk::Format format, vk::FormatFeatureFlags use) {
  return (device.getFormatProperties(format).optimalTilingFeatures & use) == use;
}

bool has_swapchains(const vk::raii::PhysicalDevice& device) {
  const auto extensions = device.enumerateDeviceExtensionProperties();
  return std::any_of(extensions.begin(), extensions.end(), [](const auto& extension) {
    return std::string_view(extension.extensionName) == VK_KHR_SWAPCHAIN_EXTENSION_NAME;
  });
}

/// Chooses the queue family.
void find_queue(Candidate& candidate, vk::Instance instance, const Presentation* presentation) {
  const auto families = candidate.device.getQueueFamilyProperties();
  bool draws = false;
  bool presents = false;
  for (std::uint32_t i = 0; i < families.size() && !presents; ++i) {
    if (!(families[i].queueFlags & vk::QueueFlagBits::eGraphics)) continue;
    presents = presentation != nullptr && presentation->can_present(instance, *candidate.device, i);
    if (!draws || presents) candidate.queue_family = i;
    draws = true;
  }
  if (!draws) candidate.info.lacks.emplace_back("no queue that draws");
  if (presentation != nullptr && !(presents && has_swapchains(candidate.device))) {
    candidate.info.lacks.emplace_back("cannot show pictures in windows");
  }
}

void find_lacks(Candidate& candidate) {
  const vk::raii::PhysicalDevice& device = candidate.device;
  std::vector<std::string>& lacks = candidate.info.lacks;
  const auto limits = device.getProperties().limits;
  const auto both = limits.framebufferColorSampleCounts & limits.framebufferDepthSampleCounts;
  if (!(both & vk::SampleCountFlagBits::e4)) lacks.emplace_back("no 4 samples a pixel");
  using Use = vk::FormatFeatureFlagBits;
  if (!can(device, kColour, Use::eColorAttachment | Use::eColorAttachmentBlend)) {
    lacks.emplace_back("no RGBA8 pictures");
  }
  if (!can(device, kDepth, Use::eDepthStencilAttachment)) {
    lacks.emplace_back("no 32-bit depth");
  }
  if (candidate.info.api_major == 1 && candidate.info.api_minor < 3) {
    lacks.push_back("Vulkan 1." + std::to_string(candidate.info.api_minor) +
                    " where 1.3 is needed");
    return;  // what follows may only be asked of 1.3
  }
  const auto features =
      device.getFeatures2<vk::PhysicalDeviceFeatures2, vk::PhysicalDeviceVulkan13Features>();
  const auto& v13 = features.get<vk::PhysicalDeviceVulkan13Features>();
  if (!v13.dynamicRendering) lacks.emplace_back("no dynamic rendering");
  if (!v13.synchronization2) lacks.emplace_back("no synchronization2");
}

Candidate examine(vk::raii::PhysicalDevice device, vk::Instance instance,
                  const Presentation* presentation) {
  const auto properties =
      device.getProperties2<vk::PhysicalDeviceProperties2, vk::PhysicalDeviceDriverProperties>();
  const vk::PhysicalDeviceProperties& base =
      properties.get<vk::PhysicalDeviceProperties2>().properties;
  const auto& driver = properties.get<vk::PhysicalDeviceDriverProperties>();
  Candidate candidate{std::move(device), {}, 0};
  DeviceInfo& info = candidate.info;
  info.name = base.deviceName.data();
  info.kind = kind_of(base.deviceType);
  info.software = base.deviceType == vk::PhysicalDeviceType::eCpu;
  if (base.apiVersion >= VK_API_VERSION_1_2) {
    info.driver = std::string(driver.driverName.data());
    if (driver.driverInfo[0] != '\0') info.driver += " " + std::string(driver.driverInfo.data());
  }
  info.api_major = VK_API_VERSION_MAJOR(base.apiVersion);
  info.api_minor = VK_API_VERSION_MINOR(base.apiVersion);
  info.api_patch = VK_API_VERSION_PATCH(base.apiVersion);
  info.memory = largest_heap(candidate.device);
  find_queue(candidate, instance, presentation);
  find_lacks(candidate);
  return candidate;
}

/// "llvmpipe (software); Old GPU (discrete GPU; refused: no dynamic rendering)".
std::string in_words(const std::vector<Candidate>& candidates) {
  std::string text;
  for (const Candidate& candidate : candidates) {
    if (!text.empty()) text += ", ";
    text += candidate.info.name + " (" + candidate.info.kind;
    std::string reasons;
    for (const std::string& lack : candidate.info.lacks) {
      reasons += (reasons.empty() ? "; refused: " : ", ") + lack;
    }
    text += reasons + ")";
  }
  return text;
}

}  // namespace

std::vector<Candidate> examine_devices(const vk::raii::Instance& instance,
                                       const Presentation* presentation) {
  std::vector<Candidate> candidates;
  for (vk::raii::PhysicalDevice& device : vk::raii::PhysicalDevices(instance)) {
    candidates.push_back(examine(std::move(device), *instance, presentation));
  }
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const auto& a, const auto& b) { return rank_of(a.info) < rank_of(b.info); });
  if (!candidates.empty() && candidates.front().info.lacks.empty()) {
    candidates.front().info.chosen = true;
  }
  return candidates;
}

std::size_t choose_device(const std::vector<Candidate>& candidates, const std::string& name) {
  if (candidates.empty()) {
    throw Failure({ErrorCode::kNoDevice,
                   "there is no Vulkan device",
                   {"install a driver (Debian: mesa-vulkan-drivers, which also draws without a "
                    "GPU)"}});
  }
  bool named = false;
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    const DeviceInfo& info = candidates[i].info;
    if (lower_case(info.name).find(lower_case(name)) == std::string::npos) continue;
    named = true;
    if (info.lacks.empty()) return i;
  }
  if (!named) {
    throw Failure({ErrorCode::kNoDevice,
                   "no device is called '" + name + "'",
                   {"there are: " + in_words(candidates)}});
  }
  throw Failure({ErrorCode::kNoDevice, (name.empty() ? "no device can draw: "
                                                     : "the device '" + name + "' cannot draw: ") +
                                           in_words(candidates)});
}

}  // namespace geotherm::engine
