// SPDX-License-Identifier: MIT
#include "app/cli/line_files.h"

#include <CLI/CLI.hpp>

#include "app/cli/options.h"
#include "app/text/text.h"
#include "solver/core/text.h"

namespace geotherm::app {
namespace {

bool is_picture(const std::string& path) { return io::file_extension(path) == ".svg"; }

Result<void> check_line_path(const std::string& path) {
  if (path == "-" || is_picture(path) || check_polyline_path(path)) return {};
  return Error{ErrorCode::kNotAvailable,
               "--output: " + one_line(path) + ": unknown extension '" +
                   one_line(io::file_extension(path)) + "'",
               {"there are .obj .csv .vtp .svg"}};
}

}  // namespace

void add_line_file_options(CLI::App& command, LineFileArguments& arguments,
                           SettingArguments& settings, const std::string& what) {
  may_repeat(
      command.add_option("-o,--output", arguments.outputs,
                         "where " + what +
                             " go: .obj .csv .vtp, .svg (a picture), or - for CSV on standard "
                             "output; may be repeated"),
      "FILE");
  add_json_option(command, arguments.json);
  add_line_picture_options(command, settings);
}

Result<void> expect_line_files(const LineFileArguments& arguments, Outputs& outputs) {
  for (const std::string& path : arguments.outputs) {
    if (auto known = check_line_path(path); !known) return known;
    if (auto expected = outputs.expect(path, "--output"); !expected) return expected;
  }
  return expect_report(arguments.json, outputs);
}

LinePicture picture_on(const Model& model, const std::string& what) {
  LinePicture picture;
  picture.mesh = model.mesh;
  picture.title = model.name + ", " + what;
  picture.up = model.up;
  return picture;
}

Result<void> write_line_files(const LineFileArguments& arguments, const LinePicture& picture,
                              const PictureSettings& settings, const Progress& progress,
                              Outputs& outputs, CommandOutput& out) {
  const TriangleMesh& mesh = *picture.mesh;
  for (const std::string& path : arguments.outputs) {
    if (!report(progress, "writing " + path, 1.0)) {
      outputs.remove_written();
      return cancelled_error();
    }
    Result<void> written;
    if (path == "-") {
      written = outputs.write_text(path, polyline_csv(mesh, picture.lines), out.text);
    } else if (is_picture(path)) {
      auto svg = line_picture_svg(picture, settings, progress);
      if (!svg) {
        outputs.remove_written();
        return svg.error();
      }
      if (!svg->shows_lines && !picture.lines.empty()) {
        out.warnings.push_back({one_line(path) + " shows no line: all are behind the surface",
                                {"look from another side with ", SettingHint{"azimuth"}, " and ",
                                 SettingHint{"elevation"}}});
      }
      written = outputs.write_text(path, std::move(svg->text), out.text);
    } else {
      written = outputs.write(path, [&] { return write_polylines(path, mesh, picture.lines); });
    }
    if (!written) return written;
  }
  return {};
}

}  // namespace geotherm::app
