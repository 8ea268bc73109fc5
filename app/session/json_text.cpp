// SPDX-License-Identifier: MIT
#include <string_view>
#include <utility>

#include "app/session/report.h"

namespace geotherm::app {
namespace {

/// The control characters that JSON lets stand, U+007F to U+009F, are escaped, too: it may end up
/// on a terminal.
std::string compact(const Json& json) {
  const std::string dumped = json.dump(-1, ' ', false, Json::error_handler_t::replace);
  if (dumped.find_first_of("\x7f\xc2") == std::string::npos) return dumped;
  constexpr std::string_view kDigits = "0123456789abcdef";
  std::string out;
  for (std::size_t i = 0; i < dumped.size(); ++i) {
    const auto byte = static_cast<unsigned char>(dumped[i]);
    const unsigned next = i + 1 < dumped.size() ? static_cast<unsigned char>(dumped[i + 1]) : 0;
    const bool two = byte == 0xc2 && next < 0xa0;
    if (byte != 0x7f && !two) {
      out += dumped[i];
      continue;
    }
    const unsigned code = two ? next : byte;
    out += {'\\', 'u', '0', '0', kDigits[code >> 4U], kDigits[code & 0xfU]};
    if (two) ++i;
  }
  return out;
}

/// True for what gets a line for each of its members: filled objects, and lists that hold some.
bool opens(const Json& json) {
  if (json.empty()) return false;
  return json.is_object() || (json.is_array() && json.front().is_structured());
}

void write(const Json& json, int level, std::string& out) {
  constexpr int kDeepest = 2;
  if (level >= kDeepest || !opens(json)) {
    out += compact(json);
    return;
  }
  const bool object = json.is_object();
  const std::string indent(static_cast<std::size_t>(2 * level), ' ');
  out += object ? "{" : "[";
  bool first = true;
  for (const auto& item : json.items()) {
    out += (first ? "\n  " : ",\n  ") + indent;
    if (object) out += compact(item.key()) + ": ";
    write(item.value(), level + 1, out);
    first = false;
  }
  out += "\n" + indent + (object ? "}" : "]");
}

std::string& command_of_process() {
  static std::string command;
  return command;
}

}  // namespace

std::string to_text(const Json& json) {
  std::string out;
  write(json, 0, out);
  return out + '\n';
}

void remember_command(std::string command) { command_of_process() = std::move(command); }

const std::string& typed_command() { return command_of_process(); }

std::string report_text(Json figures) {
  constexpr int kSchema = 1;  // docs/reports.schema.json; another where a key goes or means another
  Json report = {{"program",
                  {{"name", "geotherm"},
                   {"version", GEOTHERM_VERSION},
                   {"schema", kSchema},
                   {"command", typed_command()}}}};
  report.update(std::move(figures));
  return to_text(report);
}

}  // namespace geotherm::app
