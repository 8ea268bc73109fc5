// SPDX-License-Identifier: MIT
// Signed distance by heat: normals of the curves diffuse as vectors do, and a function is found
// whose gradient is nearest to them (Feng, Crane 2024), on vertices.
#include <cmath>
#include <new>
#include <numbers>
#include <string>
#include <utility>

#include "solver/directions/curve_pieces.h"
#include "solver/directions/vector_heat_state.h"
#include "solver/geometry/operator_mesh.h"

namespace geotherm {
namespace {

using Point2 = Eigen::Vector2d;
using Layout = std::array<Point2, 3>;

/// Vectors of a face in the frames of its corners, and back.
class FaceFrames {
 public:
  FaceFrames(const FlippedDirections& flipped, Index face)
      : at(corners_of(flipped.mesh.lengths[static_cast<std::size_t>(face)])) {
    for (int k = 0; k < 3; ++k) {
      side_[k] = angle_of(at[next_corner(k)] - at[k]);
      begin_[k] = flipped.at_begin[3 * face + k];
      scale_[k] = flipped.scale[flipped.mesh.faces[face][k]];
    }
  }

  Point2 to_corner(int k, const Point2& v) const {
    const double turn = std::remainder(angle_of(v) - side_[k], 2 * std::numbers::pi);
    const double angle = begin_[k] + scale_[k] * turn;
    return v.norm() * Point2(std::cos(angle), std::sin(angle));
  }
  Point2 from_corner(int k, const Point2& v) const {
    const double turn = std::remainder(angle_of(v) - begin_[k], 2 * std::numbers::pi);
    const double angle = side_[k] + turn / scale_[k];
    return v.norm() * Point2(std::cos(angle), std::sin(angle));
  }

  Layout at;

 private:
  std::array<double, 3> side_{}, begin_{}, scale_{};
};

}  // namespace

Result<SignedDistance> VectorHeat::signed_distance(std::span<const SurfacePath> curves,
                                                   const Progress& progress) const try {
  const State& state = *state_;
  if (state.no_vectors) {
    return Error{ErrorCode::kBadInput,
                 "the signed heat method needs an oriented manifold, which the surface is not at "
                 "vertex " +
                     std::to_string(*state.flipped.broken),
                 {"close the curves, so that their sides tell, or repair the mesh"}};
  }
  const auto collected = curve_pieces(state.directions->paths, curves);
  if (!collected) return collected.error();
  const IntrinsicMesh& mesh = state.flipped.mesh;
  std::vector<FacePiece> pieces;
  for (const CurvePiece& piece : collected->pieces) {
    pieces.push_back({piece.face, piece.from, piece.to, pieces.size()});
  }
  pieces = carry_pieces(state.flipped.flips, mesh.face_count(), std::move(pieces));

  // To the right of the curves, as long as each piece.
  std::vector<double> right(2 * state.mass.size(), 0.0);
  std::vector<Index> rows;
  for (const FacePiece& piece : pieces) {
    const FaceFrames frames(state.flipped, piece.face);
    const Point2 along = place_of(frames.at, piece.to) - place_of(frames.at, piece.from);
    const Point2 normal = collected->pieces[piece.source].share * Point2(along.y(), -along.x());
    if (!(normal.norm() > 0)) continue;
    for (int k = 0; k < 3; ++k) {
      const Index row = state.row_of_vertex[mesh.faces[piece.face][k]];
      const double share = (piece.from[k] + piece.to[k]) / 2;
      const Point2 there = share * frames.to_corner(k, normal);
      right[2 * row] += there.x();
      right[2 * row + 1] += there.y();
      if (share > 0) rows.push_back(row);
    }
  }
  if (rows.empty()) return Error{ErrorCode::kBadInput, "the curves have no length", {}};
  SignedDistance out;
  out.rule = SideRule::kHeat;
  const auto in_reach = state.reached(rows);
  std::vector<double> heat;
  const auto at = state.warm(rows, in_reach, heat, out.warnings, progress);
  if (!at) return at.error();
  const auto system = state.vectors(at->t, progress);
  if (!system) return system.error();
  const auto normals = system->system.solve(*system->factors, right, progress, state.threads);
  if (!normals) return normals.error();

  std::vector<double> divergences(state.mass.size(), 0.0);
  for (Index f = 0; f < mesh.face_count(); ++f) {
    const FaceFrames frames(state.flipped, f);
    // Relative to the largest, since heat spans the range of doubles.
    std::array<Point2, 3> at_corner;
    double largest = 0;
    for (int k = 0; k < 3; ++k) {
      const Index row = state.row_of_vertex[mesh.faces[f][k]];
      at_corner[k] = {(*normals)[2 * row], (*normals)[2 * row + 1]};
      largest = std::max(largest, at_corner[k].cwiseAbs().maxCoeff());
    }
    if (!(largest > 0)) continue;
    Point2 sum = Point2::Zero();
    for (int k = 0; k < 3; ++k) sum += frames.from_corner(k, at_corner[k] / largest);
    if (!(sum.norm() > 0)) continue;
    sum.normalize();
    const auto parts =
        divergence(lay_out(mesh.lengths[static_cast<std::size_t>(f)]), sum.x(), sum.y());
    for (int k = 0; k < 3; ++k) {
      divergences[state.row_of_vertex[mesh.faces[f][k]]] += parts[k];
    }
  }

  // One row of each part is held at 0.
  std::vector<char> pinned(state.mass.size(), 0),
      seen(static_cast<std::size_t>(state.parts.count), 0);
  for (std::size_t i = 0; i < pinned.size(); ++i) {
    char& part = seen[state.parts.of[i]];
    if (part == 0) pinned[i] = part = 1;
    if (pinned[i] != 0) divergences[i] = 0;
  }
  const auto poisson = state.scalar.factorize(
      [&](const SpreadSystem::Add& add) {
        for (Index i = 0; i < state.size(); ++i) {
          if (pinned[i] != 0) add(i, i, 1);
        }
        for (const Link& link : state.links) {
          if (link.from == link.to) continue;
          if (pinned[link.from] == 0) add(link.from, link.from, link.weight);
          if (pinned[link.to] == 0) add(link.to, link.to, link.weight);
          if (pinned[link.from] == 0 && pinned[link.to] == 0) {
            add(link.from, link.to, -link.weight);
          }
        }
      },
      state.threads);
  if (!poisson) return poisson.error();
  const auto phi = state.scalar.solve(**poisson, divergences, progress, state.threads);
  if (!phi) return phi.error();

  // 0 on the curves of each part, on average.
  std::vector<double> sum(seen.size(), 0.0), length(seen.size(), 0.0);
  for (const FacePiece& piece : pieces) {
    const Face& face = mesh.faces[piece.face];
    const Layout layout = corners_of(mesh.lengths[static_cast<std::size_t>(piece.face)]);
    const double weight = collected->pieces[piece.source].share *
                          (place_of(layout, piece.to) - place_of(layout, piece.from)).norm();
    const Index part = state.parts.of[state.row_of_vertex[face[0]]];
    length[part] += weight;
    for (int k = 0; k < 3; ++k) {
      sum[part] +=
          weight * (piece.from[k] + piece.to[k]) / 2 * (*phi)[state.row_of_vertex[face[k]]];
    }
  }
  for (Index v = 0; v < state.mesh->vertex_count(); ++v) {
    const Index row = state.row_of_vertex[state.mesh->standing_for(v)];
    const bool has = row != kNoIndex && in_reach[row];
    const Index part = row == kNoIndex ? 0 : state.parts.of[row];
    out.distances.push_back(has ? state.unit * ((*phi)[row] - sum[part] / length[part])
                                : kUnreached);
  }
  return out;
} catch (const std::bad_alloc&) {
  return directions_out_of_memory(state_->mesh->face_count());
}

}  // namespace geotherm
