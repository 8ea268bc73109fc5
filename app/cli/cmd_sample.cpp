// SPDX-License-Identifier: MIT
#include <CLI/CLI.hpp>

#include <algorithm>
#include <cstring>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "app/cli/commands.h"
#include "app/cli/many_work.h"
#include "app/cli/sample_report.h"
#include "app/session/answer.h"
#include "app/session/machine.h"
#include "app/session/model.h"
#include "app/session/outputs.h"
#include "app/session/ranks.h"
#include "app/session/report.h"
#include "app/session/wording.h"
#include "app/text/text.h"
#include "geotherm/build_method.h"
#include "geotherm/heat_method.h"
#include "geotherm/io.h"
#include "geotherm/many.h"
#include "solver/core/parallel.h"
#include "solver/core/stopwatch.h"
#include "solver/core/text.h"
#include "solver/mesh/io/format_writers.h"
#include "solver/mesh/output_file.h"
#include "solver/method/farthest_points.h"

namespace geotherm::app {

namespace {

bool is_json(const std::string& path) { return io::file_extension(path) == ".json"; }

Result<void> expect_outputs(const SampleArguments& arguments, Outputs& outputs) {
  for (const std::string& path : arguments.outputs) {
    if (!is_json(path)) {
      if (auto known = check_distance_path(path); !known) return known;
    }
    if (auto expected = outputs.expect(path, "--output"); !expected) return expected;
  }
  const std::string& samples = arguments.samples;
  if (!samples.empty()) {
    const std::string extension = io::file_extension(samples);
    if (samples != "-" && extension != ".csv" && extension != ".npy" && extension != ".txt") {
      return Error{ErrorCode::kNotAvailable,
                   "--samples: " + one_line(samples) +
                       ": the list of samples is written as .csv, .npy or .txt",
                   {"choose another name"}};
    }
    if (auto expected = outputs.expect(samples, "--samples"); !expected) return expected;
  }
  return expect_report(arguments.json, outputs);
}

/// What is asked for.
struct SampleTask {
  MethodOptions options;
  CheckSettings check;
  Index count = 0, first = kNoIndex;
  int relax = 0;  ///< steps
};

/// Ranks that solve for a vertex each, and hand the distances to all. `failed`: becomes true where
/// one of them could not, which all then know.
SampleCrew crew_of(const DistanceMethod& method, const Ranks& ranks, bool& failed) {
  const auto solve = [&](std::span<const Index> vertices, const QueryOptions& query,
                         const Progress& progress) -> Result<std::vector<DistanceResult>> {
    const auto ours = static_cast<std::size_t>(ranks.rank());
    Result<DistanceResult> mine = DistanceResult();
    if (ours < vertices.size()) {
      mine = method.solve(SourceSet::of_vertices({vertices[ours]}), query, progress);
    }
    const auto bytes = [&mine]() -> Result<std::string> {
      if (!mine) return mine.error();
      const std::span<const double> row = mine->distances;
      return std::string(reinterpret_cast<const char*>(row.data()), row.size_bytes());
    };
    const auto rows = ranks.all_gather_or_fail(bytes());
    failed = !rows;
    if (!rows) return rows.error();
    std::vector<DistanceResult> all(vertices.size());
    if (ours == 0) all.front() = *std::move(mine);
    for (std::size_t i = 0; i < all.size(); ++i) {
      const std::string& row = (*rows)[i];
      all[i].distances.resize(row.size() / sizeof(double));
      std::memcpy(all[i].distances.data(), row.data(), row.size());
    }
    return all;
  };
  return {static_cast<std::size_t>(ranks.count()), solve};
}

/// `ranks`: those that take part; null: this process alone.
Result<FarthestPoints> take_samples(const DistanceMethod& method, const TriangleMesh& mesh,
                                    const SampleTask& task, const Ranks* ranks,
                                    const Progress& progress, const Announce& announce) {
  const auto told =
      with_estimate(progress, announce, kSamplesStage, counted(task.count, "sample", "samples"),
                    bytes_in_words(method.memory_mb() * kMegabyte) + " of memory for the method");
  if (ranks == nullptr || ranks->alone()) {
    return farthest_points(method, mesh, task.count, {task.first}, told);
  }
  bool failed = false;
  auto points =
      farthest_points_by(crew_of(method, *ranks, failed), mesh, task.count, {task.first}, told);
  // What one of them met between queries, the others hear where they hand their rows around next.
  return failed ? std::move(points) : ranks->agree_on(std::move(points));
}

/// Checks the method on some of the samples, and takes them again by the method that answers
/// instead of a poor one.
Result<void> check_samples(const SampleTask& task, ModelSolver& solver, const ReadyMethod& ready,
                           const Progress& progress, const Announce& announce,
                           SampleFigures& figures) {
  std::vector<SourceSet> sets;
  for (const FarthestSample& sample : figures.points.samples) {
    sets.push_back(SourceSet::of_vertices({sample.vertex}));
  }
  auto checked = solver.check_method(ready, sets, task.check, part_of(progress, 0.0, 0.5));
  if (!checked) return checked.error();
  figures.error = std::move(checked->error);
  figures.warnings = std::move(checked->warnings);
  if (!checked->replaced) return {};
  figures.replaced = std::move(checked->replaced);
  figures.method = checked->by.method;
  figures.options = checked->by.options;
  const Stopwatch watch;
  auto points = take_samples(*figures.method, *figures.model.mesh, task, nullptr,
                             part_of(progress, 0.5, 1.0), announce);
  if (!points) return about_model(figures.model.name, points.error());
  figures.points = *std::move(points);
  figures.sampling_ms = watch.milliseconds();
  return {};
}

/// Moves the samples by a method and stores where they are then.
Result<void> move_samples(const SampleTask& task, const ReadyMethod& by, const Progress& progress,
                          SampleFigures& figures) {
  std::vector<SurfacePoint> points;
  for (const FarthestSample& sample : figures.points.samples) {
    points.push_back(SurfacePoint::at_vertex(sample.vertex));
  }
  const Stopwatch watch;
  auto relaxed = relax_points(*by.method, figures.model.mesh, points, task.relax,
                              part_of(progress, 0, 0.8), figures.options.threads);
  if (!relaxed) return about_model(figures.model.name, relaxed.error());
  figures.relaxing_ms = watch.milliseconds();
  const auto apart =
      separation_of(relaxed->points, by.options, figures.model.mesh, part_of(progress, 0.8, 1));
  if (!apart) return about_model(figures.model.name, apart.error());
  figures.relaxed = *std::move(relaxed);
  figures.relaxed_by = by.options.method;
  figures.relaxed_separation = *apart;
  return {};
}

/// Moves the samples, by near-exact distances where those of the method know no nearest sample, and
/// checks the distances from where they are then, which are those that are written. Where these are
/// replaced by better ones, the samples move by those.
Result<void> relax(const SampleTask& task, ModelSolver& solver, const ReadyMethod& ready,
                   const Progress& progress, SampleFigures& figures) {
  ReadyMethod by = ready;
  if (by.method->heat() != nullptr) {
    auto better = solver.prepare(better_options(figures.options, MethodKind::kWavefront),
                                 part_of(progress, 0, 0.1));
    if (!better) return better.error();
    by = *std::move(better);
  }
  for (double from = 0.1;;) {
    const double moved = from + 0.6 * (1 - from), checked = from + 0.9 * (1 - from);
    if (auto done = move_samples(task, by, part_of(progress, from, moved), figures); !done) {
      return done;
    }
    if (task.check.against == Check::kOff) return {};
    std::vector<SourceSet> sets(figures.relaxed->points.size());
    for (std::size_t i = 0; i < sets.size(); ++i) sets[i].points = {figures.relaxed->points[i]};
    auto check = solver.check_method(by, sets, task.check, part_of(progress, moved, checked));
    if (!check) return check.error();
    figures.error = std::move(check->error);
    std::ranges::move(check->warnings, std::back_inserter(figures.warnings));
    if (!check->replaced) return {};
    figures.replaced = std::move(check->replaced);
    by = check->by;
    from = checked;
  }
}

/// Samples a loaded model. All ranks; the first alone checks and relaxes.
Result<SampleFigures> sample(Model model, const SettingArguments& arguments, const SampleTask& task,
                             const Ranks& ranks, const Progress& progress,
                             const Announce& announce) {
  const bool relaxes = task.relax > 0;
  // What cannot be asked for is said before the set-up.
  if (auto fits = check_sampling(*model.mesh, task.count, {task.first}); !fits) {
    return about(one_line(model.name), fits.error());
  }
  ModelSolver solver(model);
  MethodOptions options = task.options;
  options.strict = options.strict || !ranks.alone();  // samples have the bits of one backend
  const auto ready = ranks.agree_on(solver.prepare(options, part_of(progress, 0.0, kSetupShare)));
  if (!ready) return ready.error();
  const Stopwatch watch;
  const bool checks = task.check.against != Check::kOff && !relaxes;  // else where they end
  const double sampled = relaxes ? 0.5 : checks ? 0.9 : 1;
  auto points = take_samples(*ready->method, *model.mesh, task, &ranks,
                             part_of(progress, kSetupShare, sampled), announce);
  if (!points) return about_model(model.name, points.error());
  const double sampling_ms = watch.milliseconds();
  const double peak = peak_rss_mb();  // of the work, not of its check
  const MeshReport mesh = ranks.is_first() ? inspect_mesh(*model.mesh) : MeshReport();
  SampleFigures figures{std::move(model),   mesh,        ready->method, task.options,
                        *std::move(points), sampling_ms, peak,          {}};
  figures.ranks = ranks.count();
  if (!ranks.is_first()) return figures;
  if (checks) {
    const auto done =
        check_samples(task, solver, *ready, part_of(progress, sampled, 1), announce, figures);
    if (!done) return done.error();
  }
  if (relaxes) {
    const auto done = relax(task, solver, *ready, part_of(progress, sampled, 1), figures);
    if (!done) return done.error();
  }
  if (figures.error && !figures.error->measured && !figures.error->failed) {
    figures.error->advice.clear();  // it names --check, which sample has not
  }
  const auto add_warnings = [&figures](const std::vector<Warning>& more) {
    figures.warnings.insert(figures.warnings.end(), more.begin(), more.end());
  };
  add_warnings(figures.model.notes);
  add_warnings(figures.method->warnings());
  add_warnings(figures.points.first.warnings);
  const auto unreached = std::ranges::count(figures.distances(), kUnreached);
  add_warnings(unreached_notes(mesh, static_cast<Index>(unreached), figures.model.mesh.get()));
  note_unused_settings(arguments, task.options, figures.warnings);
  return figures;
}

Result<void> write_labels(const std::string& path, const SampleFigures& figures,
                          std::string& standard_output) {
  if (is_json(path)) return write_file(path, report_text(sample_json(figures)));
  if (path != "-") {
    return write_distances(path, *figures.model.mesh, figures.distances(), figures.nearest());
  }
  standard_output = io::csv_bytes(figures.distances(), figures.nearest());
  return {};
}

Result<void> write_samples(const std::string& path, const SampleFigures& figures,
                           std::string& standard_output) {
  if (path == "-") {
    standard_output = samples_csv(figures);
    return {};
  }
  const std::string extension = io::file_extension(path);
  if (extension == ".csv") return write_file(path, samples_csv(figures));
  if (extension == ".txt") return write_file(path, samples_as_sources(figures));
  const std::size_t count = figures.points.samples.size();
  auto file = NpyRows::open(path, count, sample_row(figures, 0).size(), NpyType::kFloat64);
  if (!file) return file.error();
  for (std::size_t i = 0; i < count; ++i) {
    if (auto written = file->append(sample_row(figures, i)); !written) return written;
  }
  return file->finish();
}

}  // namespace

void add_sample_options(CLI::App& command, SampleArguments& arguments) {
  add_model_option(command, arguments.model, arguments.settings)->required();
  command.add_option("-n,--count", arguments.count, "how many samples")->type_name("K")->required();
  command
      .add_option("--first", arguments.first,
                  "the vertex to begin with; default: the one farthest from the first vertex")
      ->type_name("V");
  command
      .add_option(
          "--relax", arguments.relax,
          "Lloyd's iteration: so many times, or until nothing is gained, every sample moves "
          "to the mean of the part of the surface that is nearest to it")
      ->type_name("N");
  may_repeat(command.add_option(
                 "-o,--output", arguments.outputs,
                 "distance to the nearest sample and its number, for every vertex: .csv .npy .ply "
                 ".vtp, or - for CSV on standard output; .json is the report; may be repeated"),
             "FILE");
  command
      .add_option("--samples", arguments.samples,
                  "the samples in their order: vertex, position, distance to those before, radius "
                  "covered with it (relaxed: face, weights, position): .csv .npy, or - for CSV on "
                  "standard output; .txt is a source file of other commands")
      ->type_name("FILE");
  add_json_option(command, arguments.json);
  add_check_options(command, arguments.check);
  add_quiet_option(command, arguments.quiet);
  add_setting_options(command, arguments.settings, names_of(SettingGroup::kMethod));
  command.footer(
      "Each sample is the vertex farthest from all before it; parts of the surface that none of "
      "them reaches come first. Runs under mpirun, too, where ranks solve for samples side by "
      "side.\n"
      "Examples:\n"
      "  geotherm sample bunny -n 100 -o cells.ply --samples samples.csv\n"
      "  geotherm sample bunny -n 100 --relax 30 -o cells.ply --samples centres.txt\n"
      "  geotherm bunny --source-file centres.txt --view regions\n"
      "  geotherm sample bunny -n 5 --first 0 --method wavefront --json -");
}

Result<CommandOutput> run_sample(const SampleArguments& arguments, const Progress& progress,
                                 const Announce& announce) {
  const auto asked = settings_in(arguments.settings);
  if (!asked) return asked.error();
  const MethodOptions& options = asked->options;
  const auto count = whole_in("--count", arguments.count, "number of samples", 1);
  if (!count) return count.error();
  Index first = kNoIndex;
  if (!arguments.first.empty()) {
    const auto vertex = whole_in("--first", arguments.first, "vertex id", 0);
    if (!vertex) return vertex.error();
    first = *vertex;
  }
  int relax = 0;
  if (!arguments.relax.empty()) {
    const auto steps = whole_in("--relax", arguments.relax, "number of steps", 1);
    if (!steps) return steps.error();
    relax = *steps;
  }
  const auto check = check_settings(arguments.check);
  if (!check) return check.error();
  const auto ranks = Ranks::join();
  if (!ranks) return ranks.error();
  Outputs outputs;
  const auto expected = ranks->agree(expect_outputs(arguments, outputs));
  if (!expected) return expected.error();
  auto model = ranks->agree_on(load_model(arguments.model, asked->reading, progress));
  if (!model) return model.error();
  if (auto surface = refuse_space(*model, "samples are"); !surface) return surface.error();
  const auto figures = sample(*std::move(model), arguments.settings,
                              {options, *check, *count, first, relax}, *ranks, progress, announce);
  if (!figures) return figures.error();
  if (!ranks->is_first()) return CommandOutput();

  CommandOutput out{"", figures->warnings, {}};
  for (const std::string& path : arguments.outputs) {
    const auto written =
        outputs.write(path, [&] { return write_labels(path, *figures, out.text); });
    if (!written) return written.error();
  }
  if (!arguments.samples.empty()) {
    const auto written = outputs.write(
        arguments.samples, [&] { return write_samples(arguments.samples, *figures, out.text); });
    if (!written) return written.error();
  }
  out.note = accuracy_note(arguments.json, outputs, arguments.quiet, figures->error);
  return finish_command(
      std::move(out), outputs, arguments.json, [&] { return sample_json(*figures); },
      [&] { return sample_table(*figures); });
}

}  // namespace geotherm::app
