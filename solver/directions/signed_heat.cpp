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
  FaceFrames(const IntrinsicMesh& mesh, const FlippedDirections& flipped, Index face)
      : at(corners_of(mesh.lengths[static_cast<std::size_t>(face)])) {
    for (int k = 0; k < 3; ++k) {
      side_[k] = angle_of(at[next_corner(k)] - at[k]);
      begin_[k] = flipped.at_begin[3 * face + k];
      scale_[k] = flipped.scale[mesh.faces[face][k]];
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
  const auto made = state.vector_parts(part_of(progress, 0, 0.2));
  if (!made) return made.error();
  const VectorParts& of_vectors = **made;
  if (of_vectors.broken) {
    return Error{ErrorCode::kBadInput,
                 "the signed heat method needs an oriented manifold, which the surface is not at "
                 "vertex " +
                     std::to_string(*of_vectors.flipped.broken),
                 {"close the curves, so that their sides tell, or repair the mesh"}};
  }
  const auto collected = curve_pieces(of_vectors.directions->paths, curves);
  if (!collected) return collected.error();
  const Components& parts = state.surface->parts_of_rows();
  const std::vector<Index>& row_of_vertex = state.surface->row_of_vertex;
  const IntrinsicMesh& mesh = state.surface->intrinsic;
  std::vector<FacePiece> pieces;
  for (const CurvePiece& piece : collected->pieces) {
    pieces.push_back({piece.face, piece.from, piece.to, pieces.size()});
  }
  pieces = carry_pieces(state.surface->edits, mesh.face_count(), std::move(pieces));

  // To the right of the curves, as long as each piece.
  std::vector<std::complex<double>> right;
  std::vector<Index> rows;
  for (const FacePiece& piece : pieces) {
    const FaceFrames frames(mesh, of_vectors.flipped, piece.face);
    const Point2 along = place_of(frames.at, piece.to) - place_of(frames.at, piece.from);
    const Point2 normal = collected->pieces[piece.source].share * Point2(along.y(), -along.x());
    if (!(normal.norm() > 0)) continue;
    for (int k = 0; k < 3; ++k) {
      const Index row = row_of_vertex[mesh.faces[piece.face][k]];
      const double share = (piece.from[k] + piece.to[k]) / 2;
      if (!(share > 0)) continue;
      const Point2 there = share * frames.to_corner(k, normal);
      rows.push_back(row);
      right.emplace_back(there.x(), there.y());
    }
  }
  if (rows.empty()) return Error{ErrorCode::kBadInput, "the curves have no length", {}};
  if (auto sided = refuse_there_and_back(*of_vectors.directions, *collected); !sided) {
    return sided.error();
  }
  SignedDistance out;
  out.rule = SideRule::kHeat;
  const auto warmth = state.warm(rows, true, out.warnings, part_of(progress, 0.2, 0.4));
  if (!warmth) return warmth.error();
  const auto normals = state.carry(*warmth, rows, right, part_of(progress, 0.4, 0.8));
  if (!normals) return normals.error();

  const auto size = static_cast<std::size_t>(state.size());
  Block phi = Block::Zero(state.size(), 1);  // divergences first
  for (Index f = 0; f < mesh.face_count(); ++f) {
    const FaceFrames frames(mesh, of_vectors.flipped, f);
    // By the heat of the warmest corner, since heat spans the range of doubles.
    std::array<Index, 3> row{};
    for (int k = 0; k < 3; ++k) row[k] = row_of_vertex[mesh.faces[f][k]];
    if (warmth->reached[row[0]] == 0) continue;
    Index warmest = row[0];
    for (const Index other : row) {
      if (warmth->ratio(other, warmest) > 1) warmest = other;
    }
    std::array<Point2, 3> at_corner;
    for (int k = 0; k < 3; ++k) {
      const auto normal = warmth->ratio(row[k], warmest) * (*normals)[row[k]];
      at_corner[k] = {normal.real(), normal.imag()};
    }
    Point2 sum = Point2::Zero();
    for (int k = 0; k < 3; ++k) sum += frames.from_corner(k, at_corner[k]);
    if (!(sum.norm() > 0)) continue;
    sum.normalize();
    const auto flows =
        divergence(lay_out(mesh.lengths[static_cast<std::size_t>(f)]), sum.x(), sum.y());
    for (int k = 0; k < 3; ++k) {
      phi(row[k], 0) += flows[k];
    }
  }

  // One row of each part is held at 0.
  std::vector<char> seen(static_cast<std::size_t>(parts.count), 0);
  std::vector<Index> held;
  for (std::size_t i = 0; i < size; ++i) {
    if (std::exchange(seen[parts.of[i]], 1) != 0) continue;
    held.push_back(static_cast<Index>(i));
    phi(held.back(), 0) = 0;
  }
  FactorOptions options;
  options.threads = state.threads;
  const auto poisson = LinearSystem::build(*state.surface, 0, 1, held, options);
  if (!poisson) return poisson.error();
  const Workspace work{state.pool, state.threads};
  if (auto done = (*poisson)->solve(phi, {}, work, part_of(progress, 0.9, 1)); !done) {
    return done.error();
  }

  // 0 on the curves of each part, on average.
  std::vector<double> sum(seen.size(), 0.0), length(seen.size(), 0.0);
  for (const FacePiece& piece : pieces) {
    const Face& face = mesh.faces[piece.face];
    const Layout layout = corners_of(mesh.lengths[static_cast<std::size_t>(piece.face)]);
    const double weight = collected->pieces[piece.source].share *
                          (place_of(layout, piece.to) - place_of(layout, piece.from)).norm();
    const Index part = parts.of[row_of_vertex[face[0]]];
    length[part] += weight;
    for (int k = 0; k < 3; ++k) {
      sum[part] += weight * (piece.from[k] + piece.to[k]) / 2 * phi(row_of_vertex[face[k]], 0);
    }
  }
  for (Index v = 0; v < state.mesh().vertex_count(); ++v) {
    const Index row = row_of_vertex[state.mesh().standing_for(v)];
    const bool has = row != kNoIndex && warmth->reached[row] != 0;
    const Index part = row == kNoIndex ? 0 : parts.of[row];
    out.distances.push_back(has ? state.unit() * (phi(row, 0) - sum[part] / length[part])
                                : kUnreached);
  }
  return out;
} catch (const std::bad_alloc&) {
  return directions_out_of_memory(state_->mesh().face_count());
}

}  // namespace geotherm
