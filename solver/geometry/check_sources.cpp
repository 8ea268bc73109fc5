// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <utility>

#include "solver/core/text.h"
#include "solver/geometry/intrinsic_surface.h"

namespace geotherm {
namespace {

/// Weights are accepted when they sum to 1 within this: what nine typed digits give.
constexpr double kWeightSum = 1e-6;

/// First edge that is not before (low, high), in the order of the table.
Index first_edge_from(const EdgeTable& edges, Index low, Index high) {
  Index first = 0, count = edges.edge_count();
  while (count > 0) {
    const Index half = count / 2, middle = first + half;
    if (std::pair(edges.low(middle), edges.high(middle)) < std::pair(low, high)) {
      first += half + 1;
      count -= half + 1;
    } else {
      count = half;
    }
  }
  return first;
}

/// Weights that sum to 1, and the corner that they are within kAtCorner of, -1 where there is none.
struct CleanWeights {
  std::array<double, 3> weights;
  int corner = -1;
};

/// Without what is below 0. Precondition: they nearly sum to 1.
CleanWeights clean_weights(std::array<double, 3> weights) {
  double sum = 0;
  for (double& w : weights) {
    w = std::max(w, 0.0);
    sum += w;
  }
  CleanWeights out{weights};
  for (std::size_t k = 0; k < 3; ++k) {
    out.weights[k] /= sum;
    if (out.weights[k] >= 1 - kAtCorner) out.corner = static_cast<int>(k);
  }
  return out;
}

Result<void> check_vertex(const IntrinsicSurface& surface, Index v) {
  if (v < 0 || v >= surface.mesh->vertex_count()) {
    return Error{ErrorCode::kBadInput,
                 "source vertex " + std::to_string(v) + " does not exist",
                 {"vertices are 0 to " + std::to_string(surface.mesh->vertex_count() - 1)}};
  }
  if (!surface.kept->on_surface[v] && std::ranges::any_of(surface.mesh->faces(), is_one_vertex)) {
    return Error{ErrorCode::kBadInput,
                 "source vertex " + std::to_string(v) + " is masked out, or belongs to no face",
                 {"choose one that the mask leaves"}};
  }
  if (!surface.kept->on_surface[v]) {
    return Error{ErrorCode::kBadInput,
                 "source vertex " + std::to_string(v) + " belongs to no face",
                 {"choose one on the surface"}};
  }
  return {};
}

/// The number in kept->faces of a face of the mesh or, where it is a duplicate, of its twin;
/// kNoIndex where it repeats a corner.
Index clean_face_of(const IntrinsicSurface& surface, Index f) {
  const Index clean = surface.kept->of_face[f];
  if (clean != kNoIndex) return clean;
  const Face& face = surface.mesh->faces()[f];
  const Index edge = find_clean_edge(surface, face[0], face[1]);
  if (edge == kNoIndex) return kNoIndex;
  for (const Side side : surface.kept->edges.sides(edge)) {
    if (std::ranges::is_permutation(surface.kept->faces[face_of(side)], face)) return face_of(side);
  }
  return kNoIndex;
}

Result<void> check_in_face(const IntrinsicSurface& surface, const SurfacePoint& point) {
  const Index count = surface.mesh->face_count();
  if (point.face < 0 || point.face >= count) {
    return Error{ErrorCode::kBadInput,
                 "source face " + std::to_string(point.face) + " does not exist",
                 {"faces are 0 to " + std::to_string(count - 1)}};
  }
  double sum = 0;
  bool valid = true;
  for (const double w : point.weights) {
    valid = valid && std::isfinite(w) && w >= -kWeightSum;
    sum += w;
  }
  if (!valid || std::abs(sum - 1) > kWeightSum) {
    return Error{ErrorCode::kBadInput,
                 "the weights of the source in face " + std::to_string(point.face) + " sum to " +
                     number_text(sum),
                 {"barycentric weights are not negative and sum to 1"}};
  }
  if (clean_face_of(surface, point.face) == kNoIndex) {
    const int corner = clean_weights(point.weights).corner;
    if (corner >= 0) return check_vertex(surface, surface.mesh->faces()[point.face][corner]);
    return Error{
        ErrorCode::kBadInput,
        "source face " + std::to_string(point.face) + " repeats a corner and has no inside",
        {"choose another"}};
  }
  return {};
}

Result<void> check_segment(const IntrinsicSurface& surface, const FaceSegment& segment) {
  for (const auto& weights : {segment.from, segment.to}) {
    const auto valid = check_in_face(surface, SurfacePoint::in_face(segment.face, weights));
    if (!valid) return valid;
  }
  if (clean_face_of(surface, segment.face) != kNoIndex) return {};
  return Error{ErrorCode::kBadInput,
               "the source curve crosses face " + std::to_string(segment.face) +
                   ", which repeats a corner and has no inside",
               {"lead it through others"}};
}

Result<void> check_edge(const IntrinsicSurface& surface, const std::array<Index, 2>& edge) {
  for (const Index v : edge) {
    if (auto valid = check_vertex(surface, v); !valid) return valid;
  }
  if (edge[0] == edge[1] || find_clean_edge(surface, edge[0], edge[1]) != kNoIndex) return {};
  return Error{ErrorCode::kBadInput,
               "the source curve goes from vertex " + std::to_string(edge[0]) + " to " +
                   std::to_string(edge[1]) + ", which share no edge",
               {"name vertices along edges"}};
}

/// Weights of the corners of a face as its counterpart in kept->faces has them.
std::array<double, 3> as_kept(const IntrinsicSurface& surface, const Face& face, Index kept,
                              const std::array<double, 3>& weights) {
  std::array<double, 3> out{};
  for (int k = 0; k < 3; ++k) {
    const auto same = std::ranges::find(face, surface.kept->faces[kept][k]);
    out[k] = weights[static_cast<std::size_t>(same - face.begin())];
  }
  return out;
}

}  // namespace

Index find_clean_edge(const IntrinsicSurface& surface, Index a, Index b) {
  const EdgeTable& edges = surface.kept->edges;
  const Index low = std::min(a, b), high = std::max(a, b);
  const Index e = first_edge_from(edges, low, high);
  return e < edges.edge_count() && edges.low(e) == low && edges.high(e) == high ? e : kNoIndex;
}

SurfacePoint clean_point(const IntrinsicSurface& surface, const SurfacePoint& point) {
  if (point.is_vertex()) return point;
  const Face& face = surface.mesh->faces()[point.face];
  const auto [weights, corner] = clean_weights(point.weights);
  if (corner >= 0) return SurfacePoint::at_vertex(face[static_cast<std::size_t>(corner)]);
  SurfacePoint out = SurfacePoint::in_face(clean_face_of(surface, point.face), {});
  out.weights = as_kept(surface, face, out.face, weights);
  return out;
}

FaceSegment clean_segment(const IntrinsicSurface& surface, const FaceSegment& segment) {
  const Face& face = surface.mesh->faces()[segment.face];
  FaceSegment out = segment;
  out.face = clean_face_of(surface, segment.face);
  for (auto* const end : {&out.from, &out.to}) {
    auto [weights, corner] = clean_weights(*end);
    for (int k = 0; k < 3; ++k) {
      if (corner >= 0) weights[k] = k == corner ? 1 : 0;
      if (weights[k] <= kAtCorner) weights[k] = 0;
    }
    *end = as_kept(surface, face, out.face, weights);
  }
  return out;
}

Result<void> check_sources(const IntrinsicSurface& surface, const SourceSet& sources) {
  if (sources.empty()) {
    return Error{ErrorCode::kBadInput, "there is no source", {"name at least one"}};
  }
  if (!sources.cell_points.empty()) {
    return Error{ErrorCode::kBadInput,
                 "points of cells are no sources of a triangle mesh",
                 {"give points of its faces"}};
  }
  for (const SurfacePoint& point : sources.points) {
    auto valid =
        point.is_vertex() ? check_vertex(surface, point.vertex) : check_in_face(surface, point);
    if (!valid) return valid;
  }
  for (const auto& edge : sources.edges) {
    if (auto valid = check_edge(surface, edge); !valid) return valid;
  }
  for (const FaceSegment& segment : sources.segments) {
    if (auto valid = check_segment(surface, segment); !valid) return valid;
  }
  if (sources.offsets.empty()) return {};  // nor is there a sentence to be made
  return check_offsets(sources, surface.mean_edge,
                       "offsets are lengths, not negative and not beyond all measure beside the "
                       "mean edge of " +
                           rounded_text(surface.mean_edge));
}

Result<void> check_offsets(const SourceSet& sources, double unit, const std::string& hint) {
  const std::vector<double>& offsets = sources.offsets;
  if (!offsets.empty() && offsets.size() != sources.points.size()) {
    return Error{ErrorCode::kBadInput,
                 counted_text(offsets.size(), "offset is", "offsets are") + " given for " +
                     counted_text(sources.points.size(), "source point", "source points"),
                 {"give one a point, or none"}};
  }
  for (std::size_t i = 0; i < offsets.size(); ++i) {
    if (offsets[i] >= 0 && std::isfinite(offsets[i] / unit)) continue;
    return Error{
        ErrorCode::kBadInput,
        "the offset of source point " + std::to_string(i) + " is " + number_text(offsets[i]),
        {hint}};
  }
  return {};
}

}  // namespace geotherm
