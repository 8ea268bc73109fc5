// SPDX-License-Identifier: MIT
#include "solver/geometry/edit.h"

#include <algorithm>
#include <cmath>
#include <unordered_map>

#include "solver/geometry/intrinsic_surface.h"

namespace geotherm {
namespace {

using Point2 = Eigen::Vector2d;
using Weights = std::array<double, 3>;

/// Snaps weights within rounding of a corner or a side to it.
Weights snapped(Weights w) {
  for (double& x : w) {
    if (x <= kAtCorner) x = 0;
    if (x >= 1 - kAtCorner) x = 1;
  }
  return w;
}

Weights between(const Weights& from, const Weights& to, double share) {
  Weights out;
  for (int k = 0; k < 3; ++k) out[k] = from[k] + share * (to[k] - from[k]);
  return out;
}

/// Carries pieces through one flip.
class FlipCarrier {
 public:
  explicit FlipCarrier(const Edit& flip)
      : flip_(flip), q_(unfold(flip.numbers)), along_(q_.c - q_.d) {}

  /// Appends the one or two pieces that a piece becomes.
  void carry(const FacePiece& piece, std::vector<FacePiece>& out) const {
    const Point2 from = place(piece.face, piece.from), to = place(piece.face, piece.to);
    const double s = side(from), t = side(to);
    if (s * t >= 0) {
      out.push_back(on_side(s + t >= 0, from, to, piece.source));
      return;
    }
    const Point2 cut = from + s / (s - t) * (to - from);
    out.push_back(on_side(s > 0, from, cut, piece.source));
    out.push_back(on_side(t > 0, cut, to, piece.source));
  }

 private:
  Point2 place(Index face, const Weights& w) const {
    const bool in_f = face == flip_.f;
    const int start = in_f ? flip_.start_f : flip_.start_g;
    const double w0 = w[start], w1 = w[next_corner(start)], w2 = w[previous_corner(start)];
    return in_f ? Point2(w0 * q_.a + w1 * q_.b + w2 * q_.c)
                : Point2(w0 * q_.b + w1 * q_.a + w2 * q_.d);
  }

  /// Positive on the side of a, 0 within rounding of the new edge.
  double side(const Point2& p) const {
    const double area = cross(along_, p - q_.d);
    return std::abs(area) <= kAtCorner * along_.squaredNorm() ? 0.0 : area;
  }

  FacePiece on_side(bool of_a, const Point2& from, const Point2& to, std::size_t source) const {
    const auto weights = [&](const Point2& p) {
      return snapped(of_a ? clipped_weights(q_.c, q_.a, q_.d, p)
                          : clipped_weights(q_.d, q_.b, q_.c, p));
    };
    return {of_a ? flip_.f : flip_.g, weights(from), weights(to), source};
  }

  const Edit& flip_;
  FlipDiamond q_;
  Point2 along_;
};

/// Carries pieces into the two or three faces that a new vertex makes of one. Part k of the face is
/// where shares[k], the weight of its corner k over that of the vertex, is the smallest.
class SplitCarrier {
 public:
  explicit SplitCarrier(const Edit& split) : split_(split) {
    if (split.kind == Edit::Kind::kFaceSplit) {
      std::copy_n(split.numbers.begin(), 3, vertex_.begin());
      return;
    }
    const double share = split.numbers[0];
    vertex_[split.start_f] = 1 - share;
    vertex_[next_corner(split.start_f)] = share;
  }

  /// Appends the one to three pieces that a piece becomes.
  void carry(const FacePiece& piece, std::vector<FacePiece>& out) const {
    if (piece.from == piece.to) {
      out.push_back(in_part(part_of(piece.from), piece.from, piece.to, piece.source));
      return;
    }
    std::array<double, 5> cuts{0.0, 1.0};
    int count = 2;
    for (int k = 0; k < 3; ++k) {
      const int l = next_corner(k);
      if (!(vertex_[k] > 0 && vertex_[l] > 0)) continue;
      const double s = piece.from[k] / vertex_[k] - piece.from[l] / vertex_[l];
      const double t = piece.to[k] / vertex_[k] - piece.to[l] / vertex_[l];
      if (s * t < 0 && std::min(std::abs(s), std::abs(t)) > kAtCorner) cuts[count++] = s / (s - t);
    }
    std::sort(cuts.begin(), cuts.begin() + count);
    // Neighbouring pieces in one part are one: not every line that is crossed is an edge there.
    int begin = 0;
    int part = part_of(between(piece.from, piece.to, (cuts[0] + cuts[1]) / 2));
    for (int i = 1; i < count; ++i) {
      const bool last = i + 1 == count;
      const int next =
          last ? -1 : part_of(between(piece.from, piece.to, (cuts[i] + cuts[i + 1]) / 2));
      if (next == part) continue;
      out.push_back(in_part(part, between(piece.from, piece.to, cuts[begin]),
                            between(piece.from, piece.to, cuts[i]), piece.source));
      begin = i;
      part = next;
    }
  }

 private:
  int part_of(const Weights& w) const {
    int least = -1;
    double smallest = 0;
    for (int k = 0; k < 3; ++k) {
      if (!(vertex_[k] > 0)) continue;
      const double share = w[k] / vertex_[k];
      if (least < 0 || share < smallest) {
        least = k;
        smallest = share;
      }
    }
    return least;
  }

  /// The weights in the part whose corner k is the new vertex.
  FacePiece in_part(int k, const Weights& from, const Weights& to, std::size_t source) const {
    const auto weights = [&](const Weights& w) {
      Weights out = w;
      const double share = w[k] / vertex_[k];
      for (int j = 0; j < 3; ++j) out[j] = std::max(0.0, w[j] - share * vertex_[j]);
      out[k] = share;
      const double sum = out[0] + out[1] + out[2];
      for (double& x : out) x /= sum;
      return turned(k, out);
    };
    return {face_of_part(k), weights(from), weights(to), source};
  }

  Index face_of_part(int k) const {
    if (split_.kind == Edit::Kind::kSideSplit) {
      return k == split_.start_f ? split_.g : split_.f;
    }
    return k == 2 ? split_.f : split_.g + k;
  }

  /// Reorders weights as the part lists its corners.
  Weights turned(int k, const Weights& w) const {
    if (split_.kind == Edit::Kind::kSideSplit) {
      const int a = split_.start_f;
      return snapped({w[a], w[next_corner(a)], w[previous_corner(a)]});
    }
    return snapped({w[next_corner(k)], w[previous_corner(k)], w[k]});
  }

  const Edit& split_;
  Weights vertex_{};
};

}  // namespace

std::vector<FacePiece> carry_pieces(std::span<const Edit> edits, Index face_count,
                                    std::vector<FacePiece> pieces) {
  for (FacePiece& piece : pieces) {
    piece.from = snapped(piece.from);
    piece.to = snapped(piece.to);
  }
  if (edits.empty() || pieces.empty()) return pieces;
  // Most edits touch no face with a piece, and a look at the face rules them out.
  std::vector<char> holds(static_cast<std::size_t>(face_count), 0);
  std::unordered_map<Index, std::vector<FacePiece>> in_face;
  std::vector<FacePiece> moved;
  const auto put = [&](const FacePiece& piece) {
    holds[piece.face] = 1;
    in_face[piece.face].push_back(piece);
  };
  const auto carry_from = [&](const auto& carrier, Index face) {
    if (!holds[face]) return;
    for (const FacePiece& piece : in_face[face]) carrier.carry(piece, moved);
    in_face.erase(face);
    holds[face] = 0;
  };
  for (const FacePiece& piece : pieces) put(piece);
  for (const Edit& edit : edits) {
    moved.clear();
    if (edit.kind == Edit::Kind::kFlip) {
      if (!holds[edit.f] && !holds[edit.g]) continue;
      const FlipCarrier carrier(edit);
      carry_from(carrier, edit.f);
      carry_from(carrier, edit.g);
    } else {
      if (!holds[edit.f]) continue;
      carry_from(SplitCarrier(edit), edit.f);
    }
    for (const FacePiece& piece : moved) put(piece);
  }
  std::vector<Index> faces;
  for (const auto& [face, here] : in_face) faces.push_back(face);
  std::ranges::sort(faces);
  pieces.clear();
  for (const Index face : faces) {
    const auto& here = in_face[face];
    pieces.insert(pieces.end(), here.begin(), here.end());
  }
  return pieces;
}

}  // namespace geotherm
