// SPDX-License-Identifier: MIT
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>
#include <regex>
#include <string>

#include "bench/bench_mesh.h"
#include "bench/load_bench.h"
#include "bench/machine.h"
#include "bench/report.h"
#include "bench/solve_bench.h"
#include "solver/core/parallel.h"
#include "solver/linear/backend.h"
#include "solver/mesh/write_file.h"

namespace geotherm::bench {
namespace {

/// The backends of the heat method, and the methods without one that may serve instead of it.
std::vector<std::string> solver_names() {
  std::vector<std::string> names = backend_names();
  names.insert(names.end(), {"wavefront", "wavefront-fine"});
  return names;
}

constexpr Index kLoadFaces = 1'000'000;

struct Arguments {
  bool quick = false;
  std::string json, only;
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

int run(const Arguments& arguments) {
  const bool json_only = arguments.json == "-";
  std::FILE* const out = json_only ? stderr : stdout;
  const int threads = thread_count(arguments.threads);
  const Machine machine = read_machine();
  print(machine_text(machine, threads), out);
  if (make_baseline_contender() == nullptr) {
    print("Built without CHOLMOD, which the baseline needs: there are no ratios.\n", out);
  }

  const SolvePlan plan{.quick = arguments.quick,
                       .threads = arguments.threads,
                       .backends = solver_names(),
                       .only = std::regex(arguments.only)};
  print(solve_heading(), out);
  const auto groups = measure_solves(plan, say, [&](const SolveGroup& group) {
    say("");
    print(solve_text(group), out);
  });
  const auto growth = measure_growth(groups);
  print(growth_text(growth), out);

  std::vector<LoadRow> loads;
  if (std::regex_search("load", plan.only)) {
    say("reading OBJ");
    if (const auto mesh = make_mesh("torus", kLoadFaces)) {
      loads.push_back(measure_load("torus", *mesh, arguments.quick ? 5 : 15));
    }
    say("");
    for (const LoadRow& row : loads) print(load_text(row), out);
  }

  RenderBench render;
  if (std::regex_search("render", plan.only)) {
    render = measure_render(say);
    say("");
    print(render_text(render), out);
  }

  ExploreBench explore;
  if (std::regex_search("explore", plan.only)) {
    explore = measure_explore(say);
    say("");
    print(explore_text(explore), out);
  }

  if (groups.empty() && loads.empty() && render.device.empty() && render.failure.empty() &&
      explore.rows.empty() && explore.failure.empty())
    print("Nothing fits --only " + arguments.only + "\n", stderr);
  if (arguments.json.empty()) return 0;
  const auto written =
      write_file(arguments.json, to_json(machine, threads, groups, growth, loads, render, explore));
  if (written) return 0;
  print("geotherm_bench: error: " + written.error().message + "\n", stderr);
  return 1;
}

int run_command_line(int argc, char** argv) {
  Arguments arguments;
  CLI::App app("Set-up, query, batch and memory of each backend beside a plain use of CHOLMOD.");
  app.add_flag("--quick", arguments.quick, "Fewer meshes and runs: under ten minutes on 2 cores");
  app.add_option("--json", arguments.json, "Write the figures to this file ('-': standard output)");
  app.add_option("--threads", arguments.threads, "Threads of the backends (default: all cores)")
      ->check(CLI::NonNegativeNumber);
  app.add_option("--only", arguments.only,
                 "Regular expression: measure only rows MESH-SIZEk/BACKEND in which it is found, "
                 "such as 'gargoyle-200k/cholmod' or '1050k'; 'load' is the reading of files, "
                 "'render' the drawing, 'explore' the viewer")
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
    return geotherm::bench::run_command_line(argc, argv);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "geotherm_bench: error: %s\n", error.what());
    return 1;
  }
}
