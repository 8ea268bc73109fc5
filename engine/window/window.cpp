// SPDX-License-Identifier: MIT
#include "engine/window/window.h"

#include "engine/vulkan/vulkan.h"  // before GLFW, which then knows Vulkan's types

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <atomic>
#include <cassert>
#include <mutex>
#include <utility>

#include "engine/vulkan/vulkan.h"
#include "engine/window/window_state.h"

namespace geotherm::engine {
namespace {

constexpr glm::ivec2 kSmallestSize(320, 240);

/// GLFW is one for the whole program, and it may be woken from any thread, also while the window
/// opens or closes. This is all that is kept outside of objects.
struct Glfw {
  std::mutex mutex;  ///< while it opens, closes or is woken
  std::atomic<bool> open = false;
};
Glfw& glfw() {
  static Glfw the_only_one;
  return the_only_one;
}

/// What GLFW last complained about on this thread.
std::string complaint() {
  const char* text = nullptr;
  glfwGetError(&text);
  return text != nullptr ? text : "the window system gives no reason";
}

Error refusal(const std::string& what, Hint hint = {}) {
  return {ErrorCode::kNoDevice, "no window can be opened (" + what + ")", std::move(hint)};
}

Window::State& state_of(GLFWwindow* window) {
  return *static_cast<Window::State*>(glfwGetWindowUserPointer(window));
}

void take_drop(GLFWwindow* window, int count, const char** paths) {
  Window::State& state = state_of(window);
  state.dropped.insert(state.dropped.end(), paths, paths + count);
  state.happened = true;
}

void take_event(GLFWwindow* window, const PanelEvent& event) {
  Window::State& state = state_of(window);
  state.happened = true;
  if (state.panels) state.panels->add(event);
}

void watch(GLFWwindow* window) {
  using What = PanelEvent::Kind;
  constexpr auto kNote = [](GLFWwindow* on, auto...) { state_of(on).happened = true; };
  glfwSetWindowSizeCallback(window, kNote);
  glfwSetFramebufferSizeCallback(window, kNote);
  glfwSetWindowContentScaleCallback(window, kNote);
  glfwSetWindowRefreshCallback(window, kNote);
  glfwSetWindowIconifyCallback(window, kNote);
  glfwSetWindowCloseCallback(window, kNote);
  glfwSetWindowFocusCallback(window, [](GLFWwindow* on, int focused) {
    take_event(on, {.kind = What::kFocus, .code = focused});
  });
  glfwSetKeyCallback(window, [](GLFWwindow* on, int key, int scan, int action, int modifiers) {
    take_event(on, {What::kKey, key, scan, action, modifiers});
  });
  glfwSetCharCallback(window, [](GLFWwindow* on, unsigned character) {
    take_event(on, {.kind = What::kCharacter, .code = static_cast<int>(character)});
  });
  glfwSetMouseButtonCallback(window, [](GLFWwindow* on, int button, int action, int modifiers) {
    take_event(on, {What::kButton, button, 0, action, modifiers});
  });
  glfwSetCursorPosCallback(window, [](GLFWwindow* on, double x, double y) {
    take_event(on, {.kind = What::kCursor, .x = x, .y = y});
  });
  glfwSetCursorEnterCallback(window, [](GLFWwindow* on, int entered) {
    take_event(on, {.kind = What::kCursorEnter, .code = entered});
  });
  glfwSetScrollCallback(window, [](GLFWwindow* on, double x, double y) {
    take_event(on, {.kind = What::kScroll, .x = x, .y = y});
  });
  glfwSetDropCallback(window, take_drop);
}

}  // namespace

Window::State::~State() {
  panels.reset();
  const std::lock_guard lock(glfw().mutex);
  glfwDestroyWindow(window);
  glfwTerminate();
  glfw().open = false;
}

std::vector<const char*> Window::State::instance_extensions() const {
  std::uint32_t count = 0;
  const char** const names = glfwGetRequiredInstanceExtensions(&count);
  return {names, names + count};
}

bool Window::State::can_present(vk::Instance instance, vk::PhysicalDevice device,
                                std::uint32_t queue_family) const {
  return glfwGetPhysicalDevicePresentationSupport(instance, device, queue_family) == GLFW_TRUE;
}

vk::SurfaceKHR Window::State::make_surface(vk::Instance instance) const {
  VkSurfaceKHR surface = VK_NULL_HANDLE;
  if (glfwCreateWindowSurface(instance, window, nullptr, &surface) != VK_SUCCESS) {
    throw Failure(refusal(complaint()));
  }
  return surface;
}

Window::Window(std::unique_ptr<State> state) : state_(std::move(state)) {}
Window::~Window() = default;

Result<std::unique_ptr<Window>> Window::open(const WindowOptions& options) {
  const std::lock_guard lock(glfw().mutex);
  assert(!glfw().open);
  const auto refuse = [](const std::string& what, Hint hint = {}) {
    glfwTerminate();
    return refusal(what, std::move(hint));
  };
  if (glfwInit() != GLFW_TRUE) return refuse(complaint());
  std::uint32_t count = 0;
  if (glfwGetRequiredInstanceExtensions(&count) == nullptr) {
    return refuse("no Vulkan that draws in windows",
                  {"install one (Debian: libvulkan1 mesa-vulkan-drivers)"});
  }
  glfwWindowHint(GLFW_CLIENT_API, GLFW_NO_API);
  glfwWindowHint(GLFW_SCALE_TO_MONITOR, GLFW_TRUE);
  glfwWindowHintString(GLFW_X11_CLASS_NAME, "geotherm");
  glfwWindowHintString(GLFW_X11_INSTANCE_NAME, "geotherm");
  GLFWwindow* const window =
      glfwCreateWindow(options.size.x, options.size.y, options.title.c_str(), nullptr, nullptr);
  if (window == nullptr) return refuse(complaint());
  auto state = std::make_unique<State>(window);
  glfwSetWindowUserPointer(window, state.get());
  glfwSetWindowSizeLimits(window, kSmallestSize.x, kSmallestSize.y, GLFW_DONT_CARE, GLFW_DONT_CARE);
  watch(window);
  glfw().open = true;
  return std::unique_ptr<Window>(new Window(std::move(state)));
}

void Window::connect_panels() { state_->panels = std::make_unique<PanelInput>(state_->window); }

void Window::begin_panels() {
  assert(state_->panels);
  state_->panels->begin();
}

bool Window::has_more_input() const { return state_->panels && state_->panels->has_more(); }

bool Window::wait(double seconds) {
  State& s = *state_;
  s.happened = false;
  if (seconds < 0) {
    glfwWaitEvents();
    return true;
  }
  if (seconds == 0) {
    glfwPollEvents();
    return s.happened;
  }
  const double begin = glfwGetTime();
  glfwWaitEventsTimeout(seconds);
  return s.happened || glfwGetTime() - begin < seconds;  // wake() calls nothing back
}

void Window::wake() {
  if (!glfw().open) return;  // nothing waits; while it opens, others go on
  const std::lock_guard lock(glfw().mutex);
  if (glfw().open) glfwPostEmptyEvent();
}

glm::ivec2 Window::pixels() const {
  if (glfwGetWindowAttrib(state_->window, GLFW_ICONIFIED) == GLFW_TRUE) return {0, 0};
  glm::ivec2 size(0);
  glfwGetFramebufferSize(state_->window, &size.x, &size.y);
  return size;
}

glm::vec2 Window::content_scale() const {
  glm::vec2 scale(1);
  glfwGetWindowContentScale(state_->window, &scale.x, &scale.y);
  return scale;
}

bool Window::take_close() {
  const bool asked = glfwWindowShouldClose(state_->window) == GLFW_TRUE;
  glfwSetWindowShouldClose(state_->window, GLFW_FALSE);
  return asked;
}

std::vector<std::string> Window::take_dropped_files() { return std::exchange(state_->dropped, {}); }

void Window::set_title(const std::string& title) {
  glfwSetWindowTitle(state_->window, title.c_str());
}

}  // namespace geotherm::engine
