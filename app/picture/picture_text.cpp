// SPDX-License-Identifier: MIT
#include "app/picture/picture_text.h"

#include <span>

#include "app/text.h"
#include "solver/core/text.h"

namespace geotherm::app {
namespace {

template <class Value>
struct Named {
  Value value;
  const char* name;
};

constexpr Named<View> kViews[] = {{View::kContours, "contours"},
                                  {View::kWireframe, "wireframe"},
                                  {View::kFlat, "flat"},
                                  {View::kSmooth, "smooth"},
                                  {View::kSources, "sources"},
                                  {View::kHeatGradient, "heat-gradient"},
                                  {View::kGradientError, "gradient-error"},
                                  {View::kExactError, "exact-error"},
                                  {View::kRegions, "regions"},
                                  {View::kEikonalError, "eikonal-error"},
                                  {View::kLostGradients, "lost-gradients"},
                                  {View::kTriangleQuality, "triangle-quality"},
                                  {View::kNonDelaunay, "non-delaunay"}};
constexpr Named<PictureLight> kLights[] = {{PictureLight::kThreePoint, "three-point"},
                                           {PictureLight::kHeadlight, "headlight"},
                                           {PictureLight::kNone, "none"}};
constexpr Named<PictureBackground> kBackgrounds[] = {
    {PictureBackground::kLight, "light"},
    {PictureBackground::kDark, "dark"},
    {PictureBackground::kTransparent, "transparent"}};
constexpr Named<PictureFit> kFits[] = {{PictureFit::kTight, "tight"},
                                       {PictureFit::kSphere, "sphere"}};

template <class Value, std::size_t N>
std::vector<std::string> names_of(const Named<Value> (&all)[N]) {
  std::vector<std::string> names;
  for (const auto& each : all) names.emplace_back(each.name);
  return names;
}

template <class Value, std::size_t N>
std::string name_of(const Named<Value> (&all)[N], Value value) {
  for (const auto& each : all) {
    if (each.value == value) return each.name;
  }
  return {};
}

template <class Value, std::size_t N>
Result<Value> value_of(const Named<Value> (&all)[N], std::string_view text, const char* what) {
  for (const auto& each : all) {
    if (text == each.name) return each.value;
  }
  return Error{ErrorCode::kBadInput, std::string("there is no ") + what + " '" +
                                         one_line(std::string(text)) + "'; there are " +
                                         joined(names_of(all))};
}

std::string yes_or_no(bool value) { return value ? "yes" : "no"; }

}  // namespace

std::string to_text(View view) { return name_of(kViews, view); }
std::string to_text(PictureLight light) { return name_of(kLights, light); }
std::string to_text(PictureBackground background) { return name_of(kBackgrounds, background); }
std::string to_text(PictureFit fit) { return name_of(kFits, fit); }

Result<View> parse_view(std::string_view text) { return value_of(kViews, text, "view"); }
Result<PictureLight> parse_light(std::string_view text) { return value_of(kLights, text, "light"); }
Result<PictureBackground> parse_background(std::string_view text) {
  return value_of(kBackgrounds, text, "background");
}
Result<PictureFit> parse_fit(std::string_view text) { return value_of(kFits, text, "fit"); }

std::vector<std::string> view_names() { return names_of(kViews); }
std::vector<std::string> light_names() { return names_of(kLights); }
std::vector<std::string> background_names() { return names_of(kBackgrounds); }
std::vector<std::string> fit_names() { return names_of(kFits); }

std::string range_text(const PictureSettings& s) {
  const auto end = [](const std::optional<double>& value) {
    return value ? number_text(*value) : std::string();
  };
  return s.range_min || s.range_max ? end(s.range_min) + ":" + end(s.range_max) : "auto";
}

std::string centre_text(const CameraSettings& camera) {
  if (!camera.centre) return "auto";
  const auto& [x, y, z] = *camera.centre;
  return number_text(x) + ":" + number_text(y) + ":" + number_text(z);
}

std::vector<std::pair<std::string, std::string>> settings_in_words(const PictureSettings& s) {
  const CameraSettings& camera = s.camera;
  return {{"view", to_text(s.view)},
          {"size", std::to_string(s.width) + "x" + std::to_string(s.height)},
          {"samples", std::to_string(s.samples)},
          {"colour-map", s.colour_map},
          {"reverse", yes_or_no(s.reverse)},
          {"range", range_text(s)},
          {"spacing", s.line_spacing ? number_text(*s.line_spacing) : "auto"},
          {"light", to_text(s.light)},
          {"background", to_text(s.background)},
          {"bar", yes_or_no(s.bar)},
          {"caption", yes_or_no(s.caption)},
          {"markers", yes_or_no(s.markers)},
          {"azimuth", number_text(camera.azimuth)},
          {"elevation", number_text(camera.elevation)},
          {"zoom", number_text(camera.zoom)},
          {"pan", number_text(camera.pan_right) + ":" + number_text(camera.pan_up)},
          {"centre", centre_text(camera)},
          {"fit", to_text(camera.fit)},
          {"projection", camera.orthographic ? "orthographic" : "perspective"}};
}

}  // namespace geotherm::app
