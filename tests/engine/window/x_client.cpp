// SPDX-License-Identifier: MIT
#include "tests/engine/window/x_client.h"

#include <X11/Xlib.h>
#include <X11/Xutil.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <memory>
#include <stdexcept>
#include <thread>

namespace geotherm::test {
namespace {

using Connection = std::unique_ptr<Display, int (*)(Display*)>;

Connection connect() {
  Connection connection(::XOpenDisplay(nullptr), &::XCloseDisplay);
  if (!connection) throw std::runtime_error("no display");
  return connection;
}

bool is_of_class(Display* display, ::Window window, const std::string& name) {
  XClassHint hint{};
  if (::XGetClassHint(display, window, &hint) == 0) return false;
  const bool same = name == hint.res_class && name == hint.res_name;
  ::XFree(hint.res_class);
  ::XFree(hint.res_name);
  return same;
}

/// Without a window manager it is a child of the root.
::Window find(Display* display, const std::string& name) {
  ::Window root = 0;
  ::Window parent = 0;
  ::Window* children = nullptr;
  unsigned count = 0;
  ::XQueryTree(display, DefaultRootWindow(display), &root, &parent, &children, &count);
  ::Window found = 0;
  for (unsigned i = 0; i < count; ++i) {
    if (is_of_class(display, children[i], name)) found = children[i];
  }
  if (children != nullptr) ::XFree(children);
  if (found == 0) throw std::runtime_error("no window of class " + name);
  return found;
}

}  // namespace

void mark_minimised(const std::string& window_class, bool minimised) {
  const Connection display = connect();
  const ::Window window = find(display.get(), window_class);
  const Atom wm_state = ::XInternAtom(display.get(), "WM_STATE", False);
  const std::array<long, 2> value = {minimised ? IconicState : NormalState, 0};
  ::XChangeProperty(display.get(), window, wm_state, wm_state, 32, PropModeReplace,
                    reinterpret_cast<const unsigned char*>(value.data()), 2);
  ::XSync(display.get(), False);
}

void ask_to_close(const std::string& window_class) {
  const Connection display = connect();
  XEvent event{};
  event.xclient.type = ClientMessage;
  event.xclient.window = find(display.get(), window_class);
  event.xclient.message_type = ::XInternAtom(display.get(), "WM_PROTOCOLS", False);
  event.xclient.format = 32;
  event.xclient.data.l[0] =
      static_cast<long>(::XInternAtom(display.get(), "WM_DELETE_WINDOW", False));
  ::XSendEvent(display.get(), event.xclient.window, False, NoEventMask, &event);
  ::XSync(display.get(), False);
}

/// The protocol is XDND: enter, position and drop are told to the window, which asks for the
/// selection and says when it has finished.
void drop(const std::string& window_class, const std::string& uris) {
  const Connection connection = connect();
  Display* const display = connection.get();
  const auto atom = [&](const char* name) { return ::XInternAtom(display, name, False); };
  const ::Window target = find(display, window_class);
  const ::Window source =
      ::XCreateSimpleWindow(display, DefaultRootWindow(display), 0, 0, 1, 1, 0, 0, 0);
  ::XSetSelectionOwner(display, atom("XdndSelection"), source, CurrentTime);

  const auto tell = [&](const char* what, std::array<long, 4> words) {
    XEvent event{};
    event.xclient.type = ClientMessage;
    event.xclient.window = target;
    event.xclient.message_type = atom(what);
    event.xclient.format = 32;
    event.xclient.data.l[0] = static_cast<long>(source);
    std::copy(words.begin(), words.end(), event.xclient.data.l + 1);
    ::XSendEvent(display, target, False, NoEventMask, &event);
  };
  constexpr long kVersion = 5L << 24;
  tell("XdndEnter", {kVersion, static_cast<long>(atom("text/uri-list")), 0, 0});
  tell("XdndPosition", {0, 10L << 16 | 10, CurrentTime, static_cast<long>(atom("XdndActionCopy"))});
  tell("XdndDrop", {0, CurrentTime, 0, 0});
  ::XFlush(display);

  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(10);
  while (std::chrono::steady_clock::now() < end) {
    if (::XPending(display) == 0) {
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
      continue;
    }
    XEvent event{};
    ::XNextEvent(display, &event);
    if (event.type == ClientMessage && event.xclient.message_type == atom("XdndFinished")) return;
    if (event.type != SelectionRequest) continue;
    const XSelectionRequestEvent& asked = event.xselectionrequest;
    ::XChangeProperty(display, asked.requestor, asked.property, asked.target, 8, PropModeReplace,
                      reinterpret_cast<const unsigned char*>(uris.data()),
                      static_cast<int>(uris.size()));
    XEvent answer{};
    answer.xselection.type = SelectionNotify;
    answer.xselection.requestor = asked.requestor;
    answer.xselection.selection = asked.selection;
    answer.xselection.target = asked.target;
    answer.xselection.property = asked.property;
    answer.xselection.time = asked.time;
    ::XSendEvent(display, asked.requestor, False, NoEventMask, &answer);
    ::XFlush(display);
  }
}

}  // namespace geotherm::test
