// SPDX-License-Identifier: MIT
#include "app/text/text.h"

#include "app/session/check.h"
#include "ui/action.h"
#include "ui/panels.h"
#include "ui/widgets.h"

namespace geotherm::ui {
namespace {

constexpr double kNeedle = 1;    ///< degrees: a smallest angle worth a colour
constexpr double kSkewed = 0.5;  ///< mean quality worth a colour

void draw_count(Frame& frame, const char* label, std::int64_t count, const char* help = "") {
  draw_value(frame, label, app::grouped(count), "", help);
}

/// A count that ought to be 0.
void draw_flaw(Frame& frame, const char* label, std::int64_t count, const char* help) {
  if (count == 0) return;
  draw_value(frame, label, app::grouped(count), "", help, frame.colours().warning);
}

void draw_quality(Frame& frame, const MeshReport& mesh) {
  const Palette& p = frame.colours();
  draw_value(frame, "smallest angle", app::significant(mesh.smallest_angle, 3), "\u00b0",
             "Needles below a degree cost accuracy nearby.",
             mesh.smallest_angle < kNeedle ? p.warning : p.text);
  draw_value(frame, "mean quality", app::fixed(mesh.mean_quality, 3), "",
             "Mean of 4\u221a3 area / (sum of squared sides); 1: all equilateral.",
             mesh.mean_quality < kSkewed ? p.warning : p.text);
  const double share = mesh.edges > 0 ? 100.0 * mesh.non_delaunay_edges / mesh.edges : 0;
  draw_value(frame, "non-Delaunay edges",
             app::grouped(mesh.non_delaunay_edges) + " (" + app::significant(share, 2) + " %)", "",
             "Edges with a negative cotangent weight: the Laplacian 'auto' flips them away.");
  draw_value(
      frame, "edge length",
      app::significant(mesh.shortest_edge, 3) + " \u2026 " + app::significant(mesh.longest_edge, 3),
      "", "Shortest to longest, model units.");
  draw_value(frame, "mean edge h", app::significant(mesh.mean_edge_length), "",
             "Model units; the time step 'mean-edge' is t = m h\u00b2.");
}

void draw_flaws(Frame& frame, const MeshReport& mesh) {
  draw_flaw(frame, "non-manifold edges", mesh.nonmanifold_edges, "Edges of three faces or more.");
  draw_flaw(frame, "non-manifold vertices", mesh.nonmanifold_vertices,
            "Vertices whose faces form more than one fan.");
  draw_flaw(frame, "degenerate faces", mesh.degenerate_faces,
            "Faces with a repeated corner or without area.");
  draw_flaw(frame, "duplicate faces", mesh.duplicate_faces, "The same three vertices twice.");
  draw_flaw(frame, "unused vertices", mesh.unreferenced_vertices, "In none of the faces.");
  draw_flaw(frame, "duplicate positions", mesh.duplicate_positions,
            "Vertices exactly where another one lies: perhaps a cut.");
  draw_flaw(frame, "turned faces", mesh.inconsistent_faces,
            "Faces turned against their neighbours; distances do not mind.");
}

std::string boundary_text(const MeshReport& mesh) {
  if (mesh.boundary_edges == 0) return "none";
  return app::counted(mesh.boundary_edges, "edge", "edges") + " in " +
         app::counted(mesh.boundary_loops, "loop", "loops");
}

void draw_details(Frame& frame, const MeshReport& mesh) {
  draw_count(frame, "edges", mesh.edges);
  draw_count(frame, "Euler number", mesh.euler_characteristic, "V \u2212 E + F");
  draw_value(frame, "area", app::significant(mesh.area), "", "Model units squared.");
  const Vec3 size = mesh.box_max - mesh.box_min;
  draw_value(frame, "size",
             app::significant(size.x(), 3) + " \u00d7 " + app::significant(size.y(), 3) +
                 " \u00d7 " + app::significant(size.z(), 3),
             "", "Of the box about the model, model units.");
  draw_quality(frame, mesh);
}

/// A space has figures of its own; those of the mesh are of what is drawn of it.
void draw_space(Frame& frame, const app::ExploredModel& model) {
  for (const app::SpaceFigure& figure : model.figures) {
    if (!figure.row.empty()) draw_value(frame, figure.row.c_str(), figure.text, "", "");
  }
  draw_count(frame, "components", model.mesh->components, "Parts that no cell joins.");
  for (const Warning& warning : model.warnings) {
    draw_note(sentence(warning), frame.colours().warning);
  }
}

void draw_report(Frame& frame, const app::ExploredModel& model) {
  const std::string& path = model.model.path;
  draw_value(frame, "file", path.empty() ? model.model.name + " (bundled)" : path, "",
             path.empty() ? "Comes with the program." : "");
  draw_count(frame, "vertices", model.model.mesh->vertex_count());
  if (!model.model.space) draw_count(frame, "faces", model.model.mesh->face_count());
  if (!model.mesh) return;
  if (model.model.space) return draw_space(frame, model);
  const MeshReport& mesh = *model.mesh;
  draw_count(frame, "components", mesh.components, "Parts without a common vertex.");
  draw_value(frame, "boundary", boundary_text(mesh), "", "Edges with one face.");
  draw_flaws(frame, mesh);
  for (const Warning& warning : model.warnings) {
    draw_advice(frame, sentence(warning), warning.hint, frame.colours().warning);
  }
  if (draw_more(frame, "Size and triangles")) draw_details(frame, mesh);
}

}  // namespace

void draw_model_panel(Frame& frame) {
  if (!draw_section(frame, "Model")) return;
  const float width = button_width(2);
  if (draw_button(frame, "open", "Open\u2026", true, width)) perform(frame, Action::kOpenModel);
  ImGui::SameLine();
  draw_bundled_list(frame, width);
  if (!frame.model()) return draw_dim(frame, "No model is open.");
  draw_report(frame, *frame.model());
}

namespace {

/// A residual above these is too large for a system that was solved with factors of single and of
/// double precision.
constexpr double kLargeCompactResidual = 1e-4, kLargeResidual = 1e-6;
constexpr double kFarSource = 0.5;  ///< mean edges: a source that is not near 0 is worth a colour

/// A drag leaves the figures out: all of them are 0 then, which no computed answer has.
bool is_measured(const Quality& quality) {
  return quality.eikonal_error_mean != 0 || quality.poisson_residual != 0 ||
         quality.heat_residual != 0;
}

void draw_distances(Frame& frame, const app::Answer& answer) {
  const auto& distance = answer.distance;
  draw_value(frame, "largest distance", app::significant(distance.max), "", "Model units.");
  draw_value(frame, "mean distance", app::significant(distance.mean), "",
             "Over the vertices that are reached, model units.");
  if (distance.unreached > 0) {
    draw_value(frame, "unreached", app::grouped(distance.unreached), "",
               "Vertices in parts without a source: their distance is infinite.",
               frame.colours().warning);
  }
}

void draw_figures(Frame& frame, const app::Answer& answer) {
  const Quality& quality = answer.result.quality;
  const Palette& p = frame.colours();
  const auto warn = [&p](bool bad) { return bad ? p.warning : p.text; };
  const double edge = answer.mesh.mean_edge_length;
  draw_value(frame, "distance at sources", app::significant(quality.max_source_distance, 3), "",
             "Largest |d| on a source as solved, before it is set to 0; model units. Near 0 unless "
             "the constraint mode lets sources float.",
             warn(quality.max_source_distance > kFarSource * edge));
  draw_value(
      frame, "eikonal error", app::significant(quality.eikonal_error_mean, 3), "",
      "Area-weighted mean of | |\u2207d| \u2212 1 |: 0 for true distances away from where fronts "
      "meet. Falls with finer meshes; grows with t.");
  if (quality.lines_checked) {
    draw_value(
        frame, "below straight line", app::grouped(quality.below_straight_line), "",
        "Vertices whose distance is below the straight line to the nearest source by more than "
        "the method's tolerance. Such a distance is wrong, whatever the surface.",
        warn(quality.below_straight_line > 0));
  }
  if (quality.edges_checked) {
    draw_value(frame, "too steep edges", app::grouped(quality.steep_edges), "",
               "Edges along which the distance differs by more than their length and the method's "
               "tolerance. It is wrong around them.",
               warn(quality.steep_edges > 0));
  }
  if (answer.method->heat() == nullptr) return;
  const bool compact = answer.options.precision == Precision::kCompact;
  const double large = compact ? kLargeCompactResidual : kLargeResidual;
  draw_value(frame, "heat residual", app::significant(quality.heat_residual, 2), "",
             "|M u \u2212 b| / |b| of the heat step: how exactly the linear system was solved.",
             warn(quality.heat_residual > large));
  draw_value(frame, "Poisson residual", app::significant(quality.poisson_residual, 2), "",
             "|L \u03c6 \u2212 b| / |b| of the Poisson step.",
             warn(quality.poisson_residual > large));
  const bool has_faces = frame.model()->model.space == nullptr;
  draw_value(frame, has_faces ? "faces without \u2207u" : "cells without \u2207u",
             app::grouped(quality.zero_gradient_faces), "",
             "Those in reach in which the heat has no gradient: no direction can be had there.",
             warn(quality.zero_gradient_faces > 0));
  draw_value(frame, "clamped vertices", app::grouped(quality.clamped_vertices), "",
             "Distances below 0 by more than round-off, set to 0.",
             warn(quality.clamped_vertices > 0));
  const auto iterations = [](int count) {
    return count == 0 ? std::string("direct") : app::grouped(count);
  };
  draw_value(frame, "iterations, heat", iterations(quality.iterations_heat), "",
             "Of an iterative backend; direct ones need none.");
  draw_value(frame, "iterations, Poisson", iterations(quality.iterations_poisson), "",
             "Of an iterative backend; direct ones need none.");
}

}  // namespace

void draw_quality_panel(Frame& frame) {
  if (!draw_section(frame, "Quality")) return;
  const app::Answer* answer = frame.answer();
  if (!answer || !frame.model()) return draw_dim(frame, "No answer yet.");
  draw_distances(frame, *answer);
  if (is_measured(answer->result.quality)) {
    draw_figures(frame, *answer);
  } else {
    draw_dim(frame, "Quality is measured when nothing moves.");
  }
  for (const Warning& warning : answer->warnings) {
    draw_advice(frame, sentence(warning), warning.hint, frame.colours().warning);
  }
}

}  // namespace geotherm::ui
