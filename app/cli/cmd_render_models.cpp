// SPDX-License-Identifier: MIT
// `geotherm render A B ...`: several models in one picture.
#include <algorithm>
#include <utility>

#include "app/cli/render_work.h"
#include "app/cli/scene_output.h"
#include "app/picture/picture_scale.h"
#include "app/session/outputs.h"
#include "app/session/wording.h"
#include "app/text/text.h"

namespace geotherm::app {
namespace {

/// As many columns as leave each model the most room.
int suitable_columns(int models, const PictureSettings& settings) {
  int best = 1;
  double most = 0;
  for (int columns = 1; columns <= models; ++columns) {
    const int rows = (models + columns - 1) / columns;
    const double side = std::min(settings.width / double(columns), settings.height / double(rows));
    if (side <= most) continue;
    most = side;
    best = columns;
  }
  return best;
}

Result<int> columns_of(const RenderArguments& arguments, const PictureSettings& settings) {
  const int models = 1 + static_cast<int>(arguments.more_models.size());
  if (arguments.columns.empty()) return suitable_columns(models, settings);
  return whole_in("--columns", arguments.columns, "number of columns", 1, models);
}

/// One scale for all: ends that hold those of each picture.
void share_scale(std::vector<PictureData>& cells, PictureSettings& settings) {
  float most = 0;
  for (const PictureData& data : cells) most = std::max(most, data.largest_face_value);
  for (PictureData& data : cells) data.largest_face_value = most;
  std::optional<double> low, high;
  for (const PictureData& data : cells) {
    const PictureScale scale = picture_scale(data, settings);
    if (!scale.coloured) continue;
    low = std::min(low.value_or(scale.min), scale.min);
    high = std::max(high.value_or(scale.max), scale.max);
  }
  if (!high) return;
  if (settings.view == View::kExactError) settings.colour_scale = ColourScale::kDiverging;
  settings.range_min = low;
  settings.range_max = high;
}

Json models_json(const std::vector<PictureFigures>& all) {
  Json json = {{"models", Json::array()}};
  for (const PictureFigures& figures : all) {
    Json one = picture_json(figures);
    json["picture"] = one["picture"];  // the same of all
    one.erase("picture");
    json["models"].push_back(std::move(one));
  }
  return json;
}

std::string models_table(const std::vector<PictureFigures>& all, int columns) {
  std::string text = picture_table(all.front());
  for (const PictureFigures& figures : all) {
    text += "beside   " + caption_of(figures) + '\n';
    if (&figures == &all.front()) text.erase(text.rfind("beside"));
  }
  return text + "columns  " + std::to_string(columns) + '\n';
}

}  // namespace

Result<CommandOutput> run_render_models(const RenderArguments& arguments, const AskedPicture& asked,
                                        const RenderPlaces& places, DrawingDevice device,
                                        Drawing& drawing, Outputs& outputs,
                                        const Progress& progress) {
  if (scene_format(arguments.output)) {
    return Error{ErrorCode::kBadInput,
                 "--output: " + one_line(arguments.output) + " shows one model",
                 {"for several give -o FILE.png, FILE.pdf or FILE.svg"}};
  }
  const auto columns = columns_of(arguments, asked.settings);
  if (!columns) return columns.error();
  std::vector<std::string> models = {arguments.model};
  models.insert(models.end(), arguments.more_models.begin(), arguments.more_models.end());

  CommandOutput out;
  std::vector<PictureFigures> all;
  std::vector<PictureData> cells;
  for (const std::string& model : models) {
    const double share = static_cast<double>(all.size()) / static_cast<double>(models.size());
    const double next = static_cast<double>(all.size() + 1) / static_cast<double>(models.size());
    RenderArguments one = arguments;
    one.model = model;
    PictureFigures& figures = all.emplace_back();
    figures.model_argument = model;
    figures.sources = typed_sources(arguments.sources);
    figures.settings = asked.settings;
    figures.device = device;
    figures.paths = picture_paths(arguments.output, asked.settings);
    std::vector<Warning> warnings;
    auto data = prepare_picture(one, asked.state, places, asked.check,
                                part_of(progress, 0.9 * share, 0.9 * next), figures, warnings);
    if (!data && data.error().message.starts_with(one_line(model) + ": ")) return data.error();
    if (!data) return about(one_line(model), data.error());
    if (figures.solve) {
      note_unused_settings(arguments.settings, asked.state.options, figures.solve->warnings);
      warnings = figures.solve->warnings;
    }
    for (Warning& warning : warnings) {
      warning.message.insert(0, figures.model.name + ": ");
      out.warnings.push_back(std::move(warning));
    }
    data->caption = figures.model.name;
    cells.push_back(*std::move(data));
  }
  PictureSettings shared = asked.settings;
  share_scale(cells, shared);
  for (std::size_t i = 0; i < all.size(); ++i) {
    all[i].settings.range_min = shared.range_min;
    all[i].settings.range_max = shared.range_max;
    all[i].settings.colour_scale = shared.colour_scale;
    all[i].scale = picture_scale(cells[i], shared);
  }
  note_picture(arguments, all.front(), cells.front(), drawing, out.warnings);

  FrameWriter writer(arguments, outputs, all.front(), part_of(progress, 0.9, 1), out.text);
  Result<void> drawn = drawing.draw_cells(cells, *columns, shared, writer.taker(), writer.as());
  if (drawn) drawn = writer.finish();
  if (!drawn) {
    outputs.remove_written();
    return drawn.error();
  }
  return finish_command(
      std::move(out), outputs, arguments.json, [&] { return models_json(all); },
      [&] { return models_table(all, *columns); });
}

}  // namespace geotherm::app
