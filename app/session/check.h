// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "geotherm/accuracy.h"
#include "geotherm/names.h"
#include "geotherm/progress.h"

// How commands and the viewer hold distances against those of a more accurate method, and what they
// say and do when these are wrong.
namespace geotherm::app {

/// What distances are held against.
enum class Check {
  kOff,
  kOn,    ///< usual_reference(), for heat and fast marching; a session shows them before
  kAuto,  ///< the best method that fits the mesh (reference_for()), for any method
  kWavefrontFine,
  kExact,
};
inline NamedValues<Check> named_values(Check) {
  using enum Check;
  return {"'*' is no check",
          {{kOn, "on"},
           {kOff, "off"},
           {kAuto, "auto"},
           {kWavefrontFine, "wavefront-fine"},
           {kExact, "exact"}}};
}

/// Whether any method is checked, the near-exact ones, too.
inline bool is_thorough(Check check) { return check > Check::kOn; }

/// What becomes of poor distances.
enum class OnPoor {
  kKeep,    ///< they are handed out, with a warning
  kBetter,  ///< the method wavefront answers instead, or the next one (better_methods())
  kFail,    ///< the command fails
};
inline NamedValues<OnPoor> named_values(OnPoor) {
  using enum OnPoor;
  return {"there is no '*' for poor distances",
          {{kKeep, "keep"}, {kBetter, "better"}, {kFail, "fail"}}};
}

struct CheckSettings {
  Check against = Check::kOn;
  OnPoor on_poor = OnPoor::kKeep;
  bool quick = false;  ///< while something moves: figures alone, no search, no warning
};

/// The reference method; the method itself, or none better, where answers are not checked.
MethodKind reference_in(const CheckSettings& settings, MethodKind checked, Index faces);

/// The report on a method that this check holds against no other one. `in_space`: in one that is no
/// triangle mesh. Of heat and fast marching there is none to hold them against then, and wavefronts
/// run over polygons, where there are exact distances as well.
AccuracyReport unchecked(MethodKind method, Check check, bool in_space);

/// The report on a check that failed.
AccuracyReport failed_check(MethodKind method, const Error& error);

/// The methods that answer instead of `poor`, the next where one is poor as well: wavefront,
/// wavefront-fine and, where these are held against it, exact.
std::vector<MethodKind> better_methods(MethodKind poor, Check check, Index faces);
/// What such a method is held against; `kind` itself, where nothing better fits.
MethodKind reference_of_better(MethodKind kind, Check check, Index faces);
/// Options of such a method.
MethodOptions better_options(const MethodOptions& options, MethodKind kind);

/// How right a method is on some of many source sets, spread over them evenly.
struct SampleCheck : AccuracyReport {
  std::size_t of = 0;  ///< all source sets; `sets` of them were checked, and `worst_set` is of all
};

/// "1.9 % on average, at most 4.3 % of the largest distance, at vertex 17, against wavefront:
/// good".
Warning accuracy_line(const AccuracyReport& report);
Warning accuracy_line(const SampleCheck& check);

/// What is to be warned of, if anything. `line`: the accuracy_line() of the report.
std::optional<Warning> accuracy_warning(const AccuracyReport& report, const Warning& line);

/// For OnPoor::kFail. Errors: kNumericalFailure, where the distances are poor or nobody knows.
Result<void> refuse_poor(const AccuracyReport& report, const Warning& line);

/// Says that `by` answered in place of `poor`, and, where that is so, that `by` is poor as well or
/// was not checked. Each line is the accuracy_line() of its report.
std::vector<Warning> replaced_warnings(MethodKind poor, const Warning& poor_line, MethodKind by,
                                       const AccuracyReport& report, const Warning& line);

/// What the values are, over a colour bar: "error against exact".
std::string error_title(const AccuracyReport& report);

}  // namespace geotherm::app
