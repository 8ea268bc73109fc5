// SPDX-License-Identifier: MIT
#include "solver/heat/source_anchors.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "solver/core/number_text.h"

namespace geotherm {
namespace {

/// Weights nearer to a corner than this are that corner.
constexpr double kAtCorner = 1e-12;
/// Weights are accepted when they sum to 1 within this: what nine typed digits give.
constexpr double kWeightSum = 1e-6;

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

  Result<void> add(const SurfacePoint& point) {
    return point.is_vertex() ? add_vertex(point.vertex) : add_in_face(point);
  }

  Result<void> add_edge(const std::array<Index, 2>& edge) {
    for (const Index v : edge) {
      if (const auto added = add_vertex(v); !added) return added;
    }
    if (edge[0] == edge[1]) return {};
    const Index a = surface_.row_of_vertex[edge[0]];
    const Index b = surface_.row_of_vertex[edge[1]];
    for (const Index f : surface_.operators->faces_at(a)) {
      const Face& face = surface_.operators->faces[f];
      if (std::find(face.begin(), face.end(), b) != face.end()) {
        edges_.insert({std::min(a, b), std::max(a, b)});
        return {};
      }
    }
    return add_flipped_edge(edge);
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

  Result<void> add_vertex(Index v) {
    if (v < 0 || v >= surface_.mesh->vertex_count()) {
      return Error{ErrorCode::kBadInput, "source vertex " + std::to_string(v) +
                                             " does not exist; vertices are 0 to " +
                                             std::to_string(surface_.mesh->vertex_count() - 1)};
    }
    const Index row = surface_.row_of_vertex[v];
    if (row == kNoIndex) {
      return Error{ErrorCode::kBadInput, "source vertex " + std::to_string(v) +
                                             " belongs to no face; choose one on the surface"};
    }
    anchors_[row] = {0.0, 1.0};
    return {};
  }

  Result<void> add_in_face(SurfacePoint point) {
    const Index count = surface_.mesh->face_count();
    if (point.face < 0 || point.face >= count) {
      return Error{ErrorCode::kBadInput, "source face " + std::to_string(point.face) +
                                             " does not exist; faces are 0 to " +
                                             std::to_string(count - 1)};
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
                       number_text(sum) + "; barycentric weights are not negative and sum to 1"};
    }
    const Face& face = surface_.mesh->faces()[point.face];
    for (int k = 0; k < 3; ++k) {
      point.weights[k] = std::max(point.weights[k], 0.0) / sum;
      if (point.weights[k] >= 1 - kAtCorner) return add_vertex(face[k]);
    }
    const auto carried = carry(point);
    if (!carried) return carried.error();
    add_carried(*carried);
    return {};
  }

  /// The point in the flipped triangulation, face numbers of the intrinsic mesh.
  Result<SurfacePoint> carry(const SurfacePoint& point) const {
    const Face& face = surface_.mesh->faces()[point.face];
    Index clean = surface_.clean_of_face[point.face];
    const auto same_corners = [&face](const Face& other) {
      return std::is_permutation(face.begin(), face.end(), other.begin());
    };
    if (clean == kNoIndex) {  // a duplicate: its twin stands in for it
      const auto& faces = surface_.clean_faces;
      const auto it = std::find_if(faces.begin(), faces.end(), same_corners);
      if (it == faces.end()) {
        return Error{ErrorCode::kBadInput, "source face " + std::to_string(point.face) +
                                               " repeats a corner and has no inside; choose "
                                               "another"};
      }
      clean = static_cast<Index>(it - faces.begin());
    }
    SurfacePoint moved = SurfacePoint::in_face(clean, {});
    for (int k = 0; k < 3; ++k) {
      const auto corner = std::find(face.begin(), face.end(), surface_.clean_faces[clean][k]);
      moved.weights[k] = point.weights[static_cast<std::size_t>(corner - face.begin())];
    }
    return carry_through_flips(surface_.flips, moved);
  }

  /// The point as its face sees it and, where it lies on an edge, as the face beyond does: which
  /// of the two was named makes no difference.
  void add_carried(const SurfacePoint& point) {
    add_to_face(point, true);
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
  Result<void> add_flipped_edge(const std::array<Index, 2>& edge) {
    for (std::size_t c = 0; c < surface_.clean_faces.size(); ++c) {
      const Face& face = surface_.clean_faces[c];
      const auto a = std::find(face.begin(), face.end(), edge[0]);
      const auto b = std::find(face.begin(), face.end(), edge[1]);
      if (a == face.end() || b == face.end()) continue;
      SurfacePoint middle = SurfacePoint::in_face(static_cast<Index>(c), {});
      middle.weights[static_cast<std::size_t>(a - face.begin())] = 0.5;
      middle.weights[static_cast<std::size_t>(b - face.begin())] = 0.5;
      add_carried(carry_through_flips(surface_.flips, middle));
      return {};
    }
    return Error{ErrorCode::kBadInput,
                 "the source curve goes from vertex " + std::to_string(edge[0]) + " to " +
                     std::to_string(edge[1]) + ", which share no edge; name vertices along edges"};
  }

  /// Straight distances to the sources within the faces that touch one.
  void measure_near_faces() {
    const OperatorMesh& mesh = *surface_.operators;
    for (const auto& [row, anchor] : anchors_) {
      near_[row] = anchor.offset;
      if (anchor.offset > 0) continue;
      const auto faces = mesh.faces_at(row);
      touched_.insert(faces.begin(), faces.end());
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
  if (sources.empty()) {
    return Error{ErrorCode::kBadInput, "there is no source; name at least one"};
  }
  Placer placer(surface);
  for (const SurfacePoint& point : sources.points) {
    if (const auto added = placer.add(point); !added) return added.error();
  }
  for (const auto& edge : sources.edges) {
    if (const auto added = placer.add_edge(edge); !added) return added.error();
  }
  return placer.finish();
}

}  // namespace geotherm
