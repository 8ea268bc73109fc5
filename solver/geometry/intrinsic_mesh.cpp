// SPDX-License-Identifier: MIT
#include "solver/geometry/intrinsic_mesh.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "solver/core/parallel.h"
#include "solver/geometry/clean_faces.h"

namespace geotherm {
namespace {

using Lengths = std::array<double, 3>;

/// Relative to the longest side of the face: faces of any size keep their shape unless that is
/// degenerate.
constexpr double kStrict = 1e-5;
/// What is lengthened gets a tenth more, so that corrections which call for each other come to an
/// end.
constexpr double kAim = 1.1;
/// Faces below this size, in mean edges, are points: their areas would leave the doubles' range.
constexpr double kPointLength = 1e-70;
/// Rounds at most: ordinary files take three.
constexpr int kMaxRounds = 100;

/// The length by which the triangle inequality over side k fails to be strict; at most 0 where it
/// is strict enough. Points become faces that are well shaped and small.
double missing(const Lengths& l, int k, Strictness strictness, double aim = 1) {
  const double longest = std::max({l[0], l[1], l[2]});
  const double a = l[next_corner(k)], b = l[previous_corner(k)];
  const bool is_point = !(longest > kPointLength);
  const double least = aim * kStrict * (is_point ? 1.0 : longest);
  const double lack = least + l[k] - a - b;
  if (is_point || strictness == Strictness::kInequalities || !(lack > 0)) return lack;
  // Twice the area is L h; of Heron's factors a + b - L is L h^2 / (2 a b) where it is small.
  return least * std::min(1.0, kStrict / 2 * (longest / a) * (longest / b)) + l[k] - a - b;
}

/// The smallest length that makes a face strict when added to all three sides.
double addition(const Lengths& l, Strictness strictness) {
  const double most =
      std::max({missing(l, 0, strictness), missing(l, 1, strictness), missing(l, 2, strictness)});
  return std::max(0.0, most / (1 - kStrict));  // the longest side grows as well
}

std::vector<Index> faces_that_fail(const std::vector<Lengths>& lengths, Strictness strictness,
                                   int threads) {
  constexpr std::int64_t kGrain = 1 << 15;  // minimum faces per thread
  const auto list = [&](std::int64_t begin, std::int64_t end, std::vector<Index>& found) {
    for (auto f = static_cast<Index>(begin); f < static_cast<Index>(end); ++f) {
      if (addition(lengths[f], strictness) > 0) found.push_back(f);
    }
  };
  return list_in_parallel<Index>(threads, std::ssize(lengths), kGrain, list);
}

/// Lengthens the edges of failing faces, then those of neighbours that fail because of it.
class LocalRepair {
 public:
  /// `first`: first_sides() of the mesh.
  LocalRepair(std::vector<Lengths>& lengths, const std::vector<Side>& first, Strictness strictness)
      : lengths_(lengths),
        first_(first),
        strictness_(strictness),
        next_(first.size()),
        wanted_(first.size(), 0.0) {
    std::iota(next_.begin(), next_.end(), 0);
    for (Side side = 0; side < static_cast<Side>(first.size()); ++side) {
      if (first[side] != side) next_[side] = std::exchange(next_[first[side]], side);
    }
  }

  /// In rounds, each of which sees the lengths that the one before has left: the order of faces
  /// does not matter. False where the work does not end.
  bool run(std::vector<Index> active) {
    for (int round = 0; round < kMaxRounds; ++round) {
      std::vector<Side> called;
      for (const Index f : active) ask_for(f, called);
      if (called.empty()) return true;
      active.clear();
      for (const Side first : called) {
        Side side = first;
        do {
          lengths_[face_of(side)][corner_of(side)] += wanted_[first];
          active.push_back(face_of(side));
          side = next_[side];
        } while (side != first);
        wanted_[first] = 0;
      }
      std::ranges::sort(active);
      active.erase(std::unique(active.begin(), active.end()), active.end());
    }
    return false;
  }

 private:
  /// Computes the lengths that a failing face needs, and adds the first sides of its edges to
  /// `called`.
  void ask_for(Index f, std::vector<Side>& called) {
    if (!(addition(lengths_[f], strictness_) > 0)) return;
    for (int k = 0; k < 3; ++k) {
      const double lack = missing(lengths_[f], k, strictness_, kAim);
      if (!(lack > 0)) continue;
      // The shorter of the two takes the more: a needle keeps its long sides as they are.
      const int i = next_corner(k), j = previous_corner(k);
      const double a = lengths_[f][i], b = lengths_[f][j];
      const double share = a + b > 0 ? b / (a + b) : 0.5;
      want(first_[3 * f + i], share * lack, called);
      want(first_[3 * f + j], (1 - share) * lack, called);
    }
  }

  /// An edge gets the largest length that any of its faces needs.
  void want(Side first, double by, std::vector<Side>& called) {
    if (!(by > 0)) return;
    if (wanted_[first] == 0) called.push_back(first);
    wanted_[first] = std::max(wanted_[first], by);
  }

  std::vector<Lengths>& lengths_;
  const std::vector<Side>& first_;
  Strictness strictness_;
  std::vector<Side> next_;      // of each side that of the same edge, the first after the last
  std::vector<double> wanted_;  // of each edge in this round, at its first side
};

void add_to_components(std::vector<Lengths>& lengths, const FaceComponents& components,
                       Strictness strictness) {
  std::vector<double> needed(static_cast<std::size_t>(components.count), 0.0);
  for (std::size_t f = 0; f < lengths.size(); ++f) {
    double& most = needed[components.of[f]];
    most = std::max(most, addition(lengths[f], strictness));
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

std::vector<Side> first_sides(const IntrinsicMesh& mesh) {
  std::vector<Side> first(mesh.twin.size()), alone;
  for (Side side = 0; side < static_cast<Side>(mesh.twin.size()); ++side) {
    const Side twin = mesh.twin[side];
    first[side] = twin == kNoSide ? side : std::min(side, twin);
    if (twin == kNoSide || twin == side) alone.push_back(side);
  }
  std::ranges::sort(alone, [&](Side a, Side b) {
    const auto pair_a = ends_of(mesh, a), pair_b = ends_of(mesh, b);
    return pair_a != pair_b ? pair_a < pair_b : a < b;
  });
  for (std::size_t i = 1; i < alone.size(); ++i) {
    if (ends_of(mesh, alone[i]) == ends_of(mesh, alone[i - 1]))
      first[alone[i]] = first[alone[i - 1]];
  }
  return first;
}

Index mollify(IntrinsicMesh& mesh, Strictness strictness, int threads) {
  std::vector<Lengths>& lengths = mesh.lengths;
  const std::vector<Index> failing = faces_that_fail(lengths, strictness, threads);
  if (failing.empty()) return 0;
  Index vertices = 0;
  for (const Face& face : mesh.faces) {
    vertices = std::max({vertices, face[0] + 1, face[1] + 1, face[2] + 1});
  }
  const std::vector<Lengths> before = lengths;
  const FaceComponents components = face_components(mesh.faces, vertices);
  const std::vector<Side> first = first_sides(mesh);
  if (!LocalRepair(lengths, first, strictness).run(failing)) {
    lengths = before;
    add_to_components(lengths, components, strictness);
  }
  const auto fronts = static_cast<Index>(mesh.back.empty() ? mesh.faces.size() : mesh.back.size());
  Mollification added;
  std::vector<char> touched(static_cast<std::size_t>(components.count), 0);
  for (Side side = 0; side < 3 * fronts; ++side) {
    const double by =
        lengths[face_of(side)][corner_of(side)] - before[face_of(side)][corner_of(side)];
    if (first[side] != side || !(by > 0)) continue;
    ++added.edges;
    added.most = std::max(added.most, by);
    touched[components.of[face_of(side)]] = 1;
  }
  // What is lengthened again counts once.
  Mollification& all = mesh.mollified;
  all.most += added.most;
  all.faces = std::max(all.faces, static_cast<Index>(std::ranges::count_if(
                                      failing, [=](Index f) { return f < fronts; })));
  all.edges = std::max(all.edges, added.edges);
  all.components = std::max(all.components, static_cast<Index>(std::ranges::count(touched, 1)));
  return static_cast<Index>(failing.size());
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
                                   double unit, int threads, Strictness strictness) {
  IntrinsicMesh mesh;
  mesh.unit = unit;
  mesh.faces = clean.faces;
  mesh.lengths.resize(mesh.faces.size());
  mesh.twin.resize(3 * mesh.faces.size());
  const EdgeTable& edges = clean.edges;
  parallel_each<Index>(threads, edges.edge_count(), kMinEdgesPerThread, [&](Index e) {
    // One value for all sides of an edge: they must agree to the last bit.
    const double length = ((positions[edges.low(e)] - positions[edges.high(e)]) / unit).norm();
    const auto sides = edges.sides(e);
    const bool twins = sides.size() == 2 && sides_agree(mesh.faces, sides[0], sides[1]);
    for (std::size_t i = 0; i < sides.size(); ++i) {
      mesh.lengths[face_of(sides[i])][corner_of(sides[i])] = length;
      mesh.twin[sides[i]] = twins ? sides[1 - i] : kNoSide;
    }
  });
  mollify(mesh, strictness, threads);
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
