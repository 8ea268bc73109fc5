// SPDX-License-Identifier: MIT
#include "app/explore/settings.h"

#include <algorithm>

#include "app/option_values.h"
#include "app/picture/picture_text.h"
#include "app/picture/picture_values.h"
#include "app/text.h"
#include "solver/core/number_text.h"
#include "solver/heat/option_text.h"
#include "solver/linear/backend.h"
#include "solver/mesh/read_mesh.h"

namespace geotherm::app {
namespace {

using Names = std::vector<std::string>;
using State = ViewerState;
using Text = std::string;

/// Stores a value, or hands on why there is none.
template <class Value, class Into>
Result<void> store(Result<Value> parsed, Into& into) {
  if (!parsed) return parsed.error();
  into = *std::move(parsed);
  return {};
}

Names none() { return {}; }
Names switches() { return {"on", "off"}; }
Text switch_text(bool on) { return on ? "on" : "off"; }

Result<void> set_range(State& s, const Text& text) {
  Range range;
  if (auto stored = store(parse_range(text), range); !stored) return stored;
  s.picture.range_min = range.min;
  s.picture.range_max = range.max;
  return {};
}

Result<void> set_size(State& s, const Text& text) {
  Size size;
  if (auto stored = store(parse_size(text), size); !stored) return stored;
  s.picture.width = size.width;
  s.picture.height = size.height;
  return {};
}

Result<void> set_pan(State& s, const Text& text) {
  Pan pan;
  if (auto stored = store(parse_pan(text), pan); !stored) return stored;
  s.picture.camera.pan_right = pan.right;
  s.picture.camera.pan_up = pan.up;
  return {};
}

/// Which maps there are is known to whoever draws; here it is a name.
Result<void> set_colour_map(State& s, const Text& text) {
  const bool is_name = !text.empty() && std::ranges::all_of(text, [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '-';
  });
  if (!is_name) return Error{ErrorCode::kBadInput, "'" + one_line(text) + "' is no colour map"};
  s.picture.colour_map = text;
  return {};
}

constexpr std::pair<Check, std::string_view> kChecks[] = {{Check::kOn, "on"},
                                                          {Check::kOff, "off"},
                                                          {Check::kAuto, "auto"},
                                                          {Check::kWavefrontFine, "wavefront-fine"},
                                                          {Check::kExact, "exact"}};

Text check_text(Check check) {
  for (const auto& [value, name] : kChecks) {
    if (value == check) return Text(name);
  }
  return {};
}

Result<void> set_check(State& s, const Text& text) {
  for (const auto& [value, name] : kChecks) {
    if (name != text) continue;
    s.check = value;
    return {};
  }
  return Error{
      ErrorCode::kBadInput,
      "'" + one_line(text) + "' is no check; there are on, off, auto, wavefront-fine, exact"};
}

const std::vector<Setting>& all() {
  static const std::vector<Setting> kAll = {
      {"method", "how distance is computed", true,
       [](const State& s) { return to_text(s.options.method); },
       [](State& s, const Text& t) { return store(parse_method(t), s.options.method); },
       [] { return method_names(); }},
      {"backend", "the linear solver", true, [](const State& s) { return s.options.backend; },
       [](State& s, const Text& t) { return store(parse_backend(t), s.options.backend); },
       [] { return backend_names(); }},
      {"time-step", "how the diffusion time t is chosen", true,
       [](const State& s) { return to_text(s.options.time_step); },
       [](State& s, const Text& t) {
         return store(parse_time_step_option(t, s.options.time_step.factor), s.options.time_step);
       },
       [] {
         return Names{"mean-edge", "mean-face-area", "absolute:0.01"};
       }},
      {"time-factor", "m of the time step", true,
       [](const State& s) { return number_text(s.options.time_step.factor); },
       [](State& s, const Text& t) {
         return store(parse_time_factor(t), s.options.time_step.factor);
       },
       none},
      {"constraint", "what makes the Poisson system solvable", true,
       [](const State& s) { return to_text(s.options.constraint); },
       [](State& s, const Text& t) {
         return store(parse_constraint_option(t), s.options.constraint);
       },
       [] {
         return Names{"pin-sources", "pin-vertex", "penalty:10", "conserve-energy",
                      "pseudo-inverse"};
       }},
      {"heat", "what the heat step diffuses", true,
       [](const State& s) { return to_text(s.options.heat); },
       [](State& s, const Text& t) { return store(parse_heat_mode(t), s.options.heat); },
       [] {
         return Names{"unit", "diffuse", "hold"};
       }},
      {"boundary", "the condition on u along the border", true,
       [](const State& s) { return to_text(s.options.boundary); },
       [](State& s, const Text& t) { return store(parse_boundary_rule(t), s.options.boundary); },
       [] {
         return Names{"neumann", "dirichlet", "average"};
       }},
      {"laplacian", "which triangulation carries the operators", true,
       [](const State& s) { return to_text(s.options.laplacian); },
       [](State& s, const Text& t) { return store(parse_laplacian(t), s.options.laplacian); },
       [] {
         return Names{"auto", "cotan", "intrinsic-delaunay", "tufted", "refined"};
       }},
      {"variant", "how the method is discretised", true,
       [](const State& s) { return to_text(s.options.variant); },
       [](State& s, const Text& t) { return store(parse_variant(t), s.options.variant); },
       [] {
         return Names{"corrected", "classic"};
       }},
      {"precision", "how accurately systems are solved", true,
       [](const State& s) { return to_text(s.options.precision); },
       [](State& s, const Text& t) { return store(parse_precision(t), s.options.precision); },
       [] {
         return Names{"compact", "refined", "full"};
       }},
      {"strict", "a backend that fails is not replaced", true,
       [](const State& s) { return switch_text(s.options.strict); },
       [](State& s, const Text& t) { return store(parse_switch(t), s.options.strict); }, switches},
      {"memory-limit", "most that factors may take, MB", true,
       [](const State& s) { return memory_limit_text(s.options.memory_limit_mb); },
       [](State& s, const Text& t) {
         return store(parse_memory_limit(t), s.options.memory_limit_mb);
       },
       [] {
         return Names{"free", "500"};
       }},
      {"threads", "that work at once; 0: one a core", true,
       [](const State& s) { return std::to_string(s.options.threads); },
       [](State& s, const Text& t) {
         return store(parse_threads(t == "0" ? Text() : t), s.options.threads);
       },
       none},
      {"refine", "how often each face is cut into four, 0 to 6", true,
       [](const State& s) { return std::to_string(s.options.refine); },
       [](State& s, const Text& t) { return store(parse_refine(t), s.options.refine); },
       [] {
         return Names{"0", "1", "2", "3"};
       }},
      {"weld", "vertices so near are one, model units", true,
       [](const State& s) { return s.reading.weld ? number_text(*s.reading.weld) : Text("off"); },
       [](State& s, const Text& t) { return store(parse_weld(t), s.reading.weld); }, none},
      {"format", "of the model, whatever its name", true,
       [](const State& s) { return s.reading.format.empty() ? Text("auto") : s.reading.format; },
       [](State& s, const Text& t) { return store(parse_format(t), s.reading.format); },
       [] {
         Names names = mesh_formats();
         names.insert(names.begin(), "auto");
         return names;
       }},
      {"check", "what the distances are held against", false,
       [](const State& s) { return check_text(s.check); }, set_check,
       [] {
         return Names{"on", "off", "auto", "wavefront-fine", "exact"};
       }},
      {"view", "what is shown", false, [](const State& s) { return to_text(s.picture.view); },
       [](State& s, const Text& t) { return store(parse_view(t), s.picture.view); },
       [] { return view_names(); }},
      {"size", "of saved pictures, in pixels", false,
       [](const State& s) {
         return std::to_string(s.picture.width) + "x" + std::to_string(s.picture.height);
       },
       set_size, none},
      {"samples", "a pixel", false,
       [](const State& s) { return std::to_string(s.picture.samples); },
       [](State& s, const Text& t) { return store(parse_samples(t), s.picture.samples); },
       [] {
         return Names{"1", "4"};
       }},
      {"colour-map", "colours of the distances", false,
       [](const State& s) { return s.picture.colour_map; }, set_colour_map, none},
      {"reverse", "the colour map, turned round", false,
       [](const State& s) { return switch_text(s.picture.reverse); },
       [](State& s, const Text& t) { return store(parse_switch(t), s.picture.reverse); }, switches},
      {"range", "distances at the ends of the colour map", false,
       [](const State& s) { return range_text(s.picture); }, set_range, none},
      {"spacing", "between isolines, model units; 0: none", false,
       [](const State& s) {
         return s.picture.line_spacing ? number_text(*s.picture.line_spacing) : Text("auto");
       },
       [](State& s, const Text& t) { return store(parse_spacing(t), s.picture.line_spacing); },
       none},
      {"light", "on the surface", false, [](const State& s) { return to_text(s.picture.light); },
       [](State& s, const Text& t) { return store(parse_light(t), s.picture.light); },
       [] { return light_names(); }},
      {"background", "of the picture", false,
       [](const State& s) { return to_text(s.picture.background); },
       [](State& s, const Text& t) { return store(parse_background(t), s.picture.background); },
       [] { return background_names(); }},
      {"bar", "the colour bar", false, [](const State& s) { return switch_text(s.picture.bar); },
       [](State& s, const Text& t) { return store(parse_switch(t), s.picture.bar); }, switches},
      {"caption", "the line about model, t and backend", false,
       [](const State& s) { return switch_text(s.picture.caption); },
       [](State& s, const Text& t) { return store(parse_switch(t), s.picture.caption); }, switches},
      {"markers", "where the sources are", false,
       [](const State& s) { return switch_text(s.picture.markers); },
       [](State& s, const Text& t) { return store(parse_switch(t), s.picture.markers); }, switches},
      {"azimuth", "of the eye about the vertical axis, degrees", false,
       [](const State& s) { return number_text(s.picture.camera.azimuth); },
       [](State& s, const Text& t) { return store(parse_azimuth(t), s.picture.camera.azimuth); },
       none},
      {"elevation", "of the eye, degrees", false,
       [](const State& s) { return number_text(s.picture.camera.elevation); },
       [](State& s, const Text& t) {
         return store(parse_elevation(t), s.picture.camera.elevation);
       },
       none},
      {"zoom", "1: as large as it fits", false,
       [](const State& s) { return number_text(s.picture.camera.zoom); },
       [](State& s, const Text& t) { return store(parse_zoom(t), s.picture.camera.zoom); }, none},
      {"pan", "shift in picture heights", false,
       [](const State& s) {
         return number_text(s.picture.camera.pan_right) + ":" +
                number_text(s.picture.camera.pan_up);
       },
       set_pan, none},
      {"centre", "what is in the middle, model units", false,
       [](const State& s) { return centre_text(s.picture.camera); },
       [](State& s, const Text& t) { return store(parse_centre(t), s.picture.camera.centre); },
       none},
      {"fit", "how the model fills the picture", false,
       [](const State& s) { return to_text(s.picture.camera.fit); },
       [](State& s, const Text& t) { return store(parse_fit(t), s.picture.camera.fit); },
       [] { return fit_names(); }},
      {"projection", "of space onto the picture", false,
       [](const State& s) {
         return Text(s.picture.camera.orthographic ? "orthographic" : "perspective");
       },
       [](State& s, const Text& t) {
         return store(parse_projection(t), s.picture.camera.orthographic);
       },
       [] {
         return Names{"perspective", "orthographic"};
       }},
  };
  return kAll;
}

}  // namespace

std::span<const Setting> settings() { return all(); }

const Setting* find_setting(std::string_view name) {
  const auto found = std::ranges::find(all(), name, &Setting::name);
  return found == all().end() ? nullptr : &*found;
}

}  // namespace geotherm::app
