// SPDX-License-Identifier: MIT
#include "app/text.h"
#include "ui/action.h"
#include "ui/bundled.h"
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

void draw_report(Frame& frame, const app::ExploredModel& model) {
  const MeshReport& mesh = model.mesh;
  const std::string& path = model.model.path;
  draw_value(frame, "file", path.empty() ? model.model.name + " (bundled)" : path, "",
             path.empty() ? "Comes with the program." : "");
  draw_count(frame, "vertices", mesh.vertices);
  draw_count(frame, "faces", mesh.faces);
  draw_count(frame, "components", mesh.components, "Parts without a common vertex.");
  draw_value(frame, "boundary", boundary_text(mesh), "", "Edges with one face.");
  draw_flaws(frame, mesh);
  for (const std::string& warning : model.warnings) draw_note(warning, frame.colours().warning);
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

}  // namespace geotherm::ui
