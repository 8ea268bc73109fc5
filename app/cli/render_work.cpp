// SPDX-License-Identifier: MIT
// A model made ready to be drawn by `geotherm render`, and what there is to say about its picture.
#include "app/cli/render_work.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "app/cli/scene_output.h"
#include "app/picture/cut_picture.h"
#include "app/picture/picture_scale.h"
#include "app/picture/picture_text.h"
#include "app/picture/target_paths.h"
#include "app/session/explored.h"
#include "app/session/model_solver.h"
#include "app/session/vertex_field.h"
#include "app/session/wording.h"
#include "app/text/text.h"
#include "solver/core/text.h"
#include "solver/mesh/io/input_file.h"

namespace geotherm::app {
namespace {

/// A mesh without any area has no distances but may be looked at all the same.
bool has_area(const TriangleMesh& mesh) { return summarize_mesh(mesh).area > 0; }

/// What a file holds of vertices, in place of distances.
Result<void> draw_field(const std::string& path, const Model& model,
                        const PictureSettings& settings, PictureData& data,
                        PictureFigures& figures) {
  const auto field = read_vertex_field(path, model);
  if (!field) return about("--field", field.error());
  if (std::ranges::none_of(field->values, [](double x) { return std::isfinite(x); })) {
    return Error{ErrorCode::kBadFile,
                 "--field: none of the " + counted(std::ssize(field->values), "value", "values") +
                     " of " + io::printable(path) + " is a finite number",
                 {"give one that has some"}};
  }
  figures.field = path;
  if (auto shown = show_field(data, *model.mesh, *field); !shown || field->columns > 1) {
    return shown;
  }
  const std::string name = io::printable(path);
  if (settings.colour_scale == ColourScale::kDiverging && !data.is_signed) {
    return Error{ErrorCode::kBadInput,
                 "--colour-scale diverging: the values of " + name + " do not have both signs",
                 {"choose ", SettingHint{"colour-scale", {"linear"}}}};
  }
  if (settings.colour_scale == ColourScale::kLog && data.smallest_value <= 0) {
    return Error{ErrorCode::kBadInput,
                 "--colour-scale log: " + name +
                     " has values that are not above 0 and have no "
                     "logarithm",
                 {"choose ", SettingHint{"colour-scale", {"linear"}}}};
  }
  return {};
}

/// Adds the paths to all targets, and what is to be said about them to the warnings.
Result<void> draw_paths(const std::vector<Source>& targets, ModelSolver& solver, Answer& solved,
                        PictureData& data, const Progress& progress, PictureFigures& figures) {
  const std::shared_ptr<const TriangleMesh> mesh = solved.model.mesh;
  for (const Source& target : targets) {
    if (auto surface = refuse_space(solved.model, "paths are"); !surface) return surface;
    const auto placed = resolve_sources({&target, 1}, *mesh);
    if (!placed) return placed.error();
    const auto found =
        solver.paths_to(placed->set.points.front(), solved, figures.settings.path_kind, progress);
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

/// Says that no isoline is there of the values that were asked for.
void note_values(const PictureFigures& figures, const PictureData& data,
                 std::vector<Warning>& warnings) {
  const PictureScale& scale = figures.scale;
  if (figures.settings.line_values.empty() || scale.levels.empty() || !scale.coloured) return;
  const double low = std::max(scale.min, data.smallest_value);
  const double high = std::min(scale.max, data.greatest_value);
  const bool some = std::ranges::any_of(
      scale.levels, [&](double level) { return level >= low && level <= high; });
  if (some) return;
  warnings.push_back({"there is no isoline: none of --values " +
                      values_text(figures.settings.line_values) + " lies between " +
                      significant(low) + " and " + significant(high) +
                      ", which the picture shows"});
}

/// Says what tells no values apart: isolines that are not there, a scale that is too long.
void note_scale(const PictureFigures& figures, const PictureData& data,
                std::vector<Warning>& warnings) {
  const std::optional<double>& asked = figures.settings.line_spacing;
  const PictureScale& scale = figures.scale;
  if (is_one_value(data)) {
    if ((asked && *asked > 0) || !figures.settings.line_values.empty()) {
      warnings.push_back(
          {"there is no isoline: all values are " + significant(data.smallest_value)});
    }
    return;
  }
  constexpr double kSmallShare = 0.02;  // is nearly one colour
  const bool has_range = figures.settings.range_min || figures.settings.range_max;
  if (scale.coloured && scale.kind == ColourScale::kLog && !has_range &&
      scale.place_of(data.greatest_value) - scale.place_of(data.smallest_positive) < kSmallShare) {
    warnings.push_back(
        {"the values are so near to each other that a logarithmic scale gives them "
         "one colour",
         {"choose ", SettingHint{"colour-scale", {"linear"}}}});
  }
  const bool drawn = figures.scale.spacing > 0 || !figures.scale.levels.empty();
  if (!asked || *asked <= 0 || drawn || !figures.scale.coloured) return;
  const double room = figures.scale.max - figures.scale.min;
  warnings.push_back(
      {"isolines every " + significant(*asked) + " would be too close together and are left out",
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

/// Whether anything is as wide as --line-width says.
bool has_lines(const PictureFigures& figures, const PictureData& data) {
  const PictureScale& scale = figures.scale;
  const bool isolines = scale.coloured && (scale.spacing > 0 || !scale.levels.empty());
  return isolines || figures.settings.view == View::kWireframe ||
         std::ranges::any_of(data.lines, [&](const PictureData::Line& line) {
           return shows_line(figures.settings, line.name);
         });
}

/// Whether a colour bar, or keys of colours, would be there without --no-bar.
bool would_have_bar(const PictureFigures& figures, const PictureData& data) {
  PictureSettings settings = figures.settings;
  settings.bar = true;
  return picture_scale(data, settings).bar || settings.view == View::kGradientError ||
         shows_regions(data, settings) ||
         std::ranges::any_of(data.lines, [&](const PictureData::Line& line) {
           return !line.name.empty() && shows_line(settings, line.name);
         });
}

/// Options that have nothing to do in this picture, and letters that it cannot show.
void note_figure(const RenderArguments& arguments, const PictureFigures& figures,
                 const PictureData& data, const Drawing& drawing, std::vector<Warning>& warnings) {
  const auto note = [&](std::initializer_list<const char*> names, const std::string& why) {
    std::vector<std::string> typed;
    for (const char* name : names) {
      if (arguments.settings.has(name)) typed.push_back(std::string("--") + name);
    }
    if (typed.empty()) return;
    warnings.push_back(
        {joined(typed) + (typed.size() == 1 ? " is" : " are") + " not used: " + why});
  };
  if (!figures.scale.bar) {
    note({"bar-label", "units", "number-format"}, "the picture has no colour bar");
  } else if (face_field(figures.settings.view) && figures.settings.bar_label.empty()) {
    note({"units"}, "what this view shows has none");
  }
  const auto scene = scene_format(arguments.output);
  const bool is_glb = scene == SceneFormat::kGlb;  // has no place for these
  if (!is_glb && arguments.settings.has("bar") && !would_have_bar(figures, data)) {
    warnings.push_back({"--no-bar is not used: the picture has no colour bar"});
  }
  if (!is_glb && !has_lines(figures, data)) note({"line-width"}, "the picture has no lines");
  const bool mapped = figures.scale.coloured || face_field(figures.settings.view);
  if (figures.settings.view == View::kRegions) {
    note({"bands", "colour-map", "reverse"}, "each region has a colour of its own");
  } else if (!mapped) {
    note({"bands", "colour-map", "reverse"}, "the picture shows no values in colours");
  } else if (figures.scale.colour_map != figures.settings.colour_map) {
    note({"colour-map"}, face_field(figures.settings.view)
                             ? "it is for distances, and this view is drawn in viridis"
                             : "values of both signs are drawn in cool-warm or red-yellow-blue");
  }
  if (!figures.scale.coloured) {
    note({"values", "colour-scale", "range", "spacing"}, "the picture shows no distances");
  }
  if (figures.settings.view == View::kExactError && arguments.check.no_check) {
    warnings.push_back({"--no-check is not used: --view exact-error shows what the check finds"});
  }
  if (figures.settings.view == View::kExactError && figures.scale.coloured &&
      figures.scale.kind != ColourScale::kDiverging) {
    note({"range"}, "errors have a range on a diverging colour scale alone");
  }
  if (!figures.settings.slice) note({"slice-at"}, "nothing is sliced");
  if (arguments.targets.empty()) note({"path-kind"}, "no --path is drawn");
  const PictureSettings& s = figures.settings;
  std::vector<std::string> left_out;
  if (!scene) left_out = drawing.left_out(data, s);
  if (!left_out.empty()) {
    PictureSettings least = s;
    least.text_size = PaperLength{1};
    const bool sized = s.text_size || s.paper;
    const bool fits = sized && drawing.left_out(data, least).empty();  // with letters small enough
    const Hint larger = {"ask for a larger ", SettingHint{"size"}};
    const Hint smaller = {"give a smaller ", SettingHint{"text-size"}};
    warnings.push_back({"there is no room for " + joined(left_out) + " at " +
                            std::to_string(s.width) + " x " + std::to_string(s.height) + " pixels",
                        fits ? smaller : larger});
  }
  for (const auto& [name, text] : {std::pair<const char*, std::string>{"--title", s.title},
                                   {"--bar-label", s.bar_label},
                                   {"--units", s.units},
                                   {"the caption", s.caption ? data.caption : std::string()}}) {
    const std::vector<std::string> missing = drawing.missing_letters(text);
    if (missing.empty()) continue;
    warnings.push_back({std::string(name) + ": the font of pictures has no " + joined(missing) +
                        ", and a box stands there"});
  }
}

}  // namespace

Result<void> check_figure(const PictureSettings& settings, const MethodOptions& options,
                          const RenderArguments& arguments) {
  const bool is_error = settings.view == View::kExactError || !arguments.field.empty();
  if (auto fits = check_scale_of_view(settings, !arguments.field.empty()); !fits) {
    return Error{fits.error().code, "--" + fits.error().message, fits.error().hint};
  }
  if (!is_error && !settings.line_values.empty() && settings.line_values.front() <= 0) {
    return Error{
        ErrorCode::kBadInput,
        "--values: " + number_text(settings.line_values.front()) + " is no distance of an isoline",
        {"give numbers above 0, in model units, such as 0.1,0.2,0.5"}};
  }
  if (settings.line_spacing && !settings.line_values.empty()) {
    return Error{ErrorCode::kBadInput,
                 "--spacing and --values both say where isolines are",
                 {"leave one of them out"}};
  }
  const bool heat = settings.path_kind == PathKind::kHeat;
  if (heat && !arguments.targets.empty() && options.method != MethodKind::kHeat) {
    return Error{ErrorCode::kBadInput,
                 "--path-kind heat: --method " + to_text(options.method) + " has no heat to follow",
                 {"choose ", SettingHint{"path-kind", {"geodesic", "distance"}}}};
  }
  return {};
}

Result<void> check_field(const RenderArguments& arguments, View view, bool has_sources) {
  if (arguments.field.empty()) return {};
  std::vector<std::string> others;
  if (has_sources) others.emplace_back("sources");
  if (!arguments.targets.empty()) others.emplace_back("--path");
  if (!arguments.more_models.empty()) others.emplace_back("a second model");
  if (!others.empty()) {
    return Error{ErrorCode::kBadInput,
                 "--field draws values that are there already, not those of " + joined(others),
                 {"leave one of them out"}};
  }
  if (view == View::kContours) return {};
  return Error{ErrorCode::kBadInput,
               "--field: --view " + geotherm::to_text(view) + " does not show values of vertices",
               {"choose ", SettingHint{"view", {"contours"}}}};
}

Result<PictureData> prepare_picture(const RenderArguments& arguments, const ViewerState& asked,
                                    const RenderPlaces& places, CheckSettings check,
                                    const Progress& progress, PictureFigures& figures,
                                    std::vector<Warning>& warnings) {
  const auto& [sources, targets] = places;
  const MethodOptions& options = asked.options;
  const auto most = max_distance_in(arguments.max_distance);
  if (!most) return most.error();
  auto model = load_model(arguments.model, asked.reading, progress);
  if (!model) return model.error();
  const std::shared_ptr<const TriangleMesh> mesh = model->mesh;
  figures.model = *model;
  face_head_on(*model, arguments.settings, figures.settings);
  warnings = model->notes;
  const std::string unseen = model->space ? model->space->unseen() : "";
  PictureData data = picture_of(*mesh, tets_of(*model));
  data.up = model->up;
  if (!arguments.field.empty()) {
    auto drawn = draw_field(arguments.field, *model, figures.settings, data, figures);
    return drawn ? Result<PictureData>(std::move(data)) : drawn.error();
  }
  const View view = figures.settings.view;
  if (sources.empty()) {
    set_view_values(data, *model, view, nullptr);
    if (!unseen.empty()) warnings.push_back({unseen});
    return data;
  }
  QueryOptions query;
  query.reach.max_distance = *most;
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
                  std::vector<double>(static_cast<std::size_t>(mesh->vertex_count()), kUnreached));
    return data;
  }
  data.solid = is_solid(*mesh);
  add_sources(data, *mesh, solved->sources, places_in_cells(solver.model(), solved->sources));
  add_distances(data, solved->result.distances, {}, measures_time(solved->model));
  data.nearest = solved->result.nearest_source;
  if (view == View::kExactError) {
    const AccuracyReport& report = *solved->error;
    if (report.values.empty()) {
      return Error{ErrorCode::kBadInput,
                   "--view exact-error: there is nothing to hold --method " +
                       to_text(options.method) + " against: " + to_text(report),
                   {"choose another view"}};
    }
    add_error(data, report.values, error_title(report));
  }
  if (auto drawn = draw_paths(targets, solver, *solved, data, progress, figures); !drawn) {
    return drawn.error();
  }
  if (!unseen.empty()) solved->warnings.push_back({unseen});
  warnings = solved->warnings;
  set_view_values(data, solved->model, view, &solved->result);
  if (shows_arrows(view)) add_fields(data, *mesh, solved->result);
  figures.solve = *std::move(solved);
  return data;
}

void note_picture(const RenderArguments& arguments, const PictureFigures& figures,
                  const PictureData& data, const Drawing& drawing, std::vector<Warning>& warnings) {
  if (scene_format(arguments.output) != SceneFormat::kGlb) {  // which has no isolines
    note_scale(figures, data, warnings);
    note_values(figures, data, warnings);
  }
  note_figure(arguments, figures, data, drawing, warnings);
  note_empty(data, figures.settings, warnings);
}

}  // namespace geotherm::app
