// SPDX-License-Identifier: MIT
#include "solver/geometry/intrinsic_refinement.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <queue>

#include "solver/core/parallel.h"
#include "solver/geometry/delaunay.h"
#include "solver/geometry/edit.h"

namespace geotherm {
namespace {

using Point2 = Eigen::Vector2d;
using Weights = std::array<double, 3>;

/// The longest edge over sqrt(t) with which the heat still has a direction on a face; edges longer
/// than that many mean edges do not count for t. Errors grow above (4 % instead of 0.4 % at 4.5 on
/// a scan), and below it vertices are inserted for little: 5 % instead of 2 % of them at 2.1.
constexpr double kLongest = 2.6;
/// The area over t for which a vertex is inserted: sqrt(3) / 2 times a squared edge of 1.83
/// sqrt(t), what circumcentres leave on average.
constexpr double kAreaOfPoint = 2.9;
/// Vertices that may be wanted for the size of faces: a share of those that there are, and on small
/// meshes, where they cost little, so many.
constexpr double kShareOfPoints = 0.25, kFewPoints = 500;
/// Barycentric weights below this put a new vertex on the edge.
constexpr double kOnEdge = 1e-3;
/// Boundary edges opposite an angle with a cotangent above this, that of 96 degrees, do no harm:
/// they are as frequent on good meshes as others.
constexpr double kObtuse = -0.1;
/// Boundary edges shorter than this share of sqrt(t) are left as they are: what is wrong there is
/// wrong within that length.
constexpr double kShortestSplit = 0.02;

double longest_squared(const std::array<double, 3>& l) {
  const double longest = std::max({l[0], l[1], l[2]});
  return longest * longest;
}

double area(const std::array<double, 3>& l) {
  const FaceLayout p = lay_out(l);
  return 0.5 * p.base * p.height;
}

bool is_obtuse_boundary(const IntrinsicMesh& mesh, Side side) {
  if (mesh.twin[side] != kNoSide) return false;
  const auto& lengths = mesh.lengths[face_of(side)];
  return may_be_obtuse(lengths, corner_of(side)) &&
         opposite_cotangent(lengths, corner_of(side)) < kObtuse;
}

/// The ends of edges whose sides are nobody's twins and yet several: with three faces or more, or
/// between two that disagree in orientation. A vertex on one side alone would open a slit.
std::vector<std::pair<Index, Index>> joined_boundary(const IntrinsicMesh& mesh) {
  const std::vector<Side> first = first_sides(mesh);
  std::vector<std::pair<Index, Index>> out;
  for (Side side = 0; side < static_cast<Side>(first.size()); ++side) {
    if (mesh.twin[side] == kNoSide && first[side] != side) out.push_back(ends_of(mesh, side));
  }
  std::ranges::sort(out);
  return out;
}

struct MeanLength {
  double sum = 0, count = 0;
  void add(double length, double share) {
    sum += share * length;
    count += share;
  }
  double value() const { return sum / count; }
};

/// A face by its longest edge squared, and its area.
using FaceSize = std::pair<double, double>;

/// The smallest time from `least` on with which at most so many vertices are wanted by the faces
/// that are too large for it. `faces`: all that are too large for `least`.
double resolved_time(double least, std::vector<FaceSize> faces, double points) {
  const double most_area = kAreaOfPoint * points;  // over t
  std::ranges::sort(faces, std::greater());
  std::vector<double> areas{0};
  for (const auto& [longest, area] : faces) areas.push_back(areas.back() + area);
  // The k largest faces are too large for times between those that make face k and face k - 1 just
  // small enough.
  double t = least;
  for (std::size_t k = faces.size(); k > 0; --k) {
    const double enough = faces[k - 1].first / (kLongest * kLongest);
    const double wanted = areas[k] / most_area;
    if (std::max(t, wanted) < enough) return std::max(t, wanted);
    t = std::max(t, enough);
  }
  return t;
}

std::vector<double> gradings(const IntrinsicMesh& mesh, const Components& parts,
                             std::span<const double> part_edge) {
  const std::size_t count = part_edge.size();
  const auto part_of = [&](Index f) { return parts.of[mesh.faces[f][0]]; };
  std::vector<MeanLength> all(count), ordinary(count);
  for (Index f = 0; f < mesh.face_count(); ++f) {
    const Index part = part_of(f);
    for (int k = 0; k < 3; ++k) {
      const double length = mesh.lengths[f][k];
      const double share = mesh.twin[3 * f + k] == kNoSide ? 1 : 0.5;
      all[part].add(length, share);
      if (length <= kLongest * part_edge[part]) ordinary[part].add(length, share);
    }
  }
  std::vector<double> time(count);
  for (std::size_t c = 0; c < count; ++c) {
    // A part may have no faces here, and none but long edges.
    const bool is_known = ordinary[c].count > 0;
    const double edge = part_edge[c] * (is_known ? ordinary[c].value() / all[c].value() : 1);
    time[c] = edge * edge;
  }
  std::vector<std::vector<FaceSize>> large(count);
  for (Index f = 0; f < mesh.face_count(); ++f) {
    const double longest = longest_squared(mesh.lengths[f]);
    if (longest <= kLongest * kLongest * time[part_of(f)]) continue;
    large[part_of(f)].emplace_back(longest, area(mesh.lengths[f]));
  }
  std::vector<Index> vertices(count, 0);
  for (const Index part : parts.of) {
    if (part != kNoIndex) ++vertices[part];
  }
  const double total = std::accumulate(vertices.begin(), vertices.end(), 0.0);
  for (std::size_t c = 0; c < count; ++c) {
    const double points = std::max(kShareOfPoints, kFewPoints / total) * vertices[c];
    time[c] = resolved_time(time[c], std::move(large[c]), points) / part_edge[c] / part_edge[c];
  }
  return time;
}

/// Where a walk over the triangulation ends: in a face, or at a side of the boundary.
struct Circumcentre {
  Index face = kNoIndex;
  Weights weights{};
  Side boundary = kNoSide;
};

/// Walks straight from the middle of a face to its circumcentre. Neither a face nor a boundary side
/// is returned where rounding has led the walk astray.
Circumcentre find_circumcentre(const IntrinsicMesh& mesh, Index face) {
  constexpr int kMaxSteps = 1000;  // walks within the circumcircle are a few faces long
  const FaceLayout p = lay_out(mesh.lengths[face]);
  std::array<Point2, 3> at = {Point2(0, 0), Point2(p.base, 0), Point2(p.x, p.height)};
  const Point2 target(p.base / 2,
                      (p.x * p.x + p.height * p.height - p.base * p.x) / (2 * p.height));
  const Point2 start = (at[0] + at[1] + at[2]) / 3;
  const Point2 way = target - start;
  int entry = -1;
  for (int step = 0; step < kMaxSteps; ++step) {
    int exit = -1;
    for (int k = 0; k < 3; ++k) {
      const Point2 &a = at[k], &b = at[next_corner(k)];
      const double beyond = -kOnEdge * cross(b - a, at[previous_corner(k)] - a);
      if (k == entry || cross(b - a, target - a) >= beyond) continue;
      exit = k;
      if (cross(way, a - start) <= 0 && cross(way, b - start) >= 0) break;
    }
    if (exit < 0) return {face, clipped_weights(at[0], at[1], at[2], target)};
    const Side side = 3 * face + exit, other = mesh.twin[side];
    if (other == kNoSide || other == side) return {kNoIndex, {}, side};
    const Point2 a = at[exit], b = at[next_corner(exit)];
    face = face_of(other);
    entry = corner_of(other);
    const auto& l = mesh.lengths[face];
    const FaceLayout q = lay_out({l[entry], l[next_corner(entry)], l[previous_corner(entry)]});
    const Point2 along = (a - b) / q.base, across(-along.y(), along.x());
    at[entry] = b;
    at[next_corner(entry)] = a;
    at[previous_corner(entry)] = b + q.x * along + q.height * across;
  }
  return {};
}

class Refiner {
 public:
  Refiner(IntrinsicMesh& mesh, std::vector<Edit>& edits, Components& parts,
          std::span<const double> part_edge, std::span<const Vec3> positions, Index most,
          Refinement& out)
      : mesh_(mesh), edits_(edits), parts_(parts), positions_(positions), most_(most), out_(out) {
    for (std::size_t c = 0; c < part_edge.size(); ++c) {
      root_t_.push_back(part_edge[c] * std::sqrt(out.grading[c]));
    }
  }

  /// Error: kCancelled.
  Result<void> run(const RefinementNeeds& needs, const Progress& progress) {
    constexpr std::int64_t kStepsBetweenCalls = 1 << 12;
    for (Index f = 0; f < mesh_.face_count() && !needs.large.empty(); ++f) note_size(f);
    needs_ = &needs;
    obtuse_ = needs.obtuse;
    std::ranges::reverse(obtuse_);
    for (std::int64_t step = 0;; ++step) {
      if (step % kStepsBetweenCalls == 0 && !report(progress, "operators", 0.0)) {
        return cancelled_error();
      }
      if (!obtuse_.empty()) {
        const Side side = obtuse_.back();
        obtuse_.pop_back();
        if (is_obtuse_boundary(mesh_, side) && !is_short(side) && may_insert()) split_obtuse(side);
      } else if (!large_.empty()) {
        const auto [size, face] = large_.top();
        large_.pop();
        if (rounded(relative_size(face)) != size || !may_insert()) continue;
        const Index before = out_.points;
        split_large(face);
        // A split of the boundary need not reach the face.
        if (out_.points > before && rounded(relative_size(face)) == size)
          large_.emplace(size, face);
      } else {
        return {};
      }
    }
  }

 private:
  double root_t(Index face) const { return root_t_[parts_.of[mesh_.faces[face][0]]]; }
  double relative_size(Index face) const {
    const double root = root_t(face);
    return longest_squared(mesh_.lengths[face]) / (root * root);
  }
  /// Sizes that differ by rounding are one, so that a scaled mesh is refined in the same order.
  static double rounded(double size) { return std::round(size * (1 << 20)); }
  bool is_short(Side side) const {
    return mesh_.lengths[face_of(side)][corner_of(side)] < kShortestSplit * root_t(face_of(side));
  }
  bool may_insert() {
    out_.complete = out_.complete && out_.points < most_;
    return out_.points < most_;
  }

  void note_size(Index face) {
    const double size = relative_size(face);
    if (size > kLongest * kLongest) large_.emplace(rounded(size), face);
  }

  void note(Index face) {
    note_size(face);
    for (Side side = 3 * face; side < 3 * face + 3; ++side) {
      if (is_obtuse_boundary(mesh_, side)) obtuse_.push_back(side);
    }
  }

  /// Splits a boundary edge at the foot of the opposite corner, where both halves lie opposite at
  /// most a right angle; but not close to an end, where that would leave a needle.
  void split_obtuse(Side side) {
    constexpr double kFromEnd = 0.1;
    const auto& l = mesh_.lengths[face_of(side)];
    const int k = corner_of(side);
    const FaceLayout p = lay_out({l[k], l[next_corner(k)], l[previous_corner(k)]});
    insert_on_side(side, std::clamp(p.x / p.base, kFromEnd, 1 - kFromEnd));
  }

  /// Splits a face at its circumcentre, or the boundary edge on the way to that.
  void split_large(Index face) {
    const Circumcentre place = find_circumcentre(mesh_, face);
    if (place.boundary != kNoSide) return insert_on_side(place.boundary, 0.5);
    if (place.face == kNoIndex) return split_longest(face);
    int small = 0, at = 0;
    for (int k = 0; k < 3; ++k) {
      if (place.weights[k] > kOnEdge) continue;
      ++small;
      at = k;
    }
    if (small > 1) return split_longest(face);  // rounding: no vertex lies in a circumcircle
    if (small == 0) return insert_in_face(place.face, place.weights);
    const int k = next_corner(at);
    const double a = place.weights[k], b = place.weights[previous_corner(at)];
    insert_on_side(3 * place.face + k, b / (a + b));
  }

  void split_longest(Index face) {
    const auto& l = mesh_.lengths[face];
    const auto k = std::ranges::max_element(l) - l.begin();
    insert_on_side(3 * face + static_cast<Side>(k), 0.5);
  }

  void insert_on_side(Side side, double share) {
    const Side other = mesh_.twin[side];
    if (other != kNoSide && face_of(other) == face_of(side)) return;  // glued to itself
    const bool boundary = other == kNoSide;
    if (boundary && needs_->is_joined(ends_of(mesh_, side))) return;
    Weights at{};
    at[corner_of(side)] = 1 - share;
    at[next_corner(corner_of(side))] = share;
    const Index vertex = add_vertex(face_of(side), at, boundary);
    out_.boundary_splits += boundary ? 1 : 0;
    const std::size_t before = edits_.size();
    std::vector<Side> around = split_side(mesh_, side, share, vertex, edits_);
    settle(around, before);
  }

  void insert_in_face(Index face, const Weights& weights) {
    const Index vertex = add_vertex(face, weights, false);
    const std::size_t before = edits_.size();
    std::vector<Side> around = split_face(mesh_, face, weights, vertex, edits_);
    settle(around, before);
  }

  Index add_vertex(Index face, const Weights& weights, bool on_boundary) {
    Vec3 position = Vec3::Zero();
    for (int k = 0; k < 3; ++k) position += weights[k] * position_of(mesh_.faces[face][k]);
    out_.positions.push_back(position);
    out_.on_boundary.push_back(on_boundary ? 1 : 0);
    ++out_.points;
    parts_.of.push_back(parts_.of[mesh_.faces[face][0]]);
    return static_cast<Index>(parts_.of.size()) - 1;
  }

  const Vec3& position_of(Index v) const {
    const auto own = static_cast<Index>(positions_.size());
    return v < own ? positions_[v] : out_.positions[v - own];
  }

  /// Makes the triangulation Delaunay again and looks at every face that has changed.
  void settle(std::vector<Side>& queue, std::size_t first_edit) {
    restore_delaunay(mesh_, queue, edits_);
    touched_.clear();
    for (std::size_t e = first_edit; e < edits_.size(); ++e) {
      const Edit& edit = edits_[e];
      touched_.insert(touched_.end(), {edit.f, edit.g});
      if (edit.kind == Edit::Kind::kFaceSplit) touched_.push_back(edit.g + 1);
    }
    std::ranges::sort(touched_);
    touched_.erase(std::unique(touched_.begin(), touched_.end()), touched_.end());
    for (const Index face : touched_) note(face);
  }

  IntrinsicMesh& mesh_;
  std::vector<Edit>& edits_;
  Components& parts_;
  std::span<const Vec3> positions_;
  const Index most_;
  Refinement& out_;
  const RefinementNeeds* needs_ = nullptr;
  std::vector<double> root_t_;                           ///< per part
  std::vector<Side> obtuse_;                             ///< boundary sides, looked at again
  std::priority_queue<std::pair<double, Index>> large_;  ///< faces by size, looked at again
  std::vector<Index> touched_;
};

}  // namespace

RefinementNeeds find_refinement_needs(const IntrinsicMesh& mesh, const Components& parts,
                                      std::span<const double> part_edge, int threads) {
  constexpr std::int64_t kGrain = 1 << 15;  // minimum faces per thread
  const auto list_large = [&](std::int64_t begin, std::int64_t end, std::vector<Index>& list) {
    for (auto f = static_cast<Index>(begin); f < static_cast<Index>(end); ++f) {
      const double edge = parts.count == 1 ? part_edge[0] : part_edge[parts.of[mesh.faces[f][0]]];
      const auto& l = mesh.lengths[f];
      if (std::max({l[0], l[1], l[2]}) > kLongest * edge) list.push_back(f);
    }
  };
  const auto list_obtuse = [&](std::int64_t begin, std::int64_t end, std::vector<Side>& list) {
    for (auto side = static_cast<Side>(begin); side < static_cast<Side>(end); ++side) {
      if (is_obtuse_boundary(mesh, side)) list.push_back(side);
    }
  };
  RefinementNeeds needs{
      list_in_parallel<Index>(threads, std::ssize(mesh.faces), kGrain, list_large),
      list_in_parallel<Side>(threads, std::ssize(mesh.twin), 3 * kGrain, list_obtuse),
      {}};
  if (needs.large.empty() && needs.obtuse.empty()) return needs;
  needs.joined = joined_boundary(mesh);
  std::erase_if(needs.obtuse, [&](Side side) { return needs.is_joined(ends_of(mesh, side)); });
  return needs;
}

Result<Refinement> refine_triangulation(IntrinsicMesh& mesh, std::vector<Edit>& edits,
                                        Components& parts, std::span<const double> part_edge,
                                        std::span<const Vec3> positions, Index most, int threads,
                                        const Progress& progress) {
  const RefinementNeeds needs = find_refinement_needs(mesh, parts, part_edge, threads);
  Refinement out;
  out.large_faces = static_cast<Index>(needs.large.size());
  out.obtuse_boundary = static_cast<Index>(needs.obtuse.size());
  out.grading.assign(part_edge.size(), 1.0);
  if (needs.large.empty() && needs.obtuse.empty()) return out;
  if (!needs.large.empty()) out.grading = gradings(mesh, parts, part_edge);
  Refiner refiner(mesh, edits, parts, part_edge, positions, most, out);
  if (const auto done = refiner.run(needs, progress); !done) return done.error();
  return out;
}

}  // namespace geotherm
