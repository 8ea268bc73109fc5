// SPDX-License-Identifier: MIT
#include "solver/polyhedral/march_supports.h"

#include <optional>

#include "solver/core/sorting.h"

namespace geotherm {
namespace {

using Point2 = Eigen::Vector2d;

/// Cosines this near to 0 are right angles, which rounding must not make obtuse in one place and
/// acute in another: grids are full of them.
constexpr double kRightAngle = 1e-6;
/// The maximum number of faces that are unfolded at one corner; on a Delaunay triangulation a few
/// suffice.
constexpr int kMaxUnfolded = 50;

/// The corner beyond side `k` of a face, on the left of the way from `start` to `end`, where the
/// side lies.
Point2 beyond(const Point2& start, const Point2& end, const std::array<double, 3>& lengths, int k) {
  const FaceLayout layout =
      lay_out({lengths[k], lengths[next_corner(k)], lengths[previous_corner(k)]});
  const Point2 along = (end - start) / layout.base;
  return start + layout.x * along + layout.height * Point2(-along.y(), along.x());
}

/// A vertex that splits the angle at a corner, and where it is when the corner is the origin and
/// the next one (first, 0).
struct Splitter {
  Index vertex;
  Point2 at;
};

bool is_acute(const Point2& a, const Point2& b) {
  return a.dot(b) > -kRightAngle * a.norm() * b.norm();
}

std::optional<Splitter> find_splitter(const IntrinsicMesh& mesh, Side opposite, const Point2& first,
                                      const Point2& second) {
  Point2 p = first, q = second;
  Side side = opposite;
  for (int i = 0; i < kMaxUnfolded; ++i) {
    const Side twin = mesh.twin[side];
    if (twin == kNoSide) return std::nullopt;
    const Index f = face_of(twin);
    const int k = corner_of(twin);
    const Point2 apex = beyond(q, p, mesh.lengths[f], k);
    const bool near_first = is_acute(apex, first), near_second = is_acute(apex, second);
    if (near_first && near_second) return Splitter{mesh.faces[f][previous_corner(k)], apex};
    if (near_second) {
      side = 3 * f + next_corner(k);
      q = apex;
    } else {
      side = 3 * f + previous_corner(k);
      p = apex;
    }
  }
  return std::nullopt;
}

MarchSupport support(Index target, Index left, const Point2& at_left, Index right,
                     const Point2& at_right) {
  const Point2 side = at_right - at_left;
  const double base = side.norm();
  const Point2 along = side / base;
  return {target,
          left,
          right,
          base,
          -at_left.dot(along),
          at_left.x() * along.y() - at_left.y() * along.x()};
}

/// The supports of corner k of a face, whose plane has the corner as its origin.
void add_corner(const IntrinsicMesh& mesh, Index f, int k, std::vector<MarchSupport>& out) {
  const auto& lengths = mesh.lengths[f];
  const int next = next_corner(k), previous = previous_corner(k);
  const FaceLayout layout = lay_out({lengths[k], lengths[next], lengths[previous]});
  const Point2 first(layout.base, 0), second(layout.x, layout.height);
  const Index target = mesh.faces[f][k];
  const Index left = mesh.faces[f][next], right = mesh.faces[f][previous];
  if (!is_acute(first, second)) {
    if (const auto splitter = find_splitter(mesh, 3 * f + next, first, second)) {
      out.push_back(support(target, left, first, splitter->vertex, splitter->at));
      out.push_back(support(target, splitter->vertex, splitter->at, right, second));
      return;
    }
  }
  out.push_back(support(target, left, first, right, second));
}

}  // namespace

std::size_t MarchSupports::bytes() const {
  return all.capacity() * sizeof(MarchSupport) + start.capacity() * sizeof(std::uint32_t) +
         at.capacity() * sizeof(Index);
}

MarchSupports build_march_supports(const WaveSurface& surface) {
  const IntrinsicMesh& mesh = surface.base.intrinsic;
  MarchSupports out;
  out.all.reserve(3 * mesh.faces.size());
  for (Index f = 0; f < mesh.face_count(); ++f) {
    for (int k = 0; k < 3; ++k) add_corner(mesh, f, k, out.all);
  }
  const auto emit = [&out](std::size_t i, const auto& put) {
    for (const Index end : {out.all[i].left, out.all[i].right}) put(end, static_cast<Index>(i));
  };
  out.at = counting_sort<Index>(out.all.size(), surface.base.kept->on_surface.size(), 1, emit,
                                out.start);
  return out;
}

}  // namespace geotherm
