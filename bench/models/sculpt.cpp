// SPDX-License-Identifier: MIT
#include "bench/models/sculpture.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <deque>
#include <limits>
#include <memory>

#include "solver/core/sorting.h"

namespace geotherm::generate {
namespace {

GridPoint moved(const GridPoint& p, int x, int y, int z) { return {p[0] + x, p[1] + y, p[2] + z}; }

/// Corner i of the cell whose lowest corner is `p`: bit 0 is x, bit 1 is y, bit 2 is z.
GridPoint corner(const GridPoint& p, int i) { return moved(p, i & 1, (i >> 1) & 1, (i >> 2) & 1); }

/// One bit per corner of the cell: inside.
unsigned inside_mask(SparseField& field, const GridPoint& cell) {
  unsigned mask = 0;
  const std::array<double, 8> values = field.corner_values(cell);
  for (std::size_t i = 0; i < 8; ++i) mask |= (values[i] < 0 ? 1U : 0U) << i;
  return mask;
}

/// True where the voxels meet only across a diagonal of a face or of the cell.
bool is_critical(unsigned mask) {
  const auto bit = [&](int i) { return (mask >> i) & 1U; };
  for (int axis = 0; axis < 3; ++axis) {
    const int u = 1 << ((axis + 1) % 3);
    const int v = 1 << ((axis + 2) % 3);
    for (const int base : {0, 1 << axis}) {
      const unsigned a = bit(base);
      if (a == bit(base + u + v) && bit(base + u) == bit(base + v) && a != bit(base + u)) {
        return true;
      }
    }
  }
  const unsigned few = std::popcount(mask) <= 4 ? mask : ~mask & 0xffU;
  return few == 0x81U || few == 0x42U || few == 0x24U || few == 0x18U;
}

/// Every grid point near the surface, block by block.
template <class Visit>
void for_each_point(SparseField& field, Visit visit) {
  const double near = SparseField::kNear * field.spacing();
  const int blocks = field.block_count();
  for (int b = 0; b < blocks; ++b) {
    const GridPoint origin = field.block_origin(b);
    for (int slot = 0; slot < SparseField::kPoints; ++slot) {
      constexpr int kSide = SparseField::kSide;
      const GridPoint p = moved(origin, slot % kSide, slot / kSide % kSide, slot / (kSide * kSide));
      if (std::abs(field.value(p)) < near) visit(p);
    }
  }
}

/// Puts an outside point just inside; the points around it now count as near the surface.
void take_in(SparseField& field, const GridPoint& p) {
  const double most = 0.9 * SparseField::kNear * field.spacing();
  for (int i = 0; i < 27; ++i) {
    const GridPoint q = moved(p, i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1);
    field.set_value(q, std::clamp(field.value(q), -most, most));
  }
  field.set_value(p, -1e-3 * field.spacing());
}

/// Takes in the nearest outside corner of critical cells until there are none. Ends, because
/// points are only ever taken in.
void compose_well(SparseField& field) {
  std::deque<GridPoint> todo;
  const auto check = [&](const GridPoint& cell) {
    if (is_critical(inside_mask(field, cell))) todo.push_back(cell);
  };
  for_each_point(field, check);
  for (; !todo.empty(); todo.pop_front()) {
    const GridPoint cell = todo.front();
    if (!is_critical(inside_mask(field, cell))) continue;
    GridPoint nearest{};
    double least = std::numeric_limits<double>::infinity();
    for (int i = 0; i < 8; ++i) {
      const double value = field.value(corner(cell, i));
      if (value < 0 || value >= least) continue;
      least = value;
      nearest = corner(cell, i);
    }
    take_in(field, nearest);
    for (int i = 0; i < 8; ++i) {
      check(moved(nearest, -(i & 1), -((i >> 1) & 1), -((i >> 2) & 1)));
    }
  }
}

/// The middle of the points where the surface crosses the cell's edges.
Vec3 cell_vertex(SparseField& field, const GridPoint& cell) {
  Vec3 sum = Vec3::Zero();
  int crossings = 0;
  const std::array<double, 8> values = field.corner_values(cell);
  for (int i = 0; i < 8; ++i) {
    const double a = values[static_cast<std::size_t>(i)];
    for (const int step : {1, 2, 4}) {
      if (i & step) continue;
      const double b = values[static_cast<std::size_t>(i + step)];
      if ((a < 0) == (b < 0)) continue;
      const Vec3 from = field.position(corner(cell, i));
      sum += from + a / (a - b) * (field.position(corner(cell, i + step)) - from);
      ++crossings;
    }
  }
  return sum / crossings;
}

/// Keeps the connected component with the most faces (the first of equals), vertices in order.
DraftMesh largest_component(const DraftMesh& mesh) {
  const auto at = [](Index i) { return static_cast<std::size_t>(i); };
  DisjointSets components(mesh.positions.size());
  for (const Face& face : mesh.faces) {
    components.join(face[0], face[1]);
    components.join(face[0], face[2]);
  }
  std::vector<Index> faces_of(mesh.positions.size(), 0);
  for (const Face& face : mesh.faces) ++faces_of[at(components.root(face[0]))];
  Index most = 0;
  for (Index v = 0; v < std::ssize(faces_of); ++v) {
    if (faces_of[at(v)] > faces_of[at(most)]) most = v;
  }
  DraftMesh kept;
  std::vector<Index> renumbered(mesh.positions.size(), kNoIndex);
  for (Index v = 0; v < std::ssize(mesh.positions); ++v) {
    if (components.root(v) != most) continue;
    renumbered[at(v)] = static_cast<Index>(kept.positions.size());
    kept.positions.push_back(mesh.positions[at(v)]);
  }
  for (const Face& face : mesh.faces) {
    if (renumbered[at(face[0])] == kNoIndex) continue;
    kept.faces.push_back(
        {renumbered[at(face[0])], renumbered[at(face[1])], renumbered[at(face[2])]});
  }
  return kept;
}

/// The zero surface of a sampled field by surface nets (Gibson 1998): a vertex in every cell that
/// the surface crosses, two triangles across every grid edge that it crosses.
///
/// The net is the boundary of a set of voxels (the points inside), which is a manifold exactly when
/// that set is well composed (Latecki 1997): no face and no cell of the grid where inside touches
/// inside only across a diagonal. Where it does, points just outside are first taken in, until it
/// does nowhere; the result is therefore always an oriented closed manifold. Small pieces are
/// dropped: what remains is the component with the most faces.
DraftMesh extract_surface(SparseField& field) {
  compose_well(field);
  DraftMesh mesh;
  std::vector<std::array<Index, SparseField::kPoints>> vertex_of;
  const auto vertex_at = [&](const GridPoint& cell) {
    const auto block = static_cast<std::size_t>(field.block_of(cell));
    while (vertex_of.size() <= block) vertex_of.emplace_back().fill(kNoIndex);
    Index& vertex = vertex_of[block][static_cast<std::size_t>(SparseField::slot_of(cell))];
    if (vertex == kNoIndex) {
      vertex = static_cast<Index>(mesh.positions.size());
      mesh.positions.push_back(cell_vertex(field, cell));
    }
    return vertex;
  };
  for_each_point(field, [&](const GridPoint& p) {
    const bool inside = field.value(p) < 0;
    for (int axis = 0; axis < 3; ++axis) {
      const auto step = [&](int k) { return GridPoint{k == 0, k == 1, k == 2}; };
      const GridPoint u = step((axis + 1) % 3);
      const GridPoint v = step((axis + 2) % 3);
      const GridPoint far = step(axis);
      if (inside == (field.value(moved(p, far[0], far[1], far[2])) < 0)) continue;
      const auto around = [&](int a, int b) {
        return vertex_at(
            moved(p, -a * u[0] - b * v[0], -a * u[1] - b * v[1], -a * u[2] - b * v[2]));
      };
      // Counter-clockwise seen from the edge's far end, which is outside when `p` is inside.
      std::array<Index, 4> ring = {around(1, 1), around(0, 1), around(0, 0), around(1, 0)};
      if (!inside) std::swap(ring[1], ring[3]);
      mesh.faces.push_back({ring[0], ring[1], ring[2]});
      mesh.faces.push_back({ring[0], ring[2], ring[3]});
    }
  });
  return largest_component(mesh);
}

constexpr int kTries = 10;
constexpr double kCloseEnough = 0.02;
constexpr int kRounds = 6;
// Faces per squared spacing of area: two per crossed edge, 1.5 such edges in the mean over normals.
constexpr double kFacesPerArea = 3.0;

/// A solid's samples and its raw surface.
struct Attempt {
  Attempt(const Sculpture& solid, const SculptureModel& model, double spacing)
      : field(solid, spacing, model.low, model.high) {}
  SparseField field;
  DraftMesh mesh;
};

/// The surface's point on the line through `target` along `normal`: `steps` secant steps.
Vec3 onto_surface(const SparseField& field, const Vec3& target, const Vec3& normal, int steps) {
  const double most = 0.5 * field.spacing();
  const double enough = 1e-3 * field.spacing();
  double way = 0;
  double slope = 1;
  double last = 0;
  for (int step = 0; step < steps; ++step) {
    const Vec3 p = target + way * normal;
    const double d = field.sculpture().distance(p, field.parts_near(p));
    if (step == 1) slope = std::clamp((d - last) / way, 0.5, 2.0);
    if (std::abs(d) < enough) break;
    last = d;
    way = std::clamp(way - d / slope, -most, most);
  }
  return target + way * normal;
}

}  // namespace

Result<DraftMesh> sculpt(const SculptureModel& model, Index faces, const Progress& progress) {
  std::unique_ptr<Attempt> best;
  double best_error = std::numeric_limits<double>::infinity();
  double spacing = std::sqrt(kFacesPerArea * model.area / faces);
  const Sculpture solid = model.carve(spacing);  // the same for all tries, or they would not settle
  for (int i = 0; i < kTries && best_error > kCloseEnough; ++i) {
    auto attempt = std::make_unique<Attempt>(solid, model, spacing);
    if (!attempt->field.sample(progress)) return cancelled_error();
    attempt->mesh = extract_surface(attempt->field);
    const double ratio = static_cast<double>(attempt->mesh.faces.size()) / faces;
    if (std::abs(ratio - 1) < best_error) {
      best_error = std::abs(ratio - 1);
      best = std::move(attempt);
    }
    spacing *= std::sqrt(std::clamp(ratio, 0.25, 4.0));
  }
  if (!best) return Error{ErrorCode::kBadInput, "the sculpture has no surface"};
  DraftMesh mesh = std::move(best->mesh);
  for (int round = 0; round < kRounds; ++round) {
    if (!report(progress, "smoothing", static_cast<double>(round) / kRounds)) {
      return cancelled_error();
    }
    const int steps = round + 1 < kRounds ? 1 : 3;
    relax(mesh, [&](Index, const Vec3& target, const Vec3& normal) {
      return onto_surface(best->field, target, normal, steps);
    });
  }
  smooth_slivers(mesh);
  return mesh;
}

}  // namespace geotherm::generate
