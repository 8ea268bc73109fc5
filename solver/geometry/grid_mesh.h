// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "geotherm/domains.h"
#include "solver/geometry/cell_mesh.h"

namespace geotherm {

inline constexpr std::int64_t kMaxGridSamples = 1'000'000'000;

/// A whole cell (a square, a cube) of a grid, or an edge that lies in none.
struct GridCell {
  std::array<Index, 8> corners;  ///< samples; bit e of k: corner k is the farther one along axis e
  int count;                     ///< of corners: 2^D, of an edge 2
  int axis;                      ///< that an edge is along; -1: a whole cell
  double slowness;               ///< the mean of its corners' 1 / speed
};

/// A place in samples along the D axes.
using GridPlace = std::array<double, 3>;

/// Whether two are the same but for the rounding of means.
bool is_same_slowness(double slowness, double other);

/// Which cells a grid has, and where. Axes with one sample alone are none: D are left.
class GridLattice {
 public:
  /// Precondition: check_grid() accepts it. Cost: one pass, a byte a sample.
  explicit GridLattice(std::shared_ptr<const Grid> grid);

  const Grid& grid() const { return *grid_; }
  const std::shared_ptr<const Grid>& shared_grid() const { return grid_; }
  int dimension() const { return dimension_; }
  /// Between samples along axis e of D, model units, above 0.
  double spacing(int e) const { return spacing_[e]; }
  Index stride(int e) const { return stride_[e]; }
  Index length(int e) const { return length_[e]; }  ///< samples along it
  double mean_spacing() const;
  /// D-dimensional, of a cell with slowness 1; an edge's is the same: a corridor as wide as a cell.
  double measure() const;
  /// The length of a way across a cell, or along an edge, where the slowness is 1.
  double width(const GridCell& cell) const {
    return cell.axis < 0 ? mean_spacing() : spacing_[cell.axis];
  }

  /// Layers across the last axis; layer k has the samples k * layer_size() on.
  Index layer_count() const { return length_[dimension_ - 1]; }
  Index layer_size() const { return stride_[dimension_ - 1]; }

  bool has_cell(Index sample) const { return (bits_[sample] & 1) != 0; }
  /// Whether the next sample along axis e passes, as this one does.
  bool has_edge(Index sample, int e) const;
  /// Whole cells at a sample; 2^D inside.
  int cells_at(Index sample) const;
  /// The cell whose lowest corner this is. Precondition: has_cell().
  GridCell cell(Index sample) const;
  /// Whether a line in this direction that runs through a cell, numbered along each axis, has one
  /// of this slowness there: on either side of it where it runs inside a face.
  bool passes(const std::array<Index, 3>& cell, const GridPlace& way, double slowness) const;
  /// Whether every sample that passes has speed 1.
  bool is_uniform() const { return uniform_; }
  /// Whether all samples that pass have the same speed.
  bool has_one_speed() const { return one_speed_; }
  /// The sum of slowness^(D - 2) over the cells at the edge from here along e, each divided by the
  /// number of its edges along e.
  double edge_weight(Index sample, int e) const;

  /// body(cell) for the cells whose lowest corners are in these layers.
  template <class Body>
  void for_each_cell(Index first_layer, Index end_layer, const Body& body) const {
    const Index end = end_layer * layer_size();
    for (Index v = first_layer * layer_size(); v < end; ++v) {
      if (bits_[v] == 0) continue;
      if (has_cell(v)) body(cell(v));
      for (int e = 0; e < dimension_; ++e) {
        if ((bits_[v] >> (e + 1) & 1) != 0) body(edge(v, e));
      }
    }
  }
  Index cell_count() const { return cells_; }

 private:
  bool at_end(Index sample, int e) const {
    return sample / stride_[e] % length_[e] + 1 == length_[e];
  }
  bool at_start(Index sample, int e) const { return sample / stride_[e] % length_[e] == 0; }
  GridCell edge(Index sample, int e) const;
  /// body(lowest corner) for the whole cells at the edge from here along e; at the sample where e
  /// is kNoIndex.
  template <class Body>
  void for_cells_at(Index sample, int e, const Body& body) const;
  double slowness(Index sample) const { return 1 / grid_->speed(sample); }

  std::shared_ptr<const Grid> grid_;
  int dimension_ = 0;
  std::array<double, 3> spacing_{};
  std::array<Index, 3> stride_{}, length_{};
  std::vector<std::uint8_t> bits_;  ///< 1: a whole cell begins here; 2 << e: an edge along e
  Index cells_ = 0;
  bool uniform_ = true, one_speed_ = true;
};

/// The passing samples that have a neighbour, and which are neighbours: the pattern of every
/// matrix, which has five entries a row in two dimensions and seven in three.
CellPattern pattern_of_grid(const GridLattice& lattice);

/// Mass and stiffness of a grid in elimination order. Each cell gives its edges equal shares of its
/// measure: that is its gradient at the middle and a positive semidefinite rest, with no entry
/// above 0 off the diagonal, so that heat stays positive. Lengths are in units of `unit`, measures
/// relative to their mean.
std::shared_ptr<const CellMatrix> build_grid_matrix(const GridLattice& lattice,
                                                    const CellPattern& pattern,
                                                    std::span<const Index> order, double unit,
                                                    double mean_measure, int threads);

}  // namespace geotherm
