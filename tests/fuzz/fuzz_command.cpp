// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>

#include "app/session/command.h"
#include "app/session/settings.h"
#include "app/session/sources.h"
#include "app/text/text.h"
#include "tests/fuzz/fuzz_targets.h"

namespace geotherm::test {
namespace {

using namespace geotherm::app;

/// Of an error as the program prints it, which may quote all of its input.
std::string printed_fault(const Error& error, std::size_t input) {
  return message_fault(one_line(sentence(error)), 2 * input);
}

std::string source_fault(std::string_view text) {
  const auto source = parse_source(text);
  if (!source) return printed_fault(source.error(), text.size());
  const auto again = parse_source(to_text(*source));
  return again && *again == *source ? "" : "not read back: the source " + to_text(*source);
}

/// The line as the value of every setting.
std::string setting_fault(const std::string& text) {
  for (const Setting& setting : settings()) {
    ViewerState state = initial_state();
    if (const auto set = setting.set(state, text); !set) {
      const std::string fault = printed_fault(set.error(), text.size());
      if (!fault.empty()) return std::string(setting.name) + ": " + fault;
      continue;
    }
    ViewerState again = initial_state();
    const std::string written = setting.get(state);
    if (!setting.set(again, written) || again != state) {
      return "not read back: " + std::string(setting.name) + " " + written;
    }
  }
  return "";
}

/// A command is read back from its text, and so is the state to which it leads.
std::string command_fault(const Command& command, ViewerState& state) {
  const std::string text = to_text(command);
  const auto again = parse_command(text);
  if (!again) return "not read back: " + text + ": " + sentence(again.error());
  if (*again != command) return "read back as another command: " + text;
  auto next = app::apply(state, command);
  if (!next) return printed_fault(next.error(), text.size());
  state = *std::move(next);
  return "";
}

std::string state_fault(const ViewerState& state) {
  ViewerState again = initial_state();
  for (const Command& command : commands_to(state)) {
    const std::string text = to_text(command);
    const auto parsed = parse_command(text);
    if (!parsed) return "a saved session cannot be read: " + text + ": " + sentence(parsed.error());
    auto next = app::apply(again, *parsed);
    if (!next) return "a saved session cannot be run: " + text + ": " + sentence(next.error());
    again = *std::move(next);
  }
  return again == state ? "" : "a saved session leads elsewhere";
}

}  // namespace

std::string fuzz_command(Bytes bytes) {
  const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  const auto script = parse_script(text, "script");
  if (!script) {
    if (auto fault = printed_fault(script.error(), text.size()); !fault.empty()) return fault;
  }
  ViewerState state = initial_state();
  std::string_view rest = text;
  while (!rest.empty()) {
    const std::string_view line = rest.substr(0, rest.find('\n'));
    rest.remove_prefix(std::min(rest.size(), line.size() + 1));
    if (auto fault = source_fault(line); !fault.empty()) return fault;
    if (auto fault = setting_fault(std::string(line)); !fault.empty()) return fault;
    const auto command = parse_command(line);
    const std::string fault =
        command ? command_fault(*command, state) : printed_fault(command.error(), line.size());
    if (!fault.empty()) return fault;
  }
  return state_fault(state);
}

}  // namespace geotherm::test
