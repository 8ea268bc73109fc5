// SPDX-License-Identifier: MIT
#include "app/cmd_lists.h"

#include <CLI/CLI.hpp>

#include "app/bundled_models.h"
#include "app/outputs.h"
#include "app/report_json.h"
#include "app/text.h"
#include "app/text_table.h"
#include "geotherm/backend.h"

namespace geotherm::app {
namespace {

void add_json_option(CLI::App& command, ListArguments& arguments) {
  command.add_option("--json", arguments.json, "the same as JSON; - is standard output")
      ->type_name("FILE");
}

Result<CommandOutput> list(const ListArguments& arguments, const TextTable& table,
                           const Json& json) {
  Outputs outputs;
  CommandOutput out;
  if (arguments.json.empty()) {
    out.text = table.text();
    return out;
  }
  if (auto expected = outputs.expect(arguments.json, "--json"); !expected) return expected.error();
  if (!outputs.uses_stdout()) out.text = table.text();
  if (auto written = outputs.write_text(arguments.json, to_text(json), out.text); !written) {
    return written.error();
  }
  out.made = outputs.made();
  return out;
}

}  // namespace

void add_backends_options(CLI::App& command, ListArguments& arguments) {
  add_json_option(command, arguments);
  command.footer("Example:\n  geotherm backends");
}

void add_models_options(CLI::App& command, ListArguments& arguments) {
  add_json_option(command, arguments);
  command.footer("Example:\n  geotherm models");
}

Result<CommandOutput> run_backends(const ListArguments& arguments) {
  TextTable table({{"", TextTable::Align::kLeft}, {"", TextTable::Align::kLeft}});
  Json rows = Json::array();
  for (const std::string& name : backend_names()) {
    const auto backend = find_backend(name);
    const std::string description = backend ? std::string((*backend)->description()) : "";
    table.add_row({name, description});
    rows.push_back({{"name", name}, {"description", description}, {"default", rows.empty()}});
  }
  return list(arguments, table, Json{{"backends", std::move(rows)}});
}

Result<CommandOutput> run_models(const ListArguments& arguments) {
  TextTable table({{"", TextTable::Align::kLeft},
                   {"", TextTable::Align::kRight},
                   {"", TextTable::Align::kLeft}});
  Json rows = Json::array();
  for (const BundledModel& model : bundled_models()) {
    const std::string name(model.name);
    const std::string description(model.description);
    table.add_row({name, grouped(model.faces) + " faces", description});
    rows.push_back({{"name", name}, {"faces", model.faces}, {"description", description}});
  }
  return list(arguments, table, Json{{"models", std::move(rows)}});
}

}  // namespace geotherm::app
