// SPDX-License-Identifier: MIT
#include "solver/directions/curve_pieces.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

namespace geotherm {
namespace {

/// The edge in whose interior a point in a face is, kNoIndex where in none.
Index edge_of(const PathSurface& surface, const SurfacePoint& point) {
  if (point.is_vertex() || std::ranges::count(point.weights, 0.0) != 1) return kNoIndex;
  const auto corner =
      static_cast<int>(std::ranges::find(point.weights, 0.0) - point.weights.begin());
  return surface.edge_at(3 * point.face + next_corner(corner));
}

/// Weights of a point in a face that holds it.
std::optional<std::array<double, 3>> weights_in(const PathSurface& surface,
                                                const SurfacePoint& point, Index face) {
  const auto there = surface.express(point, face);
  if (!there) return std::nullopt;
  if (!there->is_vertex()) return there->weights;
  std::array<double, 3> weights{};
  weights[static_cast<std::size_t>(surface.corner_of_vertex(face, there->vertex))] = 1;
  return weights;
}

class Collector {
 public:
  explicit Collector(const PathSurface& surface) : surface_(surface) {
    out_.crossings.assign(static_cast<std::size_t>(surface.edges().edge_count()), 0);
    out_.touched.assign(out_.crossings.size(), 0);
    out_.on_curve.assign(static_cast<std::size_t>(surface.mesh()->vertex_count()), 0);
  }

  Result<void> add(const SurfacePath& curve, std::size_t number) {
    std::vector<SurfacePoint> points;
    for (const SurfacePoint& point : curve.points) {
      auto clean = surface_.into(point);
      if (!clean) return clean.error();
      points.push_back(*clean);
      out_.points.push_back(*clean);
      if (clean->is_vertex()) out_.on_curve[static_cast<std::size_t>(clean->vertex)] = 1;
      if (const Index e = edge_of(surface_, *clean); e != kNoIndex) out_.touched[e] = 1;
    }
    std::vector<Index> faces;
    for (std::size_t i = 0; i + 1 < points.size(); ++i) {
      const Index face = common_face(points[i], points[i + 1]);
      if (face == kNoIndex) {
        return Error{ErrorCode::kBadInput,
                     "piece " + std::to_string(i) + " of curve " + std::to_string(number) +
                         " lies in no face",
                     {"join its ends by a path"}};
      }
      faces.push_back(face);
      add_piece(points[i], points[i + 1], face, number);
    }
    for (std::size_t i = 1; i < faces.size(); ++i) pass(points[i], faces[i - 1], faces[i]);
    const bool closed = points.size() > 2 && same_place(points.front(), points.back());
    const bool returns = curve.closed && !faces.empty();
    if (closed || returns) {
      pass(points.front(), faces.back(), faces.front());
    } else if (!faces.empty()) {
      leave(points.front());
      leave(points.back());
    }
    return {};
  }

  CurvePieces take() { return std::move(out_); }

 private:
  Index common_face(const SurfacePoint& a, const SurfacePoint& b) const {
    const auto at_a = surface_.faces_at(a), at_b = surface_.faces_at(b);
    for (const Index f : at_a) {
      if (std::ranges::find(at_b, f) != at_b.end()) return f;
    }
    return kNoIndex;
  }

  /// A point on an edge may be said in any of its faces, and files round its weights.
  bool same_place(const SurfacePoint& a, const SurfacePoint& b) const {
    constexpr double kRounded = 1e-9;
    if (a.is_vertex() || b.is_vertex()) return a == b;
    const auto there = surface_.express(b, a.face);
    if (!there) return false;
    double apart = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      apart = std::max(apart, std::abs(a.weights[k] - there->weights[k]));
    }
    return apart < kRounded;
  }

  void add_piece(const SurfacePoint& a, const SurfacePoint& b, Index face, std::size_t curve) {
    const auto from = weights_in(surface_, a, face), to = weights_in(surface_, b, face);
    std::vector<Index> faces = {face};
    for (int k = 0; k < 3; ++k) {
      if ((*from)[k] != 0 || (*to)[k] != 0) continue;
      faces.clear();  // along the side opposite to the corner
      for (const Side s : surface_.edges().sides(surface_.edge_at(3 * face + next_corner(k)))) {
        faces.push_back(face_of(s));
      }
      break;
    }
    for (const Index f : faces) {
      out_.pieces.push_back({f, *weights_in(surface_, a, f), *weights_in(surface_, b, f),
                             1.0 / static_cast<double>(faces.size()), curve});
    }
  }

  void pass(const SurfacePoint& at, Index from, Index to) {
    const Index e = edge_of(surface_, at);
    if (e != kNoIndex && from != to) ++out_.crossings[e];
  }

  /// An end inside a border edge parts the vertices of that edge as a passage would.
  void leave(const SurfacePoint& end) {
    const Index e = edge_of(surface_, end);
    if (e != kNoIndex && surface_.edges().sides(e).size() == 1) ++out_.crossings[e];
  }

  const PathSurface& surface_;
  CurvePieces out_;
};

}  // namespace

Result<CurvePieces> curve_pieces(const PathSurface& surface, std::span<const SurfacePath> curves) {
  Collector collector(surface);
  for (std::size_t i = 0; i < curves.size(); ++i) {
    if (auto added = collector.add(curves[i], i); !added) return added.error();
  }
  CurvePieces out = collector.take();
  if (out.pieces.empty()) {
    return Error{ErrorCode::kBadInput, "there is no curve with two points or more", {}};
  }
  return out;
}

}  // namespace geotherm
