// SPDX-License-Identifier: MIT
#include <CLI/CLI.hpp>

#include <numbers>

#include "app/cli/commands.h"
#include "app/cli/options.h"
#include "app/session/model.h"
#include "app/session/outputs.h"
#include "app/session/wording.h"
#include "app/text/text.h"
#include "bench/models/generate.h"
#include "bench/models/volumes.h"
#include "geotherm/domains.h"
#include "geotherm/io.h"
#include "solver/core/text.h"
#include "solver/mesh/frames.h"
#include "solver/mesh/io/byte_order.h"
#include "solver/mesh/io/format_writers.h"
#include "solver/mesh/output_file.h"

namespace geotherm::app {
namespace {

constexpr int kMaxWaving = 10'000;

double phase_of(int k, int frames) { return 2 * std::numbers::pi * k / frames; }

/// As asked for, else the model's usual number.
Result<Index> faces_in(const GenerateArguments& arguments) {
  if (!arguments.faces.empty()) {
    return whole_in("--faces", arguments.faces, "number of faces", kMinModelFaces, kMaxModelFaces);
  }
  for (const BundledModel& model : bundled_models()) {
    if (model.name == arguments.name) return model.faces;
  }
  return kMinModelFaces;  // the unknown name is the error to report
}

Result<Index> tets_in(const GenerateArguments& arguments) {
  constexpr Index kUsual = 20'000;
  if (arguments.tets.empty()) return kUsual;
  return whole_in("--tets", arguments.tets, "number of tetrahedra", kMinVolumeTets, kMaxVolumeTets);
}

Result<CommandOutput> generate_volume_file(const GenerateArguments& arguments) {
  if (!arguments.faces.empty()) {
    return Error{ErrorCode::kBadInput,
                 "--faces is of surfaces, and " + arguments.name + " is a volume",
                 {"give --tets"}};
  }
  if (!arguments.frames.empty()) {
    return Error{ErrorCode::kBadInput,
                 "--frames is of surfaces, and " + arguments.name + " is a volume",
                 {"leave it out"}};
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

/// Positions of all frames in one array. Errors: those of the file.
Result<void> write_frames_array(const std::string& path, const TriangleMesh& mesh, int frames,
                                const Progress& progress) {
  auto file = GrowingFile::open(path);
  if (!file) return file.error();
  const std::uint64_t shape[] = {static_cast<std::uint64_t>(frames), mesh.positions().size(), 3};
  std::string bytes = io::npy_header("<f8", shape);
  for (int k = 0; k < frames; ++k) {
    if (!report(progress, "frames", static_cast<double>(k) / frames)) return cancelled_error();
    for (const Vec3& p : waving(mesh, phase_of(k, frames))) {
      for (int axis = 0; axis < 3; ++axis) io::append_little(bytes, p[axis]);
    }
    if (auto written = file->append(bytes); !written) return written;
    bytes.clear();
  }
  return file->finish();
}

/// A mesh for each frame. Errors: those of the files.
Result<void> write_frame_files(const NumberedPath& paths, const TriangleMesh& mesh, int frames,
                               Outputs& outputs, const Progress& progress) {
  for (int k = 0; k < frames; ++k) {
    const std::string path = paths.path(k);
    if (!report(progress, "frames", static_cast<double>(k) / frames)) {
      outputs.remove_written();
      return cancelled_error();
    }
    const auto moved = mesh.moved(waving(mesh, phase_of(k, frames)));
    if (!moved) return moved.error();
    auto written = outputs.write(path, [&] { return write_mesh(outputs.place_of(path), *moved); });
    if (!written) return written;
  }
  return outputs.replace_all();
}

Result<CommandOutput> generate_frames(const GenerateArguments& arguments, Index faces,
                                      const Progress& progress) {
  const auto frames = whole_in("--frames", arguments.frames, "number of frames", 1, kMaxWaving);
  if (!frames) return frames.error();
  const std::string& path = arguments.output;
  const bool array = io::file_extension(path) == ".npy";
  const auto numbered = NumberedPath::parse(path);
  if (!array && !numbered) {
    return Error{ErrorCode::kBadInput,
                 "--frames are written into one array, or a mesh each, and " + one_line(path) +
                     " is neither",
                 {"give -o FILE.npy or -o 'frame_%04d.obj'"}};
  }
  Outputs outputs;
  if (!array) {
    if (auto known = check_mesh_path(path); !known) return known.error();
    outputs.keep_together();
  }
  for (int k = 0; k < (array ? 1 : *frames); ++k) {
    auto expected = outputs.expect(array ? path : numbered->path(k), "--output");
    if (!expected) return expected.error();
  }
  const auto mesh = generate_model(arguments.name, faces, part_of(progress, 0, 0.5));
  if (!mesh) return mesh.error();
  const Progress writing = part_of(progress, 0.5, 1);
  const auto write_array = [&] { return write_frames_array(path, *mesh, *frames, writing); };
  const auto written = array ? outputs.write(path, write_array)
                             : write_frame_files(*numbered, *mesh, *frames, outputs, writing);
  if (!written) return written.error();
  return CommandOutput{one_line(path) + ": " + arguments.name + ", " +
                           counted(*frames, "frame", "frames") + " of " +
                           counted(mesh->vertex_count(), "vertex", "vertices") + "\n",
                       {},
                       outputs.made()};
}

}  // namespace

void add_generate_options(CLI::App& command, GenerateArguments& arguments) {
  command
      .add_option("NAME", arguments.name,
                  "a bundled model (geotherm models), or a volume: " + joined(volume_names()))
      ->required()
      ->type_name("");
  command.add_option("--faces", arguments.faces, "about so many; default: the model's usual size")
      ->type_name("N");
  command.add_option("--tets", arguments.tets, "of a volume: about so many; default: 20000")
      ->type_name("N");
  command
      .add_option("--frames", arguments.frames,
                  "so many frames of the surface while a wave runs through it once")
      ->type_name("N");
  command
      .add_option("-o,--output", arguments.output,
                  ".obj .ply .off .stl, or - for OBJ on standard output; of a volume .mesh .vtu, "
                  "or - for .mesh; of frames .npy, or frame_%04d.obj for a mesh each")
      ->required()
      ->type_name("FILE");
  add_quiet_option(command, arguments.quiet);
  command.footer(
      "Examples:\n  geotherm generate gargoyle --faces 1000000 -o big.ply\n"
      "  geotherm generate ball-tets --tets 100000 -o ball.mesh\n"
      "  geotherm generate bunny --frames 24 -o waving.npy");
}

Result<CommandOutput> run_generate(const GenerateArguments& arguments, const Progress& progress) {
  if (is_volume_name(arguments.name)) return generate_volume_file(arguments);
  if (!arguments.tets.empty()) {
    return Error{ErrorCode::kBadInput,
                 "--tets is of volumes, and " + one_line(arguments.name) + " is none",
                 {"there are " + joined(volume_names())}};
  }
  if (!is_bundled(arguments.name)) {
    std::vector<std::string> known = volume_names();
    for (const BundledModel& model : bundled_models()) known.emplace_back(model.name);
    return Error{ErrorCode::kNotAvailable,
                 "there is no model '" + one_line(arguments.name) + "' to be generated",
                 {known_words(arguments.name, known)}};
  }
  const auto faces = faces_in(arguments);
  if (!faces) return faces.error();
  if (!arguments.frames.empty()) return generate_frames(arguments, *faces, progress);
  if (auto known = check_mesh_path(arguments.output); !known) return known.error();
  Outputs outputs;
  if (auto expected = outputs.expect(arguments.output, "--output"); !expected) {
    return expected.error();
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
