// SPDX-License-Identifier: MIT
#include <CLI/CLI.hpp>

#include "app/cli/commands.h"
#include "app/cli/options.h"
#include "app/session/model.h"
#include "app/session/outputs.h"
#include "app/text/text.h"
#include "bench/models/generate.h"
#include "bench/models/volumes.h"
#include "geotherm/domains.h"
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

Result<Index> tets_in(const GenerateArguments& arguments) {
  constexpr Index kUsual = 20'000;
  if (arguments.tets.empty()) return kUsual;
  const auto tets = number_in<Index>(arguments.tets);
  if (tets && *tets >= kMinVolumeTets && *tets <= kMaxVolumeTets) return *tets;
  return Error{ErrorCode::kBadInput,
               "--tets: '" + one_line(arguments.tets) + "' is no number of tetrahedra; give " +
                   std::to_string(kMinVolumeTets) + " to " + std::to_string(kMaxVolumeTets)};
}

Result<CommandOutput> generate_volume_file(const GenerateArguments& arguments) {
  if (!arguments.faces.empty()) {
    return Error{ErrorCode::kBadInput,
                 "--faces is of surfaces, and " + arguments.name + " is a volume",
                 {"give --tets"}};
  }
  const auto tets = tets_in(arguments);
  if (!tets) return tets.error();
  if (auto known = check_tets_path(arguments.output); !known) return known.error();
  Outputs outputs;
  if (auto expected = outputs.expect(arguments.output, "--output"); !expected) {
    return expected.error();
  }
  const auto mesh = generate_volume(arguments.name, *tets);
  if (!mesh) return mesh.error();
  const auto written =
      outputs.write(arguments.output, [&] { return write_tets(arguments.output, *mesh); });
  if (!written) return written.error();
  if (arguments.output == "-") return CommandOutput{};
  return CommandOutput{one_line(arguments.output) + ": " + arguments.name + ", " +
                           counted(mesh->vertex_count(), "vertex", "vertices") + ", " +
                           counted(mesh->tet_count(), "tetrahedron", "tetrahedra") + "\n",
                       {},
                       outputs.made()};
}

}  // namespace

void add_generate_options(CLI::App& command, GenerateArguments& arguments) {
  command
      .add_option("NAME", arguments.name,
                  "a bundled model (geotherm models), or a volume: box-tets, ball-tets")
      ->required()
      ->type_name("");
  command.add_option("--faces", arguments.faces, "about so many; default: the model's usual size")
      ->type_name("N");
  command.add_option("--tets", arguments.tets, "of a volume: about so many; default: 20000")
      ->type_name("N");
  command
      .add_option("-o,--output", arguments.output,
                  ".obj .ply .off .stl, or - for OBJ on standard output; of a volume .mesh .vtu, "
                  "or - for .mesh")
      ->required()
      ->type_name("FILE");
  add_quiet_option(command, arguments.quiet);
  command.footer(
      "Examples:\n  geotherm generate gargoyle --faces 1000000 -o big.ply\n"
      "  geotherm generate ball-tets --tets 100000 -o ball.mesh");
}

Result<CommandOutput> run_generate(const GenerateArguments& arguments, const Progress& progress) {
  if (is_volume_name(arguments.name)) return generate_volume_file(arguments);
  if (!arguments.tets.empty()) {
    return Error{ErrorCode::kBadInput,
                 "--tets is of volumes, and " + one_line(arguments.name) + " is none",
                 {"there are box-tets, ball-tets"}};
  }
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
