// SPDX-License-Identifier: MIT
#include "ui/action.h"

#include <algorithm>
#include <iterator>
#include <optional>
#include <utility>

#include "app/picture/picture_text.h"
#include "ui/frame.h"
#include "ui/panels.h"
#include "ui/source_edit.h"

namespace geotherm::ui {
namespace {

using app::View;

constexpr std::pair<Action, View> kViews[] = {
    {Action::kWireframe, View::kWireframe},
    {Action::kFlat, View::kFlat},
    {Action::kSmooth, View::kSmooth},
    {Action::kSources, View::kSources},
    {Action::kHeatGradient, View::kHeatGradient},
    {Action::kGradientError, View::kGradientError},
    {Action::kContours, View::kContours},
    {Action::kExactError, View::kExactError},
    {Action::kRegions, View::kRegions},
    {Action::kEikonalError, View::kEikonalError},
    {Action::kLostGradients, View::kLostGradients},
    {Action::kTriangleQuality, View::kTriangleQuality},
    {Action::kNonDelaunay, View::kNonDelaunay},
};

constexpr std::pair<Action, Tool> kTools[] = {
    {Action::kViewTool, Tool::kView}, {Action::kSourceTool, Tool::kSource},
    {Action::kBrush, Tool::kBrush},   {Action::kPathTool, Tool::kPath},
    {Action::kPickTool, Tool::kPick}, {Action::kSculpt, Tool::kSculpt},
};

/// What a table has for the action.
template <class Value, std::size_t kCount>
std::optional<Value> find_in(const std::pair<Action, Value> (&table)[kCount], Action action) {
  const auto* const found = std::ranges::find(table, action, &std::pair<Action, Value>::first);
  return found == std::end(table) ? std::nullopt : std::optional(found->second);
}

/// The frame so many after the one that is shown, round the end. Precondition: there are frames.
app::Command frame_beside(const Frame& frame, int step) {
  const int frames = frame.model()->frames;
  return app::command::ShowFrame{(frame.state().timeline.frame + step + frames) % frames};
}

/// What an action sends, where it sends something.
std::optional<app::Command> command_of(const Frame& frame, Action action) {
  if (const auto view = find_in(kViews, action)) {
    return app::command::Set{"view", geotherm::to_text(*view)};
  }
  switch (action) {
    case Action::kQuit:
      return app::command::Quit{};
    case Action::kUndo:
      return app::command::Undo{};
    case Action::kRedo:
      return app::command::Redo{};
    case Action::kRotate:
      return app::command::Rotate{!frame.state().rotating};
    case Action::kPlay:
      return app::command::Play{!frame.state().timeline.playing};
    case Action::kNextFrame:
      return frame_beside(frame, 1);
    case Action::kPreviousFrame:
      return frame_beside(frame, -1);
    case Action::kLoop:
      return app::command::Loop{!frame.state().timeline.loop};
    case Action::kMoreSources:
      return app::command::MoreSources{};
    case Action::kFewerSources:
      return app::command::FewerSources{};
    case Action::kShuffleSources:
      return app::command::ShuffleSources{};
    case Action::kClearSources:
      return app::command::ClearSources{};
    case Action::kBoundarySource:
      return app::command::SetSources{{app::WholeBoundary{}}};
    case Action::kKeep:
      return app::command::Keep{};
    case Action::kFlip:
      return app::command::Flip{};
    case Action::kSwap:
      return app::command::Swap{};
    case Action::kForget:
      return app::command::Forget{};
    case Action::kShowDifference:
      return app::command::Show{app::Shown::kDifference};
    case Action::kCompare:
      return app::command::Compare{};
    default:
      return std::nullopt;
  }
}

/// One thing at a time: first what the mouse is set to, then what is marked, then the work.
void stop(Frame& frame) {
  CanvasInput& input = frame.ui.input;
  if (frame.ui.drawer != Drawer::kNone) {
    frame.ui.drawer = Drawer::kNone;
  } else if (input.tool != Tool::kSource) {
    input.tool = Tool::kSource;
  } else if (frame.session.work().busy) {
    frame.out.cancel = true;
  } else if (frame.state().target) {
    frame.send(app::command::Target{std::nullopt});
  } else if (frame.state().picked) {
    frame.send(app::command::Pick{std::nullopt});
  }
}

Rect& bar_of(Places& places, Drawer bar) {
  if (bar == Drawer::kLog) return places.log;
  return bar == Drawer::kRight ? places.right : places.left;
}

/// A bar that is wanted but has no room is shown in the other one's place or, where the window is
/// too small for any, over the picture.
void turn_bar(Frame& frame, Drawer bar) {
  UiState& ui = frame.ui;
  if (std::exchange(ui.drawer, Drawer::kNone) == bar) return;
  Layout layout = ui.layout;
  bool& wanted = bar == Drawer::kLog     ? layout.log
                 : bar == Drawer::kRight ? layout.right
                                         : layout.left;
  wanted = !(wanted && bar_of(ui.places, bar).width > 0);
  if (wanted && bar != Drawer::kLog) layout.right_first = bar == Drawer::kRight;
  const ImVec2 window = ImGui::GetIO().DisplaySize;
  Places places = place_panels(layout, window.x, window.y, ui.scale, ImGui::GetFrameHeight());
  if (wanted && bar_of(places, bar).width <= 0) {
    ui.drawer = bar;  // for a while: larger windows stay as they were
  } else {
    ui.layout = layout;
  }
}

/// As large as there is room for from here; what follows turns a model of one size.
void fit_model(Frame& frame) {
  frame.send(app::command::Frame{});
  if (const auto place = frame.canvas.tight()) frame.send(*place);
}

void turn_switch(Frame& frame, Action action) {
  Layout& layout = frame.ui.layout;
  if (const auto tool = find_in(kTools, action)) {
    Tool& now = frame.ui.input.tool;
    now = now == *tool ? Tool::kSource : *tool;
    return;
  }
  switch (action) {
    case Action::kRemovePointed:
      if (const auto place = frame.ui.input.pointed(frame)) {
        return frame.send(removal(frame.explored(), *place));
      }
      return remove_entry(frame, *chosen_entry(frame));
    case Action::kFrame:
      return fit_model(frame);
    case Action::kLeftPanel:
      return turn_bar(frame, Drawer::kLeft);
    case Action::kRightPanel:
      return turn_bar(frame, Drawer::kRight);
    case Action::kLogPanel:
      return turn_bar(frame, Drawer::kLog);
    case Action::kTheme:
      layout.theme = layout.theme == Theme::kDark ? Theme::kLight : Theme::kDark;
      frame.ui.restyle = true;
      return;
    case Action::kKeys:
      frame.ui.ask_keys = true;
      return;
    case Action::kAbout:
      frame.ui.ask_about = true;
      return;
    case Action::kStop:
      return stop(frame);
    default:
      return;
  }
}

}  // namespace

void show_figures(Frame& frame, const char* section) {
  frame.ui.layout.open[section] = true;
  frame.ui.sought = section;
  frame.ui.seeks = 3;
  if (!is_on(frame, Action::kRightPanel)) turn_switch(frame, Action::kRightPanel);
}

void perform(Frame& frame, Action action) {
  if (!is_possible(frame, action)) return;
  if (action == Action::kCompare) show_figures(frame, kCompareSection);
  const app::Timeline& timeline = frame.state().timeline;
  // From the last frame on, where none follows, there would be nothing to play.
  if (action == Action::kPlay && !timeline.playing && !timeline.loop &&
      timeline.frame + 1 >= frame.model()->frames) {
    frame.send(app::command::ShowFrame{0});
  }
  if (auto command = command_of(frame, action)) {
    frame.send(*std::move(command));
    // B has become A, which can be changed: it stays in sight.
    const bool shows_b = frame.state().shown == app::Shown::kB;
    if (action == Action::kSwap && shows_b) frame.send(app::command::Show{app::Shown::kA});
    return;
  }
  if (const FileTask* task = file_task(action)) return frame.ui.dialog.ask(*task, frame.state());
  turn_switch(frame, action);
}

bool is_possible(const Frame& frame, Action action) {
  switch (action) {
    case Action::kUndo:
      return frame.session.can_undo();
    case Action::kRedo:
      return frame.session.can_redo();
    case Action::kRemovePointed: {
      // Places belong to what is shown: while other sources are on their way, none can be named.
      const bool settled = frame.explored().sources == frame.state().sources;
      const auto place = frame.ui.input.pointed(frame);
      if (!place) return chosen_entry(frame).has_value();
      return settled && *place < frame.explored().places.size();
    }
    case Action::kMoreSources:
    case Action::kViewTool:
    case Action::kSourceTool:
    case Action::kPathTool:
    case Action::kPickTool:
    case Action::kBrush:
    case Action::kSavePicture:
    case Action::kCompare:
      return frame.model() != nullptr;
    case Action::kPlay:
    case Action::kNextFrame:
    case Action::kPreviousFrame:
    case Action::kLoop:
      return frame.model() && frame.model()->frames > 0;
    case Action::kSculpt:
    case Action::kSaveMesh:
    case Action::kOpenSequence:
      return frame.model() && !frame.model()->model.space;
    case Action::kFewerSources:
    case Action::kShuffleSources:
      return frame.model() && !frame.state().sources.empty();
    case Action::kClearSources:
      return !frame.state().sources.empty();
    case Action::kBoundarySource:
      return frame.model() &&
             (frame.model()->model.space || (frame.mesh() && frame.mesh()->boundary_edges > 0));
    case Action::kSaveDistances:
    case Action::kSaveFigures:
      return frame.answer() != nullptr;
    case Action::kFlip:
    case Action::kSwap:
    case Action::kForget:
    case Action::kShowDifference:
      return frame.state().kept.has_value();
    default:
      return true;
  }
}

bool is_on(const Frame& frame, Action action) {
  if (const auto view = find_in(kViews, action)) return frame.state().picture.view == *view;
  if (const auto tool = find_in(kTools, action)) return frame.ui.input.tool == *tool;
  switch (action) {
    case Action::kRotate:
      return frame.state().rotating;
    case Action::kPlay:
      return frame.state().timeline.playing;
    case Action::kLoop:
      return frame.state().timeline.loop;
    case Action::kLeftPanel:
      return frame.ui.places.left.width > 0;
    case Action::kRightPanel:
      return frame.ui.places.right.width > 0;
    case Action::kLogPanel:
      return frame.ui.places.log.width > 0;
    case Action::kTheme:
      return frame.ui.layout.theme == Theme::kLight;
    case Action::kShowDifference:
      return frame.state().shown == app::Shown::kDifference;
    default:
      return false;
  }
}

}  // namespace geotherm::ui
