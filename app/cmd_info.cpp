// SPDX-License-Identifier: MIT
#include "app/cmd_info.h"

#include <CLI/CLI.hpp>

#include "app/load_model.h"
#include "app/mesh_words.h"
#include "app/options.h"
#include "app/outputs.h"
#include "app/report_json.h"
#include "app/report_table.h"
#include "solver/mesh/write_file.h"

namespace geotherm::app {

void add_info_options(CLI::App& command, InfoArguments& arguments) {
  command
      .add_option("MODEL", arguments.model,
                  "a file (.obj .ply .off .stl) or a bundled model (geotherm models)")
      ->required()
      ->type_name("");
  command.add_option("--json", arguments.json, "the same as JSON; - is standard output")
      ->type_name("FILE");
  add_quiet_option(command, arguments.quiet);
  command.footer("Example:\n  geotherm info scan.stl --json scan.json");
}

Result<CommandOutput> run_info(const InfoArguments& arguments, const Progress& progress) {
  Outputs outputs;
  if (!arguments.json.empty()) {
    auto expected = outputs.expect(arguments.json, "--json",
                                   is_bundled(arguments.model) ? "" : arguments.model);
    if (!expected) return expected.error();
  }
  const auto model = load_model(arguments.model, progress);
  if (!model) return model.error();
  const MeshReport mesh = inspect_mesh(*model->mesh);
  CommandOutput out{"", model->notes};
  for (std::string& warning : mesh_warnings(mesh)) out.warnings.push_back(std::move(warning));
  if (!outputs.uses_stdout()) out.text = info_table(*model, mesh);
  if (arguments.json.empty()) return out;

  std::string text = to_text(Json{{"model", full_model_json(model->name, mesh)},
                                  {"timing_ms", {{"load", model->load_ms}}},
                                  {"warnings", out.warnings}});
  if (arguments.json == "-") {
    out.text = std::move(text);
    return out;
  }
  const auto written =
      outputs.write(arguments.json, [&] { return write_file(arguments.json, text); });
  if (!written) return written.error();
  return out;
}

}  // namespace geotherm::app
