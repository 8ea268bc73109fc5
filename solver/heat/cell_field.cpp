// SPDX-License-Identifier: MIT
#include "solver/heat/cell_field.h"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "solver/accuracy/distance_bounds.h"
#include "solver/core/parallel.h"
#include "solver/core/processor.h"
#include "solver/heat/cell_domain.h"
#include "solver/heat/field_kernels.h"

namespace geotherm {
namespace {

/// Minimum ranges of cells per thread, with one column.
constexpr std::int64_t kCellRanges = 1;

/// G' times the values at the corners.
template <class Values>
std::array<double, 3> cell_gradient(const CellMesh& mesh, Index cell, const Values& value) {
  std::array<double, 3> g{};
  const double* at = mesh.gradients_of(cell);
  const auto corners = mesh.corners_of(cell);
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const double v = value(k);
    for (int e = 0; e < mesh.dimension; ++e) g[e] += v * *at++;
  }
  return g;
}

}  // namespace

CellField::CellField(const CellDomain& domain, const HeatField& heat, const PerComponent& t,
                     const Workspace& work)
    : CellsUnitField(heat, t, domain.mesh->dimension, work), domain_(domain) {}

CellField::Square CellField::inverse_square(Index cell) const {
  if (!shortens_) return {};
  const CellMesh& mesh = *domain_.mesh;
  const int d = mesh.dimension;
  // Where there are fewer than three dimensions, the identity fills up the others.
  Eigen::Matrix3d square = Eigen::Matrix3d::Identity();
  for (int i = 0; i < d; ++i) square(i, i) = 0;
  const double* at = mesh.gradients_of(cell);
  for (std::size_t k = 0; k < mesh.corners_of(cell).size(); ++k, at += d) {
    for (int i = 0; i < d; ++i) {
      for (int j = 0; j < d; ++j) square(i, j) += at[i] * at[j];
    }
  }
  // A cell that is thin, such as an edge of a grid's corridor, has an inverse along its own
  // directions alone.
  constexpr double kThin = 1e-12;
  const double mean = square.trace() / 3;
  Square out;
  Eigen::Map<Eigen::Matrix3d>(out.data()) =
      std::abs(square.determinant()) > kThin * mean * mean * mean
          ? Eigen::Matrix3d(square.inverse())
          : inverse_along(square);
  return out;
}

/// The length of X: the slope sqrt(t) |grad log u| relative to that of one front, at most 1. Corner
/// k lies at (G' G)^-1 G_k, up to a shift.
double CellField::length(Index cell, const Square& inverse, Eigen::Index column) const {
  const CellMesh& mesh = *domain_.mesh;
  const auto corners = mesh.corners_of(cell);
  const auto g =
      cell_gradient(mesh, cell, [&](std::size_t k) { return log_u_(corners[k], column); });
  const double size = norm(g);
  if (!(size > 0) || !std::isfinite(size)) return 1;  // no logarithm: u <= 0
  const Eigen::Vector3d along = Eigen::Map<const Eigen::Matrix3d>(inverse.data()) *
                                Eigen::Map<const Eigen::Vector3d>(g.data()) / size;
  double low = kUnreached, high = -kUnreached;
  const double* at = mesh.gradients_of(cell);
  for (std::size_t k = 0; k < corners.size(); ++k) {
    double place = 0;
    for (int e = 0; e < mesh.dimension; ++e) place += *at++ * along[e];
    low = std::min(low, place);
    high = std::max(high, place);
  }
  const double root_t = root_t_.of(mesh.components.of[corners.front()]);
  return front_length(high - low, size, root_t, 1 / root_t);
}

/// (0, 0, 0) where the gradient is zero or not finite.
CellField::Direction CellField::of_cell(Index cell, const Square& inverse,
                                        Eigen::Index column) const {
  const CellMesh& mesh = *domain_.mesh;
  const auto corners = mesh.corners_of(cell);
  const int least = least_level(corners, column);
  const auto value = [&](std::size_t k) { return value_at(corners[k], column, least); };
  const double first = value(0);
  double largest = 0;
  for (std::size_t k = 1; k < corners.size(); ++k) {
    largest = std::max(largest, std::abs(value(k) - first));
  }
  if (!(largest > kEquallyWarm * std::abs(first)) || !std::isfinite(largest)) return {};
  int exponent = 0;
  std::frexp(largest, &exponent);
  const auto g = cell_gradient(
      mesh, cell, [&](std::size_t k) { return std::ldexp(value(k) - first, -exponent); });
  const double size = norm(g);
  if (!(size > 0)) return {};
  const double scale = -(shortens_ ? length(cell, inverse, column) : 1.0) / size;
  return {g[0] * scale, g[1] * scale, g[2] * scale};
}

void CellField::add_tets(Index first_tet, Index end_tet, Eigen::Index first, int group,
                         Block& b) const {
  struct Context {
    const CellField* field;
    Eigen::Index first;
  };
  const Context context{this, first};
  const CellMesh& mesh = *domain_.mesh;
  TetPass pass{};
  pass.corners = mesh.corners.data();
  pass.gradients = mesh.gradients.data();
  pass.measures = mesh.measures.data();
  pass.first = first_tet;
  pass.end = end_tet;
  pass.u = heat_.u.data() + first;
  if (!heat_.level.empty()) pass.level = heat_.level.data() + first;
  if (shortens_) pass.log_u = log_u_.data() + first;
  pass.root_t = root_t_.of(0);
  pass.b = b.data() + first;
  pass.stride = b.cols();
  pass.context = &context;
  pass.careful = [](const void* at, Index tet, int column) {
    const auto& c = *static_cast<const Context*>(at);
    return c.field->of_cell(tet, c.field->inverse_square(tet), c.first + column);
  };
  add_tet_divergence(pass, group);
}

void CellField::add_cells(Index first_cell, Index end_cell, Block& b) const {
  const CellMesh& mesh = *domain_.mesh;
  if (mesh.is_of_tets && root_t_.same()) {
    for (Eigen::Index first = 0; first < b.cols();) {
      const int group = column_group(b.cols() - first);
      add_tets(first_cell, end_cell, first, group, b);
      first += group;
    }
    return;
  }
  const int d = mesh.dimension;
  for (Index c = first_cell; c < end_cell; ++c) {
    const Square inverse = inverse_square(c);
    const auto corners = mesh.corners_of(c);
    const double* const gradients = mesh.gradients_of(c);
    for (Eigen::Index column = 0; column < b.cols(); ++column) {
      const Direction x = of_cell(c, inverse, column);
      for (std::size_t k = 0; k < corners.size(); ++k) {
        double flow = 0;
        for (int e = 0; e < d; ++e) flow += gradients[static_cast<int>(k) * d + e] * x[e];
        b(corners[k], column) += mesh.measures[c] * flow;
      }
    }
  }
}

/// In a cell beside a source X is known: the gradient of the distances at its corners.
void CellField::put_known(Index cell, std::span<const double> distances, Eigen::Index column,
                          Block& b) const {
  const CellMesh& mesh = *domain_.mesh;
  const Direction before = of_cell(cell, inverse_square(cell), column);
  const auto known = cell_gradient(mesh, cell, [&](std::size_t k) { return distances[k]; });
  const double* at = mesh.gradients_of(cell);
  for (const Index row : mesh.corners_of(cell)) {
    double flow = 0;
    for (int e = 0; e < mesh.dimension; ++e) flow += *at++ * (known[e] - before[e]);
    b(row, column) += mesh.measures[cell] * flow;
  }
}

/// In two dimensions those are the cells that touch a source at a vertex, and straight lines:
/// within a triangle that was flipped, which need not lie in space, else between positions.
void CellField::put_near(const SourceAnchors& anchors, Eigen::Index column, Block& b) const {
  const CellMesh& mesh = *domain_.mesh;
  for (const NearCell& near : near_tets(domain_, anchors)) {
    put_known(near.cell, near.distances, column, b);
  }
  const CellComplex& given = *domain_.given;
  if (mesh.dimension != 2 || given.positions.empty() || !given.lengths_are_straight) return;
  std::map<Index, std::vector<double>> distances;  // of each cell
  for (const auto& anchor : anchors.anchors) {
    if (anchor.offset > 0) continue;
    for (const Index cell : mesh.cells_at.at(anchor.row)) {
      const auto corners = mesh.corners_of(cell);
      std::vector<double>& of = distances[cell];
      of.resize(corners.size(), kUnreached);
      for (std::size_t k = 0; k < corners.size(); ++k) {
        of[k] = std::min(of[k], domain_.length_within(cell, anchor.row, corners[k]));
      }
    }
  }
  for (const auto& [cell, of] : distances) put_known(cell, of, column, b);
}

Block CellField::divergence(std::span<const SourceAnchors> anchors) const {
  const CellMesh& mesh = *domain_.mesh;
  const Eigen::Index columns = heat_.u.cols();
  Block b = work_.pool.take(heat_.u.rows(), columns);
  for_ranges(mesh.ranges, work_.threads, kCellRanges, [&](const RowRange& range) {
    b.middleRows(range.first_row, range.end_row - range.first_row).setZero();
    add_cells(range.first_cell, range.end_cell, b);
  });
  add_cells(mesh.crossing, mesh.cell_count(), b);
  if (!shortens_) return b;
  parallel_each(work_.threads, columns, 1,
                [&](std::int64_t c) { put_near(anchors[static_cast<std::size_t>(c)], c, b); });
  return b;
}

/// Cells that share a number, as the triangles of a polygon do, are one cell of what was given: it
/// has a direction where one of them has.
CellCounts CellField::inspect(std::span<const double> phi, Eigen::Index column,
                              const SourceAnchors& anchors, std::span<const char> held_at_zero,
                              int threads, Quality& quality) const {
  const CellMesh& mesh = *domain_.mesh;
  const Inspection inspection(mesh.components, phi.size(), anchors, held_at_zero);
  const std::vector<Index>& numbers = domain_.given->numbers;
  const auto goes_on = [&](Index given) {
    return given > 0 && given < domain_.given->cell_count() && !numbers.empty() &&
           numbers[given] == numbers[given - 1];
  };
  const auto has_direction = [&](Index given) {
    const Index c = domain_.cell_of_given[given];
    return of_cell(c, inverse_square(c), column) != Direction{};
  };
  Sums all;
  for (const Sums& part :
       sums_of_blocks<Sums>(threads, mesh.cell_count(), [&](std::int64_t begin, std::int64_t end) {
         Sums sum;
         for (auto c = static_cast<Index>(begin); c < static_cast<Index>(end); ++c) {
           const auto corners = mesh.corners_of(c);
           if (!inspection.reaches(corners)) continue;
           const Index given = mesh.given_cell[c];
           if (given < domain_.given->cell_count() && !goes_on(given)) {
             bool found = has_direction(given);
             for (Index next = given + 1; !found && goes_on(next); ++next) {
               found = has_direction(next);
             }
             if (domain_.flipped) {
               inspection.count(domain_.rows_of_given(given), found, sum);
             } else {
               inspection.count(corners, found, sum);
             }
           }
           if (corners.size() < 2) continue;  // a triangle all of whose corners are one vertex
           const double slope =
               norm(cell_gradient(mesh, c, [&](std::size_t k) { return phi[corners[k]]; }));
           inspection.add_slope(corners, slope, mesh.measures[c], sum);
         }
         return sum;
       })) {
    all.add(part);
  }
  return all.write_to(quality);
}

}  // namespace geotherm
