// SPDX-License-Identifier: MIT
#include "app/cli/picture_report.h"

#include <cmath>

#include "app/picture/picture_data.h"
#include "app/picture/picture_scale.h"
#include "app/picture/picture_settings.h"
#include "app/picture/picture_text.h"
#include "app/session/text.h"
#include "app/session/wording.h"
#include "geotherm/heat_method.h"
#include "geotherm/options.h"
#include "solver/core/text.h"

namespace geotherm::app {
namespace {

std::string range_of(const PictureScale& scale) {
  return number_text(scale.min) + ":" + number_text(scale.max);
}

bool has_colours(const PictureFigures& f) {
  return face_field(f.settings.view) || (f.solve && maps_values(f.settings.view));
}

/// Keywords of this program begin with its name, as the PNG specification advises.
void add(std::vector<PngText>& texts, const std::string& name, const std::string& value) {
  if (!value.empty()) texts.push_back({"geotherm:" + name, value});
}

void add_solve_texts(const Answer& solve, std::vector<PngText>& texts) {
  add(texts, "method", to_text(solve.method->kind()));
  add(texts, "largest-distance", number_text(solve.distance.max));
  const HeatMethod* heat = solve.method->heat();
  if (heat == nullptr) return;
  const HeatOptions& options = heat->options();
  add(texts, "backend", solve.result.backend);
  add(texts, "time-step", to_text(options.time_step));
  if (options.time_step.rule != TimeRule::kAbsolute) {
    add(texts, "time-factor", number_text(options.time_step.factor));
  }
  add(texts, "t", number_text(heat->t()));
  add(texts, "constraint", to_text(options.constraint));
  add(texts, "heat", to_text(options.heat));
  add(texts, "boundary", to_text(options.boundary));
  add(texts, "laplacian", to_text(heat->laplacian()));
  add(texts, "variant", to_text(options.variant));
  add(texts, "precision", to_text(options.precision));
}

Json settings_json(const PictureFigures& f) {
  const PictureSettings& s = f.settings;
  Json json = {{"view", to_text(s.view)},
               {"width", s.width},
               {"height", s.height},
               {"samples", s.samples},
               {"light", to_text(s.light)},
               {"background", to_text(s.background)},
               {"bar", f.scale.bar},
               {"caption", s.caption},
               {"markers", s.markers},
               {"camera",
                {{"azimuth", s.camera.azimuth},
                 {"elevation", s.camera.elevation},
                 {"zoom", s.camera.zoom},
                 {"pan", {s.camera.pan_right, s.camera.pan_up}},
                 {"fit", to_text(s.camera.fit)},
                 {"projection", s.camera.orthographic ? "orthographic" : "perspective"}}},
               {"turntable", s.turntable}};
  if (has_colours(f)) {
    json.update({{"colour_map", f.scale.colour_map},
                 {"reverse", s.reverse},
                 {"range", {f.scale.min, f.scale.max}},
                 {"spacing", f.scale.spacing}});
  }
  return json;
}

std::string view_in_words(const PictureFigures& f) {
  std::string text = to_text(f.settings.view);
  if (!has_colours(f)) return text;
  text += ", " + f.scale.colour_map + (f.settings.reverse ? " reversed" : "") + " from " +
          significant(f.scale.min) + " to " + significant(f.scale.max);
  if (f.scale.spacing > 0) text += ", isolines every " + significant(f.scale.spacing);
  return text;
}

}  // namespace

std::string device_in_words(const DrawingDevice& device) {
  return one_line(device.name) + (device.software ? ", in software" : "");
}

std::string caption_of(const PictureFigures& f) {
  return picture_caption(f.model, f.faces, f.solve ? f.solve->method.get() : nullptr);
}

std::vector<PngText> picture_texts(const PictureFigures& f, int frame) {
  std::vector<PngText> texts = {{"Software", "geotherm " GEOTHERM_VERSION},
                                {"Title", f.model + ", " + to_text(f.settings.view)},
                                {"Description", caption_of(f)}};
  add(texts, "version", GEOTHERM_VERSION);
  add(texts, "command", f.command);
  add(texts, "model", f.model_argument);
  add(texts, "sources", joined(f.sources, " "));
  if (f.solve) add_solve_texts(*f.solve, texts);
  PictureSettings settings = f.settings;
  settings.camera = frame_camera(f.settings, frame);
  for (auto& [name, value] : settings_in_words(settings)) {
    if (name == "colour-map" && has_colours(f)) value = f.scale.colour_map;
    if (name == "range" && has_colours(f)) value = range_of(f.scale);
    if (name == "spacing" && has_colours(f)) value = number_text(f.scale.spacing);
    add(texts, name, value);
  }
  if (f.settings.turntable > 0) {
    add(texts, "frame", std::to_string(frame + 1) + " of " + std::to_string(f.settings.turntable));
  }
  add(texts, "device", device_in_words(f.device));
  return texts;
}

Json picture_json(const PictureFigures& f) {
  Json json =
      f.solve ? solve_json(*f.solve)
              : Json{{"model", {{"name", f.model}, {"vertices", f.vertices}, {"faces", f.faces}}}};
  Json picture = settings_json(f);
  picture["files"] = f.paths;
  picture["device"] = {
      {"name", f.device.name}, {"kind", f.device.kind}, {"software", f.device.software}};
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
  table.add_row({several ? "pictures" : "picture",
                 one_line(f.paths.front()) + (several ? " to " + one_line(f.paths.back()) : "") +
                     ": " + (several ? std::to_string(f.paths.size()) + " of " : "") +
                     std::to_string(s.width) + " x " + std::to_string(s.height) + " pixels, " +
                     counted(s.samples, "sample", "samples") + " a pixel"});
  table.add_row({"view", view_in_words(f)});
  table.add_row({"model", caption_of(f)});
  if (f.solve && f.solve->error) table.add_row({"error", told(accuracy_line(*f.solve->error))});
  for (const PictureFigures::Line& line : f.lines) {
    table.add_row({"path", line.field + " to " + one_line(line.target) + ": " +
                               significant(line.length, 6) + " long"});
  }
  table.add_row({"device", device_in_words(f.device)});
  std::string time;
  if (f.solve) {
    time = "set-up " + milliseconds(f.solve->method->timing().setup) + " ms, query " +
           milliseconds(f.solve->result.timing.query) + " ms, ";
  }
  table.add_row({"time", time + "drawing " + milliseconds(f.draw_ms) + " ms, writing " +
                             milliseconds(f.write_ms) + " ms"});
  return table.text();
}

}  // namespace geotherm::app
