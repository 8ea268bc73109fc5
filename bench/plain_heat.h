// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <vector>

#include "bench/plain_cholmod.h"
#include "geotherm/mesh.h"

namespace geotherm::bench {

/// The heat method as a competent but ordinary library has it (Crane, Weischedel, Wardetzky 2013,
/// t = h^2): cotan Laplacian and lumped mass from triplets, one plain factorisation each of A + t L
/// and of L with one vertex pinned, straightforward loops over the faces, one thread, one source at
/// a time. Nothing in it is slow on purpose; what it does not do is share the analysis between the
/// two matrices, choose the ordering and the kind of factorisation by size, renumber the mesh,
/// store what the faces' geometry gives, or block right sides.
class PlainHeat {
 public:
  explicit PlainHeat(std::shared_ptr<const TriangleMesh> mesh) : mesh_(std::move(mesh)) {}

  /// False when a factorisation fails.
  bool set_up();

  /// Empty when a solve fails.
  std::vector<double> distances(Index source);

  double factor_bytes() const { return heat_.bytes() + poisson_.bytes(); }

 private:
  Eigen::VectorXd unit_field_divergence(const Eigen::VectorXd& u) const;

  std::shared_ptr<const TriangleMesh> mesh_;
  PlainCholmod heat_, poisson_;
};

}  // namespace geotherm::bench
