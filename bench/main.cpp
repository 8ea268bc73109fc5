// SPDX-License-Identifier: MIT
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <exception>
#include <regex>
#include <string>

#include "bench/bench_mesh.h"
#include "bench/benches.h"
#include "bench/machine_limits.h"
#include "bench/report.h"
#include "geotherm/backend.h"
#include "solver/core/memory.h"
#include "solver/core/parallel.h"
#include "solver/mesh/output_file.h"

namespace geotherm::bench {
namespace {

/// The backends of the heat method, and the methods without one that may serve instead of it.
std::vector<std::string> solver_names() {
  std::vector<std::string> names = backend_names();
  names.insert(names.end(), {"wavefront", "wavefront-fine"});
  return names;
}

constexpr Index kLoadFaces = 1'000'000;
constexpr Index kMovingFaces[] = {20'000, 100'000};

struct Arguments {
  bool quick = false;
  std::string json, markdown, svg, only;
  int threads = 0;
};

void print(const std::string& text, std::FILE* to) {
  std::fputs(text.c_str(), to);
  std::fflush(to);
}

/// What is being done: one line that is written over on a terminal, nothing elsewhere.
void say(std::string_view what) {
  static const bool kTerminal = isatty(STDERR_FILENO) != 0;
  if (!kTerminal) return;
  std::fprintf(stderr, "\r\033[K%.*s", static_cast<int>(what.size()), what.data());
  std::fflush(stderr);
}

/// Measures what is asked for and prints it as it comes.
BenchRun measure_all(const Arguments& arguments, std::FILE* out) {
  BenchRun run;
  run.machine = read_machine();
  run.threads = thread_count(arguments.threads);
  run.quick = arguments.quick;
  print(machine_text(run.machine, run.threads), out);
  if (make_baseline_contender() == nullptr) {
    print("Built without CHOLMOD, which the baseline needs: there are no ratios.\n", out);
  }

  const SolvePlan plan{.quick = arguments.quick,
                       .threads = arguments.threads,
                       .backends = solver_names(),
                       .only = std::regex(arguments.only),
                       .chosen = !arguments.only.empty()};
  const bool solves = std::ranges::any_of(
      all_cases(), [&](const Case& c) { return !backends_for(c, plan).empty(); });
  if (solves || std::regex_search("limits", plan.only)) {
    run.limits = measure_limits(run.threads, 0, say);
    say("");
    print(limits_text(run.limits), out);
  }
  if (solves) print(solve_heading(), out);
  run.groups = measure_solves(plan, say, [&](const SolveGroup& group) {
    say("");
    print(solve_text(group, run.limits, run.threads), out);
  });
  run.growth = measure_growth(run.groups);
  print(growth_text(run.growth), out);
  if (!run.groups.empty()) {
    run.limits = remeasure_limits(run.limits, say);
    say("");
    print(limits_text(run.limits), out);
  }

  if (std::regex_search("load", plan.only)) {
    say("reading OBJ");
    if (const auto mesh = make_mesh("torus", kLoadFaces)) {
      run.loads.push_back(measure_load("torus", *mesh, arguments.quick ? 5 : 15));
    }
    say("");
    for (const LoadRow& row : run.loads) print(load_text(row), out);
  }
  if (std::regex_search("moving", plan.only)) {
    say("a surface that moves");
    for (const Index faces : kMovingFaces) {
      const auto mesh = make_mesh("gargoyle", faces);
      if (!mesh) continue;
      for (const MethodKind method : {MethodKind::kHeat, MethodKind::kWavefront}) {
        run.moving.push_back(
            measure_moving(method, "gargoyle", *mesh, arguments.quick ? 4 : 12, arguments.threads));
      }
    }
    say("");
    for (const MovingRow& row : run.moving) print(moving_text(row), out);
  }
  if (std::regex_search("render", plan.only)) {
    run.render = measure_render(say);
    say("");
    print(render_text(run.render), out);
  }
  if (std::regex_search("explore", plan.only)) {
    run.explore = measure_explore(say);
    say("");
    print(explore_text(run.explore), out);
  }
  return run;
}

bool nothing_measured(const BenchRun& run) {
  return run.groups.empty() && run.loads.empty() && run.moving.empty() && !run.limits.measured() &&
         run.render.device.empty() && run.render.failure.empty() && run.explore.rows.empty() &&
         run.explore.failure.empty();
}

int run(const Arguments& arguments) {
  const bool silent = arguments.json == "-" || arguments.markdown == "-" || arguments.svg == "-";
  const BenchRun run = measure_all(arguments, silent ? stderr : stdout);
  if (nothing_measured(run)) {
    print("geotherm_bench: error: nothing fits --only " + arguments.only + "\n", stderr);
    return 2;
  }

  const auto wrote = [](const std::string& path, const auto& make) {
    if (path.empty()) return true;
    const auto written = write_file(path, make());
    if (!written) print("geotherm_bench: error: " + sentence(written.error()) + "\n", stderr);
    return bool(written);
  };
  // All are tried: what took an hour to measure is not lost to one path.
  const bool json = wrote(arguments.json, [&] { return to_json(run); });
  const bool markdown = wrote(arguments.markdown, [&] { return to_markdown(run); });
  const bool svg = wrote(arguments.svg, [&] { return performance_chart(run); });
  return json && markdown && svg ? 0 : 1;
}

int run_command_line(int argc, char** argv) {
  Arguments arguments;
  CLI::App app("Set-up, query, batch and memory of each backend beside a plain use of CHOLMOD.");
  app.add_flag(
      "--quick", arguments.quick,
      "Fewer runs, and fewer meshes unless --only names them: under ten minutes on 2 cores");
  app.add_option("--json", arguments.json, "Write the figures to this file ('-': standard output)");
  app.add_option("--markdown", arguments.markdown,
                 "Write them as tables of Markdown ('-' as above)");
  app.add_option("--svg", arguments.svg, "Write a chart over the number of faces ('-' as above)");
  app.add_option("--threads", arguments.threads, "Threads of the backends (default: all cores)")
      ->check(CLI::NonNegativeNumber);
  app.add_option("--only", arguments.only,
                 "Regular expression: measure only rows MESH-SIZEk/BACKEND in which it is found, "
                 "such as 'gargoyle-280k/cholmod' or '1100k'; 'limits' are the machine's, 'load' "
                 "is the reading of files, 'moving' a surface that moves, 'render' the drawing, "
                 "'explore' the viewer")
      ->check([](const std::string& text) {
        try {
          const std::regex parsed(text);
          return std::string();
        } catch (const std::regex_error& error) {
          return "not a regular expression: " + std::string(error.what());
        }
      });
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  }
  return run(arguments);
}

}  // namespace
}  // namespace geotherm::bench

int main(int argc, char** argv) {
  try {
    geotherm::keep_freed_memory();  // as `geotherm solve --each` does; all contenders alike
    return geotherm::bench::run_command_line(argc, argv);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "geotherm_bench: error: %s\n", error.what());
    return 1;
  }
}
