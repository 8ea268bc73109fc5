// SPDX-License-Identifier: MIT
// The error over the time factor, worked out beside the window.
#include <new>

#include "app/session/session_state.h"
#include "app/session/sweep.h"

namespace geotherm::app {
namespace {

constexpr double kFactors[] = {0.25, 0.5, 1, 2, 4, 8, 16, 32, 64};

/// Tells, after each answer, what has come out so far.
template <class Tell>
void study_factors_of(const Model& model, const SourceSet& sources, MethodOptions options,
                      const Progress& progress, Tell tell) {
  ModelSolver solver(model);
  SessionStudy study{.running = true};
  std::vector<MethodOptions> steps;
  for (const double factor : kFactors) {
    options.time_step.factor = factor;
    steps.push_back(options);
  }
  const auto take = [&](const StudyRow& row) {
    if (row.mean_error) study.points.push_back({row.factor, *row.mean_error});
    if (row.failure) study.failure = row.failure->message;
    tell(study);
    return !row.failure;
  };
  const auto better = solver.reference(solver.reference_of(options.method, {Check::kOn}),
                                       {&sources, 1}, options.threads, part_of(progress, 0.0, 0.1));
  const Result<void> done = better ? sweep(solver, sources, steps, better->distances.front(), take,
                                           part_of(progress, 0.1, 1.0))
                                   : better.error();
  if (!done && done.error().code != ErrorCode::kCancelled) study.failure = done.error().message;
  study.running = false;
  tell(study);
}

}  // namespace

/// What is asked for, but for what a study changes.
ExploreRequest Session::State::studied_request() const {
  ExploreRequest request = wanted();
  request.options.time_step.factor = 1;
  request.kept.reset();
  request.target.reset();
  request.centre.reset();
  request.fields = request.nearest = false;
  request.check = Check::kOff;
  return request;
}

void Session::State::start_study() {
  const ExploreRequest request = studied_request();
  if (!study.cancelled && studied && studied->covers(request) && request.covers(*studied)) return;
  studied = request;
  study = {.running = true};
  const auto job = [this, number = ++studies, model = explored.model, set = explored.set,
                    options = state.options](const Progress& progress) {
    const auto tell = [this, number](const SessionStudy& so_far) { post(Studied{number, so_far}); };
    try {
      study_factors_of(model->model, set, options, progress, tell);
    } catch (const std::bad_alloc&) {
      tell({.failure = "the memory ended"});
    }
  };
  if (compare_worker) return compare_worker->start(job, true);
  job(hooks.progress);
  take();
}

/// What has been worked out so far stays to be seen; what is still said of it comes too late.
void Session::State::stop_study() {
  if (!study.running) return;
  ++studies;
  study.running = false;
  study.cancelled = true;
}

void Session::study() {
  State& s = *state_;
  if (s.compare.running || s.dragging || stale() || !s.explored.a || s.works()) return;
  s.start_study();
}

const SessionStudy& Session::error_study() const {
  static const SessionStudy kNone;
  const State& s = *state_;
  if (!s.studied) return kNone;
  const ExploreRequest now = s.studied_request();
  return s.studied->covers(now) && now.covers(*s.studied) ? s.study : kNone;
}

}  // namespace geotherm::app
