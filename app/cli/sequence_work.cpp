// SPDX-License-Identifier: MIT
#include "app/cli/sequence_work.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <atomic>
#include <future>
#include <memory>
#include <optional>
#include <utility>

#include "app/cli/many_work.h"
#include "app/session/machine.h"
#include "app/session/model_solver.h"
#include "app/session/wording.h"
#include "app/text/text.h"
#include "geotherm/build_method.h"
#include "solver/core/memory.h"
#include "solver/core/parallel.h"
#include "solver/core/stopwatch.h"

namespace geotherm::app {
namespace {

constexpr std::string_view kFramesStage = "frames";
/// On a thread of its own, or where there is none to be had when its result is asked for.
constexpr auto kBeside = std::launch::async | std::launch::deferred;
/// Frames after which freed memory is handed back, so that what threads leave behind does not grow
/// with the frames. To do it after each would cost a tenth of their time.
constexpr std::int64_t kBetweenReleases = 16;
/// Bad frames that are named in warnings, and frames whose warnings are shown.
constexpr std::size_t kMaxNamed = 5;

/// A frame before it is solved.
struct ReadFrame {
  Result<std::shared_ptr<const TriangleMesh>> mesh;
  double milliseconds = 0;                    ///< of reading
  std::optional<Result<ReadyMethod>> method;  ///< where it was set up as well
};

/// Reads a frame on a thread of its own and, where `earlier` is a method on another frame, sets its
/// method up. When it is dropped, a set-up that is still going on is cancelled.
class ComingFrame {
 public:
  ComingFrame(const Sequence& sequence, std::int64_t k, const ReadyMethod& earlier)
      : frame_(std::async(kBeside, [this, &sequence, k, earlier] {
          const Stopwatch watch;
          auto mesh = sequence.frames.read(k);
          const double milliseconds = watch.milliseconds();
          if (!mesh) return ReadFrame{mesh.error(), milliseconds, {}};
          ReadFrame frame{std::make_shared<const TriangleMesh>(*std::move(mesh)), milliseconds, {}};
          if (earlier.method) frame.method = set_up(*frame.mesh, earlier, sequence.frames.name(k));
          return frame;
        })) {}
  ~ComingFrame() { dropped_ = true; }
  ComingFrame(const ComingFrame&) = delete;
  ComingFrame& operator=(const ComingFrame&) = delete;

  ReadFrame get() { return frame_.get(); }

 private:
  Result<ReadyMethod> set_up(const std::shared_ptr<const TriangleMesh>& mesh,
                             const ReadyMethod& earlier, const std::string& name) const {
    const Stopwatch watch;
    MethodOptions options = earlier.options;
    options.threads = thread_count(options.threads) - 1;  // one is at the query
    auto made = build_method_moved(mesh, options, earlier.method.get(),
                                   [this](std::string_view, double) { return !dropped_; });
    if (!made) return about_model(name, made.error());
    const SetupTiming timing = (*made)->timing();
    return ReadyMethod{*std::move(made), earlier.options, timing, watch.milliseconds()};
  }

  std::atomic<bool> dropped_ = false;
  std::future<ReadFrame> frame_;  ///< last: its end is waited for first
};

/// What goes on, whatever a frame holds.
bool ends_the_run(const Error& error) {
  return error.code == ErrorCode::kCancelled || error.code == ErrorCode::kOutOfMemory;
}

/// Solves frame after frame. Every answer takes the place of the one before it.
class FrameSolver {
 public:
  FrameSolver(const Sequence& sequence, SequenceFigures& figures)
      : sequence_(sequence), figures_(figures) {}

  /// Precondition: the frame has a mesh.
  Result<void> solve(std::int64_t k, const ReadFrame& frame, const Progress& progress) {
    if (frame.method && !*frame.method) return frame.method->error();
    return figures_.answer ? solve_next(k, frame, progress) : solve_first(k, *frame.mesh, progress);
  }

  /// What the next frame is set up from while `frame` is solved. None for heat, whose set-up takes
  /// all threads and whose query is short, before the first answer, and where there is one thread.
  ReadyMethod to_follow(const ReadFrame& frame) const {
    if (!figures_.answer || figures_.answer->method->heat() != nullptr) return {};
    const Answer& answer = *figures_.answer;
    if (thread_count(answer.options.threads) == 1) return {};
    if (frame.method && *frame.method) return **frame.method;
    return {answer.method, answer.options, {}, 0};
  }

 private:
  Result<void> solve_first(std::int64_t k, std::shared_ptr<const TriangleMesh> mesh,
                           const Progress& progress) {
    Model model = sequence_.model;
    model.mesh = std::move(mesh);
    model.name = sequence_.frames.name(k);
    solver_.emplace(std::move(model));
    auto answer = solver_->solve(sequence_.options, sequence_.sources,
                                 {sequence_.query, sequence_.check}, progress);
    if (!answer) return answer.error();
    count_times(*answer);
    figures_.warnings = answer->warnings;
    figures_.answer = *std::move(answer);
    return {};
  }

  /// By the method that answered in the first frame, which alone is checked.
  Result<void> solve_next(std::int64_t k, const ReadFrame& frame, const Progress& progress) {
    Answer& first = *figures_.answer;
    Model model = first.model;
    model.mesh = *frame.mesh;
    model.name = sequence_.frames.name(k);
    if (frame.method) {
      first.method = (*frame.method)->method;  // lets go of the one before, beside the next one
      solver_->move(std::move(model), **frame.method);
    } else {
      solver_->move(std::move(model));
    }
    auto answer = solver_->solve(first.options, sequence_.sources, {sequence_.query}, progress);
    if (!answer) return answer.error();
    count_times(*answer);
    note(answer->model.name, answer->warnings);
    answer->error = first.error;
    answer->replaced = std::move(first.replaced);
    answer->warnings = std::move(first.warnings);
    first = *std::move(answer);
    return {};
  }

  void count_times(const Answer& answer) {
    figures_.setup_ms += answer.setup_ms;
    figures_.query_ms += answer.result.timing.query;
  }

  /// Adds what was not said of the first frame.
  void note(const std::string& name, const std::vector<Warning>& warnings) {
    for (Warning warning : warnings) {
      if (std::ranges::find(figures_.answer->warnings, warning) != figures_.answer->warnings.end())
        continue;
      if (noted_ == kMaxNamed) return;
      ++noted_;
      warning.message.insert(0, name + ": ");
      figures_.warnings.push_back(std::move(warning));
    }
  }

  const Sequence& sequence_;
  SequenceFigures& figures_;
  std::optional<ModelSolver> solver_;
  std::size_t noted_ = 0;
};

void note_bad_frames(const Sequence& sequence, SequenceFigures& figures) {
  if (figures.bad.empty()) return;
  for (std::size_t i = 0; i < std::min(figures.bad.size(), kMaxNamed); ++i) {
    figures.warnings.push_back({"left out: " + figures.bad[i].why});
  }
  if (figures.bad.size() <= kMaxNamed) return;
  const auto more = std::ssize(figures.bad) - static_cast<std::ptrdiff_t>(kMaxNamed);
  figures.warnings.push_back({counted(more, "more frame is", "more frames are") + " left out, of " +
                              counted(sequence.frames.count(), "frame", "frames")});
}

}  // namespace

void add_sequence_option(CLI::App& command, std::string& frames) {
  command
      .add_option("--sequence", frames,
                  "the surface moves: where its vertices are, frame after frame, in numbered "
                  "meshes (frame_%04d.obj), in one .npy (frames x vertices x 3), .pc2 or .mdd, or "
                  "in an animated .glb; faces and sources are the model's")
      ->type_name("FRAMES")
      ->group("Sequences");
}

void add_sequence_options(CLI::App& command, SequenceArguments& arguments) {
  add_sequence_option(command, arguments.frames);
  command
      .add_flag("--skip-bad", arguments.skip_bad,
                "with --sequence: a frame that cannot be read or solved is left out (NaN in rows) "
                "and counted; otherwise it ends the run")
      ->group("Sequences");
}

Result<void> refuse_with_sequence(const SequenceArguments& sequence, const CheckArguments& check) {
  if (sequence.frames.empty()) {
    if (!sequence.skip_bad) return {};
    return Error{ErrorCode::kBadInput, "--skip-bad is about --sequence", {"leave it out"}};
  }
  if (sequence.skip_bad && check.on_poor == geotherm::to_text(OnPoor::kFail)) {
    return Error{ErrorCode::kBadInput,
                 "--on-poor fail ends the run and --skip-bad goes on",
                 {"leave one of them out"}};
  }
  return {};
}

Result<Sequence> begin_sequence(const std::string& name, const SequenceArguments& arguments,
                                const ViewerState& asked, const std::vector<Source>& sources,
                                const CheckSettings& check, const Progress& progress) {
  auto model = load_model(name, asked.reading, progress);
  if (!model) return model.error();
  if (!model->is_mesh()) {
    Hint hint{"give a mesh"};
    if (model->space) hint = {"give a mesh, or ", SettingHint{"domain", {"triangles"}}};
    return Error{ErrorCode::kBadInput,
                 "--sequence moves the vertices of triangles, and " + one_line(model->name) +
                     " is read as " + std::string(domain_name(*model)),
                 std::move(hint)};
  }
  auto placed = resolve_sources(sources, *model);
  if (!placed) return placed.error();
  auto frames = Frames::open(arguments.frames, model->mesh);
  if (!frames) return about("--sequence", frames.error());
  return Sequence{*std::move(model), *std::move(frames), arguments.frames,   arguments.skip_bad,
                  asked.options,     *std::move(placed), {.quality = false}, check};
}

Result<SequenceFigures> solve_frames(const Sequence& sequence, const TakeAnswer& take,
                                     const std::string& output, const Progress& progress,
                                     const Announce& announce) {
  const Frames& frames = sequence.frames;
  const std::int64_t count = frames.count();
  const std::string all = counted(count, "frame", "frames");
  const Progress estimate = with_estimate({}, announce, kFramesStage, all, output);
  SequenceFigures figures;
  FrameSolver solver(sequence, figures);
  const Stopwatch watch;
  auto next = std::make_unique<ComingFrame>(sequence, 0, ReadyMethod{});
  for (std::int64_t k = 0; k < count; ++k) {
    const double from = static_cast<double>(k) / static_cast<double>(count);
    const double to = static_cast<double>(k + 1) / static_cast<double>(count);
    const std::string stage = "frame " + grouped(k + 1) + " of " + all;
    if (!report(progress, stage, from)) return cancelled_error();
    const ReadFrame read = next->get();
    figures.read_ms += read.milliseconds;
    next.reset();
    if (k + 1 < count) {
      next = std::make_unique<ComingFrame>(sequence, k + 1, solver.to_follow(read));
    }
    const Result<void> solved =
        read.mesh ? solver.solve(k, read, part_of(with_prefix(progress, stage + ": "), from, to))
                  : Result<void>(read.mesh.error());
    if (!solved && (!sequence.skip_bad || ends_the_run(solved.error()))) return solved.error();
    if (!solved) figures.bad.push_back({k, to_text(solved.error())});
    if (auto taken = take(k, solved ? &*figures.answer : nullptr); !taken) return taken.error();
    if (k % kBetweenReleases == 0) release_freed_memory();
    report(estimate, kFramesStage, to);
  }
  figures.wall_ms = watch.milliseconds();
  figures.peak_rss_mb = peak_rss_mb();
  if (!figures.answer) {
    return Error{ErrorCode::kBadFile,
                 "none of " + all + " can be solved; the first says: " + figures.bad.front().why};
  }
  figures.answer->model.name = sequence.model.name;
  note_bad_frames(sequence, figures);
  return figures;
}

std::string frames_in_words(const Sequence& sequence, const SequenceFigures& figures) {
  std::string text = grouped(sequence.frames.count()) + " of " + one_line(sequence.path);
  if (!figures.bad.empty()) text += ", " + grouped(std::ssize(figures.bad)) + " of them bad";
  return text;
}

Json sequence_json(const Sequence& sequence, const SequenceFigures& figures) {
  const Answer& answer = *figures.answer;
  const auto count = static_cast<double>(sequence.frames.count());
  Json bad = Json::array();
  for (const BadFrame& frame : figures.bad) {
    bad.push_back({{"frame", sequence.frames.number(frame.k)}, {"reason", frame.why}});
  }
  Json json = {
      {"model", model_json(sequence.model, answer.mesh)},
      {"options", options_json(*answer.method, answer.options, answer.result)},
      {"sources", sources_json(sequence.sources.set)},
      {"frames",
       {{"path", sequence.path},
        {"count", sequence.frames.count()},
        {"first", sequence.frames.number(0)},
        {"bad", figures.bad.size()},
        {"bad_frames", std::move(bad)}}},
      {"timing_ms",
       {{"load", sequence.model.load_ms},
        {"read", figures.read_ms},
        {"setup", figures.setup_ms},
        {"query", figures.query_ms},
        {"frames", figures.wall_ms},
        {"frame", figures.wall_ms / count}}},
      {"memory_mb", {{"factor", answer.method->memory_mb()}, {"peak_rss", figures.peak_rss_mb}}},
      {"warnings", to_text(figures.warnings)}};
  if (answer.error) json["error"] = error_json(*answer.error);
  if (answer.replaced) json["replaced"] = error_json(*answer.replaced);
  return json;
}

std::string frame_times_in_words(const Sequence& sequence, const SequenceFigures& figures) {
  const auto count = static_cast<double>(sequence.frames.count());
  const auto solved = count - static_cast<double>(figures.bad.size());
  return milliseconds(figures.wall_ms / count) + " ms a frame: set-up " +
         milliseconds(figures.setup_ms / solved) + ", query " +
         milliseconds(figures.query_ms / solved) + ", reading " +
         milliseconds(figures.read_ms / count) + " beside the one before";
}

}  // namespace geotherm::app
