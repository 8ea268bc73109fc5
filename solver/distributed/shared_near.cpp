// SPDX-License-Identifier: MIT
#include "solver/distributed/shared_near.h"

#include <algorithm>

#include "solver/heat/near_march.h"
#include "solver/heat/normalize.h"

namespace geotherm {
namespace {

/// No two places are farther apart, in MeshPart::unit.
constexpr double kFarthest = 4;

/// The faces of a component with a corner in the reach of a source, those of all ranks. A face
/// comes from every block that owns such a corner: a march does not mind.
NearFaces faces_within(const SharedTask& task, std::span<const MeshBlock> blocks,
                       std::span<const SharedSource> sources, double reach) {
  const MeshPart& part = task.part;
  const auto is_near = [&](Index v) {
    return std::ranges::any_of(sources, [&](const SharedSource& source) {
      return task.components.of[v] == source.component &&
             (part.positions[v] - source.place()).norm() <= reach;
    });
  };
  std::vector<NearFace> out;
  for (const MeshBlock& block : blocks) {
    for (Index here = 0; here < block.own(); ++here) {
      const Index row = block.row(here);
      if (row == kNoIndex || !is_near(block.vertex[here])) continue;
      const OperatorMesh& mesh = *block.surface->operators;
      const double unit = block.surface->unit;
      for (const Side corner : mesh.corners.at(row)) {
        const Index f = face_of(corner);
        NearFace& face = out.emplace_back();
        for (int k = 0; k < 3; ++k) face.corners[k] = part.id[block.part_vertex(mesh.faces[f][k])];
        const FaceLayout& at = mesh.layout[f];
        face.layout = {at.base * unit, at.x * unit, at.height * unit};
      }
    }
  }
  return {task.ranks.all_gather(out), reach > kFarthest};
}

bool are_delaunay(const SharedTask& task, std::span<const MeshBlock> blocks) {
  double others = 0;
  for (const MeshBlock& block : blocks) {
    others += block.surface && !block.surface->is_delaunay ? 1 : 0;
  }
  return task.ranks.sum(others) == 0;
}

}  // namespace

void add_near_field(const SharedTask& task, std::span<const MeshBlock> blocks,
                    std::span<const SharedSource> sources, std::span<double> distances) {
  if (!uses_what_is_known(task.options)) return;
  if (task.options.laplacian == LaplacianKind::kCotan && !are_delaunay(task, blocks)) return;
  const MeshPart& part = task.part;
  std::vector<SharedSource> left(sources.begin(), sources.end());
  std::ranges::stable_sort(left, {}, &SharedSource::component);
  for (std::span<const SharedSource> rest = left; !rest.empty();) {
    const Index component = rest.front().component;
    const auto end = std::ranges::upper_bound(rest, component, {}, &SharedSource::component);
    const auto here = rest.first(static_cast<std::size_t>(end - rest.begin()));
    rest = rest.subspan(here.size());
    const ComponentSize& size = task.components.sizes[component];
    std::vector<NearDistance> seeds;
    for (const SharedSource& source : here) seeds.push_back({source.id, 0.0});
    const auto found =
        march_around(seeds, near_count(here.size(), size.cells), size.mean_edge,
                     [&](double reach) { return faces_within(task, blocks, here, reach); });
    for (const NearDistance& each : found) {
      const GlobalIndex own = each.vertex - part.first[task.ranks.rank()];
      if (own < 0 || own >= part.own) continue;
      const double share = share_of_heat(each.distance, found.back().distance);
      double& distance = distances[static_cast<std::size_t>(own)];
      distance = share * distance + (1 - share) * each.distance;
    }
  }
}

}  // namespace geotherm
