// SPDX-License-Identifier: MIT
#include "solver/wave/carry_pieces.h"

#include <cmath>
#include <unordered_map>

#include "solver/geometry/flip_diamond.h"
#include "solver/geometry/intrinsic_surface.h"

namespace geotherm {
namespace {

using Point2 = Eigen::Vector2d;
using Weights = std::array<double, 3>;

/// What is at a corner or on a side but for rounding is there.
Weights snapped(Weights w) {
  for (double& x : w) {
    if (x <= kAtCorner) x = 0;
    if (x >= 1 - kAtCorner) x = 1;
  }
  return w;
}

/// Pieces on their way through one flip.
class FlipCarrier {
 public:
  explicit FlipCarrier(const Flip& flip)
      : flip_(flip), q_(unfold(flip.lengths)), along_(q_.c - q_.d) {}

  /// Appends the one or two pieces that it becomes.
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

  const Flip& flip_;
  FlipDiamond q_;
  Point2 along_;
};

}  // namespace

std::vector<FacePiece> carry_pieces(const std::vector<Flip>& flips, Index face_count,
                                    std::vector<FacePiece> pieces) {
  for (FacePiece& piece : pieces) {
    piece.from = snapped(piece.from);
    piece.to = snapped(piece.to);
  }
  if (flips.empty()) return pieces;
  // Most flips are nowhere near a piece: one look at each face decides.
  std::vector<char> holds(static_cast<std::size_t>(face_count), 0);
  std::unordered_map<Index, std::vector<FacePiece>> in_face;
  std::vector<FacePiece> moved;
  const auto put = [&](const FacePiece& piece) {
    holds[piece.face] = 1;
    in_face[piece.face].push_back(piece);
  };
  for (const FacePiece& piece : pieces) put(piece);
  for (const Flip& flip : flips) {
    if (!holds[flip.f] && !holds[flip.g]) continue;
    const FlipCarrier carrier(flip);
    moved.clear();
    for (const Index face : {flip.f, flip.g}) {
      if (!holds[face]) continue;
      for (const FacePiece& piece : in_face[face]) carrier.carry(piece, moved);
      in_face.erase(face);
      holds[face] = 0;
    }
    for (const FacePiece& piece : moved) put(piece);
  }
  pieces.clear();
  for (Index face = 0; face < face_count; ++face) {
    if (!holds[face]) continue;
    const auto& here = in_face[face];
    pieces.insert(pieces.end(), here.begin(), here.end());
  }
  return pieces;
}

}  // namespace geotherm
