// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "solver/core/hint.h"
#include "solver/method/build_method.h"
#include "solver/method/distance_error.h"

namespace geotherm {

/// The one option of the heat method to which most of an error is due.
struct ErrorCause {
  std::string option;   ///< the name of a setting: "time-factor"
  std::string value;    ///< what lowers the error: "1"
  std::string because;  ///< "t is too large (m = 100, sqrt(t) = 10 mean edges)"; empty: the value
                        ///< is none that is recommended everywhere
  double mean_relative_before = 0, mean_relative_after = 0;  ///< DistanceError::mean_relative
};

/// A setting that was solved with, and what it gave.
struct TriedSetting {
  std::string option, value;                    ///< of a setting: "method", "wavefront"
  double mean_relative = 0, max_of_range = 0;   ///< of DistanceError
  MethodKind against = MethodKind::kWavefront;  ///< what it was held against
};
/// One whose answer is good.
using Cure = TriedSetting;

/// What to set.
SettingHint setting_of(const TriedSetting& tried);

struct Diagnosis {
  std::optional<ErrorCause> cause;  ///< absent: no option of the heat method lowers the error much
  std::optional<Cure> cure;         ///< absent: all that could be tried failed
  std::vector<TriedSetting> tried;  ///< in order
};

/// Answers of a method, and what it was asked.
struct CheckedAnswers {
  const DistanceMethod& method;
  const MethodOptions& options;  ///< that the method was made with
  std::span<const SourceSet> sources;
  std::span<const std::vector<double>> distances;  ///< one for each source set, V each
};

/// How much work a search for a cure takes on, as faces that are set up for one setting: a setting
/// that shares all but one factor counts for a third of the mesh, a cover for two, a refined mesh
/// for four. The first where it was asked for, the second where it was not.
inline constexpr Index kMaxFacesDiagnosed = 300'000;
inline constexpr Index kMaxFacesBesides = 100'000;

/// Exact distances take some tenths of a second up to here, so that other methods are held against
/// them, and they are offered where no other method is good.
inline constexpr Index kMaxFacesExact = 20'000;

/// What makes wrong answers right, by trying: solves again with one setting at a time changed, and
/// takes the first whose answer is good. In this order, and the cheapest of each kind first:
/// options of the heat method that are not what is recommended, set to that; other values of its
/// options (time factors 2 and 4, the variant classic, other rules where there is a border, tufted
/// covers, a finer mesh); the methods wavefront, wavefront-fine and, on up to kMaxFacesExact faces
/// or where it is the reference, exact. Where no option of the heat method makes it good, the one
/// that lowers the error most is the cause if it takes more than a fifth away, more faces only if
/// they leave less than half of what another one leaves. What fails is passed over. `better`:
/// distances of `reference` for the same sources. The method wavefront is held against exact
/// distances on small meshes, else against wavefront-fine, where it is itself the reference.
/// `most_faces`: kMaxFacesDiagnosed or kMaxFacesBesides. Errors: kCancelled. Cost: a set-up and
/// queries for each setting tried, at most 16.
Result<Diagnosis> diagnose(const std::shared_ptr<const TriangleMesh>& mesh,
                           const CheckedAnswers& answers, MethodKind reference,
                           std::span<const std::vector<double>> better, Index most_faces,
                           const Progress& progress = {});

}  // namespace geotherm
