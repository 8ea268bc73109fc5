// SPDX-License-Identifier: MIT
#pragma once

#include <regex>
#include <string>
#include <vector>

#include "bench/measure.h"

namespace geotherm::bench {

/// All contenders on one mesh.
struct SolveGroup {
  std::string mesh;
  Index vertices = 0, faces = 0;
  std::vector<Figures> figures;  ///< the baseline's too, where there is one
  /// Largest difference between the baseline's distances and ours when ours are discretised the
  /// same way, divided by the largest distance: that both do the same work.
  double disagreement = kNotMeasured;
  std::string failure;  ///< the mesh could not be made

  const Figures* baseline() const;
};

/// How times grow with the number of faces: time ~ faces^exponent.
struct Growth {
  std::string name;
  double setup_exponent = kNotMeasured;
  double query_exponent = kNotMeasured;
};

struct SolvePlan {
  bool quick = false;
  int threads = 0;                    ///< 0: all cores
  std::vector<std::string> backends;  ///< that this build has, and other methods
  std::regex only;                    ///< rows "MESH-THOUSANDSk/BACKEND" in which it is found
};

/// Called when the figures of a mesh are there; the mesh is handed on as well.
using OnGroup = std::function<void(const SolveGroup&)>;

std::vector<SolveGroup> measure_solves(const SolvePlan& plan, const Say& say,
                                       const OnGroup& on_group);

/// The slope of log time over log faces, common to all kinds of mesh; one row for each contender
/// that was measured on two sizes of one kind.
std::vector<Growth> measure_growth(const std::vector<SolveGroup>& groups);

}  // namespace geotherm::bench
