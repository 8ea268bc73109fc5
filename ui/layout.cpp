// SPDX-License-Identifier: MIT
#include "ui/layout.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <system_error>

#include "app/text/text.h"
#include "ui/frame.h"

namespace geotherm::ui {
namespace {

// What a file may ask for; anything else is not worth believing.
constexpr float kMinWidth = 160, kMaxWidth = 1200;
constexpr float kMinHeight = 60, kMaxHeight = 1200;
constexpr float kMinScale = 0.5F, kMaxScale = 4;
constexpr std::size_t kMaxSections = 64;
constexpr std::size_t kLongestFile = 65536;
constexpr std::string_view kOpen = "open ";  ///< before the name of a section

std::string flag_text(bool flag) { return flag ? "on" : "off"; }

void take_flag(std::string_view text, bool& flag) {
  if (text == "on") flag = true;
  if (text == "off") flag = false;
}

void take_number(std::string_view text, float least, float most, float& number) {
  const auto value = app::number_in<float>(text);
  if (value && *value >= least && *value <= most) number = *value;
}

void take_line(std::string_view name, std::string_view value, Layout& layout) {
  if (name == "left-width") take_number(value, kMinWidth, kMaxWidth, layout.left_width);
  if (name == "right-width") take_number(value, kMinWidth, kMaxWidth, layout.right_width);
  if (name == "log-height") take_number(value, kMinHeight, kMaxHeight, layout.log_height);
  if (name == "scale") take_number(value, kMinScale, kMaxScale, layout.scale);
  if (name == "left") take_flag(value, layout.left);
  if (name == "right") take_flag(value, layout.right);
  if (name == "log") take_flag(value, layout.log);
  if (name == "theme" && value == "dark") layout.theme = Theme::kDark;
  if (name == "theme" && value == "light") layout.theme = Theme::kLight;
  if (name == "recent" && !value.empty() && layout.recent.size() < kMaxRecent) {
    layout.recent.emplace_back(value);
  }
  if (!name.starts_with(kOpen) || (value != "on" && value != "off")) return;
  const std::string section(app::trimmed(name.substr(kOpen.size())));
  if (!section.empty() && layout.open.size() < kMaxSections) layout.open[section] = value == "on";
}

}  // namespace

std::string to_text(const Layout& layout) {
  std::string text;
  const auto line = [&text](std::string_view name, std::string_view value) {
    (((text += name) += " = ") += value) += '\n';
  };
  line("left-width", number_text(layout.left_width));
  line("right-width", number_text(layout.right_width));
  line("log-height", number_text(layout.log_height));
  line("left", flag_text(layout.left));
  line("right", flag_text(layout.right));
  line("log", flag_text(layout.log));
  line("theme", layout.theme == Theme::kDark ? "dark" : "light");
  line("scale", number_text(layout.scale));
  for (const std::string& path : layout.recent) line("recent", path);
  for (const auto& [section, open] : layout.open) {
    line(std::string(kOpen) + section, flag_text(open));
  }
  return text;
}

Layout parse_layout(std::string_view text) {
  Layout layout;
  while (!text.empty()) {
    const std::size_t end = text.find('\n');
    const std::string_view line = text.substr(0, end);
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
    const std::size_t sign = line.find('=');
    if (sign == std::string_view::npos) continue;
    take_line(app::trimmed(line.substr(0, sign)), app::trimmed(line.substr(sign + 1)), layout);
  }
  return layout;
}

void add_recent(Layout& layout, const std::string& path) {
  // One line each: a name with a line's end in it is not remembered.
  if (path.empty() || path.find('\n') != std::string::npos || app::trimmed(path) != path) return;
  std::erase(layout.recent, path);
  layout.recent.insert(layout.recent.begin(), path);
  if (layout.recent.size() > kMaxRecent) layout.recent.pop_back();
}

std::string layout_path() {
  const auto folder = [](const char* variable) -> std::filesystem::path {
    const char* value = std::getenv(variable);
    // The specification of base directories: what is not absolute is to be ignored.
    return value && value[0] == '/' ? value : "";
  };
  std::filesystem::path path = folder("XDG_CONFIG_HOME");
  if (path.empty()) {
    path = folder("HOME");
    if (path.empty()) return {};
    path /= ".config";
  }
  return (path / "geotherm" / "viewer.conf").string();
}

Layout load_layout(const std::string& path) {
  std::error_code error;
  if (path.empty() || !std::filesystem::is_regular_file(path, error)) return {};
  std::ifstream file(path, std::ios::binary);
  std::string text(kLongestFile, '\0');
  file.read(text.data(), static_cast<std::streamsize>(text.size()));
  text.resize(static_cast<std::size_t>(file.gcount()));
  return parse_layout(text);
}

bool save_layout(const std::string& path, const Layout& layout) {
  if (path.empty()) return false;
  std::error_code error;
  std::filesystem::create_directories(std::filesystem::path(path).parent_path(), error);
  // Written beside and renamed, so that no one ever reads half a file.
  const std::string beside = path + ".part";
  bool written = false;
  {
    std::ofstream file(beside, std::ios::binary);
    file << to_text(layout);
    file.close();
    written = file.good();
  }
  if (written) std::filesystem::rename(beside, path, error);
  if (written && !error) return true;
  std::filesystem::remove(beside, error);
  return false;
}

namespace {

/// Widths of both side bars that fit beside the picture.
struct Bars {
  float left = 0, right = 0;
};
Bars fit_bars(Bars wanted, float room, float least, bool right_first) {
  if (room < least + least && wanted.left > 0 && wanted.right > 0) {
    (right_first ? wanted.left : wanted.right) = 0;
  }
  if (room < least) return {};
  const float total = wanted.left + wanted.right;
  if (total <= room) return wanted;
  // Both give what they have above the least, in proportion to it.
  const auto above = [least](float width) { return std::max(0.0F, width - least); };
  const float spare = above(wanted.left) + above(wanted.right);
  if (spare <= 0) return {std::min(wanted.left, room), std::min(wanted.right, room)};
  const float share = std::min(1.0F, (total - room) / spare);
  return {wanted.left - share * above(wanted.left), wanted.right - share * above(wanted.right)};
}

}  // namespace

namespace {

/// What has no room beside the picture, over it; the picture stays where it is.
void open_drawer(Places& places, const Layout& layout, float scale, Drawer drawer) {
  constexpr float kShare = 0.85F;  // of the width: the picture is seen to go on below
  const float top = places.menu.height, width = places.menu.width;
  const float height = places.canvas.y + places.canvas.height + places.log.height - top;
  if (drawer == Drawer::kLog && places.log.height <= 0) {
    const float high = std::floor(std::min(layout.log_height * scale, height));
    places.log = {0, top + height - high, width, high};
    places.over = high > 0;
    return;
  }
  const bool is_right = drawer == Drawer::kRight;
  Rect& bar = is_right ? places.right : places.left;
  if (drawer == Drawer::kLog || bar.width > 0) return;
  const float wanted = is_right ? layout.right_width : layout.left_width;
  const float wide = std::floor(std::min(std::max(wanted, kMinBar) * scale, kShare * width));
  bar = {is_right ? width - wide : 0, top, wide, height};
  places.tools = {};
  places.over = wide > 0;
}

}  // namespace

Places place_panels(const Layout& layout, float width, float height, float scale, float line,
                    Drawer drawer) {
  width = std::max(0.0F, width);
  height = std::max(0.0F, height);
  const float least_canvas = kMinCanvas * scale;
  Places places;
  const float menu = std::min(line, height);
  const float status = height - menu - line >= least_canvas * 0.5F ? line : 0;
  const float middle = height - menu - status;

  Bars bars{layout.left ? std::max(layout.left_width, kMinBar) * scale : 0,
            layout.right ? std::max(layout.right_width, kMinBar) * scale : 0};
  const float room = width - std::max(least_canvas, kMinCanvasShare * width);
  bars = fit_bars(bars, room, kMinBar * scale, layout.right_first);
  bars = {std::floor(bars.left), std::floor(bars.right)};

  constexpr float kToolLines = 1.45F;
  float tools = std::floor(line * kToolLines);
  if (middle - tools < least_canvas) tools = 0;
  float log = layout.log ? std::max(layout.log_height, kMinLog) * scale : 0;
  log = std::floor(std::min(log, middle - tools - least_canvas));
  if (log < kMinLog * scale) log = 0;

  const float inner = width - bars.left - bars.right;
  places.menu = {0, 0, width, menu};
  places.left = {0, menu, bars.left, middle};
  places.right = {width - bars.right, menu, bars.right, middle};
  places.tools = {bars.left, menu, tools > 0 ? inner : 0, tools};
  places.canvas = {bars.left, menu + tools, inner, middle - log - tools};
  places.log = {bars.left, menu + middle - log, log > 0 ? inner : 0, log};
  places.status = {0, height - status, status > 0 ? width : 0, status};
  if (drawer != Drawer::kNone) open_drawer(places, layout, scale, drawer);
  return places;
}

}  // namespace geotherm::ui
