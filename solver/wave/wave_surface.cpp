// SPDX-License-Identifier: MIT
#include "solver/wave/wave_surface.h"

#include <algorithm>
#include <new>
#include <string>
#include <utility>

#include "solver/core/parallel.h"

namespace geotherm {
namespace {

/// What the set-up takes at least for each face.
constexpr double kFaceNanoseconds = 400;

/// Sides without a twin, those of one edge together: the border, edges with three faces and more,
/// and edges whose two faces disagree in orientation. Flips leave their vertices alone.
std::vector<Side> twinless_sides(const IntrinsicMesh& mesh) {
  const auto ends = [&mesh](Side side) {
    const Face& face = mesh.faces[face_of(side)];
    return std::minmax({face[corner_of(side)], face[next_corner(corner_of(side))]});
  };
  std::vector<Side> sides;
  for (Side side = 0; side < static_cast<Side>(mesh.twin.size()); ++side) {
    if (mesh.twin[side] == kNoSide) sides.push_back(side);
  }
  std::ranges::sort(sides, [&](Side a, Side b) {
    const auto pair_a = ends(a), pair_b = ends(b);
    return pair_a != pair_b ? pair_a < pair_b : a < b;
  });
  return sides;
}

/// Makes edge_of_side the number of the first side of each side's edge.
void name_edges_by_first_side(WaveSurface& surface) {
  const IntrinsicMesh& mesh = surface.base.intrinsic;
  auto& edge = surface.edge_of_side;
  edge.resize(mesh.twin.size());
  for (Side side = 0; side < static_cast<Side>(mesh.twin.size()); ++side) {
    edge[side] = mesh.twin[side] == kNoSide ? side : std::min(side, mesh.twin[side]);
  }
  const std::vector<Side> alone = twinless_sides(mesh);
  for (std::size_t i = 1; i < alone.size(); ++i) {
    const Face& before = mesh.faces[face_of(alone[i - 1])];
    const Face& face = mesh.faces[face_of(alone[i])];
    const int k = corner_of(alone[i]), j = corner_of(alone[i - 1]);
    if (std::minmax(face[k], face[next_corner(k)]) ==
        std::minmax(before[j], before[next_corner(j)])) {
      edge[alone[i]] = edge[alone[i - 1]];
    }
  }
}

/// Numbers the edges from 0 in the order of their first sides, and lists their sides.
void list_sides(WaveSurface& surface) {
  auto& edge = surface.edge_of_side;
  std::vector<std::size_t> count;
  for (Side side = 0; side < static_cast<Side>(edge.size()); ++side) {
    if (edge[side] == side) {
      edge[side] = static_cast<Index>(count.size());
      count.push_back(1);
    } else {
      edge[side] = edge[edge[side]];  // a lower side, numbered already
      ++count[edge[side]];
    }
  }
  surface.side_start.resize(count.size() + 1);
  surface.side_start[0] = 0;
  for (std::size_t e = 0; e < count.size(); ++e) {
    surface.side_start[e + 1] = surface.side_start[e] + count[e];
  }
  surface.sides.resize(edge.size());
  std::vector<std::size_t> next(surface.side_start.begin(), surface.side_start.end() - 1);
  for (Side side = 0; side < static_cast<Side>(edge.size()); ++side) {
    surface.sides[next[edge[side]]++] = side;
  }
}

}  // namespace

Error wave_out_of_memory(const char* stage, Index faces) {
  return {
      ErrorCode::kOutOfMemory,
      "the memory ended in the " + std::string(stage) + " of " + std::to_string(faces) + " faces",
      {"take a mesh with fewer faces"}};
}

Result<std::shared_ptr<const WaveSurface>> build_wave_surface(
    std::shared_ptr<const TriangleMesh> mesh, const Progress& progress, int threads) {
  const Index faces = mesh->face_count();
  threads = threads_worth_starting(threads, kFaceNanoseconds * faces);
  try {
    const ThreadCrew crew(threads);
    auto base = build_intrinsic_surface(std::move(mesh), {.flip = FlipRule::kAlways},
                                        part_of(progress, 0.0, 0.9), threads);
    if (!base) return base.error();
    auto triangulation = std::make_shared<IntrinsicSurface>(*std::move(base));
    triangulation->corners = {};
    return build_wave_surface(std::shared_ptr<const IntrinsicSurface>(std::move(triangulation)),
                              part_of(progress, 0.9, 1.0));
  } catch (const std::bad_alloc&) {
    return wave_out_of_memory("triangulation", faces);
  }
}

Result<std::shared_ptr<const WaveSurface>> build_wave_surface(
    std::shared_ptr<const IntrinsicSurface> triangulation, const Progress& progress) {
  if (!report(progress, "operators", 0.0)) return cancelled_error();
  const Index faces = triangulation->mesh->face_count();
  try {
    auto surface = std::make_shared<WaveSurface>(std::move(triangulation));
    name_edges_by_first_side(*surface);
    list_sides(*surface);
    return std::shared_ptr<const WaveSurface>(std::move(surface));
  } catch (const std::bad_alloc&) {
    return wave_out_of_memory("triangulation", faces);
  }
}

}  // namespace geotherm
