// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "app/picture/target_paths.h"
#include "app/session/answer.h"
#include "app/session/check.h"
#include "app/session/reference_beside.h"
#include "app/session/sources.h"
#include "geotherm/progress.h"

namespace geotherm::app {

/// What is wanted of an answer beside its distances.
struct Wanted {
  QueryOptions query = {};  ///< with `nearest`: the nearest sources whatever the method
  CheckSettings check = {Check::kOff};
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
  std::optional<SampleCheck> replaced;  ///< the check of the poor method that `by` replaced
  std::vector<Warning> warnings;
};

/// Whether exact distances are the best to lead so many geodesics from one point: of most they say
/// at once that they are the shortest. On many faces they take minutes.
inline bool exact_leads_tree(std::size_t paths, const Model& model) {
  constexpr std::size_t kMinPaths = 4;
  constexpr Index kMaxFaces = 500000;
  return paths >= kMinPaths && model.mesh->face_count() <= kMaxFaces;
}

/// The library names methods of surfaces as a way out; in a space its own is one.
void name_reference_method(const Space& space, std::vector<Warning>& warnings);

/// Answers questions about one model. Every command and the viewer ask here. It keeps what later
/// questions can use: factors, the wave surface, the last reference. What is done beside it (rows
/// in a stream, samples, paths, timed queries) asks the methods that prepare() returns. For one
/// thread at a time.
class ModelSolver {
 public:
  enum class Use {
    kOneAnswer,  ///< a reference reuses the triangulation of the checked method
    kSession,    ///< references have a triangulation of their own, kept when settings change
  };
  explicit ModelSolver(Model model, Use use = Use::kOneAnswer);

  const Model& model() const { return model_; }
  /// Sets the mesh summary, so that solve() does not compute it; none: the next one does.
  void set_summary(const std::optional<MeshSummary>& mesh) { summary_ = mesh; }
  /// The same model with its vertices elsewhere, with faces as before. Heat methods of it take over
  /// what they can from those that were wanted before it; what else was kept goes, but for the
  /// summary, which set_summary() renews.
  void move(Model model);
  /// The same where a method on the moved model is there, in place of all those before.
  void move(Model model, ReadyMethod ready);
  /// Options of the methods that will be asked for again: they stay when another one is made. A new
  /// method reuses parts of one that is not among them, if there is one. Without this call the last
  /// one stays.
  void want_methods(std::vector<MethodOptions> wanted) { wanted_ = std::move(wanted); }
  /// Frees the methods that are not wanted any more.
  void drop_unwanted();

  /// Errors: kBadInput (the pinned vertex is not on the mesh), kBadFile (what the library finds
  /// wrong with it), those of build_method().
  Result<ReadyMethod> prepare(const MethodOptions& options, const Progress& progress = {});

  /// Distances, nearest sources, the check: the answer with its warnings, in a session without
  /// those of the file. Where a check is to be made, a query that does not go far is answered for
  /// all of the model first. Errors: those of prepare() and of the query, kNumericalFailure
  /// (OnPoor::kFail), kCancelled.
  Result<Answer> solve(const MethodOptions& options, const ResolvedSources& sources,
                       const Wanted& wanted, const Progress& progress = {});

  /// Holds an answer against a better one: its `error`, and a warning where it is poor. Errors:
  /// kCancelled; what else fails is in the report.
  Result<void> check(Answer& answer, const CheckSettings& settings, const Progress& progress = {});

  /// Checks a method of prepare() on some of the sets, and does what is to be done where it is
  /// poor. Precondition: settings.against is not kOff. Errors: those of solve().
  Result<CheckedMethod> check_method(const ReadyMethod& ready, std::span<const SourceSet> sets,
                                     const CheckSettings& settings, const Progress& progress = {});

  /// What distances of `checked` are held against; a method that is no better where none is there.
  MethodKind reference_of(MethodKind checked, const CheckSettings& settings) const;
  /// Whether a is more accurate than b on this model.
  bool is_better(MethodKind a, MethodKind b) const;
  /// Distances to hold others against, by a method of that kind. `triangulation`: as
  /// solve_reference() of the library takes it; a session does not use it. Errors: those of set-up
  /// and queries.
  Result<ReferenceAnswers> reference(
      MethodKind kind, std::span<const SourceSet> sets, int threads, const Progress& progress = {},
      std::shared_ptr<const IntrinsicSurface> triangulation = nullptr);

  /// V: group (source_groups()) of the nearest source by the wavefront method, in a space by its
  /// reference method; kNoIndex where `distances` (V) are infinite. Errors: those of that method's
  /// set-up and query; kNotAvailable (several groups on a surface of edge lengths).
  Result<std::vector<Index>> nearest_sources(const SourceSet& sources,
                                             std::span<const double> distances, int threads,
                                             const Progress& progress = {});

  /// Paths from the sources of an answer to a point. Errors: those of TargetPathFinder.
  Result<TargetPaths> paths_to(const SurfacePoint& target, const Answer& answer,
                               PathKind kind = PathKind::kAll, const Progress& progress = {});

 private:
  Result<std::shared_ptr<const DistanceMethod>> make(const MethodOptions& options,
                                                     const DistanceMethod* other,
                                                     const Progress& progress);
  bool is_wanted(const ReadyMethod& ready) const;
  const ReadyMethod* find_ready(const MethodOptions& options) const;
  Result<Answer> distances(const MethodOptions& options, const ResolvedSources& sources,
                           const QueryOptions& query, const Progress& progress);
  void begin_reference(const MethodOptions& options, const ResolvedSources& sources,
                       const Wanted& wanted);
  void describe_mesh(Answer& answer) const;
  Result<Answer> answer_all(const MethodOptions& options, const ResolvedSources& sources,
                            const Wanted& wanted, const Progress& progress);

  // model_check.cpp
  MethodKind reference_of_better(MethodKind kind, Check check) const;
  std::vector<MethodKind> better_methods(MethodKind poor, Check check) const;
  Result<void> solve_reference(MethodKind kind, const CheckedAnswers& answers,
                               const DistanceMethod& triangulated_by, const Progress& progress);
  Result<AccuracyReport> compare_with(const CheckedAnswers& answers, MethodKind kind, Check check,
                                      const DistanceMethod& triangulated_by,
                                      const Progress& progress);
  Result<void> find_remedy(AccuracyReport& report, const CheckedAnswers& answers, Check check,
                           const Progress& progress);
  Result<void> settle(Answer& answer, AccuracyReport report, const CheckSettings& settings,
                      const Progress& progress);
  Result<void> replace(Answer& answer, const ResolvedSources& sources, const Wanted& wanted,
                       const Progress& progress);

  Model model_;
  Use use_;
  std::optional<MeshSummary> summary_;
  std::vector<MethodOptions> wanted_;
  std::vector<ReadyMethod> ready_;    ///< the last one made at the end
  std::vector<ReadyMethod> earlier_;  ///< from before move(), until one has followed
  /// Of the mesh, by walks_on_inserted(): what methods walk over that were needed so far.
  std::map<bool, std::shared_ptr<const WaveSurface>> waves_;
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
  /// That of the present question, where it is solved while its method is set up.
  std::shared_ptr<ReferenceBeside> beside_;
  struct Paths {
    std::shared_ptr<const DistanceMethod> method;
    std::shared_ptr<const TargetPathFinder> finder;
  };
  std::optional<Paths> paths_;  ///< on the streamlines of `method`, the last that was asked
};

}  // namespace geotherm::app
