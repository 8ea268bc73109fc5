// SPDX-License-Identifier: MIT
#include "app/view_picture.h"

#include "app/bundled_models.h"
#include "app/explore/explored_picture.h"
#include "app/machine.h"
#include "app/outputs.h"
#include "app/picture_report.h"
#include "app/png_file.h"

namespace geotherm::app {
namespace {

PictureFigures figures_of(const Session& session, const PictureSettings& settings) {
  const Explored& explored = session.explored();
  const ViewerState& state = session.state();
  PictureFigures figures;
  figures.model = explored.model->model.name;
  figures.model_argument = state.model;
  for (const SourceSpec& source : explored.sources) figures.sources.push_back(to_text(source));
  figures.vertices = explored.model->mesh.vertices;
  figures.faces = explored.model->mesh.faces;
  figures.settings = settings;
  if (const Answer* answer = shown_answer(explored, state.shown)) {
    figures.solve = *answer;
  }
  return figures;
}

}  // namespace

Result<void> save_view_picture(const command::SavePicture& save, const Session& session,
                               const ViewPainter& painter) {
  const Explored& explored = session.explored();
  const ViewerState& state = session.state();
  if (!explored.model) return Error{ErrorCode::kBadInput, "no model is open to draw"};
  PictureSettings settings = state.picture;
  if (save.width > 0 || painter.width > 0) {
    settings.width = save.width > 0 ? save.width : painter.width;
    settings.height = save.width > 0 ? save.height : painter.height;
  }
  Outputs outputs;
  if (!is_bundled(state.model)) outputs.protect(state.model, "the model itself");
  if (auto expected = outputs.expect(save.path, "save picture"); !expected) return expected;

  const PictureData data = picture_of(explored, state.shown, settings.view);
  const auto picture = painter.draw(data, settings, save.panels);
  if (!picture) return picture.error();
  PictureFigures figures = figures_of(session, settings);
  figures.command = painter.command;
  figures.scale = picture_scale(data, settings);
  figures.device = painter.device();
  figures.paths = {save.path};
  std::vector<PngText> texts = picture_texts(figures, 0);
  texts.push_back({"Description", data.caption});
  std::erase_if(texts, [&](const PngText& text) {
    return text.keyword == "Description" && text.text != data.caption;
  });
  auto bytes = png_bytes(*picture, texts);
  if (!bytes) return bytes.error();
  std::string unused;
  return outputs.write_text(save.path, *std::move(bytes), unused);
}

}  // namespace geotherm::app
