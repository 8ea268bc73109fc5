// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/picture/picture_data.h"
#include "app/picture/picture_settings.h"
#include "geotherm/quality_fields.h"

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
  double spacing = 0;       ///< of isolines; 0: none
  bool coloured = false;    ///< the view shows distances and there are some above 0
  bool bar = false;         ///< there is something to read off a colour bar, and it is wanted
  std::string colour_map;   ///< the one that is drawn
  Ticks ticks;              ///< of the bar
};

/// The settings' map, or a diverging one where values have both signs and it is none.
std::string colour_map_of(const PictureData& data, const PictureSettings& settings);

/// Whether a view is about where distance is 0; the others show the mesh alone.
bool needs_sources(View view);

/// Whether a view paints values of vertices by the colour map.
bool maps_values(View view);

/// Whether a picture shows which source is the nearest: the view is to, and it is known.
bool shows_regions(const PictureData& data, const PictureSettings& settings);

PictureScale picture_scale(const PictureData& data, const PictureSettings& settings);

/// The round number (1, 2, 2.5 or 5 times a power of ten) next to x > 0: by ratio, not difference.
double nearest_round_number(double x);

/// The smallest round number that is not below x > 0.
double round_number_above(double x);

/// Spacing of isolines over values from 0 to `range`: a round number that gives about 20 of them.
/// 1 where there is no range.
double round_spacing(double range);

}  // namespace geotherm::app
