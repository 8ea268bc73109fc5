// SPDX-License-Identifier: MIT
#include "app/explore/explored_picture.h"

#include "app/method_words.h"
#include "app/picture/picture_data.h"
#include "app/picture/picture_scale.h"
#include "app/text.h"

namespace geotherm::app {
namespace {

std::string caption_of(const Explored& explored, Shown shown) {
  const Model& model = explored.model->model;
  const Index faces = model.mesh->face_count();
  if (!explored.b) {
    return picture_caption(model.name, faces, explored.a ? explored.a->method.get() : nullptr);
  }
  if (shown != Shown::kDifference) {
    return picture_caption(model.name, faces, shown_answer(explored, shown)->method.get()) +
           (shown == Shown::kB ? " (B)" : " (A)");
  }
  return picture_caption(model.name, faces, nullptr) +
         ", A: " + method_caption(*explored.a->method) +
         ", B: " + method_caption(*explored.b->method);
}

void set_answer(PictureData& data, const Explored& explored, Shown shown, View view,
                const Answer& answer) {
  const TriangleMesh& mesh = *explored.model->model.mesh;
  add_sources(data, mesh, explored.set);
  add_paths(data, mesh, explored.paths);
  if (view == View::kExactError) {  // nothing, where nothing is known of the error
    if (answer.error && !answer.error->values.empty()) {
      add_error(data, answer.error->values, error_title(*answer.error));
    }
  } else if (shown == Shown::kDifference && explored.difference && !face_field(view)) {
    add_difference(data, explored.difference->values);
  } else {
    add_distances(data, answer.result.distances);
  }
  if (shows_arrows(view) && !answer.result.log_heat.empty()) {
    add_fields(data, mesh, answer.result);
  }
}

}  // namespace

bool shows_arrows(View view) { return view == View::kHeatGradient || view == View::kGradientError; }

bool needs_fields(View view) { return shows_arrows(view) || view == View::kLostGradients; }

void set_explored(PictureData& data, const Explored& explored, Shown shown, View view) {
  data.sources.clear();
  data.values.clear();
  data.heat_directions.clear();
  data.distance_gradients.clear();
  data.value_unit = 1;
  data.largest_value = 0;
  data.is_signed = false;
  data.nearest.clear();
  if (explored.a) data.nearest = explored.a->result.nearest_source;
  data.lines.clear();
  const TriangleMesh& mesh = *explored.model->model.mesh;
  if (shown != Shown::kA && !explored.b) shown = Shown::kA;
  data.caption = caption_of(explored, shown);
  const Answer* answer = shown_answer(explored, shown);
  if (answer != nullptr) set_answer(data, explored, shown, view, *answer);
  set_face_values(data, mesh, view, answer != nullptr ? &answer->result : nullptr);
}

PictureData picture_of(const Explored& explored, Shown shown, View view) {
  PictureData data = *explored.model->base;
  set_explored(data, explored, shown, view);
  return data;
}

}  // namespace geotherm::app
