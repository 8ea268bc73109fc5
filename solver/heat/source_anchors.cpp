// SPDX-License-Identifier: MIT
#include "solver/heat/source_anchors.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "solver/core/number_text.h"
#include "solver/geometry/tufted_cover.h"

namespace geotherm {
namespace {

using Point2 = Eigen::Vector2d;

std::array<Point2, 3> corners(const FaceLayout& p) {
  return {Point2(0, 0), Point2(p.base, 0), Point2(p.x, p.height)};
}

double distance_to_segment(const Point2& p, const Point2& a, const Point2& b) {
  const Point2 ab = b - a;
  const double t = std::clamp((p - a).dot(ab) / ab.squaredNorm(), 0.0, 1.0);
  return (p - a - t * ab).norm();
}

class Placer {
 public:
  explicit Placer(const Surface& surface) : surface_(surface) {}

  void add(const SurfacePoint& given) {
    const SurfacePoint point = clean_point(surface_, given);
    if (point.is_vertex()) return add_vertex(point.vertex);
    add_in_face(point, true);
    for (int k = 0; k < 3; ++k) {
      if (point.weights[previous_corner(k)] > kAtCorner) continue;
      add_beyond(3 * point.face + k, point.weights[k]);
    }
  }

  void add_edge(const std::array<Index, 2>& edge) {
    for (const Index v : edge) add_vertex(v);
    if (edge[0] == edge[1]) return;
    const Index a = surface_.row_of_vertex[edge[0]];
    const Index b = surface_.row_of_vertex[edge[1]];
    for (const Index f : surface_.operators->faces_at(a)) {
      const Face& face = surface_.operators->faces[f];
      if (std::find(face.begin(), face.end(), b) != face.end()) {
        edges_.insert({std::min(a, b), std::max(a, b)});
        return;
      }
    }
    add_flipped_edge(edge);
  }

  SourceAnchors finish() {
    measure_near_faces();
    SourceAnchors out;
    std::set<Index> components;
    for (const auto& [row, anchor] : anchors_) {
      out.anchors.push_back({row, std::min(anchor.offset, near_.at(row)), anchor.heat});
      components.insert(surface_.operators->components.of[row]);
    }
    for (const Index f : touched_) {
      const Face& face = surface_.operators->faces[f];
      out.near_faces.push_back({f, gradient(surface_.operators->layout[f], near_.at(face[0]),
                                            near_.at(face[1]), near_.at(face[2]))});
    }
    out.components.assign(components.begin(), components.end());
    return out;
  }

 private:
  struct Entry {
    double offset;
    double heat;
  };

  void add_vertex(Index v) { anchors_[surface_.row_of_vertex[v]] = {0.0, 1.0}; }

  /// A point of clean_faces, and the same on the face's back where there is one.
  void add_in_face(const SurfacePoint& point, bool heats) {
    add_carried(carry_through_flips(surface_.flips, point), heats);
    const IntrinsicMesh& intrinsic = surface_.intrinsic;
    if (intrinsic.back.empty() || intrinsic.back[point.face] == kNoIndex) return;
    add_carried(carry_through_flips(surface_.flips, on_back(intrinsic, point)), false);
  }

  /// A point on a side of clean_faces, `weight` of the side's first corner, as the other faces at
  /// the edge see it: where flips do not pass the edge, no twin leads there.
  void add_beyond(Side side, double weight) {
    const Face& face = surface_.clean_faces[face_of(side)];
    const Index from = face[corner_of(side)], to = face[next_corner(corner_of(side))];
    const auto sides = surface_.clean_edges.sides(find_clean_edge(surface_, from, to));
    if (sides.size() == 2 && sides_agree(surface_.clean_faces, sides[0], sides[1])) return;
    for (const Side other : sides) {
      if (other == side) continue;
      const int k = corner_of(other);
      const bool same = surface_.clean_faces[face_of(other)][k] == from;
      SurfacePoint point = SurfacePoint::in_face(face_of(other), {});
      point.weights[k] = same ? weight : 1 - weight;
      point.weights[next_corner(k)] = same ? 1 - weight : weight;
      add_in_face(point, false);
    }
  }

  /// The point as its face sees it and, where it lies on an edge, as the face beyond does: which
  /// of the two was named makes no difference.
  void add_carried(const SurfacePoint& point, bool heats) {
    add_to_face(point, heats);
    for (int k = 0; k < 3; ++k) {
      if (point.weights[k] > kAtCorner) continue;
      const Side twin = surface_.intrinsic.twin[3 * point.face + next_corner(k)];
      if (twin == kNoSide) continue;
      SurfacePoint beyond = SurfacePoint::in_face(face_of(twin), {});
      beyond.weights[corner_of(twin)] = point.weights[previous_corner(k)];
      beyond.weights[next_corner(corner_of(twin))] = point.weights[next_corner(k)];
      add_to_face(beyond, false);
    }
  }

  void add_to_face(const SurfacePoint& point, bool heats) {
    const OperatorMesh& mesh = *surface_.operators;
    const Index first = surface_.row_of_vertex[surface_.intrinsic.faces[point.face][0]];
    for (const Index f : mesh.faces_at(first)) {
      if (mesh.intrinsic_face[f] != point.face) continue;
      const auto at = corners(mesh.layout[f]);
      const Point2 p =
          point.weights[0] * at[0] + point.weights[1] * at[1] + point.weights[2] * at[2];
      for (int k = 0; k < 3; ++k) {
        Entry& entry = anchors_.try_emplace(mesh.faces[f][k], Entry{kUnreached, 0.0}).first->second;
        if (entry.offset == 0) continue;  // a source itself, with all its heat
        entry.offset = std::min(entry.offset, (p - at[k]).norm());
        if (heats) entry.heat += point.weights[k];
      }
      touched_.insert(f);
      return;
    }
  }

  /// An edge of the mesh that the flips removed crosses other faces: its middle stands for it.
  void add_flipped_edge(const std::array<Index, 2>& edge) {
    const Index e = find_clean_edge(surface_, edge[0], edge[1]);
    const Side side = surface_.clean_edges.sides(e).front();
    SurfacePoint middle = SurfacePoint::in_face(face_of(side), {});
    middle.weights[corner_of(side)] = middle.weights[next_corner(corner_of(side))] = 0.5;
    add_in_face(middle, true);
    add_beyond(side, 0.5);
  }

  /// Straight distances to the sources within the faces that touch one.
  void measure_near_faces() {
    const OperatorMesh& mesh = *surface_.operators;
    for (const auto& [row, anchor] : anchors_) {
      near_[row] = anchor.offset;
      if (anchor.offset > 0) continue;
      for (const Index f : mesh.faces_at(row)) touched_.insert(f);
    }
    for (const Index f : touched_) {
      const Face& face = mesh.faces[f];
      for (const Index row : face) near_.try_emplace(row, kUnreached);
    }
    // Shortest ways along edges, whatever the order of the faces: until nothing changes.
    for (bool changed = true; changed;) {
      changed = false;
      for (const Index f : touched_) changed = shorten(f) || changed;
    }
  }

  /// Brings the corners of a face as near as the others allow; true where that changed one.
  bool shorten(Index f) {
    const Face& face = surface_.operators->faces[f];
    const auto at = corners(surface_.operators->layout[f]);
    bool changed = false;
    for (int k = 0; k < 3; ++k) {
      const int i = next_corner(k), j = previous_corner(k);
      const Index a = face[i], b = face[j];
      double least =
          std::min(near_.at(a) + (at[k] - at[i]).norm(), near_.at(b) + (at[k] - at[j]).norm());
      if (edges_.contains({std::min(a, b), std::max(a, b)})) {
        least = std::min(least, distance_to_segment(at[k], at[i], at[j]));
      }
      double& value = near_.at(face[k]);
      changed = changed || least < value;
      value = std::min(value, least);
    }
    return changed;
  }

  const Surface& surface_;
  std::map<Index, Entry> anchors_;
  std::map<Index, double> near_;
  std::set<Index> touched_;
  std::set<std::array<Index, 2>> edges_;
};

}  // namespace

std::vector<Index> SourceAnchors::rows() const {
  std::vector<Index> out;
  out.reserve(anchors.size());
  for (const Anchor& anchor : anchors) out.push_back(anchor.row);
  return out;
}

Result<SourceAnchors> place_sources(const Surface& surface, const SourceSet& sources) {
  if (const auto valid = check_sources(surface, sources); !valid) return valid.error();
  for (const double offset : sources.offsets) {
    if (!(offset > 0)) continue;
    return Error{ErrorCode::kBadInput, "the heat method takes no offsets, and one is " +
                                           rounded_text(offset) + "; use --method wavefront"};
  }
  Placer placer(surface);
  for (const SurfacePoint& point : sources.points) placer.add(point);
  for (const auto& edge : sources.edges) placer.add_edge(edge);
  return placer.finish();
}

bool has_many(std::span<const SourceAnchors> sets) {
  constexpr std::size_t kFew = 32;
  return std::ranges::any_of(sets, [](const auto& set) { return set.anchors.size() > kFew; });
}

}  // namespace geotherm
