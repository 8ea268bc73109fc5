// SPDX-License-Identifier: MIT
#include "app/cmd_info.h"

#include <CLI/CLI.hpp>

#include "app/load_model.h"
#include "app/mesh_words.h"
#include "app/options.h"
#include "app/outputs.h"
#include "app/report_json.h"
#include "app/report_table.h"
#include "solver/geometry/cracks.h"

namespace geotherm::app {
namespace {

Json cracks_json(const CrackReport& cracks) {
  return {{"vertices", cracks.vertices},
          {"weld", cracks.vertices > 0 ? Json(cracks.distance) : Json(nullptr)},
          {"border_edges", cracks.border_edges},
          {"closed_edges", cracks.closed_edges}};
}

}  // namespace

void add_info_options(CLI::App& command, InfoArguments& arguments) {
  add_model_option(command, arguments.model, arguments.settings)->required();
  command.add_option("--json", arguments.json, "the same as JSON; - is standard output")
      ->type_name("FILE");
  add_quiet_option(command, arguments.quiet);
  command.footer("Example:\n  geotherm info scan.stl --json scan.json");
}

Result<CommandOutput> run_info(const InfoArguments& arguments, const Progress& progress) {
  Outputs outputs;
  if (!arguments.json.empty()) {
    protect_inputs(arguments.model, {}, outputs);
    if (auto expected = outputs.expect(arguments.json, "--json"); !expected) {
      return expected.error();
    }
  }
  const auto asked = settings_in(arguments.settings);
  if (!asked) return asked.error();
  const auto model = load_model(arguments.model, asked->reading, progress);
  if (!model) return model.error();
  const MeshReport mesh = inspect_mesh(*model->mesh);
  CommandOutput out{"", model->notes, {}};
  for (std::string& warning : mesh_warnings(mesh)) out.warnings.push_back(std::move(warning));
  const CrackReport cracks = find_cracks(*model->mesh);
  if (cracks.vertices > 0) out.warnings.push_back(crack_note(cracks));
  if (!outputs.uses_stdout()) out.text = info_table(*model, mesh);
  if (arguments.json.empty()) return out;

  std::string text = to_text(Json{{"model", full_model_json(model->name, mesh)},
                                  {"cracks", cracks_json(cracks)},
                                  {"timing_ms", {{"load", model->load_ms}}},
                                  {"warnings", out.warnings}});
  const auto written = outputs.write_text(arguments.json, std::move(text), out.text);
  if (!written) return written.error();
  out.made = outputs.made();
  return out;
}

}  // namespace geotherm::app
