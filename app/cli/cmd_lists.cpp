// SPDX-License-Identifier: MIT
#include <CLI/CLI.hpp>

#include "app/cli/commands.h"
#include "app/cli/options.h"
#include "app/session/model.h"
#include "app/session/outputs.h"
#include "app/session/report.h"
#include "app/session/wording.h"
#include "app/text/text.h"
#include "geotherm/backend.h"
#include "solver/geometry/clean_faces.h"

namespace geotherm::app {
namespace {

Json cracks_json(const CrackReport& cracks) {
  return {{"vertices", cracks.vertices},
          {"weld", cracks.vertices > 0 ? Json(cracks.distance) : Json(nullptr)},
          {"border_edges", cracks.boundary_edges},
          {"closed_edges", cracks.closed_edges}};
}

}  // namespace

void add_info_options(CLI::App& command, InfoArguments& arguments) {
  add_model_option(command, arguments.model, arguments.settings)->required();
  add_json_option(command, arguments.json, "the same");
  add_quiet_option(command, arguments.quiet);
  command.footer("Example:\n  geotherm info scan.stl --json scan.json");
}

Result<CommandOutput> run_info(const InfoArguments& arguments, const Progress& progress) {
  Outputs outputs;
  if (auto fits = expect_report(arguments.json, outputs); !fits) return fits.error();
  const auto asked = settings_in(arguments.settings);
  if (!asked) return asked.error();
  const auto model = load_model(arguments.model, asked->reading, progress);
  if (!model) return model.error();
  MeshReport mesh = inspect_mesh(*model->mesh);
  describe_space(*model, mesh);
  CommandOutput out{"", model->notes, {}};
  if (model->is_mesh()) {
    for (Warning& warning : mesh_warnings(mesh)) out.warnings.push_back(std::move(warning));
  }
  const bool polygons = domain_name(*model) == "polygons";
  const CrackReport cracks =
      model->is_mesh() || polygons ? find_cracks(*model->mesh) : CrackReport();
  if (cracks.vertices > 0) {
    Warning note = crack_note(cracks);
    const Hint as_triangles = {"with ", SettingHint{"domain", {"triangles"}}, ", "};
    if (polygons) note.hint.insert(note.hint.begin(), as_triangles.begin(), as_triangles.end());
    out.warnings.push_back(std::move(note));
  }
  const auto report = [&, warnings = to_text(out.warnings)]() -> Json {
    return {{"model", full_model_json(*model, mesh)},
            {"cracks", cracks_json(cracks)},
            {"timing_ms", {{"load", model->load_ms}}},
            {"warnings", warnings}};
  };
  return finish_command(std::move(out), outputs, arguments.json, report,
                        [&] { return info_table(*model, mesh); });
}

void add_list_options(CLI::App& command, ListArguments& arguments) {
  add_json_option(command, arguments.json, "the same");
  command.footer("Example:\n  geotherm " + command.get_name());
}

namespace {

Result<CommandOutput> list(const ListArguments& arguments, const std::string& table,
                           const Json& json) {
  Outputs outputs;
  if (auto fits = expect_report(arguments.json, outputs); !fits) return fits.error();
  return finish_command(
      {}, outputs, arguments.json, [&] { return json; }, [&] { return table; });
}

}  // namespace

Result<CommandOutput> run_backends(const ListArguments& arguments) {
  TextTable table({{"", TextTable::Align::kLeft}, {"", TextTable::Align::kLeft}});
  Json rows = Json::array();
  for (const std::string& name : backend_names()) {
    const auto backend = find_backend(name);
    const std::string description = backend ? std::string((*backend)->description()) : "";
    table.add_row({name, description});
    rows.push_back({{"name", name}, {"description", description}, {"default", rows.empty()}});
  }
  return list(arguments, table.text(), Json{{"backends", std::move(rows)}});
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
  return list(arguments, table.text(), Json{{"models", std::move(rows)}});
}

namespace {

std::string memory_in_words(double mb) {
  if (!(mb > 0)) return "";
  constexpr double kGigabyte = 1024;
  return mb < kGigabyte ? fixed(mb, 0) + " MB" : fixed(mb / kGigabyte, 1) + " GB";
}

std::string remark_on(const DrawingDevice& device) {
  if (!device.lacks.empty()) return "cannot be used: " + one_line(joined(device.lacks, "; "));
  return device.chosen ? "default" : "";
}

std::string device_table(const std::vector<DrawingDevice>& devices) {
  using Align = TextTable::Align;
  TextTable table({{"", Align::kLeft},
                   {"", Align::kLeft},
                   {"", Align::kLeft},
                   {"", Align::kLeft},
                   {"", Align::kRight},
                   {"", Align::kLeft}});
  for (const DrawingDevice& device : devices) {
    table.add_row({one_line(device.name), one_line(device.kind), one_line(device.driver),
                   one_line(device.api), memory_in_words(device.memory_mb), remark_on(device)});
  }
  return table.text();
}

Json devices_json(const std::vector<DrawingDevice>& devices) {
  Json list = Json::array();
  for (const DrawingDevice& device : devices) {
    list.push_back({{"name", device.name},
                    {"kind", device.kind},
                    {"driver", device.driver},
                    {"api", device.api},
                    {"memory_mb", device.memory_mb},
                    {"software", device.software},
                    {"default", device.chosen},
                    {"usable", device.lacks.empty()},
                    {"lacks", device.lacks}});
  }
  return {{"devices", std::move(list)}};
}

}  // namespace

Result<CommandOutput> run_devices(const ListArguments& arguments, Drawing& drawing) {
  Outputs outputs;
  if (auto fits = expect_report(arguments.json, outputs); !fits) return fits.error();
  const auto devices = drawing.devices();
  if (!devices) return devices.error();
  if (devices->empty()) {
    return Error{
        ErrorCode::kNoDevice,
        "there is no device that can draw",
        {"install a Vulkan driver (Debian: mesa-vulkan-drivers, which also draws in software)"}};
  }
  return finish_command(
      {}, outputs, arguments.json, [&] { return devices_json(*devices); },
      [&] { return device_table(*devices); });
}

}  // namespace geotherm::app
