// SPDX-License-Identifier: MIT
// Options about where distance is 0, how far it goes, and points.
#include <CLI/CLI.hpp>

#include "app/cli/options.h"
#include "app/session/command_words.h"
#include "app/session/model.h"
#include "app/session/wording.h"
#include "app/text/text.h"
#include "solver/core/text.h"

namespace geotherm::app {

CLI::Option* may_repeat(CLI::Option* option, const std::string& value_name) {
  return option->type_name(value_name)
      ->expected(1)
      ->allow_extra_args(false)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
}

void add_source_options(CLI::App& command, SourceArguments& arguments) {
  may_repeat(command.add_option(
                 "-s,--source", arguments.sources,
                 "17 or 3,99,512 (vertex ids from 0), curve:V1,V2,... (a line of vertices, joined "
                 "along edges), curve:face:ID:b0:b1:b2,... (a line of points, joined across "
                 "faces), random:K[:SEED], boundary, face:ID:b0:b1:b2, xyz:x:y:z, "
                 "sample:i:j[:k] (of a grid); points may "
                 "end in @OFFSET, the distance there; may be "
                 "repeated, all are one source set"),
             "SOURCES")
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

Result<std::vector<Source>> some_sources_of(const SourceArguments& arguments) {
  auto named = sources_of(arguments);
  if (!named || !named->empty()) return named;
  return Error{ErrorCode::kBadInput,
               "no source was given",
               {"say where distance is 0, such as -s 17 or -s boundary"}};
}

Result<std::vector<Source>> sources_of(const SourceArguments& arguments) {
  if (arguments.curve && arguments.file.empty()) {
    return Error{ErrorCode::kBadInput,
                 "--curve needs the vertex ids of the curve",
                 {"add --source-file FILE"}};
  }
  std::vector<Source> sources;
  for (const std::string& text : arguments.sources) {
    auto spec = parse_source(text);
    if (!spec) return about("--source", spec.error());
    sources.push_back({*std::move(spec), "--source " + shortened(text), ErrorCode::kBadInput});
  }
  if (arguments.file.empty()) return sources;
  auto listed = read_source_file(arguments.file, arguments.curve);
  if (!listed) return listed.error();
  for (Source& source : *listed) sources.push_back(std::move(source));
  return sources;
}

std::vector<std::string> typed_sources(const SourceArguments& arguments) {
  std::vector<std::string> typed = arguments.sources;
  if (!arguments.file.empty()) {
    typed.push_back((arguments.curve ? "curve of " : "file ") + arguments.file);
  }
  return typed;
}

Result<Source> single_point(const std::string& text, const std::string& option) {
  auto spec = parse_source(text);
  if (!spec && text.find(':') != text.npos) return about(option, spec.error());
  if (spec && is_single_point(*spec))
    return Source{*std::move(spec), option + " " + one_line(text)};
  return Error{ErrorCode::kBadInput,
               option + ": '" + one_line(text) + "' is not one point",
               {"write a vertex id, face:ID:b0:b1:b2 or xyz:x:y:z"}};
}

void add_max_distance_option(CLI::App& command, std::string& text) {
  command
      .add_option("--max-distance", text,
                  "asks for no more than this far (model units): farther is infinite, and waves, "
                  "fast marching and exact windows spend no time there")
      ->type_name("R")
      ->group("Reach");
}

void add_target_option(CLI::App& command, std::vector<std::string>& texts,
                       const std::string& what) {
  may_repeat(
      command.add_option("--target", texts,
                         "asks for " + what +
                             " of these vertices alone, given as sources are; may be repeated; the "
                             "methods but heat end when they have them"),
      "VERTICES")
      ->group("Reach");
}

Result<double> max_distance_in(const std::string& text) {
  if (text.empty()) return kUnreached;
  const auto most = parse_max_distance(text);
  return most ? most : about("--max-distance", most.error());
}

}  // namespace geotherm::app
