// SPDX-License-Identifier: MIT
#include "geotherm/mesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <new>
#include <string>
#include <utility>

#include "geotherm/sources.h"
#include "solver/mesh/connectivity.h"

namespace geotherm {
namespace {

/// The most faces of which TriangleMesh can number the corners.
constexpr std::int64_t kMaxSplitFaces = std::numeric_limits<Index>::max() / 3;

struct Arrays {
  std::vector<Vec3> positions;
  std::vector<Face> faces;
};

/// The midpoint of each side, numbered from `first` in the order of the edges; kNoIndex for faces
/// that repeat a corner.
std::vector<Face> add_midpoints(std::vector<Vec3>& positions, const std::vector<Face>& faces) {
  std::vector<Face> whole;
  std::vector<Index> number;
  for (std::size_t f = 0; f < faces.size(); ++f) {
    if (repeats_corner(faces[f])) continue;
    whole.push_back(faces[f]);
    number.push_back(static_cast<Index>(f));
  }
  const auto first = static_cast<Index>(positions.size());
  const EdgeTable edges(first, whole);
  positions.reserve(positions.size() + static_cast<std::size_t>(edges.edge_count()));
  std::vector<Face> middles(faces.size(), Face{kNoIndex, kNoIndex, kNoIndex});
  for (Index e = 0; e < edges.edge_count(); ++e) {
    positions.push_back(0.5 * positions[edges.low(e)] + 0.5 * positions[edges.high(e)]);
    for (const Side side : edges.sides(e)) {
      middles[number[face_of(side)]][corner_of(side)] = first + e;
    }
  }
  return middles;
}

void cut_into_four(Arrays& mesh) {
  const std::vector<Face> middles = add_midpoints(mesh.positions, mesh.faces);
  std::vector<Face> parts;
  parts.reserve(4 * mesh.faces.size());
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    const auto [a, b, c] = mesh.faces[f];
    const auto [ab, bc, ca] = middles[f];
    if (ab == kNoIndex) {
      parts.insert(parts.end(), 4, mesh.faces[f]);
    } else {
      parts.insert(parts.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
    }
  }
  mesh.faces = std::move(parts);
}

/// How often so many faces can be cut into four, and how many faces there are then.
std::pair<int, std::int64_t> most_times(std::int64_t faces) {
  int times = 0;
  for (; 4 * faces <= kMaxSplitFaces; faces *= 4) ++times;
  return {times, faces};
}

Result<void> check(std::int64_t faces, int times) {
  const auto [most, result] = most_times(faces);
  if (times >= 0 && times <= most) return {};
  return Error{ErrorCode::kBadInput,
               "a mesh of " + std::to_string(faces) + " faces cannot be refined " +
                   std::to_string(times) + " times (at most " + std::to_string(kMaxSplitFaces) +
                   " faces can be numbered)",
               {"refine it at most " + std::to_string(most) + " times, to " +
                std::to_string(result) + " faces"}};
}

/// Weights of a point of a face in its part at `corner`, in the middle one where that is 3.
std::array<double, 3> in_part(const std::array<double, 3>& weights, int corner) {
  std::array<double, 3> inner{};
  for (int k = 0; k < 3; ++k) {
    inner[k] = std::max(0.0, corner == 3 ? 1 - 2 * weights[previous_corner(k)]
                                         : 2 * weights[k] - (k == corner ? 1 : 0));
  }
  return inner;
}

}  // namespace

Result<TriangleMesh> subdivide(const TriangleMesh& mesh, int times) try {
  if (auto possible = check(mesh.face_count(), times); !possible) return possible.error();
  Arrays arrays{{mesh.positions().begin(), mesh.positions().end()},
                {mesh.faces().begin(), mesh.faces().end()}};
  for (int i = 0; i < times; ++i) cut_into_four(arrays);
  return TriangleMesh::build(std::move(arrays.positions), std::move(arrays.faces));
} catch (const std::bad_alloc&) {
  return Error{ErrorCode::kOutOfMemory,
               "the memory ended while " + std::to_string(mesh.face_count()) +
                   " faces were refined " + std::to_string(times) +
                   " times, each time to four times as many",
               {"refine less often"}};
}

SurfacePoint subdivided_point(SurfacePoint point, int times) {
  if (point.is_vertex()) return point;
  for (int i = 0; i < times; ++i) {
    const auto corner = std::ranges::find_if(point.weights, [](double x) { return x >= 0.5; }) -
                        point.weights.begin();
    point.face = 4 * point.face + static_cast<Index>(corner);  // 3: the part in the middle
    point.weights = in_part(point.weights, static_cast<int>(corner));
  }
  // The sum of weights may have been off by a rounding error, which every step doubles.
  const double sum = point.weights[0] + point.weights[1] + point.weights[2];
  for (double& w : point.weights) w /= sum;
  return point;
}

std::vector<FaceSegment> subdivided_segment(const FaceSegment& segment, int times) {
  const auto at = [&segment](double share) {
    SurfacePoint point = SurfacePoint::in_face(segment.face, {});
    for (std::size_t k = 0; k < 3; ++k) {
      point.weights[k] = (1 - share) * segment.from[k] + share * segment.to[k];
    }
    return point;
  };
  // Parts end where a weight is a multiple of 1 / 2^times.
  const double parts = std::ldexp(1.0, times);
  std::vector<double> cuts = {0, 1};
  for (std::size_t k = 0; k < 3; ++k) {
    const double from = parts * segment.from[k], to = parts * segment.to[k];
    const double last = std::max(from, to);
    for (double level = std::ceil(std::min(from, to)); from != to && level <= last; ++level) {
      cuts.push_back(std::clamp((level - from) / (to - from), 0.0, 1.0));
    }
  }
  std::ranges::sort(cuts);
  constexpr double kNothing = 1e-12;
  std::vector<FaceSegment> out;
  for (std::size_t i = 1; i < cuts.size(); ++i) {
    const double begin = cuts[i - 1], length = cuts[i] - begin;
    if (length < kNothing) continue;
    // The part is told by the middle; ends lie on its border, where rounding would choose.
    const Index part = subdivided_point(at(begin + length / 2), times).face;
    const auto inside = [&](double share) {
      auto weights = at(share).weights;
      for (int step = times; step-- > 0;) weights = in_part(weights, part >> (2 * step) & 3);
      return weights;
    };
    out.push_back({part, inside(begin), inside(cuts[i]), segment.curve});
  }
  return out;
}

std::vector<Index> subdivided_side(std::span<const Face> faces, Index f, int k, int times) {
  const int parts = 1 << times;
  std::vector<Index> vertices;
  for (int i = 0; i <= parts; ++i) {
    SurfacePoint point = SurfacePoint::in_face(f, {});
    point.weights[next_corner(k)] = static_cast<double>(i) / parts;
    point.weights[k] = 1 - point.weights[next_corner(k)];
    point = subdivided_point(point, times);
    const auto corner = std::ranges::find(point.weights, 1.0) - point.weights.begin();
    vertices.push_back(faces[point.face][static_cast<std::size_t>(corner)]);
  }
  return vertices;
}

}  // namespace geotherm
