// SPDX-License-Identifier: MIT
#include "solver/distributed/shared_answer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "solver/accuracy/check_heat.h"
#include "solver/distributed/shared_notes.h"
#include "solver/distributed/shared_poisson.h"

namespace geotherm {
namespace {

/// Values below 0 by less than this share of the largest distance are what the solver leaves of a
/// 0.
constexpr double kRoundOffOfDistance = 1e-6;
/// |M u - b| / |b| that what is no news may leave (shared_heat.h): 1e-6 of the terms of the rows at
/// the edges of blocks, of which those near a source are as large as b, a few together.
constexpr double kUsualHeatResidual = 1e-5;

}  // namespace

BlockFaces::BlockFaces(const SharedTask& task, const SharedHeat& heat, const MeshBlock& block,
                       SourceAnchors anchors)
    : task_(task),
      block_(block),
      anchors_(std::move(anchors)),
      given_(field_of(task, heat, block)),
      field_(*block.surface, given_.heat, given_.t, {pool_, task.threads}, given_.extent) {}

void BlockFaces::add_divergence(std::vector<double>& b) const {
  const Block divergence = field_.divergence({&anchors_, 1});
  for (Index here = 0; here < block_.own(); ++here) {
    const Index row = block_.row(here);
    if (row != kNoIndex) b[block_.vertex[here]] = divergence(row, 0) * block_.surface->unit;
  }
}

BlockFaces::Sums BlockFaces::inspect(const std::vector<double>& phi,
                                     const std::vector<double>& b) const {
  const Surface& surface = *block_.surface;
  std::vector<double> here(static_cast<std::size_t>(surface.size())), product(here.size());
  for (Index row = 0; row < surface.size(); ++row) {
    here[row] = phi[block_.part_vertex(row)] / surface.unit;
  }
  SourceAnchors anchors = anchors_;
  anchors.components.clear();
  const auto reached = block_.per_component(
      task_.components, [&](Index c) { return task_.reached[static_cast<std::size_t>(c)]; });
  for (std::size_t c = 0; c < reached.size(); ++c) {
    if (reached[c]) anchors.components.push_back(static_cast<Index>(c));
  }
  Sums out;
  const std::vector<char> own = own_faces(task_.part, block_);
  out.cells = field_.inspect(here, anchors, own, task_.threads, out.quality);
  out.area = out.cells.area * surface.unit * surface.unit;
  out.error = out.quality.eikonal_error_mean * out.area;
  surface.apply_stiffness(here, product, task_.threads);
  for (Index v = block_.first; v < block_.end; ++v) {
    const Index row = block_.row(v - block_.first);
    if (row == kNoIndex || is_pinned(task_, v)) continue;
    const double left = product[row] * surface.unit - b[v];
    out.left += left * left;
    out.given += b[v] * b[v];
  }
  return out;
}

std::vector<double> distances_of(const SharedTask& task, const std::vector<double>& phi,
                                 Quality& quality) {
  std::vector<double> distances(static_cast<std::size_t>(task.part.own), kUnreached);
  double most = 0, clamped = 0;
  for (Index v = 0; v < task.part.own; ++v) {
    const Index component = task.components.of[v];
    if (component == kNoIndex || !task.reached[static_cast<std::size_t>(component)]) continue;
    distances[v] = std::max(phi[v], 0.0);
    most = std::max(most, distances[v]);
  }
  most = task.ranks.max(most);
  for (Index v = 0; v < task.part.own; ++v) {
    clamped += distances[v] < kUnreached && phi[v] < -kRoundOffOfDistance * most ? 1 : 0;
  }
  quality.clamped_vertices = static_cast<Index>(task.ranks.sum(clamped));
  return distances;
}

void measure(const SharedTask& task, std::span<const double> distances, SharedAnswer& out) {
  double most = 0, sum = 0, unreached = 0;
  std::array<double, 1> least = {kUnreached};
  for (const double distance : distances) {
    if (!(distance < kUnreached)) {
      ++unreached;
      continue;
    }
    most = std::max(most, distance);
    least[0] = std::min(least[0], distance);
    sum += distance;
  }
  out.most = task.ranks.max(most);
  task.ranks.all_reduce(least, RankGroup::Reduction::kMin);
  out.least = least[0];
  out.unreached = static_cast<GlobalIndex>(task.ranks.sum(unreached));
  const auto reached = static_cast<double>(task.part.vertices - out.unreached);
  out.mean = task.ranks.sum(sum) / reached;
}

Result<void> check_answer(const SharedTask& task, const std::vector<BlockFaces*>& faces,
                          const SharedHeat& heat, std::vector<double> phi,
                          const std::vector<double>& b, SharedAnswer& out) {
  phi.resize(static_cast<std::size_t>(task.part.size()), 0.0);
  Halo(task.ranks, task.part, heat.beside).fetch(task.ranks, phi);
  std::array<double, 8> sums{};
  std::array<double, 1> steepest{};
  for (const BlockFaces* const block : faces) {
    const auto part = block->inspect(phi, b);
    const std::array<double, 8> here = {part.error,
                                        part.area,
                                        part.left,
                                        part.given,
                                        static_cast<double>(part.cells.in_reach),
                                        static_cast<double>(part.cells.without_direction),
                                        static_cast<double>(part.quality.zero_gradient_faces),
                                        static_cast<double>(part.quality.steep_edges)};
    for (std::size_t k = 0; k < sums.size(); ++k) sums[k] += here[k];
    steepest[0] = std::max(steepest[0], part.quality.steepest_edge);
  }
  task.ranks.all_reduce(sums, RankGroup::Reduction::kSum);
  task.ranks.all_reduce(steepest, RankGroup::Reduction::kMax);
  Quality& q = out.quality;
  q.eikonal_error_mean = sums[1] > 0 ? sums[0] / sums[1] : 0.0;
  q.poisson_residual = sums[3] > 0 ? std::sqrt(sums[2] / sums[3]) : 0.0;
  q.heat_residual = heat.residual;
  q.zero_gradient_faces = static_cast<Index>(sums[6]);
  q.steep_edges = static_cast<Index>(sums[7]);
  q.steepest_edge = steepest[0];
  q.edges_checked = true;
  DistanceResult result;
  result.quality = q;
  const CellCounts cells = {static_cast<Index>(sums[4]), static_cast<Index>(sums[5])};
  const auto assessed =
      assess_heat(task.options, task.times.extreme, cells, result, kUsualHeatResidual);
  out.warnings = std::move(result.warnings);
  return assessed;
}

}  // namespace geotherm
