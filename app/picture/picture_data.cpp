// SPDX-License-Identifier: MIT
#include "app/picture/picture_data.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <set>

#include "app/picture/openness.h"
#include "geotherm/accuracy.h"
#include "solver/core/parallel.h"
#include "solver/core/sorting.h"
#include "solver/geometry/clean_faces.h"
#include "solver/geometry/face_gradient.h"
#include "solver/volume/clean_tets.h"

namespace geotherm::app {
namespace {

PictureData::Vector to_float(const Vec3& v) {
  return {static_cast<float>(v[0]), static_cast<float>(v[1]), static_cast<float>(v[2])};
}

/// The map from model to scene; in steps that stay within the range of doubles whatever it is.
class SceneSpace {
 public:
  /// The space that the vertices of faces take up.
  explicit SceneSpace(const TriangleMesh& mesh) {
    fit([&mesh](const auto& see) {
      for (const Face& face : mesh.faces()) {
        for (const Index v : face) see(mesh.positions()[v]);
      }
    });
  }

  /// The space that points take up.
  explicit SceneSpace(std::span<const Vec3> points) {
    fit([points](const auto& see) { std::ranges::for_each(points, see); });
  }

  /// How the data say it: the inverse map.
  SceneSpace(const Vec3& centre, double model_per_scene) : centre_(centre), box_(model_per_scene) {}

  PictureData::Vector of(const Vec3& p) const { return to_float(in_box(p) / radius_); }
  const Vec3& centre() const { return centre_; }
  double model_per_scene() const {
    return std::min(box_ * radius_, std::numeric_limits<double>::max());
  }

 private:
  /// `each` shows all points to what it is given.
  template <class Each>
  void fit(const Each& each) {
    Vec3 low = Vec3::Constant(kUnreached);
    Vec3 high = -low;
    each([&](const Vec3& p) {
      low = low.cwiseMin(p);
      high = high.cwiseMax(p);
    });
    centre_ = 0.5 * low + 0.5 * high;
    const double half = (0.5 * high - 0.5 * low).maxCoeff();
    if (half > 0) box_ = half;
    double radius = 0;
    each([&](const Vec3& p) { radius = std::max(radius, in_box(p).norm()); });
    if (radius > 0) radius_ = radius;
  }

  Vec3 in_box(const Vec3& p) const { return (p - centre_) / box_; }

  Vec3 centre_ = Vec3::Zero();
  double box_ = 1;     ///< half of the box's longest side
  double radius_ = 1;  ///< of the model in units of that
};

/// Where an arrow has its full length.
constexpr double kFullAngle = 90;

}  // namespace

namespace {

/// The faces, and the vertices that they use; others are put on one of these.
PictureData picture_in(const SceneSpace& scene, const TriangleMesh& mesh) {
  PictureData data;
  data.centre = scene.centre();
  data.model_per_scene = scene.model_per_scene();
  const auto vertices = static_cast<std::size_t>(mesh.vertex_count());
  data.positions.assign(vertices, scene.of(mesh.positions()[mesh.faces()[0][0]]));
  data.faces.reserve(static_cast<std::size_t>(mesh.face_count()));
  for (const Face& face : mesh.faces()) {
    for (const Index v : face) data.positions[v] = scene.of(mesh.positions()[v]);
    data.faces.push_back({static_cast<std::uint32_t>(face[0]), static_cast<std::uint32_t>(face[1]),
                          static_cast<std::uint32_t>(face[2])});
  }
  return data;
}

}  // namespace

PictureData picture_of_frame(const TriangleMesh& mesh, std::span<const Vec3> extent) {
  const SceneSpace scene(extent);
  PictureData data = picture_in(scene, mesh);
  light_picture(data);
  for (const Vec3& p : extent) data.framed.push_back(scene.of(p));
  return data;
}

PictureData picture_of(const TriangleMesh& mesh, std::shared_ptr<const TetMesh> volume) {
  PictureData data = unlit_picture_of(mesh, std::move(volume));
  light_picture(data);
  return data;
}

PictureData unlit_picture_of(const TriangleMesh& mesh, std::shared_ptr<const TetMesh> volume) {
  const SceneSpace scene(mesh);
  PictureData data = picture_in(scene, mesh);
  data.volume = std::move(volume);
  if (!data.volume) return data;
  for (const Tet& tet : data.volume->tets()) {
    for (const Index v : tet) data.positions[v] = scene.of(mesh.positions()[v]);
  }
  if (auto border = boundary(*data.volume)) data.face_tets = std::move(border->tets);
  return data;
}

void move_picture(PictureData& data, const TriangleMesh& mesh) {
  const SceneSpace scene(data.centre, data.model_per_scene);
  for (const Face& face : mesh.faces()) {
    for (const Index v : face) data.positions[v] = scene.of(mesh.positions()[v]);
  }
}

void light_picture(PictureData& data) { data.openness = openness_of(data.positions, data.faces); }

bool is_solid(const TriangleMesh& mesh) {
  const CleanFaces clean = clean_faces(mesh, thread_count(0));
  if (!clean.oriented_manifold || clean.reoriented > 0) return false;
  DisjointSets pieces(clean.faces.size());
  for (Index e = 0; e < clean.edges.edge_count(); ++e) {
    const auto sides = clean.edges.sides(e);
    if (sides.size() != 2) return false;
    pieces.join(face_of(sides[0]), face_of(sides[1]));
  }
  const SceneSpace scene(mesh);
  const auto at = [&](Index v) {
    const auto [x, y, z] = scene.of(mesh.positions()[v]);
    return Vec3(x, y, z);
  };
  std::vector<double> volumes(clean.faces.size(), 0);  // times six: of each piece, at its root
  for (std::size_t f = 0; f < clean.faces.size(); ++f) {
    const auto root = static_cast<std::size_t>(pieces.root(static_cast<Index>(f)));
    const Vec3 from = at(clean.faces[root][0]);
    const auto& [a, b, c] = clean.faces[f];
    volumes[root] += (at(a) - from).dot((at(b) - from).cross(at(c) - from));
  }
  for (std::size_t f = 0; f < clean.faces.size(); ++f) {
    if (pieces.root(static_cast<Index>(f)) == static_cast<Index>(f) && !(volumes[f] > 0)) {
      return false;
    }
  }
  return !clean.faces.empty();
}

void add_sources(PictureData& data, const TriangleMesh& mesh, const SourceSet& sources,
                 std::span<const Vec3> in_cells) {
  data.sources.clear();
  const SceneSpace scene(data.centre, data.model_per_scene);
  std::set<Index> on_curves;
  std::vector<OutwardPlace> places;
  for (const auto& [from, to] : sources.edges) {
    places.push_back({{from, to}, kNoIndex});
    data.sources.push_back({scene.of(mesh.positions()[from]), scene.of(mesh.positions()[to])});
    on_curves.insert({from, to});
  }
  const auto in_face = [&](Index face, const std::array<double, 3>& weights) {
    return scene.of(position_at(mesh, SurfacePoint::in_face(face, weights)));
  };
  for (const FaceSegment& segment : sources.segments) {
    places.push_back({{kNoIndex, kNoIndex}, segment.face});
    data.sources.push_back(
        {in_face(segment.face, segment.from), in_face(segment.face, segment.to)});
  }
  for (const SurfacePoint& point : sources.points) {
    if (point.is_vertex() && on_curves.contains(point.vertex)) continue;
    places.push_back({{point.vertex, point.vertex}, point.is_vertex() ? kNoIndex : point.face});
    const PictureData::Vector place = scene.of(position_at(mesh, point));
    data.sources.push_back({place, place});
  }
  if (data.solid) {
    const auto outward = outward_at(mesh, places);
    for (std::size_t i = 0; i < places.size(); ++i) data.sources[i].outward = outward[i];
  }
  for (const Vec3& at : in_cells) {
    const PictureData::Vector place = scene.of(at);
    data.sources.push_back({place, place});
  }
}

std::array<float, 3> line_colour(std::string_view name) {
  if (name == "geodesic") return {1.0F, 0.84F, 0.10F};
  if (name == "heat") return {1.0F, 0.45F, 0.85F};
  if (name == "distance") return {0.25F, 0.95F, 0.45F};
  return {1, 1, 1};
}

void add_line(PictureData& data, std::span<const Vec3> points, const std::string& name) {
  const SceneSpace scene(data.centre, data.model_per_scene);
  PictureData::Line line;
  for (const Vec3& point : points) line.points.push_back(scene.of(point));
  line.colour = line_colour(name);
  line.name = name;
  data.lines.push_back(std::move(line));
}

namespace {

/// Sets what is shown: these, from value_base on in value_unit.
void set_values(PictureData& data, std::span<const double> values) {
  double least = kUnreached, greatest = -kUnreached, positive = kUnreached;
  data.values.clear();
  data.values.reserve(values.size());
  for (const double value : values) {
    const bool known = std::isfinite(value);
    data.values.push_back(known ? static_cast<float>((value - data.value_base) / data.value_unit)
                                : kNoPictureValue);
    if (!known) continue;
    least = std::min(least, value);
    greatest = std::max(greatest, value);
    if (value > 0) positive = std::min(positive, value);
  }
  const auto or_none = [](double x) { return std::isfinite(x) ? x : 0; };
  data.smallest_value = or_none(least);
  data.greatest_value = or_none(greatest);
  data.smallest_positive = or_none(positive);
  data.unreached = std::ranges::any_of(data.faces, [&data](const auto& face) {
    return std::ranges::any_of(face, [&data](auto v) { return data.values[v] == kNoPictureValue; });
  });
}

/// Makes the largest of these the unit, unless one is given.
void set_unit(PictureData& data, std::span<const double> values, std::optional<double> unit) {
  double most = unit.value_or(0);
  for (const double value : values) {
    if (!unit && std::isfinite(value)) most = std::max(most, std::abs(value));
  }
  data.value_unit = most > 0 ? most : 1;
  data.value_base = 0;
  data.largest_value = most > 0 ? 1 : 0;
  data.is_signed = data.is_field = false;
}

}  // namespace

void add_distances(PictureData& data, std::span<const double> distances, std::optional<double> unit,
                   bool times) {
  set_unit(data, distances, unit);
  // The unit stays on one line.
  data.value_title = times ? "travel time (time\u00a0units)" : "distance (model\u00a0units)";
  set_values(data, distances);
}

void add_error(PictureData& data, std::span<const double> signed_error, const std::string& title) {
  set_unit(data, signed_error, {});
  data.is_signed = true;
  data.value_title = title;
  set_values(data, signed_error);
}

void add_field(PictureData& data, std::span<const double> values) {
  add_error(data, values, "value");
  data.is_signed = data.smallest_value < 0 && data.greatest_value > 0;
  data.is_field = true;
  if (data.is_signed) return;
  // Floats would not tell values apart that are far from 0 and near each other.
  data.value_base = data.smallest_value;
  const double range = data.greatest_value - data.smallest_value;
  constexpr double kRoundingOfValues = 1e-12;
  const bool is_one = range <= kRoundingOfValues * data.largest_value * data.value_unit;
  if (!is_one) data.value_unit = range;
  set_values(data, values);
  if (is_one) data.greatest_value = data.smallest_value;
}

bool is_one_value(const PictureData& data) {
  return data.is_field && data.smallest_value == data.greatest_value;
}

void add_difference(PictureData& data, std::span<const double> difference, bool times) {
  add_error(data, difference,
            times ? "d_A \u2212 d_B (time\u00a0units)" : "d_A \u2212 d_B (model\u00a0units)");
}

namespace {

/// The direction of grad phi, as long as its angle to X says.
Vec3 with_angle_as_length(const Vec3& gradient, double angle) {
  const double length = std::min(std::isfinite(angle) ? angle / kFullAngle : 0, 1.0);
  return gradient.stableNormalized() * length;
}

void add_tet_fields(PictureData& data, const DistanceResult& result) {
  data.tet_heat = tet_heat_directions(*data.volume, result.log_heat);
  data.tet_gradients = tet_gradients(*data.volume, result.distances);
  const std::vector<double> angles = angles_between(data.tet_heat, data.tet_gradients);
  for (std::size_t t = 0; t < angles.size(); ++t) {
    data.tet_gradients[t] = with_angle_as_length(data.tet_gradients[t], angles[t]);
  }
  show_tets(data);
}

/// The gradient of u on a tet; `values` gives u at a vertex.
template <class Values>
Vec3 gradient_on(const TetMesh& volume, const Tet& tet, const Values& values) {
  const auto at = [&](std::size_t k) -> const Vec3& {
    return volume.positions()[static_cast<std::size_t>(tet[k])];
  };
  const TetGradient tets = tet_gradient(at(0), at(1), at(2), at(3));
  Vec3 sum = Vec3::Zero();
  for (std::size_t k = 0; k < 4; ++k) sum += values(tet[k]) * tets.gradients[k];
  return sum;
}

}  // namespace

std::vector<Vec3> tet_gradients(const TetMesh& volume, std::span<const double> values) {
  std::vector<Vec3> out;
  out.reserve(volume.tets().size());
  for (const Tet& tet : volume.tets()) {
    const bool known = std::ranges::all_of(tet, [&](Index v) { return std::isfinite(values[v]); });
    out.push_back(known ? gradient_on(volume, tet, [&](Index v) { return values[v]; })
                        : Vec3(Vec3::Zero()));
  }
  return out;
}

std::vector<Vec3> tet_heat_directions(const TetMesh& volume, std::span<const double> log_heat) {
  std::vector<Vec3> out;
  out.reserve(volume.tets().size());
  for (const Tet& tet : volume.tets()) {
    double largest = -kUnreached;
    for (const Index v : tet) largest = std::max(largest, log_heat[v]);
    out.emplace_back(Vec3::Zero());
    if (!std::isfinite(largest)) continue;
    // As in heat_directions(): what all corners share does not turn the gradient.
    const auto heat = [&](Index v) { return std::exp(log_heat[v] - largest); };
    out.back() = -gradient_on(volume, tet, heat).stableNormalized();
  }
  return out;
}

void show_tets(PictureData& data) {
  const auto corner = [&data](std::size_t f, std::size_t k) {
    const auto& [x, y, z] = data.positions[data.faces[f][k]];
    return Vec3(x, y, z);
  };
  const auto in_faces = [&](const std::vector<Vec3>& of_tets) {
    std::vector<PictureData::Vector> out;
    for (std::size_t f = 0; f < data.faces.size() && !of_tets.empty(); ++f) {
      const Vec3 normal = (corner(f, 1) - corner(f, 0)).cross(corner(f, 2) - corner(f, 0));
      const Vec3& all = of_tets[static_cast<std::size_t>(data.face_tets[f])];
      const Vec3 unit = normal.stableNormalized();
      out.push_back(to_float(all - all.dot(unit) * unit));
    }
    return out;
  };
  data.heat_directions = in_faces(data.tet_heat);
  data.distance_gradients = in_faces(data.tet_gradients);
  if (data.tet_values.empty()) return;
  data.face_values.clear();
  for (const Index t : data.face_tets) {
    data.face_values.push_back(data.tet_values[static_cast<std::size_t>(t)]);
  }
}

void add_fields(PictureData& data, const TriangleMesh& mesh, const DistanceResult& result) {
  if (data.volume) return add_tet_fields(data, result);
  const std::vector<Vec3> heat = heat_directions(mesh, result.log_heat);
  const std::vector<Vec3> distance = face_gradients(mesh, result.distances);
  const std::vector<double> angles = angles_between(heat, distance);
  data.heat_directions.clear();
  data.distance_gradients.clear();
  for (std::size_t f = 0; f < heat.size(); ++f) {
    data.heat_directions.push_back(to_float(heat[f]));
    data.distance_gradients.push_back(to_float(with_angle_as_length(distance[f], angles[f])));
  }
}

}  // namespace geotherm::app
