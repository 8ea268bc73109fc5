// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "app/picture/outward.h"
#include "app/picture/picture_settings.h"
#include "geotherm/distance_method.h"
#include "geotherm/domains.h"
#include "geotherm/mesh.h"
#include "geotherm/mesh_report.h"
#include "geotherm/path.h"
#include "geotherm/sources.h"
#include "geotherm/types.h"

namespace geotherm::app {

/// Value of a vertex that no source reaches.
inline constexpr float kNoPictureValue = -std::numeric_limits<float>::max();

/// A solved model made ready for drawing: floats in scene space, where the model lies within radius
/// 1 of the origin whatever its own units are.
struct PictureData {
  using Vector = std::array<float, 3>;

  std::vector<Vector> positions;                    ///< V
  std::vector<std::array<std::uint32_t, 3>> faces;  ///< F, as in the file
  std::vector<Vector> framed;                       ///< what the camera fits; empty: `positions`
  /// How much light comes to both sides of a vertex, 0 to 1 (app/picture/openness.h).
  struct Openness {
    Vector normal;
    float front = 1, back = 1;  ///< on the normal's side, on the other one
  };
  std::vector<Openness> openness;  ///< V
  Vec3 centre = Vec3::Zero();      ///< model = centre + scene * model_per_scene
  double model_per_scene = 1;
  UpAxis up = UpAxis::kAuto;  ///< that of the file, for pictures that leave it open

  /// The tets that `positions` are the vertices of and `faces` the border; null on surfaces.
  std::shared_ptr<const TetMesh> volume;
  std::vector<Index> face_tets;  ///< F: of a volume, the tet that each face belongs to
  bool solid = false;            ///< closed, all faces counter-clockwise from outside

  /// V: (distance - value_base) / value_unit, or kNoPictureValue; empty: no solve
  std::vector<float> values;
  double value_unit = 1;  ///< model units; the largest distance, 1 if there is none above 0, or
                          ///< that of another frame; of a field from value_base on, how far
  double value_base = 0;  ///< the least value of a field whose values have one sign, else 0
  /// Model units of what stands in `values`, or lies between.
  double in_model_units(double value) const { return value_base + value * value_unit; }
  double largest_value = 0;  ///< in value_unit: 1, or 0 when no distance is above 0
  /// The least and the greatest distance, where there are some, and the least above 0 (0: none).
  double smallest_value = 0, greatest_value = 0, smallest_positive = 0;
  bool unreached = false;          ///< some corner of a face has no value
  bool is_signed = false;          ///< `values` run from -1 to 1: a difference
  bool is_field = false;           ///< `values` are no distances, and 0 is nothing special
  std::vector<float> face_values;  ///< F: of a view with a colour a face (set_face_values())
  float largest_face_value = 0;    ///< where the colours of that view end
  View face_view{};                ///< that view, where there are values of it
  std::string face_title;          ///< over its colour bar

  std::vector<Vector> heat_directions;     ///< F: X = -grad u / |grad u|; 0 where there is none
  std::vector<Vector> distance_gradients;  ///< F: grad phi, scaled for the view gradient-error
  /// T: the same of each tet of a volume, which faces show (show_tets()).
  std::vector<Vec3> tet_heat, tet_gradients;
  std::vector<float> tet_values;  ///< T: of a view about tets, instead of values of faces
  struct Segment {
    Vector from, to;
    Outward outward = kAllAround;  ///< on a solid; elsewhere any face may be seen from behind
  };
  std::vector<Segment> sources;  ///< points (both ends the same) and pieces of curves

  std::vector<Index> nearest;  ///< V: group of the nearest source, or kNoIndex; empty: not known
  /// A line on the surface.
  struct Line {
    std::vector<Vector> points;     ///< one that is not finite cuts it in two
    std::array<float, 3> colour{};  ///< sRGB
    std::string name;               ///< in the legend; the same name stands there once
  };
  std::vector<Line> lines;

  std::string caption;      ///< model, faces, t, backend
  std::string value_title;  ///< over the colour bar
};

/// The mesh alone, which may be the border of a volume. The box of the vertices that faces use
/// decides where the scene lies; vertices that belong to no face and no tet are put on one that
/// does.
PictureData picture_of(const TriangleMesh& mesh, std::shared_ptr<const TetMesh> volume = nullptr);
/// The same as if the surface hid nothing of its surroundings, until light_picture().
PictureData unlit_picture_of(const TriangleMesh& mesh, std::shared_ptr<const TetMesh> volume);

/// A frame of a surface that moves, in the scene of these points (model units), which the camera
/// fits: with the points of all frames it stands still. Precondition: there are some.
PictureData picture_of_frame(const TriangleMesh& mesh, std::span<const Vec3> extent);
/// Puts the vertices of the surface where `mesh` has them; the map into scene space stays, and so
/// does the light. Precondition: the faces are those of `data`.
void move_picture(PictureData& data, const TriangleMesh& mesh);
/// Finds how much light comes to the vertices where they are now. Cost: O(V + F).
void light_picture(PictureData& data);

/// Whether the mesh is closed surfaces whose faces all run counter-clockwise seen from outside.
/// Cost: O(F).
bool is_solid(const TriangleMesh& mesh);

/// Sets where distance is 0. `in_cells`: where those are that lie in cells of a space.
void add_sources(PictureData& data, const TriangleMesh& mesh, const SourceSet& sources,
                 std::span<const Vec3> in_cells = {});

/// sRGB of a line of this name: the fields that paths follow (geodesic, heat, distance) have
/// colours that are found on all of the colour maps, others are white.
std::array<float, 3> line_colour(std::string_view name);

/// Adds a line on the surface, over those that are there. points: model units.
void add_line(PictureData& data, std::span<const Vec3> points, const std::string& name);

/// Sets the distances; those that are not finite have no value. distances: V. `unit`: at the end of
/// the scale, > 0; absent: the largest of them. `times`: they are travel times.
void add_distances(PictureData& data, std::span<const double> distances,
                   std::optional<double> unit = {}, bool times = false);

/// Shows a signed error instead: 0 in the middle of a diverging map, both of its ends equally far.
/// signed_error: V, model units, not finite where there is none. title: over the colour bar.
void add_error(PictureData& data, std::span<const double> signed_error, const std::string& title);

/// Shows any numbers instead; those that are not finite are none. values: V.
void add_field(PictureData& data, std::span<const double> values);
/// Whether all values of a field are one, but for rounding.
bool is_one_value(const PictureData& data);

/// Shows a difference of distances instead, in the same way.
void add_difference(PictureData& data, std::span<const double> difference, bool times = false);

/// Sets both vector fields of a result with fields (QueryOptions): X from ln u, so that it is there
/// however small u has become, and the direction of grad phi with the length min(a, 90) / 90, where
/// a is the angle between both in degrees. 0 where either is missing. Cost: O(F).
/// In a volume fields are those of its tets.
void add_fields(PictureData& data, const TriangleMesh& mesh, const DistanceResult& result);

/// Gradient of the linear function with these values (V) on every tet (T), value over model units;
/// 0 where a tet is flat or a value is not finite.
std::vector<Vec3> tet_gradients(const TetMesh& volume, std::span<const double> values);

/// X on every tet, as heat_directions() on faces.
std::vector<Vec3> tet_heat_directions(const TetMesh& volume, std::span<const double> log_heat);

/// What the faces of a volume show of their tets: values, and the parts of vectors that lie in the
/// face. Cost: O(F).
void show_tets(PictureData& data);

}  // namespace geotherm::app
