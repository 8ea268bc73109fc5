// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "bench/bench_mesh.h"
#include "bench/measure.h"

namespace geotherm::bench {

/// All contenders on one mesh.
struct SolveGroup {
  std::string mesh;
  Index vertices = 0, faces = 0;
  bool regular = false;          ///< as Case has it
  std::vector<Figures> figures;  ///< the baseline's too, where there is one
  /// Largest difference between the baseline's distances and ours when ours are discretised the
  /// same way, divided by the largest distance: that both do the same work.
  double disagreement = kNotMeasured;
  std::string failure;  ///< the mesh could not be made

  const Figures* baseline() const;
};

/// Called when the figures of a mesh are there; the mesh is handed on as well.
using OnGroup = std::function<void(const SolveGroup&)>;

std::vector<SolveGroup> measure_solves(const SolvePlan& plan, const Say& say,
                                       const OnGroup& on_group);

/// How times grow with the number of vertices: time ~ vertices^exponent.
struct Exponents {
  double setup = kNotMeasured;
  double query = kNotMeasured;
};

struct Growth {
  std::string name;
  Exponents all, regular, irregular;  ///< over all meshes, and over those of one kind
};

/// Slopes of log time over log vertices (least squares), with an offset of its own for each kind of
/// mesh, so that a shape's own pace is no growth. One row for each contender that was measured on
/// two sizes of one kind. What cannot be said is not a number.
std::vector<Growth> measure_growth(const std::vector<SolveGroup>& groups);

}  // namespace geotherm::bench
