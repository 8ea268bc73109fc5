// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/picture/picture_data.h"
#include "app/picture/picture_settings.h"
#include "geotherm/accuracy.h"

namespace geotherm::app {

/// Marks on a scale.
struct Ticks {
  double step = 0;
  std::vector<double> values;       ///< ascending multiples of the step, 0 itself as plain 0
  std::vector<std::string> labels;  ///< with the same number of decimals; 0 is "0"
};

/// At most `most` (>= 2) ticks in [min, max], min < max, at round numbers; where `spacing` is above
/// 0 they are round multiples of it, if two or more of these fit, so that ticks meet isolines.
Ticks make_ticks(double min, double max, int most, double spacing = 0);

/// The same on a logarithmic scale, 0 < min < max: round numbers.
Ticks make_log_ticks(double min, double max, int most);

/// Ticks between bands of equal width: at each border, or at each of some borders.
Ticks make_band_ticks(double min, double max, int bands, int most);

/// Writes the labels anew, unless the format leaves them as they are.
void format_labels(Ticks& ticks, const NumberFormat& format);

/// What a view that paints every face in a colour of its own shows; nothing for the others.
std::optional<QualityField> face_field(View view);

/// Whether what a view shows depends on distances; the mesh alone has the rest.
bool needs_distances(View view);

/// Sets the values of a view on the faces, the end of their scale and its title, or takes away what
/// was there. `answer`: null without a solve; then, and where it lacks u although the view is about
/// that, a view that needs it has no values. Cost: O(F), nothing where what only the mesh decides
/// is there. Precondition: values that are there belong to this mesh.
void set_face_values(PictureData& data, const TriangleMesh& mesh, View view,
                     const DistanceResult* answer);

/// The same with values of cells that each have some faces, one after the other. `cells`: F, the
/// cell of each face; `name`: of a cell.
void set_face_values(PictureData& data, View view, std::span<const double> values,
                     std::span<const Index> cells, const std::string& name);

/// Between the marks of a scale of whole numbers; absent: any will do.
std::optional<double> face_tick_step(View view);

/// What the colours of a picture stand for, in model units: the settings with the data's say where
/// they leave it open.
struct PictureScale {
  double min = 0, max = 1;  ///< at the ends of the colour map; min < max
  ColourScale kind = ColourScale::kLinear;
  double spacing = 0;          ///< of isolines; 0: none
  std::vector<double> levels;  ///< isolines at these values instead, ascending
  bool coloured = false;       ///< the view shows distances and there are some above 0
  bool bar = false;            ///< there is something to read off a colour bar, and it is wanted
  std::string colour_map;      ///< the one that is drawn
  Ticks ticks;                 ///< of the bar
  bool below = false, above = false;  ///< values lie beyond the ends: they have the ends' colours

  /// Where a value is on the colour map, 0 to 1 between the ends.
  double place_of(double value) const;
  /// The value there.
  double value_at(double place) const;
};

/// Ends beyond which values lie by no more than this share of the range hold them.
inline constexpr double kSlackOfEnds = 1e-4;

/// The settings' map, or a diverging one where values have both signs and it is none.
std::string colour_map_of(const PictureData& data, const PictureDataSettings& settings);

/// Whether a view is about where distance is 0; the others show the mesh alone.
bool needs_sources(View view);

/// Whether a view paints values of vertices by the colour map.
bool maps_values(View view);

/// Whether the colour scale means something in the view. `differences`: values of both signs are
/// shown in place of distances, or can be. Errors: kBadInput, "colour-scale ...".
Result<void> check_scale_of_view(const PictureSettings& settings, bool differences);

/// Whether a view shows the vector fields of an answer.
bool shows_arrows(View view);

/// Whether a view needs u (QueryOptions::fields).
bool needs_fields(View view);

/// Whether a picture shows which source is the nearest: the view is to, and it is known.
bool shows_regions(const PictureData& data, const PictureDataSettings& settings);

/// Whether a line is drawn: of the paths to points those of the kind that was asked for.
bool shows_line(const PictureDataSettings& settings, const std::string& name);

/// What stands over the bar: the settings' words, or what the data call their values.
std::string bar_title(const PictureData& data, const PictureSettings& settings);

PictureScale picture_scale(const PictureData& data, const PictureSettings& settings);

/// The round number (1, 2, 2.5 or 5 times a power of ten) next to x > 0: by ratio, not difference.
double nearest_round_number(double x);

/// The smallest round number that is not below x > 0.
double round_number_above(double x);

/// A round number that so many of reach over `range`, and little more.
double band_width(double range, int bands);

/// Round numbers from min to max, of which 0 < min < max: the last ones where they are too many.
std::vector<double> log_levels(double min, double max, std::size_t most);

/// Spacing of isolines over values from 0 to `range`: a round number that gives about 20 of them.
/// 1 where there is no range.
double round_spacing(double range);

}  // namespace geotherm::app
