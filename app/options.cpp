// SPDX-License-Identifier: MIT
#include "app/options.h"

#include <CLI/CLI.hpp>

#include "app/bundled_models.h"
#include "app/load_model.h"
#include "app/text.h"
#include "app/told.h"

namespace geotherm::app {

CLI::Option* add_model_option(CLI::App& command, std::string& model, SettingArguments& settings) {
  add_setting_options(command, settings, names_of(SettingGroup::kModel));
  return command
      .add_option("MODEL", model,
                  "a file (.obj .ply .off .stl), a bundled model (geotherm models), or - for "
                  "standard input with --format")
      ->type_name("");
}

void add_quiet_option(CLI::App& command, bool& quiet) {
  command.add_flag("--quiet", quiet, "no progress bar, no estimate of time");
}

void add_source_options(CLI::App& command, SourceArguments& arguments) {
  command
      .add_option(
          "-s,--source", arguments.sources,
          "17 or 3,99,512 (vertex ids from 0), curve:V1,V2,... (a line of vertices, joined "
          "along edges), random:K[:SEED], boundary, face:ID:b0:b1:b2, xyz:x:y:z; points may "
          "end in @OFFSET, the distance there; may be "
          "repeated, all are one source set")
      ->type_name("SOURCES")
      ->expected(1)
      ->allow_extra_args(false)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
      ->group("Sources");
  command
      .add_option("--source-file", arguments.file,
                  "one source a line: a vertex id, face:..., xyz:..., or x y z; # begins a comment")
      ->type_name("FILE")
      ->group("Sources");
  command
      .add_flag("--curve", arguments.curve,
                "the ids of the source file are a polyline; all of it is a source")
      ->group("Sources");
}

void protect_inputs(const std::string& model, const SourceArguments& sources, Outputs& outputs) {
  if (!is_bundled(model) && model != kStandardInput) outputs.protect(model, "the model itself");
  outputs.protect(sources.file, "the source file");
}

Result<std::vector<Source>> some_sources_of(const SourceArguments& arguments) {
  auto named = sources_of(arguments);
  if (!named || !named->empty()) return named;
  return Error{ErrorCode::kBadInput,
               "no source was given; say where distance is 0, such as -s 17 or -s boundary"};
}

Result<std::vector<Source>> sources_of(const SourceArguments& arguments) {
  if (arguments.curve && arguments.file.empty()) {
    return Error{ErrorCode::kBadInput,
                 "--curve needs the vertex ids of the curve; add --source-file FILE"};
  }
  std::vector<Source> sources;
  for (const std::string& text : arguments.sources) {
    auto spec = parse_source(text);
    if (!spec) return about("--source", spec.error());
    const std::string shown = text.size() > 60 ? text.substr(0, 57) + "..." : text;
    sources.push_back({*std::move(spec), "--source " + one_line(shown), ErrorCode::kBadInput});
  }
  if (arguments.file.empty()) return sources;
  auto listed = read_source_file(arguments.file, arguments.curve);
  if (!listed) return listed.error();
  for (Source& source : *listed) sources.push_back(std::move(source));
  return sources;
}

}  // namespace geotherm::app
