// SPDX-License-Identifier: MIT
// The table of settings, and its entries for models and checks.
#include "app/session/settings.h"

#include <algorithm>

#include "app/session/model.h"
#include "app/text/text.h"
#include "geotherm/io.h"

namespace geotherm::app {
namespace {

using State = ViewerState;
using Text = std::string;
using enum SettingGroup;

/// Of reading a model, and of what distances are held against.
std::vector<Setting> model_settings() {
  return {
      choice<&ModelReading::domain>(
          {.name = "domain",
           .group = kModel,
           .value_name = "KIND",
           .help = "what distance is computed in, where the file does not say or says otherwise",
           .detail = "auto takes what the file holds; polygons takes faces as they are; triangles "
                     "cuts polygons up and takes the border of tets and grids; points leaves faces "
                     "out."}),
      {.name = "weld",
       .group = kModel,
       .value_name = "EPS",
       .help = "vertices at most this far apart (model units; 0: equal) are one, which closes "
               "cracks; all keep their ids",
       .get =
           [](const State& s) {
             return s.reading.weld ? number_text(*s.reading.weld) : Text("off");
           },
       .set = [](State& s, const Text& t) { return store(parse_weld(t), s.reading.weld); }},
      {.name = "mask",
       .group = kModel,
       .value_name = "FILE",
       .help = "leaves out of a surface what the file marks: text or .npy of 0 and 1, one for each "
               "vertex or face, or of numbers of vertices; .label of FreeSurfer; .gii; "
               "FILE.ply:PROPERTY; keep:FILE marks what stays, faces:FILE has numbers of faces",
       .detail = "Distances are those on the surface that is left, and all numbers stay.",
       .get = [](const State& s) { return s.reading.mask.empty() ? Text("off") : s.reading.mask; },
       .set =
           [](State& s, const Text& t) {
             s.reading.mask = t == "off" ? Text() : t;
             return Result<void>();
           }},
      {.name = "format",
       .group = kModel,
       .value_name = "NAME",
       .help = "format of the model, whatever its name",
       .get =
           [](const State& s) {
             return s.reading.format.empty() ? Text("auto") : s.reading.format;
           },
       .set = [](State& s, const Text& t) { return store(parse_format(t), s.reading.format); },
       .values =
           [] {
             std::vector<std::string> names = model_formats();
             names.insert(names.begin(), "auto");
             return names;
           }},
      choice<&ModelReading::grid>(
          {.name = "grid",
           .group = kModel,
           .value_name = "VALUES",
           .help = "what the values of a grid mean: mask (0 is wall), speeds, or by their type",
           .detail = "Floating-point numbers are speeds, all others a mask. Of pictures a mask is "
                     "brightness of at least half, and speeds are brightness from 0 to 1."}),
      choice<&ViewerState::check>(
          {.name = "check", .group = kCheck, .help = "what the distances are held against"}),
  };
}

std::vector<Setting>& all() {
  static std::vector<Setting> every = [] {
    std::vector<Setting> joined = method_settings();
    // Figures first: a size on paper is known to fit when the pixels an inch are.
    for (const auto& group :
         {model_settings(), figure_settings_table(), picture_settings_table()}) {
      joined.insert(joined.end(), group.begin(), group.end());
    }
    return joined;
  }();
  return every;
}

}  // namespace

std::span<const Setting> settings() { return all(); }

const Setting* find_setting(std::string_view name) {
  const auto found = std::ranges::find(all(), name, &Setting::name);
  return found == all().end() ? nullptr : &*found;
}

ExtraSetting::ExtraSetting(const Setting& setting) { all().push_back(setting); }
ExtraSetting::~ExtraSetting() { all().pop_back(); }

}  // namespace geotherm::app
