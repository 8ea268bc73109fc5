// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "app/picture/target_paths.h"
#include "app/session/answer.h"
#include "app/session/check.h"
#include "app/session/sources.h"
#include "geotherm/progress.h"

namespace geotherm::app {

/// What is wanted of an answer beside its distances.
struct Wanted {
  QueryOptions query = {};  ///< with `nearest`: the nearest sources whatever the method
  CheckSettings check = {CheckMode::kNone};
};

/// A method that is ready.
struct ReadyMethod {
  std::shared_ptr<const DistanceMethod> method;
  MethodOptions options;
  SetupTiming setup;    ///< with what it took over from an earlier method
  double setup_ms = 0;  ///< from the question to the method being ready
};

/// A method that many source sets will be asked of, after a check on some of them.
struct CheckedMethod {
  ReadyMethod by;                       ///< what answers: the one asked for, or a better one
  SampleCheck error;                    ///< of `by`
  std::optional<SampleCheck> replaced;  ///< of the poor method that `by` stands for
  std::vector<std::string> warnings;
};

/// Answers questions about one model. Every command and the viewer ask here. It keeps what the next
/// question can use: factors, what waves walk over, the last distances that others were held
/// against. For one thread at a time.
class ModelSolver {
 public:
  enum class Use {
    kOneAnswer,  ///< references walk over the triangulation of the method that is checked
    kSession,    ///< many answers: they have one of their own, which outlives a change of settings
  };
  explicit ModelSolver(Model model, Use use = Use::kOneAnswer);

  const Model& model() const { return model_; }
  /// Spares solve() the work.
  void set_summary(const MeshSummary& mesh) { summary_ = mesh; }
  /// How many heat methods stay beside each other, 1 or 2. A new one begins with what the one that
  /// it replaces has.
  void keep_methods(std::size_t count);

  /// Errors: kBadInput (the pinned vertex is not on the mesh), kBadFile (what the library finds
  /// wrong with it), those of build_method().
  Result<ReadyMethod> prepare(const MethodOptions& options, const Progress& progress = {});

  /// Distances, nearest sources, the check of both: the answer with its warnings, those of the file
  /// apart. Errors: those of prepare() and of the query, kNumericalFailure (OnPoor::kFail),
  /// kCancelled.
  Result<Answer> solve(const MethodOptions& options, const ResolvedSources& sources,
                       const Wanted& wanted, const Progress& progress = {});

  /// Holds an answer against a better one: its `error`, and a warning where it is poor. Errors:
  /// kCancelled; what else fails is in the report.
  Result<void> check(Answer& answer, const CheckSettings& settings, const Progress& progress = {});

  /// prepare(), a check on some of the sets, and what is to be done where the method is poor.
  /// Precondition: settings.mode is not kNone. Errors: those of solve().
  Result<CheckedMethod> check_method(const ReadyMethod& ready, std::span<const SourceSet> sets,
                                     const CheckSettings& settings, const Progress& progress = {});

  /// V: group (source_groups()) of the nearest source by the wavefront method, kNoIndex where none
  /// can be. `distances`: finite where a source can be. Errors: those of its set-up and query.
  Result<std::vector<Index>> nearest_sources(const SourceSet& sources,
                                             std::span<const double> distances, int threads,
                                             const Progress& progress = {});

  /// Paths from the sources of an answer to a point. Errors: those of TargetPathFinder.
  Result<TargetPaths> paths_to(const SurfacePoint& target, const Answer& answer,
                               const Progress& progress = {});

 private:
  Result<std::shared_ptr<const DistanceMethod>> make(const MethodOptions& options,
                                                     const DistanceMethod* near,
                                                     const Progress& progress);
  Result<Answer> distances(const MethodOptions& options, const ResolvedSources& sources,
                           const QueryOptions& query, const Progress& progress);
  void describe_mesh(Answer& answer) const;

  // model_check.cpp
  Result<void> solve_reference(MethodKind kind, const CheckedAnswers& answers,
                               const DistanceMethod& beside, const Progress& progress);
  Result<AccuracyReport> hold(const CheckedAnswers& answers, MethodKind kind, CheckMode mode,
                              const DistanceMethod& beside, const Progress& progress);
  Result<void> settle(Answer& answer, AccuracyReport report, const CheckSettings& settings,
                      const Progress& progress);
  Result<void> replace(Answer& answer, const ResolvedSources& sources, const Wanted& wanted,
                       const Progress& progress);

  Model model_;
  Use use_;
  std::optional<MeshSummary> summary_;
  std::size_t kept_methods_ = 1;
  std::vector<ReadyMethod> ready_;            ///< the one asked for last at the end
  std::shared_ptr<const WaveSurface> waves_;  ///< of the mesh; null: not needed so far
  struct OnWaves {
    std::shared_ptr<const DistanceMethod> method;
    int threads = 0, refine = 0;
  };
  /// Methods beside heat, by kind and whether on a refined mesh. Use::kSession alone.
  std::map<std::pair<MethodKind, bool>, OnWaves> on_waves_;
  struct Reference {
    std::vector<SourceSet> sets;
    ReferenceAnswers answers;
  };
  std::optional<Reference> reference_;  ///< the last
  struct Paths {
    std::shared_ptr<const DistanceMethod> method;
    std::shared_ptr<const TargetPathFinder> finder;
  };
  std::optional<Paths> paths_;  ///< on the streamlines of `method`, the last that was asked
};

}  // namespace geotherm::app
