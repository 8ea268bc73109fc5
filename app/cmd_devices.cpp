// SPDX-License-Identifier: MIT
#include "app/cmd_devices.h"

#include <CLI/CLI.hpp>

#include "app/outputs.h"
#include "app/report_json.h"
#include "app/text.h"
#include "app/text_table.h"

namespace geotherm::app {
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

void add_devices_options(CLI::App& command, DevicesArguments& arguments) {
  command.add_option("--json", arguments.json, "the same as JSON; - is standard output")
      ->type_name("FILE");
  command.footer("Example:\n  geotherm devices");
}

Result<CommandOutput> run_devices(const DevicesArguments& arguments, Drawing& drawing) {
  Outputs outputs;
  if (!arguments.json.empty()) {
    if (auto expected = outputs.expect(arguments.json, "--json"); !expected) {
      return expected.error();
    }
  }
  const auto devices = drawing.devices();
  if (!devices) return devices.error();
  if (devices->empty()) {
    return Error{ErrorCode::kNoDevice,
                 "there is no device that can draw; install a Vulkan driver (Debian: "
                 "mesa-vulkan-drivers, which also draws in software)"};
  }
  CommandOutput out;
  if (!outputs.uses_stdout()) out.text = device_table(*devices);
  if (arguments.json.empty()) return out;
  const auto written =
      outputs.write_text(arguments.json, to_text(devices_json(*devices)), out.text);
  if (!written) return written.error();
  out.made = outputs.made();
  return out;
}

}  // namespace geotherm::app
