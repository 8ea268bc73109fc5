// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <vector>

#include "geotherm/build_method.h"
#include "solver/method/mesh_mapping.h"

namespace geotherm {

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
