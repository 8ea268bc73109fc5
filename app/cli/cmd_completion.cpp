// SPDX-License-Identifier: MIT
#include <CLI/CLI.hpp>

#include <algorithm>
#include <map>

#include "app/cli/commands.h"
#include "app/session/model.h"
#include "app/session/settings.h"
#include "app/text/text.h"
#include "geotherm/backend.h"
#include "geotherm/directions.h"
#include "geotherm/path.h"
#include "solver/core/text.h"

namespace geotherm::app {
namespace {

/// The three scripts are written from these: what may stand behind a command.
struct CompletedOption {
  std::vector<std::string> names;  ///< with their dashes
  std::string description;
  bool takes_value = false, is_file = false;
  std::vector<std::string> values;

  bool completes_as(const CompletedOption& other) const {
    return is_file == other.is_file && values == other.values;
  }
};

struct CompletedCommand {
  std::string name, description;
  std::vector<CompletedOption> options;
  bool takes_model = false, takes_files = true;
};

/// The help breaks its lines; a script has one for each option.
std::string on_one_line(std::string text) {
  std::ranges::replace(text, '\n', ' ');
  return text;
}

/// The text with a backslash before each of these characters.
std::string with_backslashes(const std::string& text, std::string_view before) {
  std::string out;
  for (const char c : text) {
    if (before.find(c) != before.npos) out += '\\';
    out += c;
  }
  return out;
}

/// What differences may be measured from: backends, and methods without one.
std::vector<std::string> solver_names() {
  std::vector<std::string> names = backend_names();
  for (const std::string& method : all_names<MethodKind>()) {
    if (method != to_text(MethodKind::kHeat)) names.push_back(method);
  }
  return names;
}

/// The words among the values of an option; one with a colon is several words to a shell.
std::vector<std::string> values_of(const std::string& option,
                                   std::span<const std::string> colour_maps) {
  const Setting* const setting = find_setting(option);
  std::vector<std::string> values;
  if (setting != nullptr && setting->values != nullptr) values = setting->values();
  if (option == "on-poor") values = all_names<OnPoor>();
  if (option == "field") values = all_names<PathField>();
  if (option == "rule") values = all_names<SideRule>();
  if (option == "reference") values = solver_names();
  if (option == "colour-map") values.assign(colour_maps.begin(), colour_maps.end());
  std::erase_if(values, [](const std::string& value) {
    return value.find_first_of(": '\"$&()") != std::string::npos;
  });
  return values;
}

/// What the values of options are called that are paths.
constexpr std::string_view kPathValues[] = {"FILE", "FOLDER", "FRAMES"};

CompletedOption completed(const CLI::Option& option, std::span<const std::string> colour_maps) {
  CompletedOption out;
  out.is_file = std::ranges::count(kPathValues, option.get_type_name()) > 0;
  out.takes_value = option.get_items_expected_max() > 0;
  for (const std::string& name : option.get_snames()) out.names.push_back("-" + name);
  for (const std::string& name : option.get_lnames()) {
    out.names.push_back("--" + name);
    if (!out.takes_value || out.is_file || !out.values.empty()) continue;
    out.values = values_of(name, colour_maps);
  }
  out.description = on_one_line(option.get_description());
  return out;
}

/// What a model alone, `geotherm bunny`, is short for.
constexpr std::string_view kOpens = "view";

/// Commands that take names alone.
constexpr std::string_view kOfNames[] = {"completion", "generate", "help"};

std::vector<CompletedCommand> completed(const CLI::App& root,
                                        std::span<const std::string> colour_maps) {
  std::vector<CompletedCommand> all;
  for (const std::string& name : command_names(root)) {
    const CLI::App& command = *root.get_subcommand(name);
    CompletedCommand one{name, on_one_line(command.get_description()), {}};
    one.takes_files = std::ranges::count(kOfNames, name) == 0;
    for (const CLI::Option* option : command.get_options()) {
      if (option->nonpositional()) one.options.push_back(completed(*option, colour_maps));
      one.takes_model |= option->get_name() == "MODEL";
    }
    all.push_back(std::move(one));
  }
  std::ranges::stable_partition(all, [](const auto& one) { return one.name != kOpens; });
  return all;
}

/// The pattern of a command's word for bash and zsh. The last one stands for a model, too.
std::string pattern_of(const CompletedCommand& command) {
  return command.name == kOpens ? command.name + " | [!-]*" : command.name;
}

std::string model_names() {
  std::vector<std::string_view> names;
  for (const BundledModel& model : bundled_models()) names.push_back(model.name);
  return joined(names, " ");
}

/// What may follow a command that is no option.
std::string words_of(const CompletedCommand& command, const CLI::App& root) {
  if (command.takes_model || command.name == "compare" || command.name == "generate") {
    return model_names();
  }
  if (command.name == "completion") return "bash zsh fish";
  return command.name == "help" ? joined(command_names(root), " ") : "";
}

/// What bash does behind an option.
std::string bash_case(const std::string& names, const CompletedOption& option) {
  std::string text = "    " + names + ")\n      ";
  if (option.is_file) {
    text += "mapfile -t COMPREPLY < <(compgen -f -- \"$current\")\n      ";
  } else if (!option.values.empty()) {
    text += "mapfile -t COMPREPLY < <(compgen -W '" + joined(option.values, " ") +
            "' -- \"$current\")\n      ";
  }
  return text + "return\n      ;;\n";
}

std::string bash_script(const std::vector<CompletedCommand>& commands, const CLI::App& root) {
  std::string cases;
  std::map<std::string, const CompletedOption*> options;
  for (const CompletedCommand& command : commands) {
    std::vector<std::string> names;
    std::string own;  // of options that take something else in other commands
    for (const CompletedOption& option : command.options) {
      names.insert(names.end(), option.names.begin(), option.names.end());
      if (!option.takes_value) continue;
      const std::string pattern = joined(option.names, " | ");
      const CompletedOption& usual = *options.emplace(pattern, &option).first->second;
      if (!usual.completes_as(option)) own += bash_case(pattern, option);
    }
    cases += "    " + pattern_of(command) + ")\n      options='" + joined(names, " ") + "'\n";
    cases += "      words='" + words_of(command, root) + "'\n";
    if (!command.takes_files) cases += "      files=\n";
    if (!own.empty()) cases += "      case $previous in\n" + own + "      esac\n";
    cases += "      ;;\n";
  }
  std::string values;
  for (const auto& [names, option] : options) values += bash_case(names, *option);
  return "# What bash completes behind geotherm; made by: geotherm completion bash\n"
         "_geotherm() {\n"
         "  local current=${COMP_WORDS[COMP_CWORD]} previous=${COMP_WORDS[COMP_CWORD - 1]}\n"
         "  local options='--help --version' words='" +
         joined(command_names(root), " ") + " " + model_names() +
         "' files=yes\n"
         "  if [[ $current == = ]]; then current=; fi  # --option=value is three words\n"
         "  if [[ $previous == = ]]; then previous=${COMP_WORDS[COMP_CWORD - 2]}; fi\n"
         "  if ((COMP_CWORD > 1)); then\n"
         "    case ${COMP_WORDS[1]} in\n" +
         cases +
         "    esac\n"
         "  fi\n"
         "  case $previous in\n" +
         values +
         "  esac\n"
         "  if [[ $current == -* ]]; then\n"
         "    mapfile -t COMPREPLY < <(compgen -W \"$options\" -- \"$current\")\n"
         "  else\n"
         "    mapfile -t COMPREPLY < <(compgen -W \"$words\" -- \"$current\" && true\n"
         "      [[ -z $files ]] || compgen -f -- \"$current\")\n"
         "  fi\n"
         "}\n"
         "complete -o filenames -F _geotherm geotherm\n";
}

/// Fit for a description between quotes and square brackets.
std::string for_zsh(const std::string& text) {
  std::string out;
  for (const char c : with_backslashes(text, "\\[]:")) {
    c == '\'' ? out += "'\\''" : out += c;
  }
  return out;
}

std::string zsh_script(const std::vector<CompletedCommand>& commands, const CLI::App& root) {
  std::string list, cases;
  for (const CompletedCommand& command : commands) {
    list += "    '" + command.name + ":" + for_zsh(command.description) + "'\n";
    cases += "    " + pattern_of(command) + ")\n      _arguments -s";
    for (const CompletedOption& option : command.options) {
      const std::string value = !option.takes_value ? ""
                                : option.is_file    ? ":file:_files"
                                : option.values.empty()
                                    ? ":value:"
                                    : ":value:(" + joined(option.values, " ") + ")";
      for (const std::string& name : option.names) {
        cases += " \\\n        '*" + name + "[" + for_zsh(option.description) + "]" + value + "'";
      }
    }
    const std::string words = words_of(command, root);
    const std::string action = command.takes_files ? "_geotherm_words " + words : "(" + words + ")";
    if (!words.empty()) cases += " \\\n        '*:word:" + action + "'";
    cases += "\n      ;;\n";
  }
  return "#compdef geotherm\n"
         "# What zsh completes behind geotherm; made by: geotherm completion zsh\n"
         "_geotherm_words() { compadd -- \"$@\"; _files }\n"
         "_geotherm() {\n"
         "  local -a commands=(\n" +
         list +
         "  )\n"
         "  if ((CURRENT == 2)); then\n"
         "    _describe command commands\n"
         "    _geotherm_words " +
         model_names() +
         "\n"
         "    return\n"
         "  fi\n"
         "  local command=$words[2]\n"
         "  shift words\n"
         "  ((CURRENT--))\n"
         "  case $command in\n" +
         cases +
         "    *) _files ;;\n"
         "  esac\n"
         "}\n"
         "compdef _geotherm geotherm\n";
}

/// The end of a line, which describes what the line is about.
std::string for_fish(const std::string& description) {
  return " -d '" + with_backslashes(description, "\\'") + "'\n";
}

std::string fish_script(const std::vector<CompletedCommand>& commands, const CLI::App& root) {
  std::string script =
      "# What fish completes behind geotherm; made by: geotherm completion fish\n"
      "complete -c geotherm -n __fish_use_subcommand -a '" +
      model_names() + "'" + for_fish("bundled model");
  for (const CompletedCommand& command : commands) {
    script += "complete -c geotherm -n __fish_use_subcommand -a " + command.name +
              for_fish(command.description);
    std::string when = "__fish_seen_subcommand_from " + command.name;
    if (command.name == kOpens) {
      when = "not __fish_use_subcommand; and not __fish_seen_subcommand_from";
      for (const CompletedCommand& other : commands) {
        if (other.name != kOpens) when += " " + other.name;
      }
    }
    const std::string here = "complete -c geotherm -n '" + when + "'";
    const std::string words = words_of(command, root);
    if (!words.empty()) {
      script += here + (command.takes_files ? "" : " -f") + " -a '" + words + "'\n";
    }
    for (const CompletedOption& option : command.options) {
      script += here;
      for (const std::string& name : option.names) {
        script += name.starts_with("--") ? " -l " + name.substr(2) : " -s " + name.substr(1);
      }
      if (option.takes_value) script += option.is_file ? " -r" : " -x";
      if (!option.values.empty()) script += " -a '" + joined(option.values, " ") + "'";
      script += for_fish(option.description);
    }
  }
  return script;
}

}  // namespace

std::vector<std::string> command_names(const CLI::App& root) {
  std::vector<std::string> names;
  for (const CLI::App* command : root.get_subcommands([](const CLI::App*) { return true; })) {
    names.push_back(command->get_name());
  }
  return names;
}

void add_completion_options(CLI::App& command, std::string& shell) {
  command.add_option("SHELL", shell, "bash, zsh or fish")->required();
  command.footer(
      "Examples:\n  source <(geotherm completion bash)\n"
      "  geotherm completion fish > ~/.config/fish/completions/geotherm.fish");
}

Result<CommandOutput> run_completion(const std::string& shell, const CLI::App& root,
                                     std::span<const std::string> colour_maps) {
  const std::vector<CompletedCommand> commands = completed(root, colour_maps);
  if (shell == "bash") return CommandOutput{bash_script(commands, root), {}, {}};
  if (shell == "zsh") return CommandOutput{zsh_script(commands, root), {}, {}};
  if (shell == "fish") return CommandOutput{fish_script(commands, root), {}, {}};
  return bad_value(shell, "is no shell with a completion",
                   known_words(shell, {"bash", "zsh", "fish"}));
}

}  // namespace geotherm::app
