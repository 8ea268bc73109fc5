// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "geotherm/error.h"
#include "geotherm/names.h"

// A turntable is a turn of the camera about the vertical axis in equal steps; one picture is a turn
// of one frame.
namespace geotherm::app {

/// Views 1 to 7, in the order of their keys, then further ones.
enum class View {
  kWireframe,
  kFlat,
  kSmooth,
  kSources,
  kHeatGradient,   ///< X in black
  kGradientError,  ///< X in black, grad phi in blue, scaled by the angle between both
  kContours,
  kExactError,  ///< d - d_exact with a diverging map
  kRegions,     ///< a colour for each source, where it is the nearest (geodesic Voronoi cells)
  // One colour a face (app/picture/picture_scale.h).
  kEikonalError,     ///< | |grad d| - 1 |
  kLostGradients,    ///< where the heat has no direction
  kTriangleQuality,  ///< 1: equilateral
  kNonDelaunay,      ///< edges with a negative cotangent weight, 0 to 3
};
inline NamedValues<View> named_values(View) {
  using enum View;
  return {"there is no view '*'",
          {{kContours, "contours"},
           {kWireframe, "wireframe"},
           {kFlat, "flat"},
           {kSmooth, "smooth"},
           {kSources, "sources"},
           {kHeatGradient, "heat-gradient"},
           {kGradientError, "gradient-error"},
           {kExactError, "exact-error"},
           {kRegions, "regions"},
           {kEikonalError, "eikonal-error"},
           {kLostGradients, "lost-gradients"},
           {kTriangleQuality, "triangle-quality"},
           {kNonDelaunay, "non-delaunay"}}};
}

enum class PictureLight { kThreePoint, kHeadlight, kNone };
inline NamedValues<PictureLight> named_values(PictureLight) {
  using enum PictureLight;
  return {"there is no light '*'",
          {{kThreePoint, "three-point"}, {kHeadlight, "headlight"}, {kNone, "none"}}};
}

/// How the surface is shaded beside the light itself.
enum class PictureShading {
  kForm,   ///< darker in hollows and towards outlines
  kPlain,  ///< by the light alone
};
inline NamedValues<PictureShading> named_values(PictureShading) {
  using enum PictureShading;
  return {"there is no shading '*'", {{kForm, "form"}, {kPlain, "plain"}}};
}

enum class PictureBackground { kLight, kDark, kTransparent };
inline NamedValues<PictureBackground> named_values(PictureBackground) {
  using enum PictureBackground;
  return {"there is no background '*'",
          {{kLight, "light"}, {kDark, "dark"}, {kTransparent, "transparent"}}};
}

enum class PictureFit { kTight, kSphere };
inline NamedValues<PictureFit> named_values(PictureFit) {
  using enum PictureFit;
  return {"there is no fit '*'", {{kTight, "tight"}, {kSphere, "sphere"}}};
}

/// The axis that points up in pictures; the middle of the eye's way round the model.
enum class UpAxis { kAuto, kX, kY, kZ, kMinusX, kMinusY, kMinusZ };
inline NamedValues<UpAxis> named_values(UpAxis) {
  using enum UpAxis;
  return {"there is no axis '*'",
          {{kAuto, "auto"},
           {kX, "x"},
           {kY, "y"},
           {kZ, "z"},
           {kMinusX, "-x"},
           {kMinusY, "-y"},
           {kMinusZ, "-z"}}};
}

/// From values to places on the colour map.
enum class ColourScale {
  kLinear,
  kLog,
  kDiverging,  ///< 0 in the middle, both ends round and equally far
};
inline NamedValues<ColourScale> named_values(ColourScale) {
  using enum ColourScale;
  return {"there is no colour scale '*'",
          {{kLinear, "linear"}, {kLog, "log"}, {kDiverging, "diverging"}}};
}

/// Which of the paths to a point are drawn.
enum class PathKind { kGeodesic, kDistance, kHeat, kAll };
inline NamedValues<PathKind> named_values(PathKind) {
  using enum PathKind;
  return {"there is no kind of path '*'",
          {{kGeodesic, "geodesic"}, {kDistance, "distance"}, {kHeat, "heat"}, {kAll, "all"}}};
}

/// How numbers on the colour bar are written.
enum class NumberStyle { kAuto, kFixed, kScientific, kSignificant };
inline NamedValues<NumberStyle> named_values(NumberStyle) {
  using enum NumberStyle;
  return {"there is no number format '*'",
          {{kAuto, "auto"},
           {kFixed, "fixed"},
           {kScientific, "scientific"},
           {kSignificant, "significant"}}};
}

struct NumberFormat {
  NumberStyle style = NumberStyle::kAuto;
  int digits = 2;  ///< after the point; of kSignificant: all of them

  bool operator==(const NumberFormat&) const = default;
};

/// Units of length on paper and screen.
enum class PaperUnit { kPixel, kCentimetre, kMillimetre, kInch, kPoint };
inline NamedValues<PaperUnit> named_values(PaperUnit) {
  using enum PaperUnit;
  return {
      "there is no unit '*'",
      {{kPixel, "px"}, {kCentimetre, "cm"}, {kMillimetre, "mm"}, {kInch, "in"}, {kPoint, "pt"}}};
}

struct PaperLength {
  double value = 0;
  PaperUnit unit = PaperUnit::kPixel;

  bool operator==(const PaperLength&) const = default;
};

/// Width and height: both in whole pixels, or both on paper.
using PictureSize = std::array<PaperLength, 2>;

/// Which cells are drawn: those with all corners on one side of a share of what is shown.
enum class PeelSide { kOff, kBelow, kAbove };
inline NamedValues<PeelSide> named_values(PeelSide) {
  using enum PeelSide;
  return {"there is no peeling '*'", {{kOff, "off"}, {kBelow, "below"}, {kAbove, "above"}}};
}

struct Peel {
  PeelSide side = PeelSide::kOff;
  double share = 0.5;  ///< of the largest distance, or of the largest error where that is shown

  bool operator==(const Peel&) const = default;
};

struct CameraSettings {
  double azimuth = 30, elevation = 20;  ///< degrees
  double zoom = 1;
  double pan_right = 0, pan_up = 0;  ///< in picture heights
  bool orthographic = false;
  PictureFit fit = PictureFit::kTight;
  /// Model units; what is in the middle with PictureFit::kSphere. Absent: the middle of the model.
  std::optional<std::array<double, 3>> centre;
  UpAxis up = UpAxis::kAuto;  ///< kAuto: as the model's file says, else Y
  double roll = 0;            ///< degrees; the picture turns counter-clockwise

  bool operator==(const CameraSettings&) const = default;
};

/// Whether it looks from where every model is seen at first.
inline bool is_seen_as_usual(const CameraSettings& camera) {
  const CameraSettings usual;
  return camera.azimuth == usual.azimuth && camera.elevation == usual.elevation;
}

/// Those settings that decide what a picture's data are. A window that has given them to the device
/// does so again when one of these changes.
struct PictureDataSettings {
  View view = View::kContours;
  std::string colour_map = "red-blue";
  bool reverse = false;
  int bands = 0;  ///< colours of the map that are told apart; 0: all
  /// The normal of a plane; what lies on its side of it is removed. Absent: nothing is.
  std::optional<std::array<double, 3>> slice;
  double slice_at = 0.5;  ///< where it is: 0 to 1 of the model's extent along the normal
  Peel peel;
  PathKind path_kind = PathKind::kGeodesic;

  bool operator==(const PictureDataSettings&) const = default;
};

/// All that decides how a solved model is shown. Lengths in model units unless said otherwise.
struct PictureSettings : PictureDataSettings {
  int width = 1280, height = 720;
  std::optional<int> dpi;  ///< pixels an inch on paper; absent: not said
  /// The size on paper that width and height come from (fit_to_paper()); absent: it is in pixels.
  std::optional<PictureSize> paper;
  int samples = 4;                             ///< 1 or 4 a pixel
  std::optional<double> range_min, range_max;  ///< distances at the map's ends
  std::optional<double> line_spacing;          ///< 0: no lines; absent: a round number that suits
  PictureLight light = PictureLight::kThreePoint;
  PictureShading shading = PictureShading::kForm;
  PictureBackground background = PictureBackground::kLight;
  bool bar = true, caption = true, markers = true;
  // What figures of papers need.
  std::string title, bar_label, units;    ///< empty: none; what the values are; model units
  NumberFormat number_format;             ///< of the bar
  std::optional<PaperLength> text_size;   ///< of letters; absent: suits the picture
  std::optional<PaperLength> line_width;  ///< of isolines; edges and paths keep their proportions
  ColourScale colour_scale = ColourScale::kLinear;
  std::vector<double> line_values;  ///< ascending; isolines there instead of a spacing
  CameraSettings camera;
  int turntable = 0;   ///< frames of one turn; 0: one picture
  std::string device;  ///< part of its name; empty: the best

  bool operator==(const PictureSettings&) const = default;
};

/// Where the size is one on paper and nothing else is said.
inline constexpr PaperLength kTextOnPaper{8, PaperUnit::kPoint};
inline constexpr PaperLength kLinesOnPaper{0.5, PaperUnit::kPoint};

/// What a picture's file says: `dpi`, or what a size on paper was drawn with.
std::optional<int> said_dpi(const PictureSettings& settings);

/// Pixels an inch: `dpi` where it is set; else 300 on paper and 96 elsewhere.
int dots_per_inch(const PictureSettings& settings);

double pixels_of(const PaperLength& length, const PictureSettings& settings);

/// Sets width and height from the size on paper, where there is one. Errors: kBadInput (a side is
/// not 1 to 8192 pixels long; nothing is changed).
Result<void> fit_to_paper(PictureSettings& settings);

/// Makes the picture so large. Errors: those of fit_to_paper().
Result<void> set_size(PictureSettings& settings, const PictureSize& size);

/// What X, Y (up) and Z of a picture whose Y is up become: the shortest turn takes Y to the axis.
/// kAuto leaves them as they are.
std::array<std::array<double, 3>, 3> axes_of(UpAxis up);

int frame_count(const PictureSettings& settings);

/// The camera's settings for frame i, azimuth within 0 to 360 unless there is one frame.
CameraSettings frame_camera(const PictureSettings& settings, int frame);

/// Where each frame goes: `output` itself for one picture; for a turntable of N its name with -000
/// to N - 1 before the extension, with as many digits as N - 1 has and at least three.
std::vector<std::string> frame_paths(const std::string& output, const PictureSettings& settings);

}  // namespace geotherm::app
