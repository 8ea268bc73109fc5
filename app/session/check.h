// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "geotherm/accuracy.h"
#include "geotherm/progress.h"

// How commands and the viewer hold distances against those of a more accurate method, and what they
// say and do when these are wrong.
namespace geotherm::app {

enum class CheckMode {
  kNone,
  kUsual,     ///< heat and fast marching against the method wavefront; a remedy where they are poor
  kThorough,  ///< any method against the best one that fits; a remedy where it is not good
};

/// What becomes of poor distances.
enum class OnPoor {
  kKeep,    ///< they are handed out, with a warning
  kBetter,  ///< the method wavefront answers instead, or the next one (better_methods())
  kFail,    ///< the command fails
};

struct CheckSettings {
  CheckMode mode = CheckMode::kUsual;
  OnPoor on_poor = OnPoor::kKeep;
  std::optional<MethodKind> against = {};  ///< named by the user; none: what `mode` takes
  bool quick = false;  ///< while something moves: figures alone, no search, no warning
};

/// The reference method: the one that was named, else that of the mode; the method itself, or none
/// better, where answers are not checked.
MethodKind reference_in(const CheckSettings& settings, MethodKind checked, Index faces);

/// The report on a method that is not held against another one in this mode.
AccuracyReport unchecked(MethodKind method, CheckMode mode);

/// The report on a check that failed.
AccuracyReport failed_check(MethodKind method, const Error& error);

/// Looks for a remedy as far as the mode asks for one. Errors: kCancelled.
Result<void> find_remedy(AccuracyReport& report, const std::shared_ptr<const TriangleMesh>& mesh,
                         const CheckedAnswers& answers, const ReferenceAnswers& better,
                         CheckMode mode, const Progress& progress);

/// The methods that answer instead of `poor`, the next where one is poor as well: wavefront,
/// wavefront-fine and, where these are held against it, exact.
std::vector<MethodKind> better_methods(MethodKind poor, CheckMode mode, Index faces);
/// What such a method is held against; `kind` itself, where nothing better fits.
MethodKind reference_of_better(MethodKind kind, CheckMode mode, Index faces);
/// Options of such a method.
MethodOptions better_options(const MethodOptions& options, MethodKind kind);

/// How right a method is on some of many source sets, spread over them evenly.
struct SampleCheck {
  AccuracyReport report;  ///< AccuracyReport::sets: how many of them
  std::size_t of = 0;     ///< all source sets
  std::size_t worst = 0;  ///< number of the set with the largest error
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
