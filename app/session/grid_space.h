// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "app/session/space.h"
#include "geotherm/mesh.h"
#include "solver/geometry/grid_mesh.h"

namespace geotherm::app {

/// A grid of samples.
class GridSpace final : public Space {
 public:
  /// Precondition: check_grid() accepts file.grid. Throws std::bad_alloc.
  explicit GridSpace(GridFile file)
      : GridSpace(
            std::make_shared<const GridLattice>(std::make_shared<const Grid>(std::move(file.grid))),
            std::move(file.meaning)) {}

  /// What is drawn: in two dimensions the squares, cut into triangles, in three the outsides of the
  /// cubes. Every sample is a vertex, so that numbers stay. Errors: kOutOfMemory.
  Result<TriangleMesh> drawn() const;

  Index cell_count() const override { return lattice_->cell_count(); }
  std::vector<Index> corners_of(Index cell) const override;
  std::array<Index, 3> size() const override { return grid_->size; }
  bool has_walls() const override { return true; }
  bool measures_time() const override { return !lattice_->is_uniform(); }
  std::string described() const override;
  std::vector<SpaceFigure> figures() const override;
  Index components() const override;
  std::vector<Index> cells_of_faces() const override;
  Vec3 gradient_on(Index cell, std::span<const double> values) const override;
  std::string unseen() const override;
  std::vector<Index> boundary_vertices() const override;
  Result<PlacedPoint> closest_point(const Vec3& place) const override;
  Result<std::shared_ptr<const DistanceMethod>> build_method(
      const MethodOptions& options, const Progress& progress) const override;
  Result<void> check_path(const std::string& path) const override;
  Result<void> write(const std::string& path, std::span<const double> distances,
                     std::span<const Index> nearest,
                     std::span<const DataField> fields) const override;

 private:
  GridSpace(std::shared_ptr<const GridLattice> lattice, std::string meaning);
  /// add(corners, cell) for each face that is drawn.
  template <class Add>
  void for_each_face(const Add& add) const;
  Index lone_edges() const;

  std::shared_ptr<const Grid> grid_;
  std::shared_ptr<const GridLattice> lattice_;
  std::string meaning_;
};

}  // namespace geotherm::app
