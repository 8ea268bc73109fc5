// SPDX-License-Identifier: MIT
#include "app/cli/command_line.h"

#include <unistd.h>

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <memory>
#include <system_error>
#include <thread>
#include <type_traits>
#include <utility>

#include "app/cli/commands.h"
#include "app/session/model.h"
#include "app/session/progress.h"
#include "app/session/ranks.h"
#include "app/session/report.h"
#include "app/session/wording.h"
#include "app/text/text.h"
#include "solver/core/text.h"
#include "solver/mesh/io/mask_numbers.h"

namespace geotherm::app {
namespace {

/// Whether this process may speak: where several work together, the first one does.
bool is_first_rank() { return launched_as().rank == 0; }

int fail(int code, const std::string& message) {
  if (!is_first_rank()) {
    if (mpi_is_started()) return code;
    // The first one speaks, and the launcher ends this one for it within a second or so; unless it
    // has nothing to say and waits for this one where MPI starts.
    std::this_thread::sleep_for(std::chrono::seconds(3));
  }
  std::fprintf(stderr, "geotherm: error: %s\n", one_line(message).c_str());
  return code;
}

int fail(const Error& error) { return fail(exit_code(error.code), to_text(error)); }

int print(const CommandOutput& output) {
  if (!is_first_rank()) return 0;
  for (const Warning& warning : output.warnings) {
    std::fprintf(stderr, "geotherm: warning: %s\n", one_line(to_text(warning)).c_str());
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

/// `geotherm MODEL` is `geotherm view MODEL`.
bool is_model(const std::string& word) {
  std::error_code unknown;
  const std::filesystem::path path(word);
  return is_bundled(word) || path.has_extension() || std::filesystem::exists(path, unknown);
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

/// Every file that an option names: one that another option writes would be lost.
void remember_named_files(const CLI::App& command) {
  std::vector<InputFile> named;
  for (const CLI::Option* option : command.get_options()) {
    if (option->get_type_name() == "TEXT") continue;
    const std::string name = option->get_name();
    const bool is_model = option->get_positional() && name.starts_with("MODEL");
    const std::string called = is_model ? "the model itself" : "the file of " + name;
    for (const std::string& value : option->results()) {
      const std::string path = name == "--mask" ? io::parse_mask_text(value).path : value;
      for (const FileId& id : files_named(path)) named.push_back({id, called, name});
    }
  }
  remember_files(std::move(named));
}

/// Null when there is no such command.
const CLI::App* find_command(const CLI::App& root, const std::string& name) {
  const auto found = root.get_subcommands(
      [&name](const CLI::App* command) { return command->get_name() == name; });
  return found.empty() ? nullptr : found.front();
}

/// A word that begins like an option and is none of the command's; empty: there is no such word.
std::string unknown_option(const CLI::App& command, const std::vector<std::string>& words,
                           std::vector<std::string>& known) {
  for (const CLI::Option* option : command.get_options()) {
    for (const std::string& name : option->get_lnames()) known.push_back("--" + name);
  }
  for (const std::string& word : words) {
    const std::string name = word.substr(0, word.find('='));
    if (name == "--") return {};
    if (name.starts_with("--") && std::ranges::find(known, name) == known.end()) return name;
  }
  return {};
}

/// What CLI11 says, in the words of people where those are others.
std::string in_words(const CLI::ParseError& error, const CLI::App& command) {
  std::string what = error.what();
  while (!what.empty() && (what.back() == '\n' || what.back() == '.')) what.pop_back();
  std::replace(what.begin(), what.end(), '\n', ' ');
  if (dynamic_cast<const CLI::ExtrasError*>(&error) != nullptr) {
    const std::vector<std::string> extra = command.remaining();
    if (!extra.empty()) return "there is no place for " + joined(extra, " and ");
  }
  if (dynamic_cast<const CLI::ArgumentMismatch*>(&error) != nullptr) {
    for (const CLI::Option* option : command.get_options()) {
      const std::size_t most = std::max(1, option->get_items_expected_max());
      const bool once = option->get_multi_option_policy() == CLI::MultiOptionPolicy::Throw;
      if (once && option->count() > most) return option->get_name() + " was given more than once";
    }
  }
  return what;
}

/// Another name of a file that was read as options, since it begins with a dash; empty: there is
/// none.
std::string named_file(const std::vector<std::string>& words) {
  const auto is_file = [](const std::string& word) {
    std::error_code failed;
    return word.starts_with('-') && std::filesystem::exists(word, failed);
  };
  const auto found = std::ranges::find_if(words, is_file);
  return found == words.end() ? std::string() : "./" + *found;
}

/// CLI11 describes what is wrong; what helps is the option that was meant, or the command's help.
int fail_to_parse(const CLI::ParseError& error, const CLI::App& command,
                  const std::vector<std::string>& words) {
  std::vector<std::string> known;
  const std::string unknown = unknown_option(command, words, known);
  const std::string file = named_file(words);
  const std::string near = file.empty() ? nearest_word(unknown, known) : file;
  const std::string what =
      unknown.empty() ? in_words(error, command) : "there is no option " + unknown;
  const std::string name = command.get_parent() == nullptr ? "" : command.get_name() + " ";
  return fail(2, what + "; " + (near.empty() ? "" : "did you mean " + near + "? ") +
                     "see geotherm " + name + "--help");
}

/// CLI::App::help() is that of the command that was typed.
std::string help_of(const CLI::App& app) {
  const std::string name = app.get_parent() == nullptr ? "geotherm" : "geotherm " + app.get_name();
  return app.get_formatter()->make_help(&app, name, CLI::AppFormatMode::Normal);
}

struct Subcommand {
  std::string name, description;
  std::function<void(CLI::App& command)> add_options;
  std::function<int()> run;
};

/// `run` takes the arguments, and where it takes more the progress of a bar and, behind that, what
/// is said beside the bar.
template <class Arguments, class Run>
Subcommand subcommand(std::string name, std::string description,
                      void (*add)(CLI::App& command, Arguments& arguments), Run run) {
  const auto given = std::make_shared<Arguments>();
  const auto run_given = [given, run] {
    if constexpr (std::is_invocable_v<Run, const Arguments&>) {
      return finish(run(*given));
    } else {
      const bool speaks = !given->quiet && is_first_rank();
      ProgressBar bar(speaks && error_is_terminal());
      Result<CommandOutput> result = CommandOutput{};
      if constexpr (std::is_invocable_v<Run, const Arguments&, const Progress&>) {
        result = run(*given, bar.progress());
      } else {
        result = run(*given, bar.progress(), speaks ? bar.announce() : Announce());
      }
      bar.clear();
      return finish(result);
    }
  };
  return {std::move(name), std::move(description),
          [given, add](CLI::App& command) { add(command, *given); }, run_given};
}

void add_help_options(CLI::App& command, std::string& name) {
  command.add_option("COMMAND", name, "one of those of geotherm --help");
}

std::vector<Subcommand> subcommands(CLI::App& root, Drawing& drawing, ViewerWindow& window) {
  const auto view = [&](const ViewArguments& arguments, const Progress& progress) {
    return run_view(arguments, drawing, window, progress);
  };
  const auto solve = [&](const SolveArguments& arguments, const Progress& progress,
                         const Announce& announce) {
    return run_solve(arguments, drawing, progress, announce);
  };
  const auto render = [&](const RenderArguments& arguments, const Progress& progress) {
    return run_render(arguments, drawing, progress);
  };
  const auto devices = [&](const ListArguments& arguments) {
    return run_devices(arguments, drawing);
  };
  const auto completion = [&](const std::string& shell) {
    return run_completion(shell, root, drawing.colour_maps());
  };
  const auto help = [&](const std::string& name) -> Result<CommandOutput> {
    const CLI::App* const command = name.empty() ? &root : find_command(root, name);
    if (command != nullptr) return CommandOutput{help_of(*command), {}, {}};
    return Error{ErrorCode::kBadInput,
                 "there is no command '" + name + "'",
                 {known_words(name, command_names(root))}};
  };
  return {
      subcommand("view", "A window to explore a model in; geotherm MODEL does the same.",
                 add_view_options, view),
      subcommand("solve", "Distance from a source set to every vertex.", add_solve_options, solve),
      subcommand("batch",
                 "Distances on many models, each in a process of its own; goes on where it ended.",
                 add_batch_options, run_batch),
      subcommand("plan", "Memory and time of a large solve, before it is started.",
                 add_plan_options, run_plan),
      subcommand("info", "What a model is, and what is wrong with it.", add_info_options, run_info),
      subcommand("compare", "The same work through several backends, side by side.",
                 add_compare_options, run_compare),
      subcommand("render", "Pictures, without a display and without a window.", add_render_options,
                 render),
      subcommand("path", "Geodesic paths and streamlines.", add_path_options, run_path),
      subcommand("logmap", "Where each vertex is seen from a point: start direction and distance.",
                 add_log_map_options, run_log_map),
      subcommand("trace", "Straightest lines from a point in given directions.", add_trace_options,
                 run_trace),
      subcommand("centre", "Where the distances to given points are least: their mean or median.",
                 add_centre_options, run_centre),
      subcommand("transport", "Tangent vectors carried over the surface without turning.",
                 add_transport_options, run_transport),
      subcommand("extend", "Values of some vertices carried to all.", add_extend_options,
                 run_extend),
      subcommand("signed", "Distance to curves, with the side.", add_signed_options, run_signed),
      subcommand("isolines", "Lines of equal distance, closed or open.", add_isolines_options,
                 run_isolines),
      subcommand("sample", "Farthest-point samples, and the nearest of them to every vertex.",
                 add_sample_options, run_sample),
      subcommand("study", "The error of the heat method over time factors, rules and modes.",
                 add_study_options, run_study),
      subcommand("generate", "Writes a bundled model.", add_generate_options, run_generate),
      subcommand("backends", "The linear solvers of this build, the default first.",
                 add_list_options, run_backends),
      subcommand("devices", "What can draw on this machine, the default marked.", add_list_options,
                 devices),
      subcommand("models", "The bundled models.", add_list_options, run_models),
      subcommand("completion", "A script by which a shell completes commands, options and values.",
                 add_completion_options, completion),
      subcommand("help", "The help of a command.", add_help_options, help),
  };
}

}  // namespace

int exit_code(ErrorCode code) {
  return code == ErrorCode::kBadInput || code == ErrorCode::kNotAvailable ? 2 : 1;
}

int run_command_line(std::vector<std::string> arguments, Drawing& drawing, ViewerWindow& window) {
  const std::vector<std::string> words = arguments;
  CLI::App root("Geodesic distance by the heat method: on meshes, points, volumes and grids.",
                "geotherm");
  root.set_version_flag("-V,--version", "geotherm " GEOTHERM_VERSION);
  root.require_subcommand(0, 1);
  root.footer(
      "Examples:\n  geotherm bunny\n  geotherm solve bunny -s 17 -o distances.ply\n"
      "geotherm COMMAND --help says more about each.");
  const std::vector<Subcommand> commands = subcommands(root, drawing, window);
  for (const Subcommand& each : commands) {
    CLI::App* const command = root.add_subcommand(each.name, each.description);
    each.add_options(*command);
    wrap_descriptions(*command);
  }
  if (arguments.empty()) return print({root.help(), {}, {}});

  const std::string& first = words.front();
  if (!first.starts_with('-') && find_command(root, first) == nullptr) {
    if (!is_model(first)) {
      std::vector<std::string> known = command_names(root);
      for (const BundledModel& model : bundled_models()) known.emplace_back(model.name);
      return fail(2,
                  "there is no command and no model '" + first + "'; " + known_words(first, known));
    }
    arguments.insert(arguments.begin(), "view");
  }
  const CLI::App* const named = find_command(root, arguments.front());
  remember_command(shell_command("geotherm", words));
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
    return fail_to_parse(error, named == nullptr ? root : *named, words);
  }
  for (const CLI::App* command : root.get_subcommands()) {
    if (const std::string problem = empty_value_problem(*command); !problem.empty()) {
      return fail(2, problem);
    }
    remember_named_files(*command);
  }
  for (const Subcommand& each : commands) {
    if (!root.got_subcommand(each.name)) continue;
    if (each.name != "solve" && each.name != "sample" && each.name != "batch") {
      if (auto alone = refuse_ranks("geotherm " + each.name); !alone) return fail(alone.error());
    }
    const int code = each.run();
    finish_mpi();
    return code;
  }
  return print({root.help(), {}, {}});
}

}  // namespace geotherm::app
