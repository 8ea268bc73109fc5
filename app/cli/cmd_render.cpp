// SPDX-License-Identifier: MIT
#include <CLI/CLI.hpp>

#include "app/cli/commands.h"
#include "app/cli/picture_report.h"
#include "app/cli/scene_output.h"
#include "app/cli/sequence_work.h"
#include "app/picture/cut_picture.h"
#include "app/picture/picture_scale.h"
#include "app/picture/picture_settings.h"
#include "app/picture/picture_text.h"
#include "app/picture/target_paths.h"
#include "app/session/explored.h"
#include "app/session/model_solver.h"
#include "app/session/outputs.h"
#include "app/session/progress.h"
#include "app/session/sources.h"
#include "app/session/wording.h"
#include "app/text/text.h"
#include "solver/core/stopwatch.h"
#include "solver/core/text.h"

namespace geotherm::app {
namespace {

Result<void> check_output(const RenderArguments& arguments, const PictureSettings& settings) {
  const std::string& path = arguments.output;
  if (scene_format(path)) {
    if (settings.turntable == 0) return {};
    return Error{ErrorCode::kBadInput, "--turntable: " + one_line(path) +
                                           " is turned by whoever looks at it; leave it out, or "
                                           "give -o FILE.png"};
  }
  if (path == "-" && settings.turntable > 0) {
    return Error{ErrorCode::kBadInput,
                 "--turntable: several pictures cannot go to standard output; give -o FILE.png"};
  }
  const std::string extension = io::file_extension(path);
  if (path == "-" || extension == ".png") return {};
  return Error{ErrorCode::kBadInput, "--output: " + one_line(path) + ": pictures are written as " +
                                         ".png, scenes as .html and .glb, not '" +
                                         one_line(extension) + "'; give -o FILE.png"};
}

Result<void> expect_outputs(const RenderArguments& arguments, const PictureSettings& settings,
                            Outputs& outputs) {
  if (auto known = check_output(arguments, settings); !known) return known;
  protect_inputs(arguments.model, arguments.sources, outputs);
  for (const std::string& path : frame_paths(arguments.output, settings)) {
    if (auto expected = outputs.expect(path, "--output"); !expected) return expected;
  }
  if (arguments.json.empty()) return {};
  return outputs.expect(arguments.json, "--json");
}

Result<std::vector<Source>> sources_for(const RenderArguments& arguments, View view) {
  auto sources = sources_of(arguments.sources);
  if (!sources || !sources->empty() || !needs_sources(view)) return sources;
  return Error{ErrorCode::kBadInput,
               "no source was given, which --view " + geotherm::to_text(view) +
                   " needs; say where distance is 0, such as -s 17 or -s boundary, or choose "
                   "--view smooth"};
}

/// A mesh without any area has no distances but may be looked at all the same.
bool has_area(const TriangleMesh& mesh) { return inspect_mesh(mesh).area > 0; }

/// Where paths are to lead. Errors: kBadInput, with what was typed.
Result<std::vector<Source>> targets_of(const std::vector<std::string>& texts) {
  std::vector<Source> targets;
  for (const std::string& text : texts) {
    auto spec = parse_source(text);
    if (!spec) return about("--path", spec.error());
    if (!is_single_point(*spec)) {
      return Error{ErrorCode::kBadInput, "--path: '" + one_line(text) +
                                             "' is not one point; write a vertex id, "
                                             "face:ID:b0:b1:b2 or xyz:x:y:z"};
    }
    targets.push_back({*std::move(spec), "--path " + one_line(text), ErrorCode::kBadInput});
  }
  return targets;
}

/// Adds the paths to all targets, and what is to be said about them to the warnings.
Result<void> draw_paths(const std::vector<Source>& targets, ModelSolver& solver, Answer& solved,
                        PictureData& data, const Progress& progress, PictureFigures& figures) {
  const std::shared_ptr<const TriangleMesh> mesh = solved.model.mesh;
  for (const Source& target : targets) {
    if (auto surface = refuse_space(solved.model, "paths are"); !surface) return surface;
    const auto placed = resolve_sources({&target, 1}, *mesh);
    if (!placed) return placed.error();
    const auto found = solver.paths_to(placed->set.points.front(), solved, progress);
    if (!found) {
      return about_model(solved.model.name, about(target.where, found.error()));
    }
    add_paths(data, *mesh, found->paths);
    for (const TargetPath& path : found->paths) {
      figures.lines.push_back({to_text(target.spec), to_text(path.field), path.path.length});
    }
    for (const auto* more : {&placed->warnings, &found->warnings}) {
      solved.warnings.insert(solved.warnings.end(), more->begin(), more->end());
    }
  }
  return {};
}

/// Solves where sources are given, and fills the data.
Result<PictureData> prepare(const RenderArguments& arguments, const ViewerState& asked,
                            const std::vector<Source>& sources, const std::vector<Source>& targets,
                            CheckSettings check, const Progress& progress, PictureFigures& figures,
                            std::vector<Warning>& warnings) {
  const MethodOptions& options = asked.options;
  auto model = load_model(arguments.model, asked.reading, progress);
  if (!model) return model.error();
  const std::shared_ptr<const TriangleMesh> mesh = model->mesh;
  figures.model = model->name;
  figures.vertices = mesh->vertex_count();
  figures.faces = mesh->face_count();
  figures.size = size_in_words(*model);
  face_head_on(*model, arguments.settings, figures.settings);
  warnings = model->notes;
  const std::string unseen = model->space ? model->space->unseen() : "";
  PictureData data = picture_of(*mesh, tets_of(*model));
  const View view = figures.settings.view;
  if (sources.empty()) {
    set_view_values(data, *model, view, nullptr);
    if (!unseen.empty()) warnings.push_back({unseen});
    return data;
  }
  QueryOptions query;
  query.fields = needs_fields(view);
  query.nearest = view == View::kRegions;
  if (view == View::kExactError) check.against = Check::kAuto;
  const auto placed = resolve_sources(sources, *model);
  if (!placed) return placed.error();
  ModelSolver solver(*std::move(model));
  auto solved = solver.solve(options, *placed, {query, check}, progress);
  if (!solved && (solved.error().code != ErrorCode::kBadFile || has_area(*mesh))) {
    return solved.error();
  }
  if (!solved) {
    Warning said = warning_of(solved.error());
    said.message.insert(0, "there are no distances, the surface is drawn in grey: ");
    warnings.push_back(std::move(said));
    add_distances(data,
                  std::vector<double>(static_cast<std::size_t>(figures.vertices), kUnreached));
    return data;
  }
  add_sources(data, *mesh, solved->sources, places_in_cells(solver.model(), solved->sources));
  add_distances(data, solved->result.distances, {}, measures_time(solved->model));
  data.nearest = solved->result.nearest_source;
  if (view == View::kExactError) {
    const AccuracyReport& report = *solved->error;
    if (report.values.empty()) {
      return Error{ErrorCode::kBadInput, "--view exact-error: there is nothing to hold --method " +
                                             to_text(options.method) + " against: " + told(report) +
                                             "; choose another view"};
    }
    add_error(data, report.values, error_title(report));
  }
  if (auto drawn = draw_paths(targets, solver, *solved, data, progress, figures); !drawn) {
    return drawn.error();
  }
  if (!unseen.empty()) solved->warnings.push_back({unseen});
  warnings = solved->warnings;
  set_view_values(data, solved->model, view, &solved->result);
  if (shows_arrows(view)) {
    add_fields(data, *mesh, solved->result);
    data.solid = is_solid(*mesh, inspect_mesh(*mesh));
  }
  figures.solve = *std::move(solved);
  return data;
}

/// Draws, encodes and writes every frame; `standard_output` takes the picture of "-".
Result<void> draw_frames(Drawing& drawing, const PictureData& data, const Progress& progress,
                         Outputs& outputs, PictureFigures& figures, std::string& standard_output) {
  const int frames = frame_count(figures.settings);
  const auto announce = [&](int frame) -> Result<void> {
    if (report(progress, "drawing", static_cast<double>(frame) / frames)) return {};
    return cancelled_error();
  };
  Stopwatch watch;
  const auto take_frame = [&](int frame, const DrawnPicture& picture) -> Result<void> {
    figures.draw_ms += watch.lap();
    auto bytes = png_bytes(picture, picture_texts(figures, frame));
    if (!bytes) return bytes.error();
    const std::string& path = figures.paths[static_cast<std::size_t>(frame)];
    auto written = outputs.write_text(path, *std::move(bytes), standard_output);
    if (!written) return written;
    figures.write_ms += watch.lap();
    return announce(frame + 1);
  };
  if (auto going = announce(0); !going) return going;
  Result<void> drawn = drawing.draw(data, figures.settings, take_frame);
  if (!drawn) outputs.remove_written();
  return drawn;
}

void note_scale(const PictureFigures& figures, std::vector<Warning>& warnings) {
  const std::optional<double>& asked = figures.settings.line_spacing;
  if (!asked || *asked <= 0 || figures.scale.spacing > 0 || !figures.scale.coloured) return;
  const double room = figures.scale.max - figures.scale.min;
  warnings.push_back({"isolines every " + significant(*asked) +
                          " would be closer together than pixels and are left out",
                      {"try ", SettingHint{"spacing", {significant(round_spacing(room))}}}});
}

bool shows_faces(const PictureData& data) {
  return std::ranges::any_of(data.faces, [](const auto& face) {
    return face[0] != face[1] && face[1] != face[2] && face[2] != face[0];
  });
}

/// Says that, and why, a picture is empty.
void note_empty(const PictureData& data, const PictureSettings& settings,
                std::vector<Warning>& warnings) {
  if (!shows_faces(data)) {
    warnings.push_back({"the picture is empty: there is no face with three corners"});
  } else if (is_cut(data, settings) && !shows_faces(cut_picture(data, settings).data)) {
    const bool sliced = settings.slice.has_value();
    warnings.push_back(
        {std::string("the picture is empty: ") +
             (sliced ? "nothing of the model lies on this side of the slice"
                     : "no cell lies on this side of the share of the distance"),
         {"try ", sliced ? SettingHint{"slice-at", {"0.5"}} : SettingHint{"peel", {"below:0.5"}}}});
  }
}

}  // namespace

void add_render_options(CLI::App& command, RenderArguments& arguments) {
  add_model_option(command, arguments.model, arguments.settings)->required();
  command
      .add_option("-o,--output", arguments.output,
                  "the picture, .png; .html is a page that turns it, .glb a glTF scene; - is "
                  "standard output; with --sequence a name with a place for the frame's number, "
                  "such as frame_%04d.png")
      ->type_name("FILE")
      ->required();
  command.add_option("--json", arguments.json, "every figure as JSON; - is standard output")
      ->type_name("FILE");
  command
      .add_option("--path", arguments.targets,
                  "draws the paths from the nearest source to this point (17, face:ID:b0:b1:b2, "
                  "xyz:x:y:z): geodesic, and the streamlines of distance and heat; may be repeated")
      ->type_name("POINT")
      ->expected(1)
      ->allow_extra_args(false)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  add_check_options(command, arguments.check);
  add_quiet_option(command, arguments.quiet);
  add_picture_options(command, arguments.settings, arguments.picture);
  add_sequence_options(command, arguments.sequence);
  add_source_options(command, arguments.sources);
  add_setting_options(command, arguments.settings, names_of(SettingGroup::kMethod));
  command.footer(
      "Examples:\n"
      "  geotherm render model.obj -s 17 --view contours -o out.png\n"
      "  geotherm render bunny -s 0 --path 1500 -o path.png\n"
      "  geotherm render bunny --view wireframe --size 1920x1080 -o bunny.png\n"
      "  geotherm render bunny -s 0 -o bunny.html\n"
      "  geotherm render terrain -s boundary --turntable 36 --background dark -o turn.png\n"
      "  geotherm render body.obj --sequence walk.pc2 -s 17 -o 'walk_%04d.png'");
}

Result<CommandOutput> run_render(const RenderArguments& arguments, Drawing& drawing,
                                 const Progress& progress) {
  const std::vector<std::string> colour_maps = drawing.colour_maps();
  const auto asked = settings_in(arguments.settings);
  if (!asked) return asked.error();
  const auto settings =
      picture_settings(*asked, arguments.settings, arguments.picture, colour_maps);
  if (!settings) return settings.error();
  const MethodOptions& options = asked->options;
  if (needs_fields(settings->view) && options.method != MethodKind::kHeat) {
    return Error{ErrorCode::kBadInput, "--view " + geotherm::to_text(settings->view) +
                                           " shows the heat u, which --method " +
                                           to_text(options.method) +
                                           " has not; use --method heat or another view"};
  }
  if (auto fits = refuse_with_sequence(arguments.sequence, arguments.check); !fits) {
    return fits.error();
  }
  const auto check = check_settings(arguments.check);
  if (!check) return check.error();
  if (needs_fields(settings->view)) {
    if (auto fits = refuse_better(*check, "--view " + geotherm::to_text(settings->view)); !fits) {
      return fits.error();
    }
  }
  if (!arguments.sequence.frames.empty()) {
    return run_render_sequence(arguments, {*asked, *settings, *check}, drawing, progress);
  }
  Outputs outputs;
  if (auto expected = expect_outputs(arguments, *settings, outputs); !expected) {
    return expected.error();
  }
  const auto sources = sources_for(arguments, settings->view);
  if (!sources) return sources.error();
  const auto targets = targets_of(arguments.targets);
  if (!targets) return targets.error();
  if (!targets->empty() && sources->empty()) {
    return Error{ErrorCode::kBadInput,
                 "--path: no source was given, so that no path leads there; add -s"};
  }
  const std::optional<SceneFormat> format = scene_format(arguments.output);
  auto device = format ? Result<DrawingDevice>(DrawingDevice()) : drawing.open(*settings);
  if (!device) return device.error();

  PictureFigures figures;
  figures.model_argument = arguments.model;
  figures.sources = typed_sources(arguments.sources);
  figures.command = arguments.command;
  figures.settings = *settings;
  figures.device = *std::move(device);
  figures.paths = frame_paths(arguments.output, *settings);
  CommandOutput out;
  auto data =
      prepare(arguments, *asked, *sources, *targets, *check, progress, figures, out.warnings);
  if (!data) return data.error();
  if (figures.solve) {
    note_unused_settings(arguments.settings, options, figures.solve->warnings);
    out.warnings = figures.solve->warnings;
  }
  figures.scale = picture_scale(*data, *settings);
  if (format == SceneFormat::kGlb) figures.scale.spacing = 0;  // lines have no place there
  data->caption = caption_of(figures);
  note_scale(figures, out.warnings);
  note_empty(*data, figures.settings, out.warnings);
  if (outputs.uses_stdout() && figures.device.software && !arguments.quiet) {
    out.warnings.push_back({"drawing in software, on " + figures.device.name});
  }
  if (format) note_what_has_no_place(arguments.settings, *format, settings->view, out.warnings);
  const auto drawn = format ? write_scene(drawing, *format, *data, progress, outputs, figures)
                            : draw_frames(drawing, *data, progress, outputs, figures, out.text);
  if (!drawn) return drawn.error();
  if (!arguments.json.empty()) {
    const auto written =
        outputs.write_text(arguments.json, to_text(picture_json(figures)), out.text);
    if (!written) return written.error();
  }
  if (!outputs.uses_stdout()) out.text = picture_table(figures);
  if (figures.solve && figures.solve->error) {
    out.note = accuracy_note(arguments.json, outputs, arguments.quiet, *figures.solve->error,
                             accuracy_line(*figures.solve->error));
  }
  out.made = outputs.made();
  return out;
}

}  // namespace geotherm::app
