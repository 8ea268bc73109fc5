// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>
#include <utility>

#include "ui/interface.h"
#include "ui/style.h"
#include "ui/ui_state.h"

namespace geotherm::ui {

/// What every panel is drawn with, for one draw().
struct Frame {
  const app::Session& session;
  const Canvas& canvas;
  UiState& ui;
  FrameOutput& out;
  std::string section;  ///< the one that is being drawn; prefix of its items' names

  void send(app::Command command) { out.commands.push_back(std::move(command)); }
  void set(std::string_view name, std::string value) {
    send(app::command::Set{std::string(name), std::move(value)});
  }
  const app::ViewerState& state() const { return session.state(); }
  const app::Explored& explored() const { return session.explored(); }
  /// The model that is shown; null: none.
  const app::ExploredModel* model() const { return session.explored().model.get(); }
  const app::Answer* answer() const {
    return app::shown_answer(session.explored(), session.state().shown);
  }
  const Palette& colours() const { return palette(ui.layout.theme); }
  float px(float at_scale_1) const { return at_scale_1 * ui.scale; }
  /// Notes where the last item was drawn, under "section/key".
  void mark(std::string_view key);
};

}  // namespace geotherm::ui
