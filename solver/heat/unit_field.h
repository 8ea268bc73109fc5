// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "solver/heat/diffuse.h"
#include "solver/heat/domain.h"
#include "solver/heat/linear_system.h"
#include "solver/heat/surface.h"

namespace geotherm {

/// X = -grad u / |grad u| on every face of a triangle mesh, for K source sets.
///
/// Where two fronts meet, distance has a crease and u blends both sides: the mean of the two unit
/// vectors is shorter than 1, and stretching it to 1 makes distances too long. There sqrt(t) |grad
/// log u|, which is 1 along a single front and falls to the cosine of the fronts' half angle at the
/// crease, says how long X is: where it is below kFront of what the mesh resolves, X is shortened
/// in proportion (t > 0; t = 0 keeps |X| = 1, as published). Where the heat has reached everything
/// and its slope is small everywhere, that says nothing about creases: as sqrt(t) grows from kShort
/// to kLong of the component's extent, measured by how far log u falls, X goes back to length 1.
///
/// On a component that is narrower than some diffusion lengths, such as a strip one face wide, heat
/// flows along one way only and touches the boundary everywhere: neither its slope nor the straight
/// distance beside the sources says more than the published field. Both fade out there.
class FaceField final : public UnitField {
 public:
  /// How far log u falls over a component, and its area, in units of the intrinsic mesh.
  struct Extent {
    double high, low;  ///< largest and smallest logarithm
    double area;
  };

  /// `t` in units of the intrinsic mesh squared, or 0 everywhere. `whole`: of each component of
  /// which the surface is a piece; empty where it has all of them. Keeps references. Cost: a
  /// logarithm a row.
  FaceField(const Surface& surface, const HeatField& heat, const PerComponent& t,
            const Workspace& work, std::span<const Extent> whole = {});
  ~FaceField() override { work_.pool.give(std::move(log_u_)); }
  FaceField(const FaceField&) = delete;
  FaceField& operator=(const FaceField&) = delete;

  /// X of one face in its own plane: (0, 0) where the gradient is zero or not finite.
  std::array<double, 2> of_face(Index face, Eigen::Index column) const;

  /// With t > 0, faces at a source take the gradient of the straight distance instead.
  Block divergence(std::span<const SourceAnchors> anchors) const override;

  CellCounts inspect(std::span<const double> phi, Eigen::Index column, const SourceAnchors& anchors,
                     std::span<const char> held_at_zero, int threads,
                     Quality& quality) const override;
  /// inspect() of the faces with a flag in `some` alone.
  CellCounts inspect(std::span<const double> phi, const SourceAnchors& anchors,
                     std::span<const char> some, int threads, Quality& quality) const;

 private:
  void take_logarithms(const PerComponent& t, std::span<const Extent> whole);
  /// Adds what these faces give to b.
  void add_faces(Index first_face, Index end_face, Block& b) const;
  void add_group(Index first_face, Index end_face, Eigen::Index first, int group, Block& b) const;
  void measure_trust(const Block& high, const Block& low);
  bool measure_width(const Block& high, const Block& low, std::span<const double> area,
                     const PerComponent& t);
  /// The value of the row's component; 1 where there are no components.
  double at(const std::vector<double>& values, Index row, Eigen::Index column) const;
  double length(Index face, Eigen::Index column) const;
  double root_t(Index face) const {
    return root_t_of_face_.empty() ? root_t_ : root_t_of_face_[face];
  }

  const Surface& surface_;
  const OperatorMesh& mesh_;
  const HeatField& heat_;
  double root_t_;                       ///< of the first component, so of all where they share one
  std::vector<double> root_t_of_face_;  ///< F; empty where they do
  Workspace work_;
  Block log_u_;  ///< n x K, natural logarithm of u with its exponent; empty when not needed
  std::vector<double> trust_;  ///< how far lengths count, per component and column; empty: wholly
  std::vector<double> width_;  ///< how far what is known beside sources does; the same
};

}  // namespace geotherm
