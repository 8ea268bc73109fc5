// SPDX-License-Identifier: MIT
#include <CLI/CLI.hpp>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "app/cli/commands.h"
#include "app/cli/many_work.h"
#include "app/session/answer.h"
#include "app/session/machine.h"
#include "app/session/model.h"
#include "app/session/outputs.h"
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

namespace geotherm::app {

/// All there is to say about samples.
struct SampleFigures {
  Model model;
  MeshReport mesh;
  std::shared_ptr<const DistanceMethod> method;
  MethodOptions options;
  FarthestPoints points;
  double sampling_ms = 0;
  double peak_rss_mb = 0;
  std::vector<Warning> warnings;
  std::optional<SampleCheck> error = {};     ///< of some samples; none: not to be checked
  std::optional<SampleCheck> replaced = {};  ///< of the poor method that this one stands for
};

Json sample_json(const SampleFigures& figures);

/// What `sample` shows to people: the figures and the first samples.
std::string sample_table(const SampleFigures& figures);

/// `sample,vertex,x,y,z,distance,radius`, one sample a line.
std::string samples_csv(const SampleFigures& figures);

/// The numbers of a line of that but for the first, as a row of a .npy array.
std::vector<double> sample_row(const SampleFigures& figures, std::size_t sample);
inline constexpr std::size_t kSampleColumns = 6;

namespace {

constexpr std::size_t kMaxShown = 20;

/// How many vertices each sample is the nearest of.
std::vector<Index> cell_sizes(const FarthestPoints& points) {
  std::vector<Index> sizes(points.samples.size(), 0);
  for (const Index sample : points.nearest) {
    if (sample != kNoIndex) ++sizes[sample];
  }
  return sizes;
}

Json position_json(const Vec3& p) { return Json::array({p[0], p[1], p[2]}); }

}  // namespace

Json sample_json(const SampleFigures& f) {
  const std::vector<Index> cells = cell_sizes(f.points);
  Json samples = Json::array();
  for (std::size_t i = 0; i < f.points.samples.size(); ++i) {
    const FarthestSample& sample = f.points.samples[i];
    samples.push_back({{"vertex", sample.vertex},
                       {"position", position_json(f.model.mesh->positions()[sample.vertex])},
                       {"distance", sample.distance},
                       {"distance_back", sample.back},
                       {"radius", sample.radius},
                       {"cell", cells[i]}});
  }
  Json json = {{"model", model_json(f.model, f.mesh)},
               {"options", options_json(*f.method, f.options, f.points.first)},
               {"count", f.points.samples.size()},
               {"radius", f.points.radius()},
               {"separation", f.points.separation()},
               {"unreached", std::ranges::count(f.points.distances, kUnreached)},
               {"samples", std::move(samples)},
               {"timing_ms",
                {{"load", f.model.load_ms},
                 {"setup", f.method->timing().setup},
                 {"sampling", f.sampling_ms},
                 {"query", f.points.query_ms}}},
               {"memory_mb", {{"factor", f.method->memory_mb()}, {"peak_rss", f.peak_rss_mb}}},
               {"warnings", told(f.warnings)}};
  if (f.error) json["error"] = error_json(*f.error);
  if (f.replaced) json["replaced"] = error_json(*f.replaced);
  return json;
}

std::string sample_table(const SampleFigures& f) {
  const FarthestPoints& points = f.points;
  TextTable figures({{"", TextTable::Align::kLeft}, {"", TextTable::Align::kLeft}});
  const std::string count =
      counted(static_cast<std::int64_t>(points.samples.size()), "sample", "samples");
  figures.add_row(
      {"model", one_line(f.model.name) + ", " + counted(f.mesh.vertices, "vertex", "vertices")});
  figures.add_row({"radius", std::isfinite(points.radius())
                                 ? significant(points.radius()) +
                                       ": every vertex of a face lies that near to one of " + count
                                 : "infinite: " + count + " for " +
                                       counted(f.mesh.components, "component", "components")});
  if (std::isfinite(points.separation())) {
    figures.add_row({"separation", significant(points.separation()) +
                                       " between two samples at least, in either direction"});
  }
  figures.add_row({"method", to_text(f.method->kind()) +
                                 (f.method->heat() ? ", " + points.first.backend : std::string()) +
                                 ", " +
                                 counted(thread_count(f.options.threads), "thread", "threads")});
  figures.add_row({"set-up", milliseconds(f.method->timing().setup) + " ms"});
  figures.add_row({"sampling", milliseconds(f.sampling_ms) + " ms, " +
                                   milliseconds(points.query_ms) + " ms each"});
  if (f.error) figures.add_row({"error", told(accuracy_line(*f.error))});
  constexpr auto kRight = TextTable::Align::kRight;
  TextTable list({{"sample", kRight}, {"vertex", kRight}, {"radius", kRight}, {"cell", kRight}});
  const std::vector<Index> cells = cell_sizes(points);
  const std::size_t shown = std::min(points.samples.size(), kMaxShown);
  for (std::size_t i = 0; i < shown; ++i) {
    list.add_row({std::to_string(i), std::to_string(points.samples[i].vertex),
                  significant(points.samples[i].radius), grouped(cells[i])});
  }
  std::string text = figures.text() + '\n' + list.text();
  if (shown < points.samples.size()) {
    text += "and " + grouped(static_cast<std::int64_t>(points.samples.size() - shown)) +
            " more; --samples FILE.csv holds all\n";
  }
  return text;
}

std::vector<double> sample_row(const SampleFigures& f, std::size_t sample) {
  const FarthestSample& s = f.points.samples[sample];
  const Vec3& p = f.model.mesh->positions()[s.vertex];
  return {static_cast<double>(s.vertex), p[0], p[1], p[2], s.distance, s.radius};
}

std::string samples_csv(const SampleFigures& f) {
  std::string text = "sample,vertex,x,y,z,distance,radius\n";
  for (std::size_t i = 0; i < f.points.samples.size(); ++i) {
    text += std::to_string(i) + ',' + std::to_string(f.points.samples[i].vertex);
    const std::vector<double> row = sample_row(f, i);
    for (std::size_t c = 1; c < row.size(); ++c) text += ',' + number_text(row[c]);
    text += '\n';
  }
  return text;
}

namespace {

Result<Index> number_in_option(const std::string& text, const char* option, Index least,
                               const char* what) {
  const auto number = number_in<Index>(text);
  if (number && *number >= least) return *number;
  return Error{ErrorCode::kBadInput, std::string(option) + ": '" + one_line(text) + "' is no " +
                                         what + "; give a whole number from " +
                                         std::to_string(least)};
}

bool is_json(const std::string& path) { return io::file_extension(path) == ".json"; }

Result<void> expect_outputs(const SampleArguments& arguments, Outputs& outputs) {
  protect_inputs(arguments.model, {}, outputs);
  for (const std::string& path : arguments.outputs) {
    if (!is_json(path)) {
      if (auto known = check_distance_path(path); !known) return known;
    }
    if (auto expected = outputs.expect(path, "--output"); !expected) return expected;
  }
  const std::string& samples = arguments.samples;
  if (!samples.empty()) {
    const std::string extension = io::file_extension(samples);
    if (samples != "-" && extension != ".csv" && extension != ".npy") {
      return Error{ErrorCode::kNotAvailable,
                   "--samples: " + one_line(samples) +
                       ": the list of samples is written as .csv or .npy; choose another name"};
    }
    if (auto expected = outputs.expect(samples, "--samples"); !expected) return expected;
  }
  if (arguments.json.empty()) return {};
  return outputs.expect(arguments.json, "--json");
}

/// What is asked for.
struct SampleTask {
  MethodOptions options;
  CheckSettings check;
  Index count = 0, first = kNoIndex;
};

Result<FarthestPoints> take_samples(const DistanceMethod& method, const TriangleMesh& mesh,
                                    const SampleTask& task, const Progress& progress,
                                    const Announce& announce) {
  return farthest_points(
      method, mesh, task.count, {task.first},
      with_estimate(progress, announce, kSamplesStage, counted(task.count, "sample", "samples"),
                    bytes_in_words(method.memory_mb() * kMegabyte) + " of memory for the method"));
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
  auto points = take_samples(*figures.method, *figures.model.mesh, task,
                             part_of(progress, 0.5, 1.0), announce);
  if (!points) return about_model(figures.model.name, points.error());
  figures.points = *std::move(points);
  figures.sampling_ms = watch.milliseconds();
  return {};
}

/// Samples a loaded model.
Result<SampleFigures> sample(Model model, const SettingArguments& arguments, const SampleTask& task,
                             const Progress& progress, const Announce& announce) {
  constexpr double kSampled = 0.9;
  // What cannot be asked for is said before the set-up.
  if (auto fits = check_sampling(*model.mesh, task.count, {task.first}); !fits) {
    return about(one_line(model.name), fits.error());
  }
  ModelSolver solver(model);
  const auto ready = solver.prepare(task.options, part_of(progress, 0.0, kSetupShare));
  if (!ready) return ready.error();
  const Stopwatch watch;
  const bool checks = task.check.against != Check::kOff;
  auto points = take_samples(*ready->method, *model.mesh, task,
                             part_of(progress, kSetupShare, checks ? kSampled : 1.0), announce);
  if (!points) return about_model(model.name, points.error());
  const double sampling_ms = watch.milliseconds();
  const double peak = peak_rss_mb();  // of the work, not of its check
  const MeshReport mesh = inspect_mesh(*model.mesh);
  SampleFigures figures{std::move(model),   mesh,        ready->method, task.options,
                        *std::move(points), sampling_ms, peak,          {}};
  if (checks) {
    const auto done =
        check_samples(task, solver, *ready, part_of(progress, kSampled, 1.0), announce, figures);
    if (!done) return done.error();
  }
  const auto add_warnings = [&figures](const std::vector<Warning>& more) {
    figures.warnings.insert(figures.warnings.end(), more.begin(), more.end());
  };
  add_warnings(figures.model.notes);
  add_warnings(figures.method->warnings());
  add_warnings(figures.points.first.warnings);
  const auto unreached = std::ranges::count(figures.points.distances, kUnreached);
  add_warnings(unreached_notes(mesh, static_cast<Index>(unreached)));
  note_unused_settings(arguments, task.options, figures.warnings);
  return figures;
}

Result<void> write_labels(const std::string& path, const SampleFigures& figures,
                          std::string& standard_output) {
  const FarthestPoints& points = figures.points;
  if (is_json(path)) return write_file(path, report_text(sample_json(figures)));
  if (path != "-") {
    return write_distances(path, *figures.model.mesh, points.distances, points.nearest);
  }
  standard_output = io::csv_bytes(points.distances, points.nearest);
  return {};
}

Result<void> write_samples(const std::string& path, const SampleFigures& figures,
                           std::string& standard_output) {
  if (path == "-") {
    standard_output = samples_csv(figures);
    return {};
  }
  if (io::file_extension(path) == ".csv") return write_file(path, samples_csv(figures));
  const std::size_t count = figures.points.samples.size();
  auto file = NpyRows::open(path, count, kSampleColumns, NpyType::kFloat64);
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
      .add_option("-o,--output", arguments.outputs,
                  "distance to the nearest sample and its number, for every vertex: .csv .npy .ply "
                  ".vtp, or - for CSV on standard output; .json is the report; may be repeated")
      ->type_name("FILE")
      ->expected(1)
      ->allow_extra_args(false)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  command
      .add_option("--samples", arguments.samples,
                  "the samples in their order: vertex, position, distance to those before, radius "
                  "covered with it; .csv .npy, or - for CSV on standard output")
      ->type_name("FILE");
  command.add_option("--json", arguments.json, "every figure as JSON; - is standard output")
      ->type_name("FILE");
  add_check_options(command, arguments.check);
  add_quiet_option(command, arguments.quiet);
  add_setting_options(command, arguments.settings, names_of(SettingGroup::kMethod));
  command.footer(
      "Each sample is the vertex farthest from all before it; parts of the surface that none of "
      "them reaches come first.\n"
      "Examples:\n"
      "  geotherm sample bunny -n 100 -o cells.ply --samples samples.csv\n"
      "  geotherm sample bunny -n 5 --first 0 --method wavefront --json -");
}

Result<CommandOutput> run_sample(const SampleArguments& arguments, const Progress& progress,
                                 const Announce& announce) {
  const auto asked = settings_in(arguments.settings);
  if (!asked) return asked.error();
  const MethodOptions& options = asked->options;
  const auto count = number_in_option(arguments.count, "--count", 1, "number of samples");
  if (!count) return count.error();
  Index first = kNoIndex;
  if (!arguments.first.empty()) {
    const auto vertex = number_in_option(arguments.first, "--first", 0, "vertex id");
    if (!vertex) return vertex.error();
    first = *vertex;
  }
  const auto check = check_settings(arguments.check);
  if (!check) return check.error();
  Outputs outputs;
  if (auto expected = expect_outputs(arguments, outputs); !expected) return expected.error();
  auto model = load_model(arguments.model, asked->reading, progress);
  if (!model) return model.error();
  if (auto surface = refuse_space(*model, "samples are"); !surface) return surface.error();
  const auto figures = sample(*std::move(model), arguments.settings,
                              {options, *check, *count, first}, progress, announce);
  if (!figures) return figures.error();

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
  if (!arguments.json.empty()) {
    const auto written =
        outputs.write_text(arguments.json, report_text(sample_json(*figures)), out.text);
    if (!written) return written.error();
  }
  if (figures->error) {
    out.note = accuracy_note(arguments.json, outputs, arguments.quiet, figures->error->report,
                             accuracy_line(*figures->error));
  }
  if (!outputs.uses_stdout()) out.text = sample_table(*figures);
  out.made = outputs.made();
  return out;
}

}  // namespace geotherm::app
