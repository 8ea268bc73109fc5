// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "solver/core/result.h"
#include "solver/core/types.h"

namespace geotherm {

/// An immutable triangle mesh, exactly as its file or generator gave it.
///
/// Positions: V x 3, finite, model units. Faces: F x 3, every corner in [0, V). Nothing else is
/// promised: faces may repeat a corner, have no area, disagree in orientation, share an edge three
/// times; vertices may belong to no face. What is made of that is the business of `geometry/`.
class TriangleMesh {
 public:
  /// Takes the arrays. Errors: no faces, a corner out of range, a coordinate that is not finite
  /// (each with its number). Cost: one pass over both arrays.
  static Result<TriangleMesh> build(std::vector<Vec3> positions, std::vector<Face> faces);

  /// One some of whose vertices are one (weld()). `same_as`: V; the lowest vertex that each is one
  /// with, itself where there is none lower. Corners become those. Errors: those of build(), a
  /// table that is none (with its vertex).
  static Result<TriangleMesh> build(std::vector<Vec3> positions, std::vector<Face> faces,
                                    std::vector<Index> same_as);

  std::span<const Vec3> positions() const { return positions_; }
  std::span<const Face> faces() const { return faces_; }
  Index vertex_count() const { return static_cast<Index>(positions_.size()); }
  Index face_count() const { return static_cast<Index>(faces_.size()); }

  /// V: the vertex that stands for each in all faces; empty where each stands for itself. Those
  /// that another stands for belong to no face, and have its distance.
  std::span<const Index> same_as() const { return same_as_; }

  /// The vertex that stands for v. Precondition: v in [0, V).
  Index standing_for(Index v) const {
    return same_as_.empty() ? v : same_as_[static_cast<std::size_t>(v)];
  }

 private:
  TriangleMesh(std::vector<Vec3> positions, std::vector<Face> faces)
      : positions_(std::move(positions)), faces_(std::move(faces)) {}

  std::vector<Vec3> positions_;
  std::vector<Face> faces_;
  std::vector<Index> same_as_;
};

}  // namespace geotherm
