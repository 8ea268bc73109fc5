// SPDX-License-Identifier: MIT
// The settings of what figures of papers need: words, numbers, sizes on paper, scales of colours.
#include <utility>

#include "app/picture/picture_text.h"
#include "app/session/settings.h"
#include "app/text/text.h"
#include "solver/core/text.h"

namespace geotherm::app {
namespace {

using enum SettingGroup;
using enum SettingKind;

Result<void> set_dpi(ViewerState& s, const std::string& text) {
  const auto dpi = parse_dpi(text);
  if (!dpi) return dpi.error();
  PictureSettings changed = s.picture;
  changed.dpi = *dpi;
  if (auto fits = fit_to_paper(changed); !fits) return fits;
  s.picture = std::move(changed);
  return {};
}

/// Words of the picture; `none`: what stands for no words.
template <std::string PictureSettings::*kMember>
Setting words(Setting setting, const char* (*none)()) {
  static const char* (*const kNone)() = none;
  setting.group = kFigure;
  setting.value_name = "TEXT";
  setting.get = [](const ViewerState& s) {
    return (s.picture.*kMember).empty() ? std::string(kNone()) : s.picture.*kMember;
  };
  setting.set = [](ViewerState& s, const std::string& text) -> Result<void> {
    constexpr std::size_t kMax = 300;
    if (text.size() > kMax) {
      return bad_value(text, "is too long", "give up to " + std::to_string(kMax) + " bytes");
    }
    s.picture.*kMember = text == kNone() ? std::string() : one_line(text);
    return {};
  };
  return setting;
}

const char* off() { return "off"; }
const char* by_itself() { return "auto"; }

/// A length on paper or in pixels.
template <std::optional<PaperLength> PictureSettings::*kMember>
Setting length(Setting setting) {
  setting.group = kFigure;
  setting.value_name = "LENGTH";
  setting.forms = "pixels, pt, mm, cm or in, such as 0.5pt, or auto (default)";
  setting.get = [](const ViewerState& s) { return length_text(s.picture.*kMember); };
  setting.set = [](ViewerState& s, const std::string& text) {
    return store(parse_length(text), s.picture.*kMember);
  };
  return setting;
}

}  // namespace

std::vector<Setting> figure_settings_table() {
  return {
      words<&PictureSettings::title>({.name = "title", .help = "words over the picture"}, off),
      words<&PictureSettings::bar_label>(
          {.name = "bar-label",
           .help = "words over the colour bar, in place of what its values are"},
          by_itself),
      words<&PictureSettings::units>(
          {.name = "units", .help = "units of the values, behind the words over the colour bar"},
          by_itself),
      {.name = "number-format",
       .group = kFigure,
       .value_name = "STYLE:N",
       .help = "format of the numbers at the colour bar",
       .forms = "auto (default), fixed:N, scientific:N or significant:N with N digits",
       .get = [](const ViewerState& s) { return number_format_text(s.picture.number_format); },
       .set =
           [](ViewerState& s, const std::string& t) {
             return store(parse_number_format(t), s.picture.number_format);
           },
       .values =
           [] {
             return std::vector<std::string>{"auto", "fixed:2", "scientific:1", "significant:3"};
           }},
      length<&PictureSettings::text_size>(
          {.name = "text-size",
           .help = "size of letters",
           .detail =
               "auto: 1/44 of the picture's shorter side; 8pt where the size is one on paper."}),
      length<&PictureSettings::line_width>(
          {.name = "line-width",
           .help = "width of isolines; edges and paths keep their proportions",
           .detail = "auto: it suits the picture; 0.5pt where the size is one on paper."}),
      {.name = "dpi",
       .group = kFigure,
       .value_name = "N",
       .help = "pixels an inch on paper, 10 to 2400, for lengths in pt, mm, cm or in and for the "
               "file",
       .detail = "auto: 300 where the size is one on paper; elsewhere 96, and the file says none.",
       .get =
           [](const ViewerState& s) {
             return s.picture.dpi ? std::to_string(*s.picture.dpi) : std::string("auto");
           },
       .set = set_dpi},
      choice<&PictureSettings::colour_scale>(
          {.name = "colour-scale",
           .group = kFigure,
           .value_name = "NAME",
           .help = "how values become colours",
           .detail = "log: equal ratios are equally far apart, between round numbers above 0; "
                     "diverging: of differences, 0 in the middle and round ends."}),
      {.name = "bands",
       .group = kFigure,
       .value_name = "N",
       .help = "colours that are told apart, 2 to 64, with round numbers between them",
       .get =
           [](const ViewerState& s) {
             return s.picture.bands == 0 ? std::string("off") : std::to_string(s.picture.bands);
           },
       .set = [](ViewerState& s,
                 const std::string& t) { return store(parse_bands(t), s.picture.bands); }},
      {.name = "values",
       .group = kFigure,
       .value_name = "V1,V2,...",
       .help = "isolines at these values, up to 64, instead of at multiples of a spacing",
       .get = [](const ViewerState& s) { return values_text(s.picture.line_values); },
       .set = [](ViewerState& s,
                 const std::string& t) { return store(parse_values(t), s.picture.line_values); }},
      choice<&PictureSettings::path_kind>(
          {.name = "path-kind",
           .group = kFigure,
           .value_name = "KIND",
           .help = "which paths to a point are drawn",
           .detail =
               "geodesic: locally shortest; distance, heat: streamlines of what was computed."}),
  };
}

}  // namespace geotherm::app
