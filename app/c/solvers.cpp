// SPDX-License-Identifier: MIT
// Solvers, and distances from them.
#include <algorithm>
#include <chrono>
#include <memory>
#include <utility>

#include "app/c/handles.h"
#include "app/session/wording.h"
#include "app/text/text.h"
#include "geotherm/io.h"
#include "solver/core/memory.h"
#include "solver/core/text.h"

namespace geotherm::c {
namespace {

using app::Model;

Result<std::shared_ptr<const Solver>> made_ready(app::ModelSolver with, const ViewerState& asked,
                                                 const Progress& progress) {
  with.want_methods({asked.options});
  auto ready = with.prepare(asked.options, progress);
  if (!ready) return ready.error();
  return std::make_shared<const Solver>(std::move(with), *std::move(ready), asked);
}

/// How far the rows of many sets go.
class Selection {
 public:
  static Result<Selection> build(const geotherm_rows& rows, Index vertices) {
    if (!(rows.max_distance > 0)) {
      return bad_argument("max_distance is " + number_text(rows.max_distance),
                          {"give a length above 0, or infinity"});
    }
    Selection out;
    out.reach_.max_distance = rows.max_distance;
    if (rows.targets == nullptr) {
      out.reach_.sparse = rows.max_distance < kUnreached;
      return out;
    }
    if (rows.target_count < 1) return bad_argument("targets is empty");
    for (std::int64_t i = 0; i < rows.target_count; ++i) {
      const std::int64_t v = rows.targets[i];
      if (v < 0 || v >= vertices) {
        return bad_argument("targets: there is no vertex " + std::to_string(v) +
                                ", which is number " + std::to_string(i),
                            {"vertices are 0 to " + std::to_string(vertices - 1)});
      }
      out.reach_.targets.push_back(static_cast<Index>(v));
    }
    return out;
  }

  std::int64_t columns(Index vertices) const {
    return reach_.targets.empty() ? vertices : std::ssize(reach_.targets);
  }
  const Reach& reach() const { return reach_; }
  void make_sparse() { reach_.sparse = true; }

  /// The whole row. Valid until the next one.
  std::span<const double> row_of(const DistanceResult& answer, Index vertices) {
    if (!reach_.sparse) return answer.distances;
    for (const Index v : in_row_) row_[static_cast<std::size_t>(v)] = kUnreached;
    row_.resize(static_cast<std::size_t>(vertices), kUnreached);
    in_row_ = answer.vertices;
    for (std::size_t i = 0; i < in_row_.size(); ++i) {
      row_[static_cast<std::size_t>(in_row_[i])] = answer.distances[i];
    }
    return row_;
  }

 private:
  Reach reach_;
  std::vector<double> row_;
  std::vector<Index> in_row_;  ///< those in row_ that are finite
};

Result<void> stream(const Solver& solver, const app::EachSource& each, const Reach& reach,
                    const Progress& progress, const AnswerSink& take) {
  const Index vertices = solver.model().mesh->vertex_count();
  StreamOptions options;
  options.query.quality = false;
  options.query.reach = reach;
  options.chunk = std::clamp<std::size_t>(
      each.sets.size(), 1, good_chunk(vertices, solver.options.threads, free_memory()));
  return stream_answers(*solver.ready.method, each.sets, options, take, progress);
}

Result<void> stream_to_file(const Solver& solver, const app::EachSource& each,
                            const geotherm_rows& rows, Selection& selection,
                            const Progress& progress) {
  const std::string path = rows.path;
  const bool sparse = io::file_extension(path) == ".npz";
  if (io::file_extension(path) != ".npy" && !sparse) {
    return Error{ErrorCode::kNotAvailable,
                 printable(path) + ": rows are written as .npy or, sparse, as .npz",
                 {"choose another name"}};
  }
  if (sparse && rows.targets != nullptr) {
    return bad_argument("targets: sparse rows are of all vertices",
                        {"write a .npy, or leave targets out"});
  }
  if (rows.array.type != GEOTHERM_FLOAT64 && rows.array.type != GEOTHERM_FLOAT32) {
    return bad_argument("rows.array must be of float64 or float32");
  }
  const Index vertices = solver.model().mesh->vertex_count();
  const auto columns = static_cast<std::uint64_t>(selection.columns(vertices));
  const NpyType type = rows.array.type == GEOTHERM_FLOAT32 ? NpyType::kFloat32 : NpyType::kFloat64;
  if (sparse) {
    selection.make_sparse();
    auto file = SparseRows::open(path, columns, type);
    if (!file) return file.error();
    const auto done = stream(solver, each, selection.reach(), progress,
                             [&](std::size_t, DistanceResult&& answer) {
                               return file->append(answer.vertices, answer.distances);
                             });
    return done ? file->finish() : done;
  }
  auto file = NpyRows::open(path, each.sets.size(), columns, type);
  if (!file) return file.error();
  const auto done =
      stream(solver, each, selection.reach(), progress, [&](std::size_t, DistanceResult&& answer) {
        return file->append(selection.row_of(answer, vertices));
      });
  return done ? file->finish() : done;
}

Result<void> stream_to_memory(const Solver& solver, const app::EachSource& each,
                              const geotherm_array& array, Selection& selection,
                              const Progress& progress) {
  const Index vertices = solver.model().mesh->vertex_count();
  auto fits = check_output(array, std::ssize(each.sets), selection.columns(vertices), "out");
  if (!fits) return fits;
  return stream(
      solver, each, selection.reach(), progress, [&](std::size_t row, DistanceResult&& answer) {
        return write_row(array, static_cast<std::int64_t>(row), selection.row_of(answer, vertices));
      });
}

/// The words of geotherm_solve().
Result<app::Wanted> wanted_by(const Solver& solver, std::string_view words) {
  app::Wanted wanted;
  wanted.check.against = solver.check;
  const auto& space = solver.model().space;
  const bool checks =
      !space || space->reference_method() != MethodKind::kHeat;  // there is a better method
  while (!words.empty()) {
    const std::string_view word = words.substr(0, words.find(' '));
    words.remove_prefix(std::min(word.size() + 1, words.size()));
    if (word == "labels") {
      wanted.query.nearest = true;
    } else if (word == "fields") {
      wanted.query.fields = solver.options.method == MethodKind::kHeat;
    } else if (word.starts_with("max-distance=")) {
      const std::string text(word.substr(word.find('=') + 1));
      const auto most = app::number_in<double>(text);
      if (!most || !(*most > 0)) {
        return bad_argument("max_distance is " + printable(text), {"give a length above 0"});
      }
      wanted.query.reach.max_distance = *most;
    } else if (word.starts_with("check=")) {
      const auto check = parse<app::Check>(word.substr(word.find('=') + 1));
      if (!check) return check.error();
      wanted.check.against = *check;
    } else if (!word.empty()) {
      return bad_argument("wanted: there is no '" + printable(word) + "'",
                          {"there are labels, fields, check=... and max-distance=..."});
    }
  }
  if (!checks) wanted.check.against = app::Check::kOff;
  return wanted;
}

}  // namespace

SolverLock::SolverLock(std::unique_lock<std::timed_mutex> lock, const Solver& solver)
    : lock_(std::move(lock)) {
  Watched::innermost()->holds(&solver);
}

void SolverLock::unlock() {
  if (!lock_.owns_lock()) return;
  Watched::innermost()->holds(nullptr);
  lock_.unlock();
}

Result<SolverLock> lock_of(const Solver& solver, const Progress& progress) {
  if (Watched::innermost()->is_within_one_that_holds(solver)) {
    return bad_argument("the solver is at work for the call whose progress asks it",
                        {"ask it when that call has returned, or another solver"});
  }
  std::unique_lock lock(solver.lock, std::defer_lock);
  while (!lock.try_lock_for(std::chrono::milliseconds(20))) {
    if (!report(progress, "waiting for the solver", -1)) return cancelled_error();
  }
  return SolverLock(std::move(lock), solver);
}

}  // namespace geotherm::c

using namespace geotherm;     // NOLINT: the functions below are C
using namespace geotherm::c;  // NOLINT

geotherm_status geotherm_solver_new(const geotherm_model* model, const geotherm_options* options,
                                    const geotherm_watch* watch, geotherm_solver** solver) {
  return guarded([&]() -> Result<void> {
    const auto object = object_of<const HeldModel>(model, "model");
    if (!object) return object.error();
    if (auto there = require(solver, "solver"); !there) return there;
    const auto asked = state_of(options);
    if (!asked) return asked.error();
    const Watched watched(watch);
    auto made = made_ready(app::ModelSolver(**object), *asked, watched.progress());
    if (!made) return made.error();
    (*object)->note_method((*made)->ready.method);
    hand_out(*std::move(made), solver);
    return {};
  });
}

geotherm_status geotherm_solver_move(const geotherm_solver* solver, const geotherm_array* positions,
                                     const geotherm_watch* watch, geotherm_solver** moved,
                                     geotherm_model** model) {
  return guarded([&]() -> Result<void> {
    const auto object = object_of<const Solver>(solver, "solver");
    if (!object) return object.error();
    if (auto there = require(positions, "positions"); !there) return there;
    if (auto there = require(moved, "moved"); !there) return there;
    Model next = (*object)->model();
    if (auto surface = app::refuse_space(next, "moving surfaces are"); !surface) return surface;
    auto places = places_in(*positions, "positions");
    if (!places) return places.error();
    auto mesh = next.mesh->moved(*std::move(places));
    if (!mesh) return mesh.error();
    next.mesh = std::make_shared<const TriangleMesh>(*std::move(mesh));
    const Watched watched(watch);
    auto lock = lock_of(**object, watched.progress());
    if (!lock) return lock.error();
    app::ModelSolver copy = (*object)->solver;
    lock->unlock();
    copy.move(next);
    ViewerState asked = app::initial_state();
    asked.options = (*object)->options;
    asked.check = (*object)->check;
    auto made = made_ready(std::move(copy), asked, watched.progress());
    if (!made) return made.error();
    hand_out(*std::move(made), moved);
    if (model != nullptr) hand_out(std::make_shared<const HeldModel>(std::move(next)), model);
    return {};
  });
}

geotherm_status geotherm_distance(const geotherm_solver* solver, const geotherm_sources* sources,
                                  const geotherm_array* out, const geotherm_watch* watch) {
  return guarded([&]() -> Result<void> {
    const auto object = object_of<const Solver>(solver, "solver");
    if (!object) return object.error();
    if (auto there = require(out, "out"); !there) return there;
    const Model& model = (*object)->model();
    geotherm_array row = *out;  // a list is one row
    if (row.columns == 1) {
      row.columns = row.rows;
      row.column_stride = row.row_stride;
      row.rows = 1;
    }
    if (auto fits = check_output(row, 1, model.mesh->vertex_count(), "out"); !fits) return fits;
    const Watched watched(watch);
    const auto placed = one_set(sources, model, watched.progress());
    if (!placed) return placed.error();
    const auto answer =
        (*object)->ready.method->solve(placed->set, {.quality = false}, watched.progress());
    if (!answer) return answer.error();
    return write_row(row, 0, answer->distances);
  });
}

geotherm_status geotherm_distances(const geotherm_solver* solver, const geotherm_sources* sources,
                                   geotherm_rows* rows, const geotherm_watch* watch) {
  return guarded([&]() -> Result<void> {
    const auto object = object_of<const Solver>(solver, "solver");
    if (!object) return object.error();
    if (auto there = require(rows, "rows"); !there) return there;
    const Model& model = (*object)->model();
    auto selection = Selection::build(*rows, model.mesh->vertex_count());
    if (!selection) return selection.error();
    const Watched watched(watch);
    const auto each = many_sets(sources, model, watched.progress());
    if (!each) return each.error();
    if (each->sets.empty()) return bad_argument("sources is empty", {"name at least one"});
    if (rows->path == nullptr && rows->array.data == nullptr) {
      rows->array.rows = std::ssize(each->sets);
      rows->array.columns = selection->columns(model.mesh->vertex_count());
      return {};
    }
    if (rows->path != nullptr) {
      return stream_to_file(**object, *each, *rows, *selection, watched.progress());
    }
    return stream_to_memory(**object, *each, rows->array, *selection, watched.progress());
  });
}

geotherm_status geotherm_solve(const geotherm_solver* solver, const geotherm_sources* sources,
                               const char* wanted, const geotherm_watch* watch,
                               geotherm_answer** answer) {
  auto fill = [&](const Solver& held, const Progress& progress, Answer& made) -> Result<void> {
    const auto asked = wanted_by(held, wanted == nullptr ? "" : wanted);
    if (!asked) return asked.error();
    const auto placed = one_set(sources, held.model(), progress);
    if (!placed) return placed.error();
    const auto lock = lock_of(held, progress);
    if (!lock) return lock.error();
    auto solved = held.solver.solve(held.options, *placed, *asked, progress);
    if (!solved) return solved.error();
    made.solved = *std::move(solved);
    return {};
  };
  return answering<const Solver>(solver, "solver", answer, "answer", watch, fill);
}
