// SPDX-License-Identifier: MIT
#include "app/cli/picture_report.h"

#include <algorithm>
#include <initializer_list>
#include <string_view>
#include <utility>

#include "app/picture/picture_data.h"
#include "app/picture/picture_scale.h"
#include "app/picture/picture_settings.h"
#include "app/picture/picture_text.h"
#include "app/session/progress.h"
#include "app/session/wording.h"
#include "app/text/text.h"
#include "geotherm/heat_method.h"
#include "geotherm/options.h"
#include "solver/core/text.h"

namespace geotherm::app {
namespace {

bool has_colours(const PictureFigures& f) {
  if (face_field(f.settings.view)) return true;
  return (f.solve || !f.field.empty()) && maps_values(f.settings.view);
}

/// Keywords of this program begin with its name, as the PNG specification advises.
void add(std::vector<FileText>& texts, std::string_view name, const std::string& value) {
  if (!value.empty()) texts.push_back({"geotherm:" + std::string(name), value});
}

bool is_one_of(std::initializer_list<std::string_view> names, const Setting& setting) {
  return std::ranges::count(names, setting.name) > 0;
}

void add_solve_texts(const Answer& solve, std::vector<FileText>& texts) {
  add(texts, "method", to_text(solve.method->kind()));
  add(texts, "largest-distance", number_text(solve.distance.max));
  const HeatMethod* heat = solve.method->heat();
  if (heat == nullptr) return;
  ViewerState state;
  static_cast<HeatOptions&>(state.options) = heat->options();
  state.options.backend = solve.result.backend;
  state.options.boundary = heat->boundary();
  state.options.laplacian = heat->laplacian();
  const bool absolute = state.options.time_step.rule == TimeRule::kAbsolute;
  for (const Setting& setting : settings()) {
    // The last two say what may fail, not what is computed.
    if (!setting.of_heat || is_one_of({"memory-limit", "strict"}, setting)) continue;
    const bool is_factor = setting.name == "time-factor";
    if (!is_factor || !absolute) add(texts, setting.name, setting.get(state));
    if (is_factor) add(texts, "t", number_text(heat->t()));
  }
}

/// The settings of a frame, and what the data decided where they leave it open.
ViewerState settings_of(const PictureFigures& f, int frame) {
  ViewerState state;
  PictureSettings& picture = state.picture;
  picture = f.settings;
  picture.camera = frame_camera(f.settings, frame);
  if (!has_colours(f)) return state;
  picture.colour_map = f.scale.colour_map;
  picture.range_min = f.scale.min;
  picture.range_max = f.scale.max;
  picture.line_spacing = f.scale.spacing;
  return state;
}

Json settings_json(const PictureFigures& f) {
  const PictureSettings& s = f.settings;
  ViewerState state;
  state.picture = s;
  Json json, camera;
  for (const Setting& setting : settings()) {
    if (!setting.of_picture()) continue;
    if (setting.name == "size") {
      json.update({{"width", s.width}, {"height", s.height}});
    } else if (setting.name == "pan") {
      camera["pan"] = {s.camera.pan_right, s.camera.pan_up};
    } else if (setting.group == SettingGroup::kCamera && setting.kind == SettingKind::kNumber) {
      camera[key_of(setting)] = *number_in<double>(setting.get(state));
    } else if (!is_one_of({"colour-map", "reverse", "range", "spacing", "centre"}, setting)) {
      Json& group = setting.group == SettingGroup::kCamera ? camera : json;
      group[key_of(setting)] = setting_json(setting, state);
    }
  }
  json.update({{"bar", f.scale.bar}, {"camera", std::move(camera)}, {"turntable", s.turntable}});
  if (has_colours(f)) {
    json.update({{"colour_map", f.scale.colour_map},
                 {"reverse", s.reverse},
                 {"range", {f.scale.min, f.scale.max}},
                 {"spacing", f.scale.spacing},
                 {"clamped", {f.scale.below, f.scale.above}},
                 {"levels", f.scale.levels}});
  }
  return json;
}

/// The ends of the colours, with one digit more than tells them apart.
std::string ends_in_words(const PictureScale& scale) {
  constexpr int kUsual = 4, kAll = 17;
  int digits = kUsual;
  while (digits < kAll && significant(scale.min, digits - 1) == significant(scale.max, digits - 1))
    ++digits;
  return significant(scale.min, digits) + " to " + significant(scale.max, digits);
}

std::string view_in_words(const PictureFigures& f) {
  std::string text = geotherm::to_text(f.settings.view);
  if (!has_colours(f)) return text;
  text += ", " + f.scale.colour_map + (f.settings.reverse ? " reversed" : "") + " from " +
          ends_in_words(f.scale);
  if (f.scale.kind == ColourScale::kLog) text += ", logarithmic";
  if (f.settings.bands > 0) text += ", in " + std::to_string(f.settings.bands) + " bands";
  if (!f.scale.levels.empty() && f.scale.spacing == 0) {
    text += ", isolines at " +
            counted(static_cast<std::int64_t>(f.scale.levels.size()), "value", "values");
  }
  if (f.scale.spacing > 0) text += ", isolines every " + significant(f.scale.spacing);
  return text;
}

}  // namespace

std::string device_in_words(const DrawingDevice& device) {
  return one_line(device.name) + (device.software ? ", in software" : "");
}

std::string caption_of(const PictureFigures& f) {
  return picture_caption(f.model.name, size_in_words(f.model),
                         f.solve ? f.solve->method.get() : nullptr);
}

std::vector<FileText> picture_texts(const PictureFigures& f, int frame) {
  std::vector<FileText> texts = {
      {"Software", "geotherm " GEOTHERM_VERSION},
      {"Title", f.model.name + ", " + geotherm::to_text(f.settings.view)},
      {"Description", caption_of(f)}};
  add(texts, "version", GEOTHERM_VERSION);
  add(texts, "command", typed_command());
  add(texts, "model", f.model_argument);
  add(texts, "sources", joined(f.sources, " "));
  add(texts, "field", f.field);
  if (f.solve) add_solve_texts(*f.solve, texts);
  const ViewerState state = settings_of(f, frame);
  for (const Setting& setting : settings()) {
    if (!setting.of_picture()) continue;
    const std::string value = setting.get(state);
    const bool is_switch = setting.kind == SettingKind::kSwitch;
    add(texts, setting.name, !is_switch ? value : value == "on" ? "yes" : "no");
  }
  if (f.settings.turntable > 0) {
    add(texts, "frame", std::to_string(frame + 1) + " of " + std::to_string(f.settings.turntable));
  }
  add(texts, "device", device_in_words(f.device));
  return texts;
}

Json picture_json(const PictureFigures& f) {
  Json json = f.solve ? solve_json(*f.solve) : Json{{"model", brief_model_json(f.model)}};
  Json picture = settings_json(f);
  picture["files"] = f.paths;
  if (!f.field.empty()) picture["field"] = f.field;
  if (f.scene_bytes > 0) {
    picture["bytes"] = f.scene_bytes;
  } else {
    picture["device"] = {
        {"name", f.device.name}, {"kind", f.device.kind}, {"software", f.device.software}};
  }
  picture["timing_ms"] = {{"draw", f.draw_ms}, {"write", f.write_ms}};
  for (const PictureFigures::Line& line : f.lines) {
    picture["paths"].push_back(
        {{"to", line.target}, {"field", line.field}, {"length", line.length}});
  }
  json["picture"] = std::move(picture);
  return json;
}

std::string picture_table(const PictureFigures& f) {
  const PictureSettings& s = f.settings;
  TextTable table({{"", TextTable::Align::kLeft}, {"", TextTable::Align::kLeft}});
  const bool several = f.paths.size() > 1;
  const bool scene = f.scene_bytes > 0;
  if (scene) {
    table.add_row({"scene", one_line(f.paths.front()) + ": " +
                                bytes_in_words(static_cast<double>(f.scene_bytes))});
  }
  if (!scene)
    table.add_row({several ? "pictures" : "picture",
                   one_line(f.paths.front()) + (several ? " to " + one_line(f.paths.back()) : "") +
                       ": " + (several ? std::to_string(f.paths.size()) + " of " : "") +
                       std::to_string(s.width) + " x " + std::to_string(s.height) + " pixels, " +
                       counted(s.samples, "sample", "samples") + " a pixel"});
  table.add_row({"view", view_in_words(f)});
  table.add_row({"model", caption_of(f)});
  if (f.solve && f.solve->error) table.add_row({"error", to_text(accuracy_line(*f.solve->error))});
  for (const PictureFigures::Line& line : f.lines) {
    table.add_row({"path", line.field + " to " + one_line(line.target) + ": " +
                               significant(line.length, 6) + " long"});
  }
  if (!f.frames.empty()) table.add_row({"frames", f.frames});
  if (!scene) table.add_row({"device", device_in_words(f.device)});
  std::string time;
  if (!f.frame_times.empty()) {
    time = f.frame_times + "; all: ";
  } else if (f.solve) {
    time = "set-up " + milliseconds(f.solve->method->timing().setup) + " ms, query " +
           milliseconds(f.solve->result.timing.query) + " ms, ";
  }
  table.add_row({"time", time + (scene ? "making " : "drawing ") + milliseconds(f.draw_ms) +
                             " ms, writing " + milliseconds(f.write_ms) + " ms"});
  return table.text();
}

}  // namespace geotherm::app
