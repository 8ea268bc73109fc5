// SPDX-License-Identifier: MIT
// The real window: the one place where engine, panels and session meet.
#include "app/main_window/make_window.h"
#include "app/main_window/window_loop.h"

namespace geotherm::app {
namespace {

class EngineWindow final : public ViewerWindow {
 public:
  Result<void> run(const ViewerStart& start) override {
    auto loop = WindowLoop::open(start);
    if (!loop) return loop.error();
    return (*loop)->run();
  }
};

}  // namespace

std::unique_ptr<ViewerWindow> make_window() { return std::make_unique<EngineWindow>(); }

}  // namespace geotherm::app
