// SPDX-License-Identifier: MIT
#include "solver/heat/source_anchors.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "solver/core/text.h"
#include "solver/geometry/edit.h"
#include "solver/heat/surface.h"
#include "solver/polyhedral/wave_surface.h"

namespace geotherm {
namespace {

using Point2 = Eigen::Vector2d;
using Weights = std::array<double, 3>;

/// Heat that a piece gives to the corners of its face: as a whole, and for its length.
struct PieceHeat {
  double whole = 0, of_length = 0;
};
constexpr PieceHeat kNoHeat{}, kWholeHeat{1, 0}, kEvenHeat{0, 1};

class Placer {
 public:
  explicit Placer(const Surface& surface) : surface_(surface) {}

  void add(const SurfacePoint& given) {
    const SurfacePoint point = clean_point(surface_, given);
    if (point.is_vertex()) return add_vertex(point.vertex);
    add_piece({point.face, point.weights, point.weights}, kWholeHeat);
    for (int k = 0; k < 3; ++k) {
      if (point.weights[previous_corner(k)] > kAtCorner) continue;
      add_beyond(3 * point.face + k, {point.weights[k], point.weights[k]});
    }
  }

  /// All of an edge. Where it is still one, its faces measure from all of it; where flips or
  /// splits have cut it up, its pieces do.
  void add_edge(const std::array<Index, 2>& edge) {
    for (const Index v : edge) add_vertex(v);
    if (edge[0] == edge[1]) return;
    const Index e = find_clean_edge(surface_, edge[0], edge[1]);
    const Side side = surface_.kept->edges.sides(e).front();
    FacePiece piece{face_of(side), {}, {}};
    piece.from[corner_of(side)] = piece.to[next_corner(corner_of(side))] = 1;
    add_piece(piece, kWholeHeat);
    add_beyond(side, {1, 0});
  }

  /// A piece of a curve across faces.
  void add_segment(const FaceSegment& given) {
    const FaceSegment segment = clean_segment(surface_, given);
    if (segment.from == segment.to) return add(SurfacePoint::in_face(given.face, given.from));
    add_piece({segment.face, segment.from, segment.to}, kEvenHeat);
    for (int k = 0; k < 3; ++k) {
      const int beside = previous_corner(k);
      if (segment.from[beside] > 0 || segment.to[beside] > 0) continue;
      add_beyond(3 * segment.face + k, {segment.from[k], segment.to[k]});
    }
  }

  SourceAnchors finish() {
    measure_near_faces();
    SourceAnchors out;
    out.pieces = std::move(pieces_);
    std::set<Index> components;
    for (const auto& [row, anchor] : anchors_) {
      out.anchors.push_back({row, std::min(anchor.offset, near_.at(row)), anchor.heat});
      components.insert(surface_.operators->components.of[row]);
    }
    for (const Index f : touched_) {
      const Face& face = surface_.operators->faces[f];
      const auto g = gradient(surface_.operators->layout[f], near_.at(face[0]), near_.at(face[1]),
                              near_.at(face[2]));
      out.near_faces.push_back({f, g});
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

  /// A piece of kept->faces, and the same on the face's back where there is one.
  void add_piece(const FacePiece& piece, const PieceHeat& heat) {
    add_carried(piece, heat);
    const IntrinsicMesh& intrinsic = surface_.intrinsic;
    if (intrinsic.back.empty() || intrinsic.back[piece.face] == kNoIndex) return;
    const auto turned = [](const Weights& w) { return Weights{w[0], w[2], w[1]}; };
    add_carried({intrinsic.back[piece.face], turned(piece.from), turned(piece.to)}, kNoHeat);
  }

  /// A piece on a side of kept->faces, from and to where the side's first corner has these weights,
  /// as the other faces at the edge see it: where edits do not pass the edge, no twin leads there.
  void add_beyond(Side side, const std::array<double, 2>& weights) {
    const Face& face = surface_.kept->faces[face_of(side)];
    const Index from = face[corner_of(side)], to = face[next_corner(corner_of(side))];
    const auto sides = surface_.kept->edges.sides(find_clean_edge(surface_, from, to));
    if (sides.size() == 2 && sides_agree(surface_.kept->faces, sides[0], sides[1])) return;
    for (const Side other : sides) {
      if (other == side) continue;
      const int k = corner_of(other), l = next_corner(k);
      const bool same = surface_.kept->faces[face_of(other)][k] == from;
      FacePiece piece{face_of(other), {}, {}};
      piece.from[same ? k : l] = weights[0];
      piece.from[same ? l : k] = 1 - weights[0];
      piece.to[same ? k : l] = weights[1];
      piece.to[same ? l : k] = 1 - weights[1];
      add_piece(piece, kNoHeat);
    }
  }

  /// The pieces that it is in the triangulation: as their faces see them and, where they lie on an
  /// edge, as the face beyond does; which of the two was named makes no difference.
  void add_carried(const FacePiece& given, const PieceHeat& heat) {
    for (const FacePiece& piece : carried(given)) {
      if (is_edge(piece)) continue;
      add_to_face(piece, heat);
      for (int k = 0; k < 3; ++k) {
        if (piece.from[k] > 0 || piece.to[k] > 0) continue;
        const Side twin = surface_.intrinsic.twin[3 * piece.face + next_corner(k)];
        if (twin == kNoSide) continue;
        const auto beyond = [&](const Weights& w) {
          Weights out{};
          out[corner_of(twin)] = w[previous_corner(k)];
          out[next_corner(corner_of(twin))] = w[next_corner(k)];
          return out;
        };
        add_to_face({face_of(twin), beyond(piece.from), beyond(piece.to)}, kNoHeat);
      }
    }
  }

  std::vector<FacePiece> carried(const FacePiece& piece) const {
    return carry_pieces(surface_.edits, surface_.intrinsic.face_count(), {piece});
  }

  /// Takes note of a piece that is a whole edge: both ends are sources, and what their faces
  /// measure is measured from all of it.
  bool is_edge(const FacePiece& piece) {
    const Face& face = surface_.intrinsic.faces[piece.face];
    for (int k = 0; k < 3; ++k) {
      for (const int l : {next_corner(k), previous_corner(k)}) {
        if (piece.from[k] < 1 || piece.to[l] < 1) continue;
        add_vertex(face[k]);
        add_vertex(face[l]);
        const Index a = surface_.row_of_vertex[face[k]], b = surface_.row_of_vertex[face[l]];
        edges_.insert({std::min(a, b), std::max(a, b)});
        add_on_side(3 * piece.face + (l == next_corner(k) ? k : l));
        return true;
      }
    }
    return false;
  }

  /// A whole side, as both faces at it see it.
  void add_on_side(Side side) {
    for (const Side of : {side, surface_.intrinsic.twin[side]}) {
      if (of == kNoSide) continue;
      const Index f = face_number(face_of(of));
      const auto at = corners_of(surface_.operators->layout[f]);
      pieces_.push_back({f, at[corner_of(of)], at[next_corner(corner_of(of))]});
    }
  }

  Index face_number(Index intrinsic_face) const {
    const OperatorMesh& mesh = *surface_.operators;
    const Index first = surface_.row_of_vertex[surface_.intrinsic.faces[intrinsic_face][0]];
    for (const Side corner : mesh.corners.at(first)) {
      const Index f = face_of(corner);
      if (mesh.intrinsic_face[f] == intrinsic_face) return f;
    }
    return kNoIndex;
  }

  void add_to_face(const FacePiece& piece, const PieceHeat& heat) {
    const OperatorMesh& mesh = *surface_.operators;
    const Index f = face_number(piece.face);
    const auto at = corners_of(mesh.layout[f]);
    const auto place = [&at](const Weights& w) {
      return Point2(w[0] * at[0] + w[1] * at[1] + w[2] * at[2]);
    };
    const Point2 from = place(piece.from), to = place(piece.to);
    pieces_.push_back({f, from, to});
    const double given = heat.whole + heat.of_length * (to - from).norm();
    for (int k = 0; k < 3; ++k) {
      Entry& entry = anchors_.try_emplace(mesh.faces[f][k], Entry{kUnreached, 0.0}).first->second;
      if (entry.offset == 0) continue;  // a source itself, with all its heat
      const double offset = distance_to({f, from, to, 0, 0}, at[k]);
      if (piece.from[k] == 1 || piece.to[k] == 1) {
        entry = {0.0, 1.0};
        continue;
      }
      entry.offset = std::min(entry.offset, offset);
      entry.heat += (piece.from[k] + piece.to[k]) / 2 * given;
    }
    touched_.insert(f);
  }

  /// Straight distances to the sources within the faces that touch one.
  void measure_near_faces() {
    const OperatorMesh& mesh = *surface_.operators;
    for (const auto& [row, anchor] : anchors_) {
      near_[row] = anchor.offset;
      if (anchor.offset > 0) continue;
      for (const Side corner : mesh.corners.at(row)) touched_.insert(face_of(corner));
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
    const auto at = corners_of(surface_.operators->layout[f]);
    bool changed = false;
    for (int k = 0; k < 3; ++k) {
      const int i = next_corner(k), j = previous_corner(k);
      const Index a = face[i], b = face[j];
      double least =
          std::min(near_.at(a) + (at[k] - at[i]).norm(), near_.at(b) + (at[k] - at[j]).norm());
      if (edges_.contains({std::min(a, b), std::max(a, b)})) {
        least = std::min(least, distance_to({f, at[i], at[j], 0, 0}, at[k]));
      }
      double& value = near_.at(face[k]);
      changed = changed || least < value;
      value = std::min(value, least);
    }
    return changed;
  }

  const Surface& surface_;
  std::map<Index, Entry> anchors_;
  std::vector<SourceAnchors::Piece> pieces_;
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

std::size_t SourceAnchors::source_count(const Components& parts, Index component) const {
  double heat = 0;  // 1 of each source
  for (const Anchor& anchor : anchors) heat += parts.of[anchor.row] == component ? anchor.heat : 0;
  return static_cast<std::size_t>(std::max(std::lround(heat), 1L));
}

SourceAnchors AnchorMap::finish(const Components& parts) const {
  SourceAnchors out;
  std::set<Index> components;
  for (const auto& [row, anchor] : anchors_) {
    out.anchors.push_back(anchor);
    components.insert(parts.of[row]);
  }
  out.components.assign(components.begin(), components.end());
  return out;
}

Result<void> refuse_offsets(const SourceSet& sources, std::optional<MethodKind> other) {
  for (const double offset : sources.offsets) {
    if (!(offset > 0)) continue;
    return Error{
        other ? ErrorCode::kBadInput : ErrorCode::kNotAvailable,
        "the heat method takes no offsets, and one is " + rounded_text(offset),
        other ? Hint{"use ", SettingHint{"method", {to_text(*other)}}} : Hint{"leave it out"}};
  }
  return {};
}

Result<SourceAnchors> place_sources(const Surface& surface, const SourceSet& sources) {
  if (const auto valid = check_sources(surface, sources); !valid) return valid.error();
  if (auto none = refuse_offsets(sources, MethodKind::kWavefront); !none) return none.error();
  Placer placer(surface);
  for (const SurfacePoint& point : sources.points) placer.add(point);
  for (const auto& edge : sources.edges) placer.add_edge(edge);
  for (const FaceSegment& segment : sources.segments) placer.add_segment(segment);
  return placer.finish();
}

bool has_many(std::span<const SourceAnchors> sets) {
  constexpr std::size_t kFew = 128;
  return std::ranges::any_of(sets, [](const auto& set) { return set.anchors.size() > kFew; });
}

}  // namespace geotherm
