// SPDX-License-Identifier: MIT
// `geotherm solve` of one mesh that several ranks hold together (mpirun, backend petsc or
// method wavefront).
#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include "app/cli/commands.h"
#include "app/cli/many_work.h"
#include "app/cli/rows_file.h"
#include "app/session/answer.h"
#include "app/session/check.h"
#include "app/session/machine.h"
#include "app/session/ranks.h"
#include "app/session/report.h"
#include "app/session/wording.h"
#include "app/text/text.h"
#include "solver/core/parallel.h"
#include "solver/core/text.h"
#include "solver/distributed/mesh_part.h"
#include "solver/distributed/shared_solve.h"
#include "solver/mesh/io/format_writers.h"

namespace geotherm::app {
namespace {

/// What is typed, as far as ranks can do it.
struct SharedWork {
  std::string path;
  ViewerState asked;
  std::vector<GlobalIndex> sources;
  NpyType type = NpyType::kFloat64;
  MeshCounts counts;
  CheckSettings check;
  Outputs outputs;

  bool is_heat() const { return asked.options.method == MethodKind::kHeat; }
};

/// What ranks take of a setting that they know; without values, whatever there is.
struct TakenSetting {
  std::string_view name;
  std::vector<std::string_view> values = {};
};

/// The settings that ranks take; of all others in the table of settings they take the default
/// alone.
const std::vector<TakenSetting>& taken_settings() {
  static const std::vector<TakenSetting> taken = {
      {"method", {"heat", "wavefront"}},
      {"backend"},
      {"time-step"},
      {"time-factor"},
      {"boundary", {"neumann"}},
      {"laplacian", {"cotan", "intrinsic-delaunay"}},
      {"variant"},
      {"precision"},
      {"strict"},  // nothing takes over from a backend here
      {"threads"},
      {"domain", {"triangles"}},
      {"format", {"ply"}},
  };
  return taken;
}

Error for_one_process(const std::string& what, const std::string& takes = {}) {
  return {ErrorCode::kBadInput,
          what + " is for one process, not for a mesh that ranks share" +
              (takes.empty() ? "" : ", which takes " + takes),
          {"leave it out, or start without mpirun"}};
}

/// Errors: kBadInput, the first setting that is neither the default nor taken.
Result<void> refuse_other_settings(const ViewerState& asked) {
  const ViewerState usual;
  for (const Setting& setting : settings()) {
    if (!setting.of_method()) continue;
    const std::string value = setting.get(asked), by_default = setting.get(usual);
    if (value == by_default) continue;
    const auto taken = std::ranges::find(taken_settings(), setting.name, &TakenSetting::name);
    std::string values;
    if (taken != taken_settings().end()) {
      if (taken->values.empty() || std::ranges::count(taken->values, value) > 0) continue;
      for (const std::string_view each : taken->values) {
        values += (values.empty() ? "" : ", ") + std::string(each);
      }
    }
    return for_one_process("--" + std::string(setting.name) + ' ' + one_line(value), values);
  }
  return {};
}

/// Names the first thing that was asked for and that one process alone does. Errors: kBadInput.
Result<void> refuse_what_one_does(const SolveArguments& a, const ViewerState& asked) {
  if (auto taken = refuse_other_settings(asked); !taken) return taken;
  const std::pair<bool, const char*> kept[] = {
      {a.check.check, "--check"},
      {a.check.on_poor == geotherm::to_text(OnPoor::kBetter), "--on-poor better"},
      {!a.fields.empty(), "--fields"},
      {!a.bake.empty(), "--bake-colours"},
      {a.labels, "--labels"},
      {!a.max_distance.empty(), "--max-distance"},
      {!a.targets.empty(), "--target"},
      {!a.sequence.frames.empty(), "--sequence"},
      {a.sequence.skip_bad, "--skip-bad"},
      {a.symmetric, "--symmetric"},
      {a.sources.curve, "--curve"},
  };
  for (const auto& [asked_for, what] : kept) {
    if (asked_for) return for_one_process(what);
  }
  for (const std::string& path : a.outputs) {
    if (io::file_extension(path) == ".npy") continue;
    return Error{ErrorCode::kBadInput,
                 "--output: " + one_line(path) + ": ranks write one array together",
                 {"give -o FILE.npy"}};
  }
  return {};
}

/// Random ones are drawn among all `vertices` of the file: which belong to a face is not known
/// here.
Result<std::vector<GlobalIndex>> vertices_in(const SourceArguments& arguments,
                                             GlobalIndex vertices) {
  const auto named = some_sources_of(arguments);
  if (!named) return named.error();
  std::vector<GlobalIndex> out;
  for (const Source& source : *named) {
    if (const auto* const random = std::get_if<RandomVertices>(&source.spec);
        random != nullptr && random->offset == 0) {
      if (random->count > vertices) {
        return Error{source.blame, source.where + ": " + grouped(random->count) +
                                       " different vertices were asked for, and the mesh has " +
                                       grouped(vertices)};
      }
      const auto drawn = draw_numbers(vertices, random->count, random->seed);
      out.insert(out.end(), drawn.begin(), drawn.end());
      continue;
    }
    const auto* const list = std::get_if<VertexList>(&source.spec);
    if (list == nullptr || list->offset != 0) {
      return Error{source.blame, source.where +
                                     ": sources of a mesh that ranks share are vertices by their "
                                     "numbers or random ones, without offsets; give such, or "
                                     "start without mpirun"};
    }
    const GlobalIndex last = std::ranges::max(list->vertices);
    if (last >= vertices) {
      return Error{source.blame, source.where + ": there is no vertex " + std::to_string(last) +
                                     "; vertices are 0 to " + std::to_string(vertices - 1)};
    }
    out.insert(out.end(), list->vertices.begin(), list->vertices.end());
  }
  std::ranges::sort(out);
  out.erase(std::ranges::unique(out).begin(), out.end());
  return out;
}

Result<SharedWork> begin_shared(const SolveArguments& arguments, bool first) {
  SharedWork work;
  auto asked = settings_in(arguments.settings);
  if (!asked) return asked.error();
  work.asked = *std::move(asked);
  if (auto fits = refuse_what_one_does(arguments, work.asked); !fits) return fits.error();
  const auto type = number_type(arguments);
  if (!type) return type.error();
  work.type = *type;
  const auto check = check_settings(arguments.check);
  if (!check) return check.error();
  work.check = *check;
  work.path = arguments.model;
  if (is_bundled(work.path)) {
    auto file = bundled_file(work.path);
    if (!file) return file.error();
    work.path = *std::move(file);
  }
  if (io::file_extension(work.path) != ".ply" && work.asked.reading.format.empty()) {
    return Error{ErrorCode::kBadInput,
                 one_line(work.path) +
                     ": a mesh that ranks share is read from a binary .ply; geotherm generate and "
                     "most programs write one"};
  }
  const auto counts = count_ply(work.path);
  if (!counts) return counts.error();
  work.counts = *counts;
  auto sources = vertices_in(arguments.sources, counts->vertices);
  if (!sources) return sources.error();
  work.sources = *std::move(sources);
  if (!first) return work;
  for (const std::string& path : arguments.outputs) {
    if (auto expected = work.outputs.expect(path, "--output"); !expected) return expected.error();
    const auto bytes = static_cast<double>(
        npy_bytes_of(1, static_cast<std::uint64_t>(counts->vertices), work.type));
    if (auto fits = check_room(path, bytes); !fits) return fits.error();
  }
  if (auto fits = expect_report(arguments.json, work.outputs); !fits) return fits.error();
  return work;
}

/// Every rank writes the share of the file that it has. Errors, the same on all: kBadFile.
Result<void> write_shared(const std::string& path, NpyType type, const Ranks& ranks,
                          const SharedAnswer& answer) {
  const auto count = static_cast<std::uint64_t>(answer.vertices);
  const bool wide = type == NpyType::kFloat64;
  std::string bytes;
  const auto fits = ranks.agree(io::npy_row(path, answer.distances, type, bytes));
  if (!fits) return fits;
  auto file = SharedFile::open(path, io::npy_header(wide ? "<f8" : "<f4", {&count, 1}), ranks);
  if (!file) return about_file(file.error());
  const auto begin =
      static_cast<std::uint64_t>(share_begin(answer.vertices, ranks.rank(), ranks.count()));
  auto written = ranks.agree(file->write((wide ? 8 : 4) * begin, bytes));
  if (written) written = ranks.agree(ranks.is_first() ? file->finish() : Result<void>());
  return written ? written : about_file(written.error());
}

/// Laplacian and boundary as they are.
ViewerState settings_used(ViewerState state) {
  state.options.boundary = BoundaryRule::kNeumann;
  if (state.options.laplacian == LaplacianKind::kAuto) {
    state.options.laplacian = LaplacianKind::kIntrinsicDelaunay;
  }
  return state;
}

Json shared_json(const SharedWork& work, const SharedAnswer& answer, int ranks, double peak_mb) {
  Json options;
  const ViewerState used = settings_used(work.asked);
  for (const Setting& setting : settings()) {
    if (setting.group != SettingGroup::kMethod) continue;
    const bool unused = !work.is_heat() && setting.of_heat;
    options[key_of(setting)] = unused ? Json(nullptr) : setting_json(setting, used);
  }
  options["threads"] = thread_count(used.options.threads);
  if (used.options.time_step.rule == TimeRule::kAbsolute) options["time_factor"] = nullptr;
  const auto of_heat = [&work](auto value) { return work.is_heat() ? Json(value) : Json(nullptr); };
  options["t"] = of_heat(answer.t);
  options["flips"] = answer.flips;
  const DistanceSummary distance = {answer.least, answer.most, answer.mean, answer.unreached};
  Json json = {{"model",
                {{"name", std::filesystem::path(work.path).stem().string()},
                 {"path", std::filesystem::absolute(work.path).string()},
                 {"vertices", answer.vertices},
                 {"faces", answer.faces},
                 {"components", answer.components},
                 {"mean_edge_length", answer.mean_edge},
                 {"area", answer.area}}},
               {"options", options},
               {"sources", work.sources},
               {"distance", distance_json(distance)},
               {"timing_ms",
                {{"load", answer.read_ms},
                 {"share", answer.share_ms},
                 {"setup", answer.set_up_ms},
                 {"diffuse", of_heat(answer.timing.diffuse)},
                 {"gradient", of_heat(answer.timing.gradient)},
                 {"poisson", of_heat(answer.timing.poisson)},
                 {"query", answer.timing.query}}},
               {"memory_mb", {{"factor", of_heat(answer.factor_mb)}, {"peak_rss", peak_mb}}},
               {"quality", quality_json(answer.quality, work.is_heat())},
               {"warnings", to_text(answer.warnings)},
               {"ranks", ranks},
               {"shared",
                {{"blocks", answer.blocks},
                 {"rings", of_heat(answer.rings)},
                 {"rounds", answer.rounds},
                 {"row_residual", of_heat(answer.row_residual)}}}};
  if (answer.error) json["error"] = error_json(*answer.error);
  return json;
}

std::string shared_table(const SharedWork& work, const SharedAnswer& a, int ranks, double peak_mb) {
  const MethodOptions options = settings_used(work.asked).options;
  const auto ms = [](double value) { return milliseconds(value) + " ms"; };
  TextTable table({{"", TextTable::Align::kLeft}, {"", TextTable::Align::kLeft}});
  table.add_row({"model", one_line(std::filesystem::path(work.path).stem().string()) + ": " +
                              counted(a.vertices, "vertex", "vertices") + ", " +
                              counted(a.faces, "face", "faces") + ", " +
                              counted(a.components, "component", "components")});
  std::string blocks = std::to_string(ranks) + ", " + counted(a.blocks, "block", "blocks");
  if (work.is_heat()) {
    table.add_row({"ranks", blocks + " with " + counted(a.rings, "ring", "rings") + " around"});
    table.add_row({"t", significant(a.t) + " = " + significant(a.relative_t) + " h^2"});
    table.add_row({"method", "pin-sources, heat unit, boundary neumann, " +
                                 to_text(options.variant) + ", " + to_text(options.precision) +
                                 " precision"});
    table.add_row(
        {"laplacian", to_text(options.laplacian) + (a.flips > 0 ? ", edges were flipped" : "")});
  } else {
    table.add_row({"ranks", blocks + ", " + counted(a.rounds, "round", "rounds")});
    table.add_row({"method", to_text(options.method)});
  }
  table.add_row({"sources", counted(std::ssize(work.sources), "vertex", "vertices")});
  table.add_row({"read", ms(a.read_ms) + " + " + milliseconds(a.share_ms) + " to share it out"});
  table.add_row({"set-up", ms(a.set_up_ms)});
  const std::string steps = " = heat " + milliseconds(a.timing.diffuse) + " + gradient " +
                            milliseconds(a.timing.gradient) + " + Poisson " +
                            milliseconds(a.timing.poisson);
  table.add_row({"query", ms(a.timing.query) + (work.is_heat() ? steps : "")});
  const std::string factors = work.is_heat() ? milliseconds(a.factor_mb) + " MB factors, " : "";
  table.add_row({"memory", factors + milliseconds(peak_mb) + " MB peak, of the largest rank"});
  table.add_row({"distance", distances_in_words({a.least, a.most, a.mean, a.unreached}) +
                                 (a.unreached > 0 ? ", " + grouped(a.unreached) + " unreached"
                                                  : std::string())});
  std::string gradient =
      "| |grad d| - 1 | = " + significant(a.quality.eikonal_error_mean, 2) + " on average";
  if (!work.is_heat()) {
    table.add_row({"gradient", gradient});
    return table.text();
  }
  gradient += ", " + counted(a.quality.zero_gradient_faces, "face", "faces") + " without direction";
  table.add_row({"gradient", gradient});
  table.add_row(
      {"residuals", "heat " + significant(a.quality.heat_residual, 2) + ", its worst row " +
                        significant(a.row_residual, 2) + ", after " +
                        counted(a.rounds, "round", "rounds") + "; Poisson " +
                        significant(a.quality.poisson_residual, 2) + ", after " +
                        counted(a.quality.iterations_poisson, "iteration", "iterations")});
  if (a.error) table.add_row({"error", to_text(accuracy_line(*a.error))});
  return table.text();
}

}  // namespace

bool is_shared(const SolveArguments& arguments) {
  if (arguments.each || arguments.pairs || !has_launcher()) return false;
  const auto typed = arguments.settings.texts.find("backend");
  if (typed != arguments.settings.texts.end()) return typed->second == "petsc";
  const auto method = arguments.settings.texts.find("method");
  return launched_as().count > 1 && method != arguments.settings.texts.end() &&
         method->second == "wavefront";
}

Result<CommandOutput> run_shared(const SolveArguments& arguments, const Progress& progress) {
  const auto ranks = Ranks::join();
  if (!ranks) return ranks.error();
  const auto module = mpi_module();
  if (!module) return module.error();
  const auto started = start_mpi();
  if (!started) return started.error();
  auto work = ranks->agree_on(begin_shared(arguments, ranks->is_first()));
  if (!work) return work.error();
  const RankGroup group(**module, *started,
                        [&ranks](const Result<void>& mine) { return ranks->agree(mine); });
  const auto answer =
      solve_over_ranks(group, work->path, work->sources, work->asked.options,
                       work->is_heat() && work->check.against != Check::kOff, progress);
  if (!answer) return answer.error();
  const Warning line = answer->error ? accuracy_line(*answer->error) : Warning();
  if (answer->error && work->check.on_poor == OnPoor::kFail) {
    if (auto right = refuse_poor(*answer->error, line); !right) return right.error();
  }
  for (const std::string& path : arguments.outputs) {
    const auto write = [&] { return write_shared(path, work->type, *ranks, *answer); };
    const auto written = ranks->is_first() ? work->outputs.write(path, write) : write();
    if (!written) return written.error();
  }
  const double peak_mb = group.max(peak_rss_mb());
  CommandOutput out;
  if (!ranks->is_first()) return out;
  out.warnings = answer->warnings;
  SettingArguments used = arguments.settings;
  used.texts.erase("backend");  // by which ranks were asked to share the mesh
  note_unused_settings(used, work->asked.options, out.warnings);
  MeshSummary mesh;
  mesh.components = answer->components;
  mesh.unreferenced_vertices = static_cast<Index>(answer->loose);
  for (Warning& note : unreached_notes(mesh, static_cast<Index>(answer->unreached))) {
    out.warnings.push_back(std::move(note));
  }
  if (answer->error) {
    if (auto poor = accuracy_warning(*answer->error, line)) out.warnings.push_back(*poor);
  }
  out.note = accuracy_note(arguments.json, work->outputs, arguments.quiet, answer->error);
  return finish_command(
      std::move(out), work->outputs, arguments.json,
      [&] { return shared_json(*work, *answer, ranks->count(), peak_mb); },
      [&] { return shared_table(*work, *answer, ranks->count(), peak_mb); });
}

}  // namespace geotherm::app
