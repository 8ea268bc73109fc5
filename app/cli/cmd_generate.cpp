// SPDX-License-Identifier: MIT
#include <CLI/CLI.hpp>

#include "app/cli/commands.h"
#include "app/cli/options.h"
#include "app/session/model.h"
#include "app/session/outputs.h"
#include "app/text/text.h"
#include "bench/models/generate.h"
#include "geotherm/io.h"
#include "solver/mesh/io/format_writers.h"

namespace geotherm::app {
namespace {

/// As asked for, else the model's usual number.
Result<Index> faces_in(const GenerateArguments& arguments) {
  if (arguments.faces.empty()) {
    for (const BundledModel& model : bundled_models()) {
      if (model.name == arguments.name) return model.faces;
    }
    return kMinModelFaces;  // the unknown name is the error to report
  }
  const auto faces = number_in<Index>(arguments.faces);
  if (faces && *faces >= kMinModelFaces && *faces <= kMaxModelFaces) return *faces;
  return Error{ErrorCode::kBadInput,
               "--faces: '" + one_line(arguments.faces) + "' is no number of faces; give " +
                   std::to_string(kMinModelFaces) + " to " + std::to_string(kMaxModelFaces)};
}

}  // namespace

void add_generate_options(CLI::App& command, GenerateArguments& arguments) {
  command.add_option("NAME", arguments.name, "a bundled model (geotherm models)")
      ->required()
      ->type_name("");
  command.add_option("--faces", arguments.faces, "about so many; default: the model's usual size")
      ->type_name("N");
  command
      .add_option("-o,--output", arguments.output,
                  ".obj .ply .off .stl, or - for OBJ on standard output")
      ->required()
      ->type_name("FILE");
  add_quiet_option(command, arguments.quiet);
  command.footer("Example:\n  geotherm generate gargoyle --faces 1000000 -o big.ply");
}

Result<CommandOutput> run_generate(const GenerateArguments& arguments, const Progress& progress) {
  const auto faces = faces_in(arguments);
  if (!faces) return faces.error();
  if (auto known = check_mesh_path(arguments.output); !known) return known.error();
  Outputs outputs;
  if (is_bundled(arguments.name)) {  // otherwise its error is the one to report
    if (auto expected = outputs.expect(arguments.output, "--output"); !expected) {
      return expected.error();
    }
  }
  const auto mesh = generate_model(arguments.name, *faces, progress);
  if (!mesh) return mesh.error();
  if (arguments.output == "-") return CommandOutput{io::obj_bytes(*mesh), {}, {}};
  const auto written =
      outputs.write(arguments.output, [&] { return write_mesh(arguments.output, *mesh); });
  if (!written) return written.error();
  return CommandOutput{one_line(arguments.output) + ": " + arguments.name + ", " +
                           counted(mesh->vertex_count(), "vertex", "vertices") + ", " +
                           counted(mesh->face_count(), "face", "faces") + "\n",
                       {},
                       outputs.made()};
}

}  // namespace geotherm::app
