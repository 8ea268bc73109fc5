// SPDX-License-Identifier: MIT
#include "app/cli/command_line.h"

#include <unistd.h>

#include <CLI/CLI.hpp>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <system_error>

#include "app/cli/commands.h"
#include "app/session/model.h"
#include "app/session/progress.h"
#include "app/session/wording.h"
#include "app/text/text.h"

namespace geotherm::app {
namespace {

constexpr std::array kCommands = {"view",     "solve",    "info",   "compare", "render",
                                  "path",     "isolines", "sample", "study",   "generate",
                                  "backends", "devices",  "models"};

int fail(int code, const std::string& message) {
  std::fprintf(stderr, "geotherm: error: %s\n", one_line(message).c_str());
  return code;
}

int fail(const Error& error) { return fail(exit_code(error.code), told(error)); }

int print(const CommandOutput& output) {
  for (const Warning& warning : output.warnings) {
    std::fprintf(stderr, "geotherm: warning: %s\n", one_line(told(warning)).c_str());
  }
  if (!output.note.empty()) {
    std::fprintf(stderr, "geotherm: %s\n", one_line(output.note).c_str());
  }
  errno = 0;
  if (std::fwrite(output.text.data(), 1, output.text.size(), stdout) == output.text.size() &&
      std::fflush(stdout) == 0) {
    return output.failure ? fail(*output.failure) : 0;
  }
  const int code = errno;
  for (const std::string& path : output.made) ::unlink(path.c_str());
  return fail(1, "standard output: cannot be written: " + std::generic_category().message(code) +
                     "; choose another place for it");
}

int finish(const Result<CommandOutput>& result) {
  if (result) return print(*result);
  return fail(result.error());
}

template <class Arguments, class Run>
int run_with_bar(const Arguments& arguments, Run&& run) {
  ProgressBar bar(!arguments.quiet && error_is_terminal());
  const Result<CommandOutput> result = run(arguments, bar.progress());
  bar.clear();
  return finish(result);
}

bool is_in(const auto& list, const std::string& word) {
  return std::find(list.begin(), list.end(), word) != list.end();
}

/// The same for a command that says more than its bar shows.
template <class Arguments, class Run>
int run_with_words(const Arguments& arguments, Run&& run) {
  ProgressBar bar(!arguments.quiet && error_is_terminal());
  const Result<CommandOutput> result =
      run(arguments, bar.progress(), arguments.quiet ? Announce() : bar.announce());
  bar.clear();
  return finish(result);
}

/// `geotherm MODEL` is `geotherm view MODEL`.
bool is_model(const std::string& word) {
  std::error_code unknown;
  const std::filesystem::path path(word);
  return is_bundled(word) || path.has_extension() || std::filesystem::exists(path, unknown);
}

/// What is wrong with a first word that is no command; empty when it is one or an option.
std::string first_word_problem(const std::vector<std::string>& arguments) {
  const std::string there_are = "there are " + joined(kCommands);
  if (arguments.empty()) {
    return "no command and no model was given; name a model to look at, such as bunny, or a "
           "command: " +
           there_are + "; see geotherm --help";
  }
  const std::string& word = arguments.front();
  if (word.starts_with('-') || is_in(kCommands, word)) return {};
  return "there is no command and no model '" + word + "'; " + there_are;
}

/// CLI11 leaves long descriptions on one line.
void wrap_descriptions(CLI::App& command) {
  constexpr std::size_t kWidth = 68;
  for (CLI::Option* option : command.get_options()) {
    option->description(wrapped(option->get_description(), kWidth));
  }
}

/// An empty word is a variable of the shell that was not set, most likely: never a value.
std::string empty_value_problem(const CLI::App& command) {
  for (const CLI::Option* option : command.get_options()) {
    const std::vector<std::string>& values = option->results();
    if (std::find(values.begin(), values.end(), "") == values.end()) continue;
    return option->get_name() + ": was given an empty value; give one" +
           (option->get_required() ? "" : " or leave it out");
  }
  return {};
}

/// CLI11 describes what is wrong; what helps is the help of the command.
int fail_to_parse(const CLI::ParseError& error, const std::string& first) {
  std::string what = error.what();
  while (!what.empty() && (what.back() == '\n' || what.back() == '.')) what.pop_back();
  std::replace(what.begin(), what.end(), '\n', ' ');
  const std::string command = first.starts_with('-') ? "" : first + " ";
  return fail(2, what + "; see geotherm " + command + "--help");
}

}  // namespace

int exit_code(ErrorCode code) {
  return code == ErrorCode::kBadInput || code == ErrorCode::kNotAvailable ? 2 : 1;
}

int run_command_line(std::vector<std::string> arguments, Drawing& drawing, ViewerWindow& window) {
  const std::vector<std::string> words = arguments;
  if (!arguments.empty() && !arguments.front().starts_with('-') &&
      !is_in(kCommands, arguments.front()) && is_model(arguments.front())) {
    arguments.insert(arguments.begin(), "view");
  }
  if (const std::string problem = first_word_problem(arguments); !problem.empty()) {
    return fail(2, problem);
  }
  CLI::App root("Geodesic distance by the heat method: on meshes, points, volumes and grids.",
                "geotherm");
  root.set_version_flag("--version", "geotherm " GEOTHERM_VERSION);
  root.require_subcommand(0, 1);
  root.footer(
      "Examples:\n  geotherm bunny\n  geotherm solve bunny -s 17 -o distances.ply\n"
      "geotherm COMMAND --help says more about each.");

  ViewArguments view;
  SolveArguments solve;
  InfoArguments info;
  CompareArguments compare;
  RenderArguments render;
  PathArguments path;
  IsolinesArguments isolines;
  SampleArguments sample;
  StudyArguments study;
  GenerateArguments generate;
  DevicesArguments devices;
  ListArguments backends, models;
  CLI::App* const view_app =
      root.add_subcommand("view", "A window to explore a model in; geotherm MODEL does the same.");
  CLI::App* const solve_app =
      root.add_subcommand("solve", "Distance from a source set to every vertex.");
  CLI::App* const info_app =
      root.add_subcommand("info", "What a model is, and what is wrong with it.");
  CLI::App* const compare_app =
      root.add_subcommand("compare", "The same work through several backends, side by side.");
  CLI::App* const render_app =
      root.add_subcommand("render", "Pictures, without a display and without a window.");
  CLI::App* const path_app = root.add_subcommand("path", "Geodesic paths and streamlines.");
  CLI::App* const isolines_app =
      root.add_subcommand("isolines", "Lines of equal distance, closed or open.");
  CLI::App* const sample_app = root.add_subcommand(
      "sample", "Farthest-point samples, and the nearest of them to every vertex.");
  CLI::App* const study_app = root.add_subcommand(
      "study", "The error of the heat method over time factors, rules and modes.");
  CLI::App* const generate_app = root.add_subcommand("generate", "Writes a bundled model.");
  CLI::App* const backends_app =
      root.add_subcommand("backends", "The linear solvers of this build, the default first.");
  CLI::App* const devices_app =
      root.add_subcommand("devices", "What can draw on this machine, the default marked.");
  CLI::App* const models_app = root.add_subcommand("models", "The bundled models.");
  add_view_options(*view_app, view);
  add_solve_options(*solve_app, solve);
  add_info_options(*info_app, info);
  add_compare_options(*compare_app, compare);
  add_render_options(*render_app, render);
  add_path_options(*path_app, path);
  add_isolines_options(*isolines_app, isolines);
  add_sample_options(*sample_app, sample);
  add_study_options(*study_app, study);
  add_generate_options(*generate_app, generate);
  add_devices_options(*devices_app, devices);
  add_backends_options(*backends_app, backends);
  add_models_options(*models_app, models);

  for (CLI::App* command : root.get_subcommands({})) wrap_descriptions(*command);

  const std::string first = arguments.front();
  render.command = view.command = shell_command("geotherm", words);
  const bool has_empty_word = std::find(words.begin(), words.end(), "") != words.end();
  if (!has_empty_word) complete_bare_fit(arguments);
  try {
    std::reverse(arguments.begin(), arguments.end());  // the order that CLI11 takes them in
    root.parse(arguments);
  } catch (const CLI::CallForHelp&) {
    return print({root.help(), {}, {}});
  } catch (const CLI::CallForVersion& version) {
    return print({std::string(version.what()) + "\n", {}, {}});
  } catch (const CLI::ParseError& error) {
    return fail_to_parse(error, first);
  }
  for (const CLI::App* command : root.get_subcommands()) {
    if (const std::string problem = empty_value_problem(*command); !problem.empty()) {
      return fail(2, problem);
    }
  }
  if (view_app->parsed()) {
    return run_with_bar(view, [&](const ViewArguments& a, const Progress& progress) {
      return run_view(a, drawing, window, progress);
    });
  }
  if (solve_app->parsed()) {
    return run_with_words(solve, [&drawing](const SolveArguments& a, const Progress& progress,
                                            const Announce& announce) {
      return run_solve(a, drawing, progress, announce);
    });
  }
  if (info_app->parsed()) return run_with_bar(info, run_info);
  if (compare_app->parsed()) return run_with_bar(compare, run_compare);
  if (render_app->parsed()) {
    return run_with_bar(render, [&drawing](const RenderArguments& a, const Progress& progress) {
      return run_render(a, drawing, progress);
    });
  }
  if (path_app->parsed()) return run_with_bar(path, run_path);
  if (isolines_app->parsed()) return run_with_bar(isolines, run_isolines);
  if (sample_app->parsed()) return run_with_words(sample, run_sample);
  if (study_app->parsed()) return run_with_bar(study, run_study);
  if (devices_app->parsed()) return finish(run_devices(devices, drawing));
  if (generate_app->parsed()) return run_with_bar(generate, run_generate);
  if (backends_app->parsed()) return finish(run_backends(backends));
  return finish(run_models(models));
}

}  // namespace geotherm::app
