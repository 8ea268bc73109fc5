// SPDX-License-Identifier: MIT
#include <algorithm>
#include <limits>
#include <new>
#include <utility>

#include "geotherm/domains.h"
#include "solver/core/sorting.h"
#include "solver/volume/clean_tets.h"

namespace geotherm {

Result<TetMesh> TetMesh::build(std::vector<Vec3> positions, std::vector<Tet> tets) {
  constexpr std::size_t kMax = static_cast<std::size_t>(std::numeric_limits<Index>::max()) / 6;
  if (tets.empty()) {
    return Error{ErrorCode::kBadInput,
                 "the volume has no tetrahedra (" + std::to_string(positions.size()) + " vertices)",
                 {"distances in a volume need tetrahedra with four corners"}};
  }
  if (positions.size() > kMax || tets.size() > kMax) {
    return Error{ErrorCode::kBadInput,
                 "the volume has " + std::to_string(positions.size()) + " vertices and " +
                     std::to_string(tets.size()) + " tetrahedra",
                 {"at most " + std::to_string(kMax) + " of each are supported"}};
  }
  const auto vertex_count = static_cast<Index>(positions.size());
  for (std::size_t v = 0; v < positions.size(); ++v) {
    if (!positions[v].allFinite()) {
      return Error{ErrorCode::kBadInput,
                   "vertex " + std::to_string(v) + " has a coordinate that is not finite"};
    }
  }
  for (std::size_t t = 0; t < tets.size(); ++t) {
    for (const Index corner : tets[t]) {
      if (corner < 0 || corner >= vertex_count) {
        return Error{ErrorCode::kBadInput, "tetrahedron " + std::to_string(t) + " uses vertex " +
                                               std::to_string(corner) + ", but there are " +
                                               std::to_string(vertex_count) + " vertices"};
      }
    }
  }
  return TetMesh(std::move(positions), std::move(tets));
}

namespace {

/// A face by its corners in ascending order, and where it is: 4 times the tet and the corner that
/// it lies opposite.
struct TetSide {
  Face sorted;
  Index place;
};

/// Calls use(t, k) for each face of a tet that counts and is alone, in any order.
template <class Use>
void for_each_lone_side(const TetMesh& mesh, const std::vector<TetFault>& fault, const Use& use) {
  std::vector<std::uint32_t> start;
  const auto emit = [&](std::size_t t, const auto& put) {
    if (fault[t] != TetFault::kNone) return;
    for (int k = 0; k < 4; ++k) {
      Face face = face_opposite(mesh.tets()[t], k);
      std::ranges::sort(face);
      put(face[0], TetSide{face, static_cast<Index>(4 * t + static_cast<std::size_t>(k))});
    }
  };
  RawVector<TetSide> sides = counting_sort<TetSide>(
      mesh.tets().size(), static_cast<std::size_t>(mesh.vertex_count()), 1, emit, start);
  for (std::size_t v = 0; v + 1 < start.size(); ++v) {
    const std::span here(sides.data() + start[v], start[v + 1] - start[v]);
    std::ranges::sort(here, {}, &TetSide::sorted);
    for (std::size_t i = 0; i < here.size(); ++i) {
      const bool as_before = i > 0 && here[i - 1].sorted == here[i].sorted;
      const bool as_next = i + 1 < here.size() && here[i + 1].sorted == here[i].sorted;
      if (!as_before && !as_next) use(here[i].place / 4, here[i].place % 4);
    }
  }
}

TetBoundary find_boundary(const TetMesh& mesh) {
  std::vector<std::uint8_t> lone(mesh.tets().size(), 0);  // a bit for each face
  for_each_lone_side(mesh, find_tet_faults(mesh), [&lone](Index t, Index k) {
    lone[t] = static_cast<std::uint8_t>(lone[t] | (1U << static_cast<unsigned>(k)));
  });
  TetBoundary border;
  std::vector<std::uint8_t> on_border(mesh.positions().size(), 0);
  for (Index t = 0; t < mesh.tet_count(); ++t) {
    if (lone[t] == 0) continue;
    const Tet& tet = mesh.tets()[t];
    const auto at = [&](std::size_t k) -> const Vec3& { return mesh.positions()[tet[k]]; };
    const bool negative = orientation_of(at(0), at(1), at(2), at(3)) < 0;
    for (int k = 0; k < 4; ++k) {
      if ((lone[t] >> static_cast<unsigned>(k) & 1U) == 0) continue;
      Face face = face_opposite(tet, k);
      if (negative) std::swap(face[1], face[2]);
      for (const Index v : face) on_border[v] = 1;
      border.faces.push_back(face);
      border.tets.push_back(t);
    }
  }
  for_each_with_value(on_border, std::uint8_t{1},
                      [&border](Index v) { border.vertices.push_back(v); });
  return border;
}

}  // namespace

Result<TetBoundary> boundary(const TetMesh& mesh) {
  try {
    return find_boundary(mesh);
  } catch (const std::bad_alloc&) {
    return Error{ErrorCode::kOutOfMemory, "not enough memory for the border of " +
                                              std::to_string(mesh.tet_count()) + " tetrahedra"};
  }
}

}  // namespace geotherm
