// SPDX-License-Identifier: MIT
#include "app/options.h"

#include <CLI/CLI.hpp>
#include <cmath>

#include "app/load_model.h"
#include "app/option_value.h"
#include "app/option_values.h"
#include "app/text.h"
#include "app/told.h"
#include "solver/heat/option_text.h"
#include "solver/linear/backend.h"

namespace geotherm::app {

CLI::Option* add_model_option(CLI::App& command, std::string& model, ReadingArguments& reading) {
  add_reading_options(command, reading);
  return command
      .add_option("MODEL", model,
                  "a file (.obj .ply .off .stl), a bundled model (geotherm models), or - for "
                  "standard input with --format")
      ->type_name("");
}

void add_reading_options(CLI::App& command, ReadingArguments& reading) {
  command
      .add_option("--format", reading.format, "of the model, whatever its name: obj, ply, off, stl")
      ->type_name("NAME")
      ->group("Model");
  command
      .add_option("--weld", reading.weld,
                  "vertices at most this far apart (model units; 0: equal) are one, which closes "
                  "cracks; all keep their ids")
      ->type_name("EPS")
      ->group("Model");
}

void add_backend_option(CLI::App& command, MethodArguments& arguments) {
  command.add_option("--backend", arguments.backend, "linear solver: " + joined(backend_names()))
      ->type_name("NAME")
      ->group("Method");
  command
      .add_flag("--strict", arguments.strict,
                "a backend that fails is an error; otherwise the next one takes over")
      ->group("Method");
}

namespace {

void add_word(CLI::App& command, const char* names, std::string& value, const char* type,
              const char* help) {
  command.add_option(names, value, help)->type_name(type)->group("Method");
}

}  // namespace

void add_method_options(CLI::App& command, MethodArguments& a) {
  const auto add = [&command](const char* names, std::string& value, const char* type,
                              const char* help) { add_word(command, names, value, type, help); };
  add("--time-step", a.time_step, "RULE",
      "diffusion time: mean-edge (t = m h^2, default), mean-face-area (t = m A/F), absolute:T");
  add("-m,--time-factor", a.time_factor, "M", "m of the time step, default 1");
  add("--constraint", a.constraint, "MODE",
      "pin-sources (default), pin-vertex[:V], penalty[:VALUE], conserve-energy, pseudo-inverse");
  add("--method", a.method, "NAME",
      "heat (default), wavefront, wavefront-fine (near exact), fast-marching, exact");
  add("--boundary", a.boundary, "RULE", "neumann (default), dirichlet, average");
  add_study_method_options(command, a);
}

void add_study_method_options(CLI::App& command, MethodArguments& a) {
  const auto add = [&command](const char* names, std::string& value, const char* type,
                              const char* help) { add_word(command, names, value, type, help); };
  add("--heat", a.heat, "MODE", "unit (default), diffuse, hold");
  add("--laplacian", a.laplacian, "KIND",
      "auto (default), cotan, intrinsic-delaunay, tufted, refined");
  add("--variant", a.variant, "NAME", "corrected (default), classic: as first published");
  add("--precision", a.precision, "NAME",
      "compact (default): factors at half the size where the backend can; refined: the same with a "
      "step of iterative refinement a solve; full: factors in double");
  add("--memory-limit", a.memory_limit, "SIZE",
      "most that a backend's factors may take, in MB or with K, M or G: 800, 4G; what needs more "
      "fails before it starts; default: free, what the machine has left");
  add("--refine", a.refine, "N",
      "cuts each face into four N times (0, default, to 6) before anything is solved: less error, "
      "4^N times the faces, memory and time; the output keeps the model's vertices");
  add_threads_option(command, a.threads);
}

void add_threads_option(CLI::App& command, std::string& threads) {
  command.add_option("--threads", threads, "default: all cores")->type_name("N")->group("Method");
}

void add_quiet_option(CLI::App& command, bool& quiet) {
  command.add_flag("--quiet", quiet, "no progress bar, no estimate of time");
}

void add_source_options(CLI::App& command, SourceArguments& arguments) {
  command
      .add_option(
          "-s,--source", arguments.sources,
          "17 or 3,99,512 (vertex ids from 0), curve:V1,V2,... (a line of vertices, joined "
          "along edges), random:K[:SEED], boundary, face:ID:b0:b1:b2, xyz:x:y:z; points may "
          "end in @OFFSET, the distance there; may be "
          "repeated, all are one source set")
      ->type_name("SOURCES")
      ->expected(1)
      ->allow_extra_args(false)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
      ->group("Sources");
  command
      .add_option("--source-file", arguments.file,
                  "one source a line: a vertex id, face:..., xyz:..., or x y z; # begins a comment")
      ->type_name("FILE")
      ->group("Sources");
  command
      .add_flag("--curve", arguments.curve,
                "the ids of the source file are a polyline; all of it is a source")
      ->group("Sources");
}

Result<MethodOptions> method_options(const MethodArguments& a) {
  MethodOptions options;
  double factor = 1;
  if (auto taken = take(parse_time_factor(a.time_factor), "--time-factor", factor); !taken) {
    return taken.error();
  }
  const Result<void> all = first_failure({
      take(parse_method(a.method), "--method", options.method),
      take(parse_backend(a.backend), "--backend", options.backend),
      take(parse_time_step_option(a.time_step, factor), "--time-step", options.time_step),
      take(parse_constraint_option(a.constraint), "--constraint", options.constraint),
      take(parse_heat_mode(a.heat), "--heat", options.heat),
      take(parse_boundary_rule(a.boundary), "--boundary", options.boundary),
      take(parse_laplacian(a.laplacian), "--laplacian", options.laplacian),
      take(parse_variant(a.variant), "--variant", options.variant),
      take(parse_precision(a.precision), "--precision", options.precision),
      take(parse_memory_limit(a.memory_limit), "--memory-limit", options.memory_limit_mb),
      take(parse_refine(a.refine), "--refine", options.refine),
      take(parse_threads(a.threads), "--threads", options.threads),
  });
  if (!all) return all.error();
  options.strict = a.strict;
  return options;
}

void note_unused_options(const MethodArguments& arguments, const MethodOptions& options,
                         std::vector<std::string>& warnings) {
  if (options.method != MethodKind::kHeat) {
    const MethodArguments usual;
    std::vector<std::string> unused;
    const auto look = [&](const char* name, const std::string& typed, const std::string& standard) {
      if (typed != standard) unused.emplace_back(name);
    };
    look("--backend", arguments.backend, usual.backend);
    if (arguments.strict) unused.emplace_back("--strict");
    look("--memory-limit", arguments.memory_limit, usual.memory_limit);
    look("--time-step", arguments.time_step, usual.time_step);
    look("--time-factor", arguments.time_factor, usual.time_factor);
    look("--constraint", arguments.constraint, usual.constraint);
    look("--heat", arguments.heat, usual.heat);
    look("--boundary", arguments.boundary, usual.boundary);
    look("--laplacian", arguments.laplacian, usual.laplacian);
    look("--variant", arguments.variant, usual.variant);
    look("--precision", arguments.precision, usual.precision);
    if (unused.empty()) return;
    warnings.push_back("the method " + to_text(options.method) + " does not use " + joined(unused) +
                       "; these are options of --method heat");
    return;
  }
  if (options.time_step.rule != TimeRule::kAbsolute || arguments.time_factor.empty()) return;
  warnings.push_back("--time-factor " + arguments.time_factor + " is not used: --time-step " +
                     arguments.time_step + " is the time itself; leave one of them out");
}

void protect_inputs(const std::string& model, const SourceArguments& sources, Outputs& outputs) {
  if (!is_bundled(model) && model != kStandardInput) outputs.protect(model, "the model itself");
  outputs.protect(sources.file, "the source file");
}

Result<std::vector<Source>> some_sources_of(const SourceArguments& arguments) {
  auto named = sources_of(arguments);
  if (!named || !named->empty()) return named;
  return Error{ErrorCode::kBadInput,
               "no source was given; say where distance is 0, such as -s 17 or -s boundary"};
}

Result<std::vector<Source>> sources_of(const SourceArguments& arguments) {
  if (arguments.curve && arguments.file.empty()) {
    return Error{ErrorCode::kBadInput,
                 "--curve needs the vertex ids of the curve; add --source-file FILE"};
  }
  std::vector<Source> sources;
  for (const std::string& text : arguments.sources) {
    auto spec = parse_source(text);
    if (!spec) return about("--source", spec.error());
    const std::string shown = text.size() > 60 ? text.substr(0, 57) + "..." : text;
    sources.push_back({*std::move(spec), "--source " + one_line(shown), ErrorCode::kBadInput});
  }
  if (arguments.file.empty()) return sources;
  auto listed = read_source_file(arguments.file, arguments.curve);
  if (!listed) return listed.error();
  for (Source& source : *listed) sources.push_back(std::move(source));
  return sources;
}

}  // namespace geotherm::app
