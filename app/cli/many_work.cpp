// SPDX-License-Identifier: MIT
#include "app/cli/many_work.h"

#include <algorithm>
#include <cstring>
#include <optional>
#include <type_traits>
#include <utility>

#include "app/session/answer.h"
#include "app/session/machine.h"
#include "app/session/progress.h"
#include "app/session/wording.h"
#include "app/text/text.h"
#include "geotherm/heat_method.h"
#include "solver/core/memory.h"
#include "solver/core/parallel.h"
#include "solver/core/stopwatch.h"

namespace geotherm::app {
namespace {

/// Warnings of answers that are shown; they are alike from source to source.
constexpr std::size_t kMaxWarnings = 5;

}  // namespace

DistanceSummary sums_of_all(const DistanceSummary& mine, const Ranks& ranks) {
  static_assert(std::is_trivially_copyable_v<DistanceSummary>);
  std::string bytes(sizeof mine, '\0');
  std::memcpy(bytes.data(), &mine, sizeof mine);
  DistanceSummary all;
  for (const std::string& each : ranks.all_gather(bytes)) {
    DistanceSummary sums;
    std::memcpy(&sums, each.data(), sizeof sums);
    all.add(sums);
  }
  return all;
}

void add_warnings(std::vector<Warning>& all, const std::vector<Warning>& more) {
  for (const Warning& warning : more) {
    if (std::ranges::find(all, warning) == all.end()) all.push_back(warning);
  }
}

Result<NpyType> number_type(const SolveArguments& arguments) {
  if (arguments.dtype.empty()) {
    return arguments.float32 ? NpyType::kFloat32 : NpyType::kFloat64;
  }
  const auto type = parse<NpyType>(arguments.dtype);
  if (!type) return about("--dtype", type.error());
  if (arguments.float32 && *type != NpyType::kFloat32) {
    return Error{ErrorCode::kBadInput,
                 "--dtype " + arguments.dtype + " and --float32 disagree",
                 {"leave one of them out"}};
  }
  return *type;
}

Result<void> refuse_single_options(const SolveArguments& arguments, const std::string& option) {
  const auto refuse = [&option](const std::string& other) {
    return Error{
        ErrorCode::kBadInput,
        other + " is about one source set, and " + option + " solves for each source by itself",
        {"leave one of them out"}};
  };
  if (arguments.check.check) return refuse("--check");
  if (!arguments.fields.empty()) return refuse("--fields");
  if (arguments.labels) return refuse("--labels");
  if (!arguments.bake.empty()) return refuse("--bake-colours");
  return {};
}

Result<std::vector<Index>> vertices_of_each(const EachSource& each, const std::string& option) {
  std::vector<Index> vertices;
  for (const SourceSet& set : each.sets) {
    const SurfacePoint* const point = only_point(set);
    const bool is_vertex = point != nullptr && point->is_vertex();
    if (!is_vertex || !set.offsets.empty()) {
      return Error{ErrorCode::kBadInput,
                   option + " " + std::to_string(vertices.size() + 1) +
                       (is_vertex ? " has an offset" : " is no vertex"),
                   {"distances are between vertices, such as 3,99,512 or random:20"}};
    }
    vertices.push_back(point->vertex);
  }
  return vertices;
}

Result<Reach> reach_of(const SolveArguments& arguments, const Model& model) {
  Reach reach;
  const auto most = max_distance_in(arguments.max_distance);
  if (!most) return most.error();
  reach.max_distance = *most;
  auto targets = targets_of(arguments.targets, model);
  if (!targets) return targets.error();
  reach.targets = *std::move(targets);
  return reach;
}

Result<std::vector<Index>> targets_of(const std::vector<std::string>& texts, const Model& model) {
  if (texts.empty()) return std::vector<Index>();
  std::vector<Source> named;
  for (const std::string& text : texts) {
    auto spec = parse_source(text);
    if (!spec) return about("--target", spec.error());
    named.push_back({*std::move(spec), "--target " + shortened(text)});
  }
  const auto each = resolve_each(named, model);
  if (!each) return each.error();
  return vertices_of_each(*each, "--target: number");
}

namespace {

Result<ManySources> begin_many(const SolveArguments& arguments, const Ranks& ranks,
                               const Progress& progress) {
  const auto asked = settings_in(arguments.settings);
  if (!asked) return asked.error();
  const MethodOptions& options = asked->options;
  const auto check = check_settings(arguments.check);
  if (!check) return check.error();
  const auto named = some_sources_of(arguments.sources);
  if (!named) return named.error();
  auto model = load_model(arguments.model, asked->reading, progress);
  if (!model) return model.error();
  if (auto pin = check_pin(options.constraint, *model); !pin) return pin.error();
  auto sources = resolve_each(*named, *model);
  if (!sources) return sources.error();
  auto reach = reach_of(arguments, *model);
  if (!reach) return reach.error();
  MeshReport mesh = inspect_mesh(*model->mesh);
  describe_space(*model, mesh);
  std::string none_yet((sources->sets.size() + kBlockRows - 1) / kBlockRows, '0');
  ManySources work{.model = *std::move(model),
                   .mesh = mesh,
                   .options = options,
                   .sources = *std::move(sources),
                   .reach = *std::move(reach),
                   .check = *check,
                   .ranks = ranks,
                   .rows = {}};
  share_out(work, none_yet);
  return work;
}

}  // namespace

void share_out(ManySources& work, std::string& marks) {
  if (marks.find('0') == std::string::npos) marks.front() = '0';
  work.rows.clear();
  for (std::size_t row = 0; row < work.sources.sets.size(); ++row) {
    if (marks[row / kBlockRows] == '0') work.rows.push_back(row);
  }
  const std::size_t rows = work.rows.size(), blocks = (rows + kBlockRows - 1) / kBlockRows;
  const auto ranks = static_cast<std::size_t>(work.ranks.count());
  // The first rank, which reports, has some always.
  const auto begin_of = [&](int rank) {
    const std::size_t before = blocks * static_cast<std::size_t>(rank) + ranks - 1;
    return std::min(rows, before / ranks * kBlockRows);
  };
  work.first = begin_of(work.ranks.rank());
  work.count = begin_of(work.ranks.rank() + 1) - work.first;
  work.chunk =
      std::min(good_chunk(work.model.mesh->vertex_count(), work.options.threads, free_memory()),
               std::max<std::size_t>(work.count, 1));
}

Result<ManySources> begin_many(const SolveArguments& arguments, const Result<void>& before,
                               const Progress& progress) {
  const auto ranks = Ranks::join();
  if (!ranks) return ranks.error();
  if (const auto all = ranks->agree(before); !all) return all.error();
  return ranks->agree_on(begin_many(arguments, *ranks, progress));
}

Result<void> check_room(const std::string& path, double bytes) {
  const auto room = room_for(path);
  if (!room || bytes <= static_cast<double>(*room)) return {};
  return Error{ErrorCode::kBadFile,
               one_line(path) + ": the file would take " + bytes_in_words(bytes) + ", and " +
                   bytes_in_words(static_cast<double>(*room)) + " are free there",
               {"take fewer rows, --dtype float32 or another place"}};
}

namespace {

Result<ManyFigures> solve_share(const ManySources& work, const SolveArguments& arguments,
                                const TakeRow& take, const std::string& output,
                                const Progress& progress, const Announce& announce) {
  constexpr double kMethodShare = kSetupShare / 2;  // the other half is the check's
  ModelSolver solver(work.model);
  MethodOptions options = work.options;
  if (!work.ranks.alone()) options.strict = true;  // rows have the bits of one backend
  auto ready = solver.prepare(options, part_of(progress, 0.0, kMethodShare));
  if (!ready) return ready.error();
  keep_freed_memory();  // from here on answers come and go
  ManyFigures figures;
  add_warnings(figures.warnings, work.model.notes);
  if (work.check.against != Check::kOff) {
    auto checked = solver.check_method(*ready, work.sources.sets, work.check,
                                       part_of(progress, kMethodShare, kSetupShare));
    if (!checked) return checked.error();
    *ready = std::move(checked->by);
    figures.error = std::move(checked->error);
    figures.replaced = std::move(checked->replaced);
    add_warnings(figures.warnings, checked->warnings);
  }
  figures.method = std::move(ready->method);
  figures.options = ready->options;
  figures.options.strict = work.options.strict;
  add_warnings(figures.warnings, figures.method->warnings());
  add_warnings(figures.warnings, work.sources.warnings);

  const auto rows = std::span(work.rows).subspan(work.first, work.count);
  std::vector<SourceSet> sets;
  for (const std::size_t row : rows) sets.push_back(work.sources.sets[row]);
  StreamOptions stream;
  stream.chunk = work.chunk;
  stream.query.reach = work.reach;
  stream.query.quality = work.ranks.is_first();  // of the others' answers nothing is reported
  std::vector<Warning> of_answers;
  std::optional<Error> not_taken;
  const auto sink = [&](std::size_t row, DistanceResult&& answer) -> Result<void> {
    auto taken = take(rows[row], answer);
    if (!taken) {
      not_taken = taken.error();
      return taken;
    }
    add_warnings(of_answers, answer.warnings);
    answer.distances = {};
    answer.vertices = {};
    if (row == 0) figures.first = std::move(answer);
    return {};
  };
  const Stopwatch watch;
  const std::string details =
      output + ", up to " +
      bytes_in_words(static_cast<double>(chunk_bytes(work.mesh.vertices, work.chunk))) +
      " of memory for answers and " + bytes_in_words(figures.method->memory_mb() * kMegabyte) +
      " for the method";
  const auto done = stream_answers(
      *figures.method, sets, stream, sink,
      with_estimate(part_of(progress, kSetupShare, 1.0), announce, kSourcesStage,
                    counted(static_cast<std::int64_t>(work.count), "source", "sources"), details));
  if (!done) return not_taken ? *not_taken : about_model(work.model.name, done.error());
  figures.queries_ms = watch.milliseconds();
  figures.peak_rss_mb = peak_rss_mb();

  if (of_answers.size() > kMaxWarnings) {
    const auto more = static_cast<std::int64_t>(of_answers.size() - kMaxWarnings);
    of_answers.resize(kMaxWarnings);
    of_answers.push_back({"and " + counted(more, "more such warning", "more such warnings") +
                          " about the first " +
                          counted(static_cast<std::int64_t>(std::min(kSetsInBlock, work.chunk)),
                                  "source", "sources")});
  }
  if (work.model.space) name_reference_method(*work.model.space, of_answers);
  add_warnings(figures.warnings, of_answers);
  note_unused_settings(arguments.settings, work.options, figures.warnings);
  return figures;
}

}  // namespace

Result<ManyFigures> solve_many(const ManySources& work, const SolveArguments& arguments,
                               const TakeRow& take, const std::string& output,
                               const Progress& progress, const Announce& announce) {
  return work.ranks.agree_on(solve_share(work, arguments, take, output, progress, announce));
}

std::string unreached_note(const ManySources& work, std::int64_t unreached) {
  return counted(unreached, "distance is", "distances are") +
         " infinite: no way leads there from the source (" +
         counted(work.mesh.components, "component", "components") + ", " +
         counted(work.mesh.unreferenced_vertices, "vertex", "vertices") + " in no " +
         (work.model.space ? work.model.space->words().cell : "face") + ")";
}

Json many_json(const ManySources& work, const ManyFigures& figures) {
  Json sources = Json::array();
  for (const SourceSet& set : work.sources.sets) {
    if (!set.edges.empty()) {
      sources.push_back({{"edges", set.edges.size()}});
      continue;
    }
    if (!set.segments.empty()) {
      sources.push_back({{"segments", set.segments.size()}});
      continue;
    }
    Json points = sources_json(set);
    if (points.size() == 1) {
      sources.push_back(std::move(points[0]));
    } else {
      sources.push_back({{"points", points.size()}});
    }
  }
  const SetupTiming& setup = figures.method->timing();
  const auto rows = static_cast<double>(work.rows.size());
  Json json = {
      {"model", model_json(work.model, work.mesh)},
      {"options", options_json(*figures.method, figures.options, figures.first)},
      {"sources", std::move(sources)},
      {"timing_ms",
       {{"load", work.model.load_ms},
        {"setup", setup.setup},
        {"queries", figures.queries_ms},
        {"query", figures.queries_ms / rows}}},
      {"memory_mb",
       {{"factor", figures.method->memory_mb()},
        {"answers", static_cast<double>(chunk_bytes(work.mesh.vertices, work.chunk)) / kMegabyte},
        {"peak_rss", figures.peak_rss_mb}}},
      {"warnings", to_text(figures.warnings)}};
  if (work.done_before() > 0) json["done_before"] = work.done_before();
  if (!work.ranks.alone()) json["ranks"] = work.ranks.count();
  if (figures.error) json["error"] = error_json(*figures.error);
  if (figures.replaced) json["replaced"] = error_json(*figures.replaced);
  return json;
}

std::string many_table(const ManySources& work, const ManyFigures& figures,
                       std::vector<std::array<std::string, 2>> first_rows) {
  TextTable table({{"", TextTable::Align::kLeft}, {"", TextTable::Align::kLeft}});
  for (auto& [name, value] : first_rows) table.add_row({std::move(name), std::move(value)});
  const HeatMethod* const heat = figures.method->heat();
  table.add_row({"method", to_text(figures.method->kind()) +
                               (heat ? ", " + figures.first.backend : std::string()) + ", " +
                               counted(thread_count(work.options.threads), "thread", "threads")});
  const auto rows = static_cast<double>(work.rows.size());
  if (work.done_before() > 0) {
    const auto before = static_cast<std::int64_t>(work.done_before());
    table.add_row({"done before", counted(before, "row", "rows") + ", which were kept"});
  }
  if (!work.ranks.alone()) table.add_row({"ranks", std::to_string(work.ranks.count())});
  table.add_row({"set-up", milliseconds(figures.method->timing().setup) + " ms"});
  table.add_row({"queries", milliseconds(figures.queries_ms) + " ms, " +
                                milliseconds(figures.queries_ms / rows) + " ms each"});
  if (figures.error) table.add_row({"error", to_text(accuracy_line(*figures.error))});
  return table.text();
}

}  // namespace geotherm::app
