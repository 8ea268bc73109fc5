// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "geotherm/build_method.h"
#include "geotherm/mesh_report.h"

namespace geotherm {

/// Settings with one of them changed, which may give a better answer.
struct Candidate {
  std::string option, value;  ///< what is changed, as on the command line without dashes
  std::string because;        ///< why it may be the cause; empty: it is not wrong as it is
  double faces = 1;           ///< of the work, in those of the mesh (kMaxFacesDiagnosed)
  MethodOptions options;
};

/// Options of the heat method to be tried instead of `options`, in the order of diagnose(), but for
/// more faces. `relative_t`: HeatMethod::relative_t() of what there is. Precondition:
/// options.method is kHeat.
std::vector<Candidate> heat_candidates(const MethodOptions& options, const MeshReport& mesh,
                                       double relative_t);

/// The same options on a mesh with four times the faces.
Candidate refined_candidate(const MethodOptions& options);

}  // namespace geotherm
