// SPDX-License-Identifier: MIT
// In builds without the viewer, instead of the real one.
#include "app/cli/viewer_window.h"

namespace geotherm::app {
namespace {

class NoWindow final : public ViewerWindow {
 public:
  Result<void> run(const ViewerStart& /*start*/) override {
    return Error{ErrorCode::kNoDevice,
                 "this build has no window",
                 {"configure it with -DGEOTHERM_BUILD_VIEWER=ON, or draw without one: geotherm "
                  "render, geotherm view ",
                  SettingHint{"headless"}}};
  }
};

}  // namespace

std::unique_ptr<ViewerWindow> make_window() { return std::make_unique<NoWindow>(); }

}  // namespace geotherm::app
