// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <cstdint>
#include <exception>
#include <memory>
#include <mutex>
#include <new>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "app/c/geotherm.h"
#include "app/session/answer.h"
#include "app/session/model.h"
#include "app/session/model_solver.h"
#include "app/session/report.h"
#include "app/session/state.h"
#include "geotherm/directions.h"
#include "geotherm/error.h"
#include "geotherm/many.h"
#include "geotherm/path.h"
#include "geotherm/progress.h"

// What stands behind the handles of geotherm.h, and what all its functions have in common.
namespace geotherm::c {

using app::ViewerState;

/// What geotherm_options is: of the state what the settings of models, methods and checks change.
struct Options {
  std::mutex lock;
  ViewerState state = app::initial_state();
};

/// What geotherm_model is: a model, and what directions and curves there need, which is made when
/// it is first asked for and kept. For several threads.
class HeldModel : public app::Model {
 public:
  explicit HeldModel(app::Model model) : app::Model(std::move(model)) {}

  /// Errors: those of Directions::build().
  Result<std::shared_ptr<const Directions>> directions(const Progress& progress) const;
  /// The last options' is kept. What a solver of the model has set up is shared. Errors: those of
  /// VectorHeat::build().
  Result<std::shared_ptr<const VectorHeat>> vector_heat(const SpreadOptions& options,
                                                        const Progress& progress) const;
  /// Of geodesics. Errors: those of ModelSolver::prepare().
  Result<std::shared_ptr<const PathFinder>> curve_finder(const Progress& progress) const;
  /// The method of a solver of this model.
  void note_method(const std::shared_ptr<const DistanceMethod>& method) const;

 private:
  mutable std::mutex lock_;
  mutable std::shared_ptr<const Directions> directions_;
  mutable SpreadOptions heat_options_;
  mutable std::shared_ptr<const VectorHeat> heat_;
  mutable std::shared_ptr<const PathFinder> finder_;
  mutable std::weak_ptr<const DistanceMethod> solver_method_;  ///< of the last solver
};

struct Solver {
  Solver(app::ModelSolver with, app::ReadyMethod by, const ViewerState& asked)
      : solver(std::move(with)), ready(std::move(by)), options(asked.options), check(asked.check) {}

  mutable std::timed_mutex lock;    ///< of what follows up to `ready`
  mutable app::ModelSolver solver;  ///< for answers with all there is to say
  mutable std::shared_ptr<const PathFinder> geodesics, exact_paths;
  const app::ReadyMethod ready;  ///< for distances alone, on any number of threads
  const MethodOptions options;
  const app::Check check;

  const app::Model& model() const { return solver.model(); }
};

/// An array by its name. Exactly one of the views has values.
struct NamedArray {
  std::string name;
  std::variant<std::vector<double>, std::vector<Index>, std::vector<std::int64_t>> values;
  std::int64_t columns = 1;
};

/// Lines with the mesh that they are on.
struct Lines {
  std::shared_ptr<const TriangleMesh> mesh;
  std::vector<Isoline> all;
  bool have_values = false;  ///< of isolines
};

/// What geotherm_answer is.
struct Answer {
  std::optional<app::Answer> solved;
  std::optional<Lines> lines;
  /// Texts beside the warnings by their names.
  std::vector<std::pair<std::string, std::string>> texts;
  std::vector<Warning> warnings;
  mutable std::mutex lock;
  mutable std::vector<std::unique_ptr<const NamedArray>> arrays;  ///< some are made when asked for
};

using Object = std::variant<std::shared_ptr<Options>, std::shared_ptr<const HeldModel>,
                            std::shared_ptr<const Solver>, std::shared_ptr<const Answer>>;

/// A handle for an object. Handles are numbers that are never used twice.
void* add_handle(Object object);
/// Nothing where it is none.
std::optional<Object> find_handle(const void* handle);
/// Whether it was one.
bool remove_handle(const void* handle);

/// The object of a handle. Errors: kBadInput, with the argument's name.
template <class T>
Result<std::shared_ptr<T>> object_of(const void* handle, const char* argument) {
  const auto found = find_handle(handle);
  if (found) {
    if (const auto* const object = std::get_if<std::shared_ptr<T>>(&*found)) return *object;
  }
  return Error{ErrorCode::kBadInput,
               std::string(argument) + (handle == nullptr ? " is NULL"
                                        : found           ? " is a handle of another kind"
                                                          : " is no handle, or was freed")};
}

/// The state of options; the initial one for NULL.
inline Result<ViewerState> state_of(const geotherm_options* options) {
  if (options == nullptr) return app::initial_state();
  const auto object = object_of<Options>(options, "options");
  if (!object) return object.error();
  const std::lock_guard lock((*object)->lock);
  return (*object)->state;
}

/// Puts an object behind a handle that the caller gets.
template <class Handle, class T>
void hand_out(std::shared_ptr<T> object, Handle** out) {
  *out = static_cast<Handle*>(add_handle(Object(std::move(object))));
}

inline Error bad_argument(const std::string& message, Hint hint = {}) {
  return {ErrorCode::kBadInput, message, std::move(hint)};
}

inline Result<void> require(const void* pointer, const char* argument) {
  if (pointer != nullptr) return {};
  return bad_argument(std::string(argument) + " is NULL");
}

/// Keeps the error for geotherm_last_error().
geotherm_status keep_error(const Error& error) noexcept;

/// Keeps a text for the caller until the thread's next one.
const char* keep_text(std::string text);

/// Runs what a function does; nothing that it throws gets out.
template <class Work>
geotherm_status guarded(const Work& work) noexcept try {
  const Result<void> done = work();
  return done ? GEOTHERM_OK : keep_error(done.error());
} catch (const std::bad_alloc&) {
  return keep_error({ErrorCode::kOutOfMemory, "the memory ended"});
} catch (const std::exception& failure) {
  return keep_error({ErrorCode::kNumericalFailure, failure.what()});
} catch (...) {
  return keep_error({ErrorCode::kNumericalFailure, "something was thrown that is no exception"});
}

/// A call with its watch as the library's progress. It knows the calls from whose progress it was
/// made, on whatever thread that was told.
class Watched {
 public:
  explicit Watched(const geotherm_watch* watch);
  ~Watched();
  Watched(const Watched&) = delete;
  Watched& operator=(const Watched&) = delete;
  const Progress& progress() const { return progress_; }

  /// The innermost call of this thread, null outside of all.
  static const Watched* innermost();
  /// Whether a call that this one was made from has locked the solver: it would wait for itself.
  bool is_within_one_that_holds(const Solver& solver) const;
  /// Notes what this call has locked, null for nothing.
  void holds(const Solver* solver) const { held_ = solver; }

 private:
  void watch_by(const geotherm_watch& watch);

  const Watched* const outer_;
  mutable std::atomic<const Solver*> held_ = nullptr;
  bool interruptible_ = false;
  Progress progress_;
};

/// Runs what a function does that hands out an answer: `fill` gets the object of the handle, the
/// progress and the answer, which it fills. `called`: what messages call `out`.
template <class T, class Fill>
geotherm_status answering(const void* handle, const char* argument, geotherm_answer** out,
                          const char* called, const geotherm_watch* watch,
                          const Fill& fill) noexcept {
  return guarded([&]() -> Result<void> {
    const auto object = object_of<T>(handle, argument);
    if (!object) return object.error();
    if (auto there = require(out, called); !there) return there;
    const Watched watched(watch);
    const auto made = std::make_shared<Answer>();
    if (auto done = fill(**object, watched.progress(), *made); !done) return done;
    hand_out(std::shared_ptr<const Answer>(made), out);
    return {};
  });
}

// arrays.cpp

/// Numbers of any type. `columns`: as many as there must be. Errors: kBadInput, with the name.
Result<std::vector<double>> numbers_in(const geotherm_array& array, std::int64_t columns,
                                       const std::string& name);
Result<std::vector<Vec3>> places_in(const geotherm_array& array, const std::string& name);
/// Whole numbers that fit an Index.
Result<std::vector<Index>> indices_in(const geotherm_array& array, std::int64_t columns,
                                      const std::string& name);
/// Whether numbers of this size can be written there. Errors: kBadInput, kOutOfMemory.
Result<void> check_output(const geotherm_array& array, std::int64_t rows, std::int64_t columns,
                          const std::string& name);
/// Writes row `row`. Precondition: check_output() has accepted the array. Errors: kBadInput (beyond
/// the range of float32).
Result<void> write_row(const geotherm_array& array, std::int64_t row,
                       std::span<const double> values);

// sources.cpp

/// One set of all points and texts. Errors: kBadInput, with the number of the source; kCancelled.
Result<app::ResolvedSources> one_set(const geotherm_sources* sources, const app::Model& model,
                                     const Progress& progress);
/// A set for each range of `starts` or, without these, for each point; then those of the text.
Result<app::EachSource> many_sets(const geotherm_sources* sources, const app::Model& model,
                                  const Progress& progress);

// solvers.cpp

/// The lock of a solver, which the innermost call of the thread holds.
class SolverLock {
 public:
  SolverLock(std::unique_lock<std::timed_mutex> lock, const Solver& solver);
  SolverLock(SolverLock&&) = default;
  ~SolverLock() { unlock(); }
  void unlock();

 private:
  std::unique_lock<std::timed_mutex> lock_;
};

/// The solver's lock, once other calls have let go of it. Errors: kBadInput (asked for from the
/// progress of the call that has it), kCancelled, also while it waits.
Result<SolverLock> lock_of(const Solver& solver, const Progress& progress);

// views.cpp

/// Errors: kBadInput, with the cure, where vertices lie nowhere.
Result<void> require_places(const app::Model& model, Hint cure = {});

// lines.cpp

/// Adds sentences to what there is to know of an answer.
inline void add_warnings(Answer& answer, const std::vector<Warning>& more) {
  answer.warnings.insert(answer.warnings.end(), more.begin(), more.end());
}
/// Keeps an array with an answer.
void keep(const Answer& answer, std::string name, auto values, std::int64_t columns = 1) {
  answer.arrays.push_back(
      std::make_unique<const NamedArray>(NamedArray{std::move(name), std::move(values), columns}));
}
/// The arrays of Answer::lines.
void keep_lines(const Answer& answer);
/// The points of all sources, in their order. Adds to `warnings` what there is to know of their
/// places. Errors: kBadInput, kCancelled.
Result<std::vector<SurfacePoint>> points_in_order(const geotherm_sources* sources,
                                                  const app::Model& model,
                                                  std::vector<Warning>& warnings,
                                                  const Progress& progress);

}  // namespace geotherm::c
