// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "geotherm/accuracy.h"
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

/// The same in a space that is no triangle mesh, with the time factor 1/2 as well. `has_boundary`:
/// whether there is a boundary for rules.
std::vector<Candidate> space_candidates(const MethodOptions& options, bool has_boundary,
                                        double relative_t);

/// The candidate that keeps the options and refines the mesh to four times the faces.
Candidate refined_candidate(const MethodOptions& options);

/// Makes a method of the space that is searched.
using MakeMethod = std::function<Result<std::shared_ptr<const DistanceMethod>>(
    const MethodOptions& options, const Progress& progress)>;

/// As diagnose(), in any space: tries the candidates in order; where none makes the answer good,
/// the remedy is the method of the reference, `better`. Errors: kCancelled.
Result<Diagnosis> diagnose_space(const MakeMethod& make, const CheckedAnswers& answers,
                                 const ReferenceAnswers& better,
                                 std::span<const Candidate> candidates, const Progress& progress);

/// Puts what a search found into a report: cause, remedy, advice and verdict.
void tell_found(AccuracyReport& report, Diagnosis found);

}  // namespace geotherm
