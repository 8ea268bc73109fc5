// SPDX-License-Identifier: MIT
#include "solver/heat/grid_field.h"

#include <algorithm>
#include <cmath>
#include <unordered_map>

#include "solver/core/parallel.h"
#include "solver/grid/grid_marching.h"
#include "solver/heat/field_kernels.h"
#include "solver/heat/grid_domain.h"

namespace geotherm {
namespace {

/// So far from the sources, in mean widths of cells, the gradient is that of near-exact distances.
constexpr double kNearReach = 5;

/// Layers are cut into so many ranges of two or more, whatever the number of threads.
std::vector<Index> cut_layers(Index layers) {
  constexpr Index kMaxLayerRanges = 64;
  const Index ranges = std::clamp<Index>(layers / 4, 1, kMaxLayerRanges);
  std::vector<Index> cuts;
  for (Index r = 0; r <= ranges; ++r) {
    cuts.push_back(static_cast<Index>(std::int64_t{layers} * r / ranges));
  }
  return cuts;
}

}  // namespace

struct GridField::Element {
  std::array<Index, 8> rows;
  int count;
  int dimension;
  double measure;
  double width;
  std::array<double, 3> weight;  ///< of the corners in the gradient; 0: nothing along this axis
  std::array<double, 3> extent;  ///< along each axis

  std::span<const Index> all_rows() const { return {rows.data(), static_cast<std::size_t>(count)}; }
  bool is_farther(int k, int e) const { return count == 2 ? k == 1 : (k >> e & 1) != 0; }

  template <class Values>
  Direction gradient(const Values& value) const {
    Direction g{};
    for (int k = 0; k < count; ++k) {
      const double v = value(static_cast<std::size_t>(k));
      for (int e = 0; e < dimension; ++e) g[e] += is_farther(k, e) ? v * weight[e] : -v * weight[e];
    }
    return g;
  }
};

GridField::GridField(const GridDomain& domain, const HeatField& heat, const PerComponent& t,
                     const Workspace& work)
    : CellsUnitField(heat, t, domain.lattice->dimension(), work), domain_(domain) {}

GridField::Element GridField::element_of(const GridCell& cell) const {
  const GridLattice& lattice = *domain_.lattice;
  const int d = lattice.dimension();
  Element out{{}, cell.count, d, 0, 0, {}, {}};
  for (int k = 0; k < cell.count; ++k) {
    out.rows[k] = domain_.row_of_vertex[cell.corners[k]];
  }
  out.measure = lattice.measure() / domain_.mean_measure;
  for (int e = 0; e < d; ++e) out.measure *= cell.slowness;
  out.width = lattice.width(cell) * cell.slowness / domain_.unit;
  for (int e = 0; e < d; ++e) {
    if (cell.axis >= 0 && cell.axis != e) continue;
    out.extent[e] = lattice.spacing(e) * cell.slowness / domain_.unit;
    out.weight[e] = 2 / (out.extent[e] * cell.count);
  }
  return out;
}

/// The length of X: the slope sqrt(t) |grad log u| relative to that of one front, at most 1.
double GridField::length(const Element& element, Eigen::Index column) const {
  const auto g = element.gradient([&](std::size_t k) { return log_u_(element.rows[k], column); });
  const double size = norm(g);
  if (!(size > 0) || !std::isfinite(size)) return 1;  // no logarithm: u <= 0
  double reach = 0;
  for (int e = 0; e < element.dimension; ++e) reach += element.extent[e] * std::abs(g[e]) / size;
  const double root_t = root_t_.of(domain_.matrix->components.of[element.rows[0]]);
  return front_length(reach, size, root_t, 1 / root_t);
}

/// Turns the gradient of u to where heat comes from. On a lattice exp(-k x) solves the heat step
/// for those k with sum (2 cosh(k_e h_e) - 2) / h_e^2 = 1 / t, and from a point the one arrives
/// that is normal to this surface there: along sinh(k_e h_e) / h_e. The gradient has tanh(k_e h_e /
/// 2) in its place, which lies up to 3 degrees beside it where t = h^2.
void GridField::straighten(const Element& element, const std::array<double, 8>& value,
                           Direction& g) const {
  if (element.count == 2) return;
  double total = 0;
  Direction far{};
  for (int k = 0; k < element.count; ++k) {
    total += value[k];
    for (int e = 0; e < element.dimension; ++e) far[e] += element.is_farther(k, e) ? value[k] : 0;
  }
  for (int e = 0; e < element.dimension; ++e) {
    if (!(far[e] > 0 && total - far[e] > 0)) return;
  }
  for (int e = 0; e < element.dimension; ++e) {
    g[e] *= total / far[e] * (total / (total - far[e]));
  }
}

/// (0, 0, 0) where the gradient is zero or not finite.
GridField::Direction GridField::of_cell(const Element& element, Eigen::Index column) const {
  const int least = least_level(element.all_rows(), column);
  std::array<double, 8> value{};
  double largest = 0;
  for (int k = 0; k < element.count; ++k) {  // to one exponent: the largest values'
    value[k] = value_at(element.rows[k], column, least);
    largest = std::max(largest, std::abs(value[k] - value[0]));
  }
  if (!(largest > kEquallyWarm * std::abs(value[0])) || !std::isfinite(largest)) return {};
  int exponent = 0;
  std::frexp(largest, &exponent);
  const double first = value[0];
  auto g = element.gradient([&](std::size_t k) { return std::ldexp(value[k] - first, -exponent); });
  straighten(element, value, g);
  const double size = norm(g);
  if (!(size > 0) || !std::isfinite(size)) return {};
  const double scale = -(shortens_ ? length(element, column) : 1.0) / size;
  return {g[0] * scale, g[1] * scale, g[2] * scale};
}

/// Cells whose lowest corners are in these layers.
void GridField::add_layers(Index first, Index end, Block& b) const {
  domain_.lattice->for_each_cell(first, end, [&](const GridCell& cell) {
    const Element element = element_of(cell);
    for (Eigen::Index column = 0; column < b.cols(); ++column) {
      Direction flow = of_cell(element, column);
      for (int e = 0; e < element.dimension; ++e) flow[e] *= element.measure * element.weight[e];
      for (int k = 0; k < element.count; ++k) {
        double sum = 0;
        for (int e = 0; e < element.dimension; ++e) {
          sum += element.is_farther(k, e) ? flow[e] : -flow[e];
        }
        b(element.rows[k], column) += sum;
      }
    }
  });
}

/// In the cells nearest to the sources X is known: the gradient of the distance by fast marching.
/// Its right side is that of all of L, also of what the gradient in the middle does not see, which
/// would flatten the tip of the cone.
void GridField::put_near(const SourceAnchors& anchors, Eigen::Index column, Block& b) const {
  const GridLattice& lattice = *domain_.lattice;
  std::vector<Index> samples;
  for (const auto& anchor : anchors.anchors) {
    if (anchor.offset == 0) samples.push_back(domain_.vertex_of_row[anchor.row]);
  }
  const std::vector<NearSample> near =
      march_near(lattice, samples, anchors.cell_points, kNearReach * domain_.unit);
  std::unordered_map<Index, double> distance_of;
  for (const auto& [sample, distance] : near) distance_of.emplace(sample, distance / domain_.unit);
  for (const auto& [lowest, unused] : near) {
    if (!lattice.has_cell(lowest)) continue;
    const GridCell cell = lattice.cell(lowest);
    const auto is_near = [&](Index sample) { return distance_of.contains(sample); };
    if (!std::all_of(cell.corners.begin(), cell.corners.begin() + cell.count, is_near)) continue;
    const Element element = element_of(cell);
    const Direction x = of_cell(element, column);
    for (int k = 0; k < cell.count; ++k) {
      double sum = 0;
      for (int e = 0; e < element.dimension; ++e) {
        const double rise = distance_of[cell.corners[k]] - distance_of[cell.corners[k ^ 1 << e]];
        const double before = element.is_farther(k, e) ? x[e] : -x[e];
        sum += element.weight[e] * (rise / element.extent[e] - before);
      }
      b(element.rows[k], column) += element.measure * sum;
    }
  }
}

Block GridField::divergence(std::span<const SourceAnchors> anchors) const {
  Block b = work_.take_zero(heat_.u.rows(), heat_.u.cols());
  // Ranges write to layers of their own, then those cells follow that join two of them: each row
  // has its sum in one order, with any number of threads.
  const std::vector<Index> cuts = cut_layers(domain_.lattice->layer_count());
  for (const bool joins : {false, true}) {
    parallel_each<std::size_t>(work_.threads, std::ssize(cuts) - 1, 1, [&](std::size_t r) {
      const Index last = cuts[r + 1] - 1;
      add_layers(joins ? last : cuts[r], joins ? last + 1 : last, b);
    });
  }
  if (!shortens_) return b;
  // Each march holds some bytes of every sample.
  constexpr std::int64_t kMaxAtOnce = std::int64_t{1} << 22;
  const int at_once = b.rows() > kMaxAtOnce ? 1 : work_.threads;
  parallel_each(at_once, b.cols(), 1,
                [&](std::int64_t c) { put_near(anchors[static_cast<std::size_t>(c)], c, b); });
  return b;
}

CellCounts GridField::inspect(std::span<const double> phi, Eigen::Index column,
                              const SourceAnchors& anchors, std::span<const char> held_at_zero,
                              int threads, Quality& quality) const {
  const Inspection inspection(domain_.matrix->components, phi.size(), anchors, held_at_zero);
  const std::vector<Index> cuts = cut_layers(domain_.lattice->layer_count());
  std::vector<Sums> sums(cuts.size() - 1);
  const auto inspect_cell = [&](const GridCell& cell, Sums& sum) {
    const Element element = element_of(cell);
    const auto rows = element.all_rows();
    if (!inspection.reaches(rows)) return;
    const double slope =
        norm(element.gradient([&](std::size_t k) { return phi[element.rows[k]]; }));
    inspection.count(rows, of_cell(element, column) != Direction{}, sum);
    inspection.add_slope(rows, slope, element.measure, sum);
  };
  parallel_each<std::size_t>(threads, std::ssize(sums), 1, [&](std::size_t r) {
    domain_.lattice->for_each_cell(cuts[r], cuts[r + 1],
                                   [&](const GridCell& cell) { inspect_cell(cell, sums[r]); });
  });
  Sums all;
  for (const Sums& part : sums) all.add(part);
  return all.write_to(quality);
}

}  // namespace geotherm
