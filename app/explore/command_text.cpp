// SPDX-License-Identifier: MIT
#include "app/explore/command.h"
#include "app/explore/command_words.h"
#include "app/text.h"
#include "solver/core/text.h"

namespace geotherm::app {
namespace {

std::string words(std::string text, const std::vector<std::string>& more) {
  for (const std::string& word : more) text += " " + command_word(word);
  return text;
}

std::string sources(std::string text, const std::vector<SourceSpec>& more) {
  for (const SourceSpec& source : more) text += " " + to_text(source);
  return text;
}

std::string numbers(std::string text, std::initializer_list<double> more) {
  for (const double number : more) text += " " + number_text(number);
  return text;
}

struct Printer {
  std::string operator()(const command::Open& c) const { return words("open", {c.model}); }
  std::string operator()(const command::Reset&) const { return "reset"; }
  std::string operator()(const command::Run& c) const { return words("run", {c.path}); }
  std::string operator()(const command::Set& c) const { return words(c.name, {c.value}); }
  std::string operator()(const command::SetSources& c) const {
    return sources("source set", c.sources);
  }
  std::string operator()(const command::AddSources& c) const {
    return sources("source add", c.sources);
  }
  std::string operator()(const command::MoveSource& c) const {
    return sources("source move " + std::to_string(c.index), {c.source});
  }
  std::string operator()(const command::RemoveSource& c) const {
    return words("source remove", {std::to_string(c.index)});
  }
  std::string operator()(const command::ExtendCurve& c) const {
    std::vector<std::string> ids;
    for (const Index v : c.vertices) ids.push_back(std::to_string(v));
    return words("source extend", {joined(ids, ",")});
  }
  std::string operator()(const command::ClearSources&) const { return "source clear"; }
  std::string operator()(const command::MoreSources&) const { return "source more"; }
  std::string operator()(const command::FewerSources&) const { return "source fewer"; }
  std::string operator()(const command::ShuffleSources&) const { return "source shuffle"; }
  std::string operator()(const command::Orbit& c) const {
    return numbers("camera orbit", {c.azimuth, c.elevation});
  }
  std::string operator()(const command::Zoom& c) const {
    if (c.right == 0 && c.up == 0) return numbers("camera zoom", {c.factor});
    return numbers("camera zoom", {c.factor, c.right, c.up});
  }
  std::string operator()(const command::Pan& c) const {
    return numbers("camera pan", {c.right, c.up});
  }
  std::string operator()(const command::Centre& c) const {
    return numbers("camera centre", {c.x, c.y, c.z});
  }
  std::string operator()(const command::Place& c) const {
    return numbers("camera place", {c.azimuth, c.elevation, c.zoom, c.right, c.up});
  }
  std::string operator()(const command::Frame&) const { return "camera frame"; }
  std::string operator()(const command::Rotate& c) const {
    return c.on ? "rotate on" : "rotate off";
  }
  std::string operator()(const command::Keep&) const { return "keep"; }
  std::string operator()(const command::Forget&) const { return "forget"; }
  std::string operator()(const command::Swap&) const { return "swap"; }
  std::string operator()(const command::Show& c) const {
    return std::string("show ") + kShownNames[static_cast<int>(c.shown)];
  }
  std::string operator()(const command::Flip&) const { return "flip"; }
  std::string operator()(const command::Pick& c) const {
    return "pick " + (c.point ? to_text(SourceSpec(*c.point)) : "none");
  }
  std::string operator()(const command::Target& c) const {
    return "target " + (c.point ? to_text(*c.point) : "none");
  }
  std::string operator()(const command::Compare& c) const { return words("compare", {c.backends}); }
  std::string operator()(const command::SavePicture& c) const {
    std::string text = words("save picture", {c.path});
    if (c.width > 0) text += " " + std::to_string(c.width) + "x" + std::to_string(c.height);
    return text + (c.panels ? " panels" : "");
  }
  std::string operator()(const command::SaveDistances& c) const {
    return words("save distances", {c.path});
  }
  std::string operator()(const command::SaveSession& c) const {
    return words("save session", {c.path});
  }
  std::string operator()(const command::SaveLog& c) const { return words("save log", {c.path}); }
  std::string operator()(const command::SaveFigures& c) const {
    return words("save figures", {c.path});
  }
  std::string operator()(const command::Undo&) const { return "undo"; }
  std::string operator()(const command::Redo&) const { return "redo"; }
  std::string operator()(const command::Quit&) const { return "quit"; }
};

}  // namespace

std::string to_text(const Command& command) { return std::visit(Printer(), command); }

}  // namespace geotherm::app
