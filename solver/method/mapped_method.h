// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <vector>

#include "geotherm/distance_method.h"
#include "solver/geometry/intrinsic_surface.h"

namespace geotherm {

/// What leads from a mesh to the one that is solved on: its faces cut into four (subdivide()), and
/// vertices that are one (TriangleMesh::same_as()). Immutable.
class MeshMapping {
 public:
  /// `refine`: how often faces are cut; at 0 the mesh is solved on as it is, and only vertices that
  /// are one count. Errors: those of subdivide(). Cost: that, and O(F).
  static Result<MeshMapping> build(std::shared_ptr<const TriangleMesh> mesh, int refine);

  const TriangleMesh& mesh() const { return *mesh_; }
  const std::shared_ptr<const TriangleMesh>& inner() const { return inner_; }  ///< solved on
  int refine() const { return refine_; }
  double milliseconds() const { return milliseconds_; }
  const std::vector<Warning>& warnings() const { return warnings_; }

  /// The same sources on the inner mesh. Errors: those of check_sources(), with the numbers of the
  /// outer mesh.
  Result<SourceSet> inner_sources(const SourceSet& sources) const;

  /// Values of the inner mesh's vertices become those of the outer mesh's, and groups those of the
  /// outer sources; of such as touch on the inner mesh alone, the first stands for all.
  void take_back(const SourceSet& sources, DistanceResult& result) const;

 private:
  MeshMapping() = default;
  std::vector<Index> outer_groups(const SourceSet& sources) const;
  void add_edge(const std::array<Index, 2>& edge, std::vector<std::array<Index, 2>>& edges) const;

  std::shared_ptr<const TriangleMesh> mesh_, inner_;
  int refine_ = 0;
  IntrinsicSurface surface_;  ///< of the outer mesh, without lengths; only where it is refined
  double milliseconds_ = 0;
  std::vector<Warning> warnings_;
};

/// Distances on a mesh from a method on another one: the same surface cut finer, or the same mesh
/// with vertices that are one. Sources and answers are those of the outer mesh; the quality
/// figures, and the heat method behind heat(), are those of the inner one.
class MappedMethod final : public DistanceMethod {
 public:
  /// `inner`: a method on mapping->inner().
  MappedMethod(std::shared_ptr<const MeshMapping> mapping,
               std::shared_ptr<const DistanceMethod> inner);

  MethodKind kind() const override { return inner_->kind(); }
  Result<std::vector<DistanceResult>> solve_each(std::span<const SourceSet> sets,
                                                 const QueryOptions& query,
                                                 const Progress& progress) const override;
  const SetupTiming& timing() const override { return timing_; }
  double memory_mb() const override { return inner_->memory_mb(); }
  const std::vector<Warning>& warnings() const override { return warnings_; }
  const HeatMethod* heat() const override { return inner_->heat(); }

  const std::shared_ptr<const MeshMapping>& mapping() const { return mapping_; }

 private:
  std::shared_ptr<const MeshMapping> mapping_;
  std::shared_ptr<const DistanceMethod> inner_;
  SetupTiming timing_;
  std::vector<Warning> warnings_;
};

}  // namespace geotherm
