// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "geotherm/accuracy.h"
#include "geotherm/build_method.h"
#include "geotherm/domains.h"
#include "geotherm/error.h"
#include "geotherm/io.h"
#include "geotherm/sources.h"

namespace geotherm::app {

/// What a space is called in messages and reports.
struct SpaceWords {
  const char* domain;        ///< "tets": model.domain in JSON
  const char *cell, *cells;  ///< "tet", "tets"; JSON counts them under the second
  const char* body;          ///< "volume"
  const char* drawn;         ///< "border": what Model::mesh is of it
  const char* width;         ///< "mean longest edge": what t is in squares of
};

/// The point of a space nearest to a place: a vertex, else a point in a cell.
struct PlacedPoint {
  Index vertex = kNoIndex;
  CellPoint in_cell;    ///< where `vertex` is kNoIndex
  double distance = 0;  ///< to the place, model units
};

/// A figure of a space: a row of `info`, and a key of its JSON.
struct SpaceFigure {
  std::string row, text;  ///< empty: the JSON alone has it
  std::string key;
  std::variant<std::int64_t, double, std::array<double, 3>> value;
};

/// What distance is computed in, where that is no triangle mesh. Its vertices are those of
/// Model::mesh, which is what is drawn of it. Immutable.
class Space {
 public:
  virtual ~Space() = default;

  const SpaceWords& words() const { return words_; }
  /// V: flags the vertices that belong to a cell, where distance can start.
  const std::vector<char>& used() const { return used_; }
  /// Whether vertices in no cell are meant: walls.
  virtual bool has_walls() const { return false; }
  Index unused_vertices() const { return static_cast<Index>(std::ranges::count(used_, 0)); }
  /// Near-exact, and there is nothing better: what heat is held against.
  MethodKind reference_method() const { return reference_method_; }

  virtual Index cell_count() const = 0;
  /// The vertices of a cell as sources number it, in the order of their weights.
  virtual std::vector<Index> corners_of(Index cell) const = 0;
  /// What slices cut, where that is tets: drawn as Model::mesh otherwise.
  virtual std::shared_ptr<const TetMesh> tets() const { return nullptr; }
  /// Samples along x, y and z; zeros where vertices are no samples of a grid.
  virtual std::array<Index, 3> size() const { return {}; }
  /// Whether its vertices lie anywhere.
  virtual bool has_places() const { return true; }
  /// Whether the answer is travel time, not a length.
  virtual bool measures_time() const { return false; }
  /// What `info` says of it, in one line and in figures. Cost: a pass over the cells.
  virtual std::string described() const = 0;
  virtual std::vector<SpaceFigure> figures() const = 0;
  /// Parts that no cell joins. Cost: a pass over the cells.
  virtual Index components() const = 0;
  /// F: the cell that each face of Model::mesh belongs to; kNoIndex: it stands for none that has a
  /// gradient.
  virtual std::vector<Index> cells_of_faces() const = 0;
  /// The gradient at the middle of a cell, times the speed there, of what has these values at its
  /// corners: in the cell's own frame.
  virtual Vec3 gradient_on(Index cell, std::span<const double> values) const = 0;
  /// What pictures and isolines leave out of it; empty: nothing.
  virtual std::string unseen() const { return {}; }
  /// The vertices that the source `boundary` is.
  virtual std::vector<Index> boundary_vertices() const = 0;
  virtual Result<PlacedPoint> closest_point(const Vec3& place) const = 0;

  /// Errors: those of the library, kNotAvailable for options that the space has not.
  virtual Result<std::shared_ptr<const DistanceMethod>> build_method(
      const MethodOptions& options, const Progress& progress) const = 0;

  /// Whether the extension of `path` is one that write() knows; what else there is holds
  /// Model::mesh. Errors: kNotAvailable.
  virtual Result<void> check_path(const std::string& path) const = 0;
  /// As write_distances() of a mesh.
  virtual Result<void> write(const std::string& path, std::span<const double> distances,
                             std::span<const Index> nearest,
                             std::span<const DataField> fields) const = 0;

 protected:
  Space(const SpaceWords& words, std::vector<char> used, MethodKind reference_method)
      : words_(words), used_(std::move(used)), reference_method_(reference_method) {}

 private:
  SpaceWords words_;
  std::vector<char> used_;
  MethodKind reference_method_;
};

/// The values of an answer in `cells`: eikonal errors, lost gradients or angles of gradients; none
/// where the number of a cell is kNoIndex. Precondition: the answer has u where the field needs it.
std::vector<double> cell_field(const Space& space, QualityField field, const DistanceResult& answer,
                               std::span<const Index> cells);

/// Whether cell_field() knows it.
inline bool is_of_cells(QualityField field) {
  return field == QualityField::kEikonalError || field == QualityField::kLostGradients ||
         field == QualityField::kGradientAngle;
}

/// A method for the space; of heat one that shares what it can with `other`, which may be null.
Result<std::shared_ptr<const DistanceMethod>> build_method_sharing(const Space& space,
                                                                   const MethodOptions& options,
                                                                   const DistanceMethod* other,
                                                                   const Progress& progress);

/// A volume, and its border with all vertices of the volume.
class TetSpace final : public Space {
 public:
  /// Errors: those of boundary().
  static Result<std::shared_ptr<const TetSpace>> build(TetMesh volume);

  std::vector<Index> corners_of(Index cell) const override;
  std::shared_ptr<const TetMesh> tets() const override { return volume_; }
  const TetBoundary& border() const { return border_; }

  Index cell_count() const override { return volume_->tet_count(); }
  std::string described() const override;
  std::vector<SpaceFigure> figures() const override;
  Index components() const override;
  std::vector<Index> cells_of_faces() const override { return border_.tets; }
  Vec3 gradient_on(Index cell, std::span<const double> values) const override;
  std::vector<Index> boundary_vertices() const override { return border_.vertices; }
  Result<PlacedPoint> closest_point(const Vec3& place) const override;
  Result<std::shared_ptr<const DistanceMethod>> build_method(
      const MethodOptions& options, const Progress& progress) const override;
  Result<void> check_path(const std::string& path) const override;
  Result<void> write(const std::string& path, std::span<const double> distances,
                     std::span<const Index> nearest,
                     std::span<const DataField> fields) const override;

 private:
  TetSpace(std::shared_ptr<const TetMesh> volume, TetBoundary border, std::vector<char> used);

  std::shared_ptr<const TetMesh> volume_;
  TetBoundary border_;
};

/// Cells of any kind, and the triangles that they are drawn as.
class CellSpace : public Space {
 public:
  const std::shared_ptr<const TriangleMesh>& drawn() const { return drawn_; }

  Index components() const override;
  std::vector<Index> boundary_vertices() const override;
  /// The heat method on the cells.
  Result<std::shared_ptr<const DistanceMethod>> build_method(
      const MethodOptions& options, const Progress& progress) const override;
  Result<void> write(const std::string& path, std::span<const double> distances,
                     std::span<const Index> nearest,
                     std::span<const DataField> fields) const override;

 protected:
  CellSpace(const SpaceWords& words, CellComplex cells, TriangleMesh drawn,
            MethodKind reference_method);

  const CellComplex& cells() const { return *cells_; }

 private:
  std::shared_ptr<const CellComplex> cells_;
  std::shared_ptr<const TriangleMesh> drawn_;
};

/// Polygons, and the triangles that they are drawn as.
class PolygonSpace final : public CellSpace {
 public:
  /// Errors: those of cells_of() and triangulated().
  static Result<std::shared_ptr<const PolygonSpace>> build(const PolygonMesh& mesh);

  Index cell_count() const override { return count_; }
  std::vector<Index> corners_of(Index cell) const override;
  std::string described() const override;
  std::vector<SpaceFigure> figures() const override;
  std::vector<Index> cells_of_faces() const override { return cells_of_faces_; }
  Vec3 gradient_on(Index cell, std::span<const double> values) const override;
  /// The nearest vertex of the nearest triangle.
  Result<PlacedPoint> closest_point(const Vec3& place) const override;
  Result<std::shared_ptr<const DistanceMethod>> build_method(
      const MethodOptions& options, const Progress& progress) const override;
  Result<void> check_path(const std::string& path) const override;

 private:
  PolygonSpace(CellComplex cells, TriangleMesh triangles, std::vector<Index> cells_of_faces);
  /// The first of the cells that a polygon is.
  Index place_of(Index polygon) const;

  std::vector<Index> cells_of_faces_;
  Index count_ = 0;  ///< of polygons, each of which is several cells
};

}  // namespace geotherm::app
