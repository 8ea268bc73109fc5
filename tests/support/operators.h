// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <vector>

#include "geotherm/backend.h"
#include "solver/geometry/delaunay.h"
#include "solver/geometry/fem_operator.h"
#include "tests/support/shapes.h"

namespace geotherm::test {

/// Clean faces of a mesh, and its intrinsic mesh in units of the mean edge length.
struct Intrinsic {
  CleanFaces clean;
  IntrinsicMesh mesh;
  std::vector<Edit> flips;  ///< empty unless asked for
};
Intrinsic intrinsic_of(const TriangleMesh& mesh, bool flip);

/// Vertices in use, numbered from 0.
struct Numbering {
  std::vector<Index> local;  ///< V, kNoIndex where unused
  std::vector<Index> vertex;
};
Numbering numbering_of(const TriangleMesh& mesh, const CleanFaces& clean);

SymmetricPattern pattern_of(const IntrinsicMesh& mesh, const Numbering& numbers);

/// The operators of an intrinsic mesh in the order of the file.
std::shared_ptr<const OperatorMesh> operators_of(const TriangleMesh& mesh, const Intrinsic& in);

/// A mesh analysed by a backend, and its operators in that order.
struct Analysed {
  std::shared_ptr<const Analysis> analysis;
  std::shared_ptr<const OperatorMesh> operators;
};
Analysed analysed(const TriangleMesh& mesh, const Backend& backend, bool flip = true);

}  // namespace geotherm::test
