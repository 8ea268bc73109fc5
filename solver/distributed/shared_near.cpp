// SPDX-License-Identifier: MIT
#include "solver/distributed/shared_near.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "solver/heat/near_march.h"
#include "solver/heat/normalize.h"

namespace geotherm {
namespace {

/// A disc of so many vertices of an even mesh is guessed this much larger.
constexpr double kRoom = 1.5;
/// No two places are farther apart, in MeshPart::unit.
constexpr double kFarthest = 4;

struct NearFace {
  std::array<GlobalIndex, 3> corners;
  FaceLayout layout;  ///< in MeshPart::unit
};

/// The faces of a component with a corner in the reach of a source, those of all ranks. A face
/// comes from every block that owns such a corner: a march does not mind.
std::vector<NearFace> faces_within(const SharedTask& task, std::span<const MeshBlock> blocks,
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
      for (const Index f : mesh.faces_at(row)) {
        NearFace& face = out.emplace_back();
        for (int k = 0; k < 3; ++k) face.corners[k] = part.id[block.part_vertex(mesh.faces[f][k])];
        const FaceLayout& at = mesh.layout[f];
        face.layout = {at.base * unit, at.x * unit, at.height * unit};
      }
    }
  }
  return task.ranks.gather(out);
}

/// What a march over some faces finds, by global numbers.
struct NearVertices {
  std::vector<GlobalIndex> id;
  std::vector<NearDistance> found;  ///< `vertex`: place in `id`
};

NearVertices march_over(std::span<const NearFace> near, std::span<const SharedSource> sources,
                        std::size_t count) {
  NearVertices out;
  for (const NearFace& face : near)
    out.id.insert(out.id.end(), face.corners.begin(), face.corners.end());
  std::ranges::sort(out.id);
  out.id.erase(std::ranges::unique(out.id).begin(), out.id.end());
  const auto number = [&](GlobalIndex id) {
    return static_cast<Index>(std::ranges::lower_bound(out.id, id) - out.id.begin());
  };
  std::vector<Face> faces;
  std::vector<FaceLayout> layout;
  for (const NearFace& face : near) {
    faces.push_back({number(face.corners[0]), number(face.corners[1]), number(face.corners[2])});
    layout.push_back(face.layout);
  }
  std::vector<NearDistance> seeds;
  for (const SharedSource& source : sources) seeds.push_back({number(source.id), 0.0});
  const CornerTable corners(static_cast<Index>(out.id.size()), faces);
  out.found = march_nearest(corners, faces, layout, seeds, count);
  return out;
}

/// Marches until all that is as near as the last vertex was there to be walked over. Straight lines
/// are no longer than distances, so that the faces within a reach hold every way that is as short.
NearVertices march_in_component(const SharedTask& task, std::span<const MeshBlock> blocks,
                                std::span<const SharedSource> sources, std::size_t count) {
  const ComponentSize& size = task.components.sizes[sources.front().component];
  const double each = static_cast<double>(count) / static_cast<double>(sources.size());
  double reach = kRoom * size.mean_edge * std::sqrt(each / M_PI);
  for (;;) {
    NearVertices out = march_over(faces_within(task, blocks, sources, reach), sources, count);
    const double limit = out.found.back().distance;
    const bool enough = out.found.size() >= count;
    if ((enough && limit <= reach) || reach > kFarthest) return out;
    reach = enough ? limit : 2 * reach;
  }
}

}  // namespace

void add_near_field(const SharedTask& task, std::span<const MeshBlock> blocks,
                    std::span<const SharedSource> sources, std::span<double> distances) {
  if (!uses_what_is_known(task.options)) return;
  const MeshPart& part = task.part;
  std::vector<SharedSource> left(sources.begin(), sources.end());
  std::ranges::stable_sort(left, {}, &SharedSource::component);
  for (std::span<const SharedSource> rest = left; !rest.empty();) {
    const Index component = rest.front().component;
    const auto end = std::ranges::upper_bound(rest, component, {}, &SharedSource::component);
    const auto here = rest.first(static_cast<std::size_t>(end - rest.begin()));
    rest = rest.subspan(here.size());
    const auto count = near_count(here.size(), task.components.sizes[component].cells);
    if (count == 0) continue;
    const NearVertices near = march_in_component(task, blocks, here, count);
    for (const NearDistance& each : near.found) {
      const GlobalIndex own = near.id[each.vertex] - part.first[task.ranks.rank()];
      if (own < 0 || own >= part.own) continue;
      const double share = share_of_heat(each.distance, near.found.back().distance);
      double& distance = distances[static_cast<std::size_t>(own)];
      distance = share * distance + (1 - share) * each.distance;
    }
  }
}

}  // namespace geotherm
