// SPDX-License-Identifier: MIT
#include "solver/geometry/clean_faces.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

#include "solver/core/parallel.h"
#include "solver/core/sorting.h"
#include "solver/mesh/connectivity.h"

namespace geotherm {
namespace {

/// The lexicographic order of positions.
bool less(const Vec3& a, const Vec3& b) {
  return std::lexicographical_compare(a.begin(), a.end(), b.begin(), b.end());
}

/// The sum of the cotangents opposite to an edge of two faces, at 0 and below the less Delaunay; of
/// faces without area that of any sign.
double cotangents_at(std::span<const Vec3> positions, const std::vector<Face>& faces,
                     std::span<const Side> sides) {
  double sum = 0;
  for (const Side side : sides) {
    const Face& face = faces[face_of(side)];
    const int k = corner_of(side);
    const Vec3& apex = positions[face[previous_corner(k)]];
    const Vec3 a = (positions[face[k]] - apex).stableNormalized();
    const Vec3 b = (positions[face[next_corner(k)]] - apex).stableNormalized();
    sum += a.dot(b) / std::max(a.cross(b).norm(), std::numeric_limits<double>::min());
  }
  return sum;
}

/// Disjoint sets of faces that also know, for each face, whether it is turned relative to the root
/// of its set.
class TurnedFaces {
 public:
  explicit TurnedFaces(std::size_t count) : parent_(count), size_(count, 1), turned_(count, 0) {
    std::iota(parent_.begin(), parent_.end(), Index{0});
  }
  bool is_turned(Index f) const {
    char turned = 0;
    for (; parent_[f] != f; f = parent_[f]) turned = static_cast<char>(turned ^ turned_[f]);
    return turned != 0;
  }
  /// The root of the set that the face belongs to.
  Index root(Index f) const {
    while (parent_[f] != f) f = parent_[f];
    return f;
  }
  /// Joins the sets of `a` and `b` so that the two faces agree; does nothing where both are in one
  /// set.
  void join(Index a, Index b, bool disagree) {
    const bool turn = is_turned(a) != is_turned(b);
    const Index root_a = root(a), root_b = root(b);
    if (root_a == root_b) return;
    const bool swapped = size_[root_a] < size_[root_b];  // paths stay short
    const Index above = swapped ? root_b : root_a, below = swapped ? root_a : root_b;
    parent_[below] = above;
    size_[above] += size_[below];
    turned_[below] = static_cast<char>(turn != disagree);
  }

 private:
  std::vector<Index> parent_, size_;
  std::vector<char> turned_;  ///< relative to the parent
};

/// The positions of a face's corners in their cyclic order, the least by coordinates first.
std::array<Vec3, 3> from_least(std::span<const Vec3> positions, const Face& face) {
  std::array<Vec3, 3> out = {positions[face[0]], positions[face[1]], positions[face[2]]};
  std::rotate(out.begin(), std::ranges::min_element(out, less), out.end());
  return out;
}

/// For each set of faces, whether all of it is to be turned: the face whose positions come first
/// keeps the orientation in which they ascend.
std::vector<char> turned_roots(std::span<const Vec3> positions, const std::vector<Face>& faces,
                               const TurnedFaces& turned) {
  using Places = std::array<double, 9>;
  std::vector<Places> least(faces.size());
  std::vector<char> found(faces.size(), 0), out(faces.size(), 0);
  for (std::size_t f = 0; f < faces.size(); ++f) {
    auto [a, b, c] = from_least(positions, faces[f]);
    const bool descends = less(c, b);
    if (descends) std::swap(b, c);
    const Places places = {a[0], a[1], a[2], b[0], b[1], b[2], c[0], c[1], c[2]};
    const auto root = static_cast<std::size_t>(turned.root(static_cast<Index>(f)));
    if (found[root] != 0 && !(places < least[root])) continue;
    found[root] = 1;
    least[root] = places;
    out[root] = static_cast<char>(descends != turned.is_turned(static_cast<Index>(f)));
  }
  return out;
}

/// The rank by which edges are made to agree, from the shape alone: first the cotangents, rounded
/// so that those of a regular mesh are equal, then the position.
using Rank = std::array<double, 7>;
Rank rank_of(std::span<const Vec3> positions, const std::vector<Face>& faces,
             const EdgeTable& edges, Index e) {
  constexpr double kSteps = 1e6;
  Vec3 a = positions[edges.low(e)], b = positions[edges.high(e)];
  if (less(b, a)) std::swap(a, b);
  return {std::round(kSteps * cotangents_at(positions, faces, edges.sides(e))),
          a[0],
          a[1],
          a[2],
          b[0],
          b[1],
          b[2]};
}

/// Turns faces round so that neighbours agree where they can, on surfaces with one side, too, where
/// some edges stay in disagreement and stop flips. Edges that flips need most agree first (a
/// maximum spanning tree of the faces, Kruskal 1956, by the opposite cotangents): what is flipped,
/// and the turn of the whole, then follow from the shape and not from the numbering. `edges`: of
/// `faces`, whose sides it names; it is out of date afterwards. Cost: O(F log F).
void orient_by_shape(std::span<const Vec3> positions, std::vector<Face>& faces,
                     const EdgeTable& edges) {
  std::vector<std::pair<Rank, Index>> order;
  for (Index e = 0; e < edges.edge_count(); ++e) {
    if (edges.sides(e).size() == 2) order.emplace_back(rank_of(positions, faces, edges, e), e);
  }
  std::ranges::sort(order);
  TurnedFaces turned(faces.size());
  for (const auto& [rank, e] : order) {
    const auto sides = edges.sides(e);
    turned.join(face_of(sides[0]), face_of(sides[1]), !sides_agree(faces, sides[0], sides[1]));
  }
  const std::vector<char> whole = turned_roots(positions, faces, turned);
  for (std::size_t f = 0; f < faces.size(); ++f) {
    const auto here = static_cast<Index>(f);
    const bool with_all = whole[static_cast<std::size_t>(turned.root(here))] != 0;
    if (turned.is_turned(here) != with_all) std::swap(faces[f][1], faces[f][2]);
  }
}

/// Minimum edges or faces per thread.
constexpr std::int64_t kMinCleanedPerThread = 1 << 14;

/// The corner of a side's face that is none of its ends.
Index opposite(const std::vector<Face>& faces, Side side) {
  return faces[face_of(side)][previous_corner(corner_of(side))];
}

/// Whether two sides of one edge belong to faces with the same three vertices.
bool same_vertices(const std::vector<Face>& faces, Side a, Side b) {
  return opposite(faces, a) == opposite(faces, b);
}

/// Defects that most meshes do not have, found in one pass over the edges.
struct Flaws {
  bool duplicates = false;    ///< the two faces at an edge have the same vertices
  bool inconsistent = false;  ///< the two faces at an edge disagree
  bool fans = false;          ///< an edge has three faces or more
};

Flaws find_flaws(const std::vector<Face>& faces, const EdgeTable& edges, int threads) {
  const int pieces = piece_count(threads, edges.edge_count(), kMinCleanedPerThread);
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
      if (sides.size() > 64 && j > 64) break;  // bounds the work of fans with hundreds of faces
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

/// Copies the faces of the mesh that repeat no corner.
void take_faces(const TriangleMesh& mesh, int threads, CleanFaces& out) {
  const auto count = static_cast<std::int64_t>(mesh.faces().size());
  const int pieces = piece_count(threads, count, kMinCleanedPerThread);
  std::vector<std::size_t> before(static_cast<std::size_t>(pieces) + 1, 0);
  std::vector<Index> one_vertex(static_cast<std::size_t>(pieces), 0);
  const auto is_usable = [&mesh](std::int64_t f) {
    return !repeats_corner(mesh.faces()[static_cast<std::size_t>(f)]);
  };
  for_pieces(pieces, count, [&](int piece, std::int64_t begin, std::int64_t end) {
    std::size_t usable = 0;
    for (std::int64_t f = begin; f < end; ++f) {
      usable += is_usable(f);
      one_vertex[static_cast<std::size_t>(piece)] +=
          is_one_vertex(mesh.faces()[static_cast<std::size_t>(f)]) ? 1 : 0;
    }
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
  out.one_vertex = std::accumulate(one_vertex.begin(), one_vertex.end(), Index{0});
}

void list_edges(Index vertex_count, int threads, CleanFaces& out) {
  out.corners = CornerTable(vertex_count, out.faces, threads);
  out.edges = EdgeTable(out.corners, out.faces, threads);
}

/// Drops faces that repeat an earlier one; false where there are none.
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
      out.turned_by_shape = true;
      list_edges(mesh.vertex_count(), threads, out);
    }
  }
  out.oriented_manifold = !flaws.inconsistent && !flaws.fans;
  return out;
}

FaceComponents face_components(std::span<const Face> faces, Index vertex_count) {
  DisjointSets sets(static_cast<std::size_t>(vertex_count));
  for (const Face& face : faces) {
    sets.join(face[0], face[1]);
    sets.join(face[1], face[2]);
  }
  FaceComponents out;
  out.of.reserve(faces.size());
  std::vector<Index> number(static_cast<std::size_t>(vertex_count), kNoIndex);
  for (const Face& face : faces) {
    Index& component = number[sets.root(face[0])];
    if (component == kNoIndex) component = out.count++;
    out.of.push_back(component);
  }
  return out;
}

}  // namespace geotherm
