// SPDX-License-Identifier: MIT
// The error over the time factor, worked out beside the window.
#include <new>

#include "app/session/model_solver.h"
#include "app/session/session_state.h"

namespace geotherm::app {
namespace {

constexpr double kFactors[] = {0.25, 0.5, 1, 2, 4, 8, 16, 32, 64};

/// One answer after the other, each told when it is there. False: cancelled.
template <class Tell>
void study_factors_of(const Model& model, const ResolvedSources& sources, MethodOptions options,
                      const Progress& progress, Tell tell) {
  ModelSolver solver(model, ModelSolver::Use::kSession);
  SessionStudy study{.running = true};
  for (const double factor : kFactors) {
    options.time_step.factor = factor;
    auto answer = solver.solve(options, sources, {{.quality = false}}, progress);
    Result<void> done = answer ? Result<void>() : answer.error();
    if (done) done = solver.check(*answer, {.against = Check::kOn, .quick = true}, progress);
    if (!done) {
      if (done.error().code != ErrorCode::kCancelled) study.failure = done.error().message;
      break;
    }
    if (answer->error && answer->error->measured) {
      study.points.push_back({factor, answer->error->figures.mean_relative});
    }
    tell(study);
  }
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
      study_factors_of(model->model, {set, {}}, options, progress, tell);
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
