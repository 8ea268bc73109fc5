// SPDX-License-Identifier: MIT
#include "solver/geometry/clean_faces.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "solver/core/parallel.h"
#include "solver/geometry/orient_by_shape.h"
#include "solver/mesh/connectivity.h"

namespace geotherm {
namespace {

/// Edges or faces a thread must have to be worth starting.
constexpr std::int64_t kGrain = 1 << 14;

/// The corner of a side's face that is none of its ends.
Index opposite(const std::vector<Face>& faces, Side side) {
  return faces[face_of(side)][previous_corner(corner_of(side))];
}

/// Whether two sides of one edge belong to faces with the same three vertices.
bool same_vertices(const std::vector<Face>& faces, Side a, Side b) {
  return opposite(faces, a) == opposite(faces, b);
}

/// What most meshes have none of, found in one pass over the edges.
struct Flaws {
  bool duplicates = false;    ///< the two faces at an edge have the same vertices
  bool inconsistent = false;  ///< the two faces at an edge disagree
  bool fans = false;          ///< an edge has three faces or more
};

Flaws find_flaws(const std::vector<Face>& faces, const EdgeTable& edges, int threads) {
  const int pieces = piece_count(threads, edges.edge_count(), kGrain);
  std::vector<Flaws> found(static_cast<std::size_t>(pieces));
  for_pieces(pieces, edges.edge_count(), [&](int piece, std::int64_t begin, std::int64_t end) {
    Flaws flaws;
    for (auto e = static_cast<Index>(begin); e < static_cast<Index>(end); ++e) {
      const auto sides = edges.sides(e);
      if (sides.size() == 2) {
        flaws.duplicates |= same_vertices(faces, sides[0], sides[1]);
        flaws.inconsistent |= !sides_agree(faces, sides[0], sides[1]);
      } else if (sides.size() > 2) {
        flaws.fans = true;
      }
    }
    found[static_cast<std::size_t>(piece)] = flaws;
  });
  Flaws all;
  for (const Flaws& flaws : found) {
    all.duplicates |= flaws.duplicates;
    all.inconsistent |= flaws.inconsistent;
    all.fans |= flaws.fans;
  }
  return all;
}

std::vector<char> find_duplicates(const std::vector<Face>& faces, const EdgeTable& edges) {
  std::vector<char> duplicate(faces.size(), 0);
  for (Index e = 0; e < edges.edge_count(); ++e) {
    const auto sides = edges.sides(e);
    for (std::size_t j = 1; j < sides.size(); ++j) {
      for (std::size_t i = 0; i < j; ++i) {
        if (same_vertices(faces, sides[i], sides[j])) {
          duplicate[std::max(face_of(sides[i]), face_of(sides[j]))] = 1;
          break;
        }
      }
      if (sides.size() > 64 && j > 64) break;  // a fan of hundreds: quadratic work is not worth it
    }
  }
  return duplicate;
}

/// Turns faces so that neighbours agree, walking each patch from its first face. On a surface
/// that cannot be oriented some edges stay in disagreement.
Index orient(std::vector<Face>& faces, const EdgeTable& edges) {
  std::vector<Side> twin(3 * faces.size(), kNoSide);
  for (Index e = 0; e < edges.edge_count(); ++e) {
    const auto sides = edges.sides(e);
    if (sides.size() != 2) continue;
    twin[sides[0]] = sides[1];
    twin[sides[1]] = sides[0];
  }
  std::vector<signed char> turned(faces.size(), -1);
  std::vector<Index> stack;
  for (std::size_t seed = 0; seed < faces.size(); ++seed) {
    if (turned[seed] >= 0) continue;
    turned[seed] = 0;
    stack.push_back(static_cast<Index>(seed));
    while (!stack.empty()) {
      const Index f = stack.back();
      stack.pop_back();
      for (int k = 0; k < 3; ++k) {
        const Side other = twin[3 * f + k];
        if (other == kNoSide || turned[face_of(other)] >= 0) continue;
        const bool disagree = !sides_agree(faces, 3 * f + k, other);
        turned[face_of(other)] = static_cast<signed char>(turned[f] ^ static_cast<int>(disagree));
        stack.push_back(face_of(other));
      }
    }
  }
  Index count = 0;
  for (std::size_t f = 0; f < faces.size(); ++f) {
    if (turned[f] == 1) {
      std::swap(faces[f][1], faces[f][2]);
      ++count;
    }
  }
  return count;
}

/// Takes the faces of the mesh that repeat no corner.
void take_faces(const TriangleMesh& mesh, int threads, CleanFaces& out) {
  const auto count = static_cast<std::int64_t>(mesh.faces().size());
  const int pieces = piece_count(threads, count, kGrain);
  std::vector<std::size_t> before(static_cast<std::size_t>(pieces) + 1, 0);
  const auto is_usable = [&mesh](std::int64_t f) {
    return !repeats_corner(mesh.faces()[static_cast<std::size_t>(f)]);
  };
  for_pieces(pieces, count, [&](int piece, std::int64_t begin, std::int64_t end) {
    std::size_t usable = 0;
    for (std::int64_t f = begin; f < end; ++f) usable += is_usable(f);
    before[static_cast<std::size_t>(piece) + 1] = usable;
  });
  std::partial_sum(before.begin(), before.end(), before.begin());
  out.faces.resize(before.back());
  out.original.resize(before.back());
  for_pieces(pieces, count, [&](int piece, std::int64_t begin, std::int64_t end) {
    std::size_t next = before[static_cast<std::size_t>(piece)];
    for (std::int64_t f = begin; f < end; ++f) {
      if (!is_usable(f)) continue;
      out.faces[next] = mesh.faces()[static_cast<std::size_t>(f)];
      out.original[next++] = static_cast<Index>(f);
    }
  });
  out.repeated_corner = static_cast<Index>(count - static_cast<std::int64_t>(before.back()));
}

void list_edges(Index vertex_count, int threads, CleanFaces& out) {
  out.corners = CornerTable(vertex_count, out.faces, threads);
  out.edges = EdgeTable(out.corners, out.faces, threads);
}

/// Leaves out faces that are there already; false where there are none.
bool drop_duplicates(CleanFaces& out) {
  const std::vector<char> duplicate = find_duplicates(out.faces, out.edges);
  std::size_t kept = 0;
  for (std::size_t f = 0; f < out.faces.size(); ++f) {
    if (duplicate[f]) continue;
    out.faces[kept] = out.faces[f];
    out.original[kept++] = out.original[f];
  }
  out.duplicate = static_cast<Index>(out.faces.size() - kept);
  out.faces.resize(kept);
  out.original.resize(kept);
  return out.duplicate > 0;
}

}  // namespace

CleanFaces clean_faces(const TriangleMesh& mesh, int threads) {
  CleanFaces out;
  take_faces(mesh, threads, out);
  list_edges(mesh.vertex_count(), threads, out);
  Flaws flaws = find_flaws(out.faces, out.edges, threads);
  if ((flaws.duplicates || flaws.fans) && drop_duplicates(out)) {
    list_edges(mesh.vertex_count(), threads, out);
    flaws = find_flaws(out.faces, out.edges, threads);
  }
  if (flaws.inconsistent) {
    out.reoriented = orient(out.faces, out.edges);
    list_edges(mesh.vertex_count(), threads, out);
    flaws = find_flaws(out.faces, out.edges, threads);
    if (flaws.inconsistent) {
      orient_by_shape(mesh.positions(), out.faces, out.edges);
      list_edges(mesh.vertex_count(), threads, out);
    }
  }
  out.oriented_manifold = !flaws.inconsistent && !flaws.fans;
  return out;
}

}  // namespace geotherm
