// SPDX-License-Identifier: MIT
#include "solver/geometry/intrinsic_mesh.h"

#include <algorithm>
#include <cmath>

#include "solver/core/parallel.h"
#include "solver/geometry/clean_faces.h"

namespace geotherm {
namespace {

using Lengths = std::array<double, 3>;

/// By how much each triangle inequality must be strict, relative to the longest side of the face:
/// faces of any size keep their shape unless that is degenerate.
constexpr double kStrict = 1e-5;
/// What is lengthened gets a tenth more, so that corrections which call for each other come to an
/// end.
constexpr double kAim = 1.1 * kStrict;
/// Faces below this size, in mean edges, are points: their areas would leave the doubles' range.
constexpr double kPointLength = 1e-70;
/// Rounds at most: ordinary files take three.
constexpr int kMaxFlipRounds = 100;

/// The length by which the triangle inequality over side k fails to be strict; at most 0 where it
/// is strict enough.
double missing(const Lengths& l, int k, double strict) {
  const double longest = std::max({l[0], l[1], l[2]});
  const double size = longest > kPointLength ? longest : 1.0;
  return strict * size + l[k] - l[next_corner(k)] - l[previous_corner(k)];
}

/// The smallest length that makes a face strict when added to all three sides.
double addition(const Lengths& l) {
  const double most =
      std::max({missing(l, 0, kStrict), missing(l, 1, kStrict), missing(l, 2, kStrict)});
  return std::max(0.0, most / (1 - kStrict));  // the longest side grows as well
}

std::vector<Index> faces_that_fail(const std::vector<Lengths>& lengths, int threads) {
  constexpr std::int64_t kGrain = 1 << 15;  // minimum faces per thread
  const auto count = static_cast<std::int64_t>(lengths.size());
  const int pieces = piece_count(threads, count, kGrain);
  std::vector<std::vector<Index>> found(static_cast<std::size_t>(pieces));
  for_pieces(pieces, count, [&](int piece, std::int64_t begin, std::int64_t end) {
    for (std::int64_t f = begin; f < end; ++f) {
      if (addition(lengths[static_cast<std::size_t>(f)]) > 0) {
        found[static_cast<std::size_t>(piece)].push_back(static_cast<Index>(f));
      }
    }
  });
  std::vector<Index> out = std::move(found.front());
  for (std::size_t p = 1; p < found.size(); ++p) {
    out.insert(out.end(), found[p].begin(), found[p].end());
  }
  return out;
}

/// Lengthens the edges of failing faces, then those of neighbours that fail because of it.
class LocalRepair {
 public:
  LocalRepair(std::vector<Lengths>& lengths, const EdgeTable& edges)
      : lengths_(lengths),
        edges_(edges),
        edge_of_(3 * lengths.size()),
        wanted_(static_cast<std::size_t>(edges.edge_count()), 0.0) {
    for (Index e = 0; e < edges.edge_count(); ++e) {
      for (const Side side : edges.sides(e)) edge_of_[side] = e;
    }
  }

  /// In rounds, each of which sees the lengths that the one before has left: the order of faces
  /// does not matter. False where the work does not end.
  bool run(std::vector<Index> active) {
    for (int round = 0; round < kMaxFlipRounds; ++round) {
      std::vector<Index> called;
      for (const Index f : active) ask_for(f, called);
      if (called.empty()) return true;
      active.clear();
      for (const Index e : called) {
        for (const Side side : edges_.sides(e)) {
          lengths_[face_of(side)][corner_of(side)] += wanted_[e];
          active.push_back(face_of(side));
        }
        wanted_[e] = 0;
      }
      std::ranges::sort(active);
      active.erase(std::unique(active.begin(), active.end()), active.end());
    }
    return false;
  }

 private:
  /// Computes the lengths that a failing face needs, and adds its edges to `called`.
  void ask_for(Index f, std::vector<Index>& called) {
    if (!(addition(lengths_[f]) > 0)) return;
    for (int k = 0; k < 3; ++k) {
      const double lack = missing(lengths_[f], k, kAim);
      if (!(lack > 0)) continue;
      // The shorter of the two takes the more: a needle keeps its long sides as they are.
      const int i = next_corner(k), j = previous_corner(k);
      const double a = lengths_[f][i], b = lengths_[f][j];
      const double share = a + b > 0 ? b / (a + b) : 0.5;
      want(edge_of_[3 * f + i], share * lack, called);
      want(edge_of_[3 * f + j], (1 - share) * lack, called);
    }
  }

  /// An edge gets the largest length that any of its faces needs.
  void want(Index edge, double by, std::vector<Index>& called) {
    if (!(by > 0)) return;
    if (wanted_[edge] == 0) called.push_back(edge);
    wanted_[edge] = std::max(wanted_[edge], by);
  }

  std::vector<Lengths>& lengths_;
  const EdgeTable& edges_;
  std::vector<Index> edge_of_;
  std::vector<double> wanted_;  // of each edge in this round
};

void add_to_components(std::vector<Lengths>& lengths, const FaceComponents& components) {
  std::vector<double> needed(static_cast<std::size_t>(components.count), 0.0);
  for (std::size_t f = 0; f < lengths.size(); ++f) {
    double& most = needed[components.of[f]];
    most = std::max(most, addition(lengths[f]));
  }
  for (std::size_t f = 0; f < lengths.size(); ++f) {
    for (double& length : lengths[f]) length += needed[components.of[f]];
  }
}

/// Minimum edges per thread.
constexpr std::int64_t kMinEdgesPerThread = 1 << 14;

/// Puts the larger first, without a branch: of two sides either is the longer as often.
void put_in_order(double& a, double& b) {
  const double larger = std::max(a, b);
  b = std::min(a, b);
  a = larger;
}

/// Four times the area by Kahan's formula, which stays accurate for needles: a >= b >= c.
double four_areas(double a, double b, double c) {
  put_in_order(a, b);
  put_in_order(b, c);
  put_in_order(a, b);
  const double product = (a + (b + c)) * (c - (a - b)) * (c + (a - b)) * (a + (b - c));
  return std::sqrt(std::max(product, 0.0));
}

}  // namespace

Mollification mollify(std::vector<Lengths>& lengths, const CleanFaces& clean, int threads) {
  Mollification out;
  const std::vector<Index> failing = faces_that_fail(lengths, threads);
  if (failing.empty()) return out;
  Index vertices = 0;
  for (const Face& face : clean.faces) {
    vertices = std::max({vertices, face[0] + 1, face[1] + 1, face[2] + 1});
  }
  const std::vector<Lengths> before = lengths;
  const FaceComponents components = face_components(clean.faces, vertices);
  if (!LocalRepair(lengths, clean.edges).run(failing)) {
    lengths = before;
    add_to_components(lengths, components);
  }
  std::vector<char> touched(static_cast<std::size_t>(components.count), 0);
  for (Index e = 0; e < clean.edges.edge_count(); ++e) {
    const Side side = clean.edges.sides(e).front();
    const double added =
        lengths[face_of(side)][corner_of(side)] - before[face_of(side)][corner_of(side)];
    if (!(added > 0)) continue;
    ++out.edges;
    out.most = std::max(out.most, added);
    touched[components.of[face_of(side)]] = 1;
  }
  out.faces = static_cast<Index>(failing.size());
  out.components = static_cast<Index>(std::count(touched.begin(), touched.end(), 1));
  return out;
}

double mean_edge_length(std::span<const Vec3> positions, const EdgeTable& edges, int threads) {
  const Index count = edges.edge_count();
  const double sum = parallel_sum(threads, count, [&](std::int64_t begin, std::int64_t end) {
    double part = 0;
    for (auto e = static_cast<Index>(begin); e < static_cast<Index>(end); ++e) {
      part += safe_norm(positions[edges.low(e)] - positions[edges.high(e)]);
    }
    return part;
  });
  return count > 0 ? sum / count : 0.0;
}

IntrinsicMesh build_intrinsic_mesh(std::span<const Vec3> positions, const CleanFaces& clean,
                                   double unit, int threads) {
  IntrinsicMesh mesh;
  mesh.unit = unit;
  mesh.faces = clean.faces;
  mesh.lengths.resize(mesh.faces.size());
  mesh.twin.resize(3 * mesh.faces.size());
  const EdgeTable& edges = clean.edges;
  parallel_for(
      threads, edges.edge_count(), kMinEdgesPerThread, [&](std::int64_t begin, std::int64_t end) {
        for (auto e = static_cast<Index>(begin); e < static_cast<Index>(end); ++e) {
          // One value for all sides of an edge: they must agree to the last bit.
          const double length =
              ((positions[edges.low(e)] - positions[edges.high(e)]) / unit).norm();
          const auto sides = edges.sides(e);
          const bool twins = sides.size() == 2 && sides_agree(mesh.faces, sides[0], sides[1]);
          for (std::size_t i = 0; i < sides.size(); ++i) {
            mesh.lengths[face_of(sides[i])][corner_of(sides[i])] = length;
            mesh.twin[sides[i]] = twins ? sides[1 - i] : kNoSide;
          }
        }
      });
  mesh.mollified = mollify(mesh.lengths, clean, threads);
  return mesh;
}

FaceLayout lay_out(const std::array<double, 3>& l) {
  const double base = l[0];
  const double x = (base * base + (l[2] - l[1]) * (l[2] + l[1])) / (2 * base);
  return {base, x, four_areas(l[0], l[1], l[2]) / (2 * base)};
}

double opposite_cotangent(const std::array<double, 3>& l, int side) {
  const double a = l[side];
  const double b = l[next_corner(side)];
  const double c = l[previous_corner(side)];
  return (b * b + (c - a) * (c + a)) / four_areas(a, b, c);
}

}  // namespace geotherm
