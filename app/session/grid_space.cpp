// SPDX-License-Identifier: MIT
#include "app/session/grid_space.h"

#include <algorithm>
#include <array>
#include <new>
#include <utility>

#include "app/text/text.h"
#include "solver/core/sorting.h"

namespace geotherm::app {
namespace {

/// Flags the samples that have a neighbour.
std::vector<char> used_samples(const GridLattice& lattice) {
  std::vector<char> used(static_cast<std::size_t>(lattice.grid().sample_count()), 0);
  for (Index v = 0; v < lattice.grid().sample_count(); ++v) {
    for (int e = 0; e < lattice.dimension(); ++e) {
      if (lattice.has_edge(v, e)) used[v] = used[v + lattice.stride(e)] = 1;
    }
  }
  return used;
}

/// Whether axes run backwards so that what is counter-clockwise turns round.
bool is_mirrored(const Grid& grid) {
  return std::ranges::count_if(grid.spacing, [](double each) { return each < 0; }) % 2 == 1;
}

/// A square as two triangles, its corners in the order of the bits of their numbers.
template <class Add>
void add_square(const std::array<Index, 4>& corners, bool turned, Index cell, const Add& add) {
  const auto [a, b, c, d] = corners;
  add(turned ? Face{a, d, b} : Face{a, b, d}, cell);
  add(turned ? Face{a, c, d} : Face{a, d, c}, cell);
}

/// The sides of a cube behind which there is no other.
template <class Add>
void add_outside(const GridLattice& lattice, Index lowest, bool mirrored, const Add& add) {
  const GridCell cell = lattice.cell(lowest);
  const auto at = lattice.grid().place(lowest);
  for (std::size_t e = 0; e < 3; ++e) {
    const std::size_t f = (e + 1) % 3, g = (e + 2) % 3;  // e, f, g turn as x, y, z
    for (const int far : {0, 1}) {
      const bool at_end = far != 0 ? at[e] + 2 >= lattice.grid().size[e] : at[e] == 0;
      const Index beside = lowest + (far != 0 ? 1 : -1) * lattice.stride(static_cast<int>(e));
      if (!at_end && lattice.has_cell(beside)) continue;
      std::array<Index, 4> corners{};
      for (std::size_t k = 0; k < 4; ++k) {
        corners[k] =
            cell.corners[static_cast<std::size_t>(far) << e | (k & 1) << f | (k >> 1) << g];
      }
      add_square(corners, (far == 0) != mirrored, lowest, add);
    }
  }
}

}  // namespace

GridSpace::GridSpace(std::shared_ptr<const GridLattice> lattice, std::string meaning)
    : Space({"grid", "cell", "cells", "grid", lattice->dimension() < 3 ? "sheet" : "outside",
             lattice->is_uniform() ? "mean spacing" : "mean time between samples"},
            used_samples(*lattice), MethodKind::kFastMarching),
      grid_(lattice->shared_grid()),
      lattice_(std::move(lattice)),
      meaning_(std::move(meaning)) {}

template <class Add>
void GridSpace::for_each_face(const Add& add) const {
  const bool mirrored = is_mirrored(*grid_);
  lattice_->for_each_cell(0, lattice_->layer_count(), [&](const GridCell& cell) {
    const auto& c = cell.corners;
    if (cell.axis >= 0 || lattice_->dimension() == 1) {
      add(Face{c[0], c[1], c[1]}, kNoIndex);  // an edge alone: nothing to see
    } else if (lattice_->dimension() == 2) {
      add_square({c[0], c[1], c[2], c[3]}, mirrored, c[0], add);
    } else {
      add_outside(*lattice_, c[0], mirrored, add);
    }
  });
}

Result<TriangleMesh> GridSpace::drawn() const try {
  const Grid& grid = *grid_;
  std::vector<Vec3> positions(static_cast<std::size_t>(grid.sample_count()));
  for (Index v = 0; v < grid.sample_count(); ++v) positions[v] = grid.position(v);
  std::vector<Face> faces;
  for_each_face([&faces](const Face& face, Index) { faces.push_back(face); });
  return TriangleMesh::build(std::move(positions), std::move(faces));
} catch (const std::bad_alloc&) {
  return Error{ErrorCode::kOutOfMemory, "the memory ended while the squares of a grid were made"};
}

std::vector<Index> GridSpace::cells_of_faces() const {
  std::vector<Index> cells;
  for_each_face([&cells](const Face&, Index cell) { cells.push_back(cell); });
  return cells;
}

Vec3 GridSpace::gradient_on(Index cell, std::span<const double> values) const {
  const GridCell at = lattice_->cell(cell);
  Vec3 sum = Vec3::Zero();
  for (int e = 0; e < lattice_->dimension(); ++e) {
    for (int k = 0; k < at.count; ++k) sum[e] += (k >> e & 1) != 0 ? values[k] : -values[k];
    sum[e] *= 2 / (at.count * lattice_->spacing(e) * at.slowness);
  }
  return sum;
}

Index GridSpace::lone_edges() const {
  Index count = 0;
  lattice_->for_each_cell(0, lattice_->layer_count(),
                          [&count](const GridCell& cell) { count += cell.axis >= 0 ? 1 : 0; });
  return count;
}

std::string GridSpace::unseen() const {
  const Index edges = lattice_->dimension() == 1 ? cell_count() : lone_edges();
  if (edges == 0) return {};
  return counted(edges, "edge is alone", "edges are alone") +
         ", as in corridors one sample wide, and neither drawn nor crossed by isolines: their "
         "samples have distances all the same";
}

Index GridSpace::components() const {
  DisjointSets sets(static_cast<std::size_t>(grid_->sample_count()));
  Index parts = grid_->sample_count() - unused_vertices();
  for (Index v = 0; v < grid_->sample_count(); ++v) {
    for (int e = 0; e < lattice_->dimension(); ++e) {
      if (!lattice_->has_edge(v, e)) continue;
      const Index beside = v + lattice_->stride(e);
      if (sets.root(v) == sets.root(beside)) continue;
      sets.join(v, beside);
      --parts;
    }
  }
  return parts;
}

std::vector<SpaceFigure> GridSpace::figures() const {
  const Index edges = lone_edges(), whole = cell_count() - edges;
  const bool flat = lattice_->dimension() < 3;
  std::vector<SpaceFigure> out;
  out.push_back({"cells",
                 counted(whole, flat ? "square" : "cube", flat ? "squares" : "cubes") + ", " +
                     counted(edges, "edge", "edges") + " alone",
                 flat ? "squares" : "cubes", std::int64_t{whole}});
  out.push_back({"", "", "lone_edges", std::int64_t{edges}});
  std::int64_t walls = 0;
  double slowest = kUnreached, fastest = 0;
  for (Index v = 0; v < grid_->sample_count(); ++v) {
    const double speed = grid_->speed(v);
    if (!(speed > 0)) {
      ++walls;
      continue;
    }
    slowest = std::min(slowest, speed);
    fastest = std::max(fastest, speed);
  }
  out.push_back({"walls", counted(walls, "sample", "samples"), "walls", walls});
  const std::int64_t rim = std::ssize(boundary_vertices());
  out.push_back({"boundary", counted(rim, "sample", "samples") + " at the rim and at walls",
                 "boundary_samples", rim});
  out.push_back({"speed",
                 slowest == fastest ? significant(slowest) + " everywhere"
                                    : significant(slowest) + " to " + significant(fastest),
                 "slowest", slowest});
  out.push_back({"", "", "fastest", fastest});
  out.push_back({"", "", "spacing", grid_->spacing});
  const char* const name = flat ? "area" : "volume";
  const double measure = whole * lattice_->measure();
  out.push_back({name, significant(measure), name, measure});
  return out;
}

std::vector<Index> GridSpace::corners_of(Index cell) const {
  const auto& corners = lattice_->cell(cell).corners;
  return {corners.begin(), corners.begin() + (1 << lattice_->dimension())};
}

std::string GridSpace::described() const {
  const Grid& grid = *grid_;
  std::string size, spacing;
  for (std::size_t e = 0; e < (grid.size[2] > 1 ? 3U : 2U); ++e) {
    size += (e > 0 ? " x " : "") + grouped(grid.size[e]);
    spacing += (e > 0 ? " x " : "") + significant(std::abs(grid.spacing[e]));
  }
  const Index passing = grid.sample_count() - unused_vertices();
  return size + " samples every " + spacing + ", of which " + grouped(passing) + " pass, in " +
         counted(cell_count(), "cell", "cells") + "; " + meaning_;
}

std::vector<Index> GridSpace::boundary_vertices() const {
  std::vector<Index> vertices;
  for (Index v = 0; v < grid_->sample_count(); ++v) {
    if (used()[v] != 0 && lattice_->cells_at(v) < 1 << lattice_->dimension()) vertices.push_back(v);
  }
  return vertices;
}

Result<PlacedPoint> GridSpace::closest_point(const Vec3& place) const {
  auto found = geotherm::closest_point(*grid_, place);
  if (!found) return found.error();
  return PlacedPoint{found->sample, std::move(found->in_cell), found->distance};
}

Result<std::shared_ptr<const DistanceMethod>> GridSpace::build_method(
    const MethodOptions& options, const Progress& progress) const {
  return geotherm::build_method(grid_, options, progress);
}

Result<void> GridSpace::check_path(const std::string& path) const {
  return check_grid_distances_path(path);
}

Result<void> GridSpace::write(const std::string& path, std::span<const double> distances,
                              std::span<const Index> nearest,
                              std::span<const DataField> fields) const {
  return write_distances(path, *grid_, distances, nearest, fields);
}

}  // namespace geotherm::app
