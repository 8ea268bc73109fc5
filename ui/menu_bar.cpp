// SPDX-License-Identifier: MIT
#include "ui/panels.h"

#include <imgui.h>
#include <algorithm>
#include <cfloat>
#include <string>

#include "app/session/model.h"
#include "ui/key_map.h"
#include "ui/widgets.h"

namespace geotherm::ui {
namespace {

void draw_bundled_entries(Frame& frame) {
  for (const app::BundledModel& model : app::bundled_models()) {
    const std::string name(model.name);
    if (ImGui::MenuItem(name.c_str(), std::string(model.feature).c_str())) {
      frame.send(app::command::Open{name});
    }
    frame.mark(name);
  }
}

}  // namespace

void draw_bundled_list(Frame& frame, float width) {
  if (draw_button(frame, "bundled", "Bundled\u2026", true, width)) ImGui::OpenPopup("bundled");
  if (!ImGui::BeginPopup("bundled")) return;
  draw_bundled_entries(frame);
  ImGui::EndPopup();
}

namespace {

constexpr int kScales[] = {75, 100, 125, 150, 200};  ///< of letters, percent

/// A menu of the bar. True: open.
bool begin_menu(Frame& frame, const char* name) {
  frame.section = "Menu";
  // A menu that is taller than its window scrolls: it would cover the bar, and the pointer one of
  // its entries.
  const float room = ImGui::GetIO().DisplaySize.y - ImGui::GetFrameHeight();
  ImGui::SetNextWindowSizeConstraints({0, 0}, {FLT_MAX, std::max(1.0F, room)});
  const bool open = ImGui::BeginMenu(name);
  frame.mark(name);
  return open;
}

void draw_recent_menu(Frame& frame) {
  const bool open = ImGui::BeginMenu("Open recent", !frame.ui.layout.recent.empty());
  frame.mark("Open recent");
  if (!open) return;
  for (const std::string& path : frame.ui.layout.recent) {
    if (ImGui::MenuItem(path.c_str())) frame.send(app::command::Open{path});
    frame.mark(path);
  }
  ImGui::EndMenu();
}

void draw_file_menu(Frame& frame) {
  if (!begin_menu(frame, "File")) return;
  draw_menu_action(frame, "Open model\u2026", Action::kOpenModel);
  const bool open = ImGui::BeginMenu("Open bundled");
  frame.mark("Open bundled");
  if (open) {
    draw_bundled_entries(frame);
    ImGui::EndMenu();
  }
  draw_recent_menu(frame);
  draw_menu_action(frame, "Open session\u2026", Action::kOpenSession);
  draw_menu_action(frame, "Open sequence\u2026", Action::kOpenSequence);
  ImGui::Separator();
  draw_menu_action(frame, "Save session\u2026", Action::kSaveSession);
  draw_menu_action(frame, "Save picture\u2026", Action::kSavePicture);
  draw_menu_action(frame, "Save distances\u2026", Action::kSaveDistances);
  draw_menu_action(frame, "Save report\u2026", Action::kSaveFigures);
  draw_menu_action(frame, "Save log\u2026", Action::kSaveLog);
  draw_menu_action(frame, "Save mesh\u2026", Action::kSaveMesh);
  ImGui::Separator();
  draw_menu_action(frame, "Quit", Action::kQuit);
  ImGui::EndMenu();
}

void draw_edit_menu(Frame& frame) {
  if (!begin_menu(frame, "Edit")) return;
  draw_menu_action(frame, "Undo", Action::kUndo);
  draw_menu_action(frame, "Redo", Action::kRedo);
  ImGui::Separator();
  draw_menu_action(frame, "More sources", Action::kMoreSources);
  draw_menu_action(frame, "Fewer sources", Action::kFewerSources);
  draw_menu_action(frame, "Shuffle sources", Action::kShuffleSources);
  draw_menu_action(frame, "Boundary as source", Action::kBoundarySource);
  draw_menu_action(frame, "Clear sources", Action::kClearSources);
  draw_menu_action(frame, "Remove the source", Action::kRemovePointed);
  ImGui::Separator();
  draw_menu_action(frame, "View only", Action::kViewTool);
  draw_menu_action(frame, "Set sources", Action::kSourceTool);
  draw_menu_action(frame, "Brush", Action::kBrush);
  draw_menu_action(frame, "Paths", Action::kPathTool);
  draw_menu_action(frame, "Pick points", Action::kPickTool);
  draw_menu_action(frame, "Sculpt", Action::kSculpt);
  ImGui::EndMenu();
}

void draw_scale_menu(Frame& frame) {
  const bool open = ImGui::BeginMenu("Size of letters");
  frame.mark("Size of letters");
  if (!open) return;
  for (const int percent : kScales) {
    const auto scale = static_cast<float>(percent) / 100;
    const std::string label = std::to_string(percent) + " %";
    if (ImGui::MenuItem(label.c_str(), nullptr, frame.ui.layout.scale == scale)) {
      frame.ui.layout.scale = scale;
    }
    frame.mark(label);
  }
  ImGui::EndMenu();
}

void draw_view_menu(Frame& frame) {
  if (!begin_menu(frame, "View")) return;
  draw_menu_action(frame, "Wireframe", Action::kWireframe);
  draw_menu_action(frame, "Flat", Action::kFlat);
  draw_menu_action(frame, "Smooth", Action::kSmooth);
  draw_menu_action(frame, "Heat sources", Action::kSources);
  draw_menu_action(frame, "Heat gradient X", Action::kHeatGradient);
  draw_menu_action(frame, "Gradient error", Action::kGradientError);
  draw_menu_action(frame, "Distance contours", Action::kContours);
  draw_menu_action(frame, "Exact error", Action::kExactError);
  draw_menu_action(frame, "Nearest sources", Action::kRegions);
  draw_menu_action(frame, "Eikonal error", Action::kEikonalError);
  draw_menu_action(frame, "Lost gradients", Action::kLostGradients);
  draw_menu_action(frame, "Triangle quality", Action::kTriangleQuality);
  draw_menu_action(frame, "Non-Delaunay edges", Action::kNonDelaunay);
  ImGui::Separator();
  draw_menu_action(frame, "Rotate", Action::kRotate);
  draw_menu_action(frame, "Whole model", Action::kFrame);
  ImGui::Separator();
  draw_menu_action(frame, "Play frames", Action::kPlay);
  draw_menu_action(frame, "Next frame", Action::kNextFrame);
  draw_menu_action(frame, "Previous frame", Action::kPreviousFrame);
  draw_menu_action(frame, "Loop", Action::kLoop);
  ImGui::Separator();
  draw_menu_action(frame, "Left side bar", Action::kLeftPanel);
  draw_menu_action(frame, "Right side bar", Action::kRightPanel);
  draw_menu_action(frame, "Log", Action::kLogPanel);
  ImGui::Separator();
  draw_menu_action(frame, "Light theme", Action::kTheme);
  draw_scale_menu(frame);
  ImGui::EndMenu();
}

void draw_solve_menu(Frame& frame) {
  if (!begin_menu(frame, "Solve")) return;
  draw_menu_action(frame, "Keep as B", Action::kKeep);
  draw_menu_action(frame, "Swap A and B", Action::kSwap);
  draw_menu_action(frame, "Forget B", Action::kForget);
  draw_menu_action(frame, "Flip A and B", Action::kFlip);
  draw_menu_action(frame, "Difference A \u2212 B", Action::kShowDifference);
  ImGui::Separator();
  draw_menu_action(frame, "Compare all backends", Action::kCompare);
  if (ImGui::MenuItem("Cancel the work", "Esc", false, frame.session.work().busy)) {
    frame.out.cancel = true;
  }
  frame.mark("Cancel the work");
  ImGui::EndMenu();
}

void draw_help_menu(Frame& frame) {
  if (!begin_menu(frame, "Help")) return;
  draw_menu_action(frame, "Keys and mouse", Action::kKeys);
  draw_menu_action(frame, "About", Action::kAbout);
  ImGui::EndMenu();
}

}  // namespace

void draw_menu_action(Frame& frame, const char* label, Action action) {
  const std::string keys(shortcut(action));
  if (ImGui::MenuItem(label, keys.c_str(), is_on(frame, action), is_possible(frame, action))) {
    perform(frame, action);
  }
  frame.mark(label);
}

void draw_menu_bar(Frame& frame) {
  if (!ImGui::BeginMainMenuBar()) return;
  draw_file_menu(frame);
  draw_edit_menu(frame);
  draw_view_menu(frame);
  draw_solve_menu(frame);
  draw_help_menu(frame);
  ImGui::EndMainMenuBar();
}

}  // namespace geotherm::ui
