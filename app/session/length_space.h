// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "app/session/space.h"

namespace geotherm::app {

/// Triangles of which only the lengths of their sides are known: a surface that lies nowhere. What
/// is drawn of it are its faces with all vertices at the origin.
class LengthSpace final : public CellSpace {
 public:
  /// lengths[f][k]: of the side opposite corner k of face f, model units. Errors (kBadInput, with
  /// the number): those of TriangleMesh::build(), a vertex from 3 F on, a length that is not above
  /// 0, three lengths that are no triangle or have an area beyond the range of doubles, an edge
  /// that has another length in another face (by more than 1e-6 of it).
  static Result<std::shared_ptr<const LengthSpace>> build(
      const std::vector<Face>& faces, const std::vector<std::array<double, 3>>& lengths);

  Index cell_count() const override { return cells().cell_count(); }
  std::vector<Index> corners_of(Index cell) const override;
  std::string described() const override;
  std::vector<SpaceFigure> figures() const override;
  std::vector<Index> cells_of_faces() const override;
  Vec3 gradient_on(Index cell, std::span<const double> values) const override;
  bool has_places() const override { return false; }
  std::string unseen() const override { return "it lies nowhere, so that nothing is drawn of it"; }
  /// Errors: kBadInput, always.
  Result<PlacedPoint> closest_point(const Vec3& place) const override;
  /// The heat method alone.
  Result<std::shared_ptr<const DistanceMethod>> build_method(
      const MethodOptions& options, const Progress& progress) const override;
  /// .csv and .npy.
  Result<void> check_path(const std::string& path) const override;

 private:
  LengthSpace(CellComplex cells, TriangleMesh drawn);
};

}  // namespace geotherm::app
