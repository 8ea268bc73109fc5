// SPDX-License-Identifier: MIT
#include "app/solve_steps.h"

#include "app/resolve_sources.h"
#include "app/text.h"
#include "app/told.h"

namespace geotherm::app {

Error about_model(const std::string& name, const Error& error) {
  const ErrorCode code = error.code == ErrorCode::kBadInput ? ErrorCode::kBadFile : error.code;
  return about(one_line(name), error, code);
}

Result<void> check_pin(const Constraint& constraint, const TriangleMesh& mesh) {
  if (constraint.mode != ConstraintMode::kPinVertex || constraint.pin_vertex == kNoIndex) return {};
  const Source pin{VertexList{{constraint.pin_vertex}},
                   "--constraint pin-vertex:" + std::to_string(constraint.pin_vertex),
                   ErrorCode::kBadInput};
  const auto placed = resolve_sources({&pin, 1}, mesh);
  if (!placed) return placed.error();
  return {};
}

std::vector<std::string> unreached_notes(const MeshSummary& mesh, Index unreached) {
  std::vector<std::string> notes;
  const Index loose = mesh.unreferenced_vertices;
  if (loose > 0) {
    notes.push_back(counted(loose, "vertex belongs", "vertices belong") +
                    " to no face; their distance is infinite");
  }
  const Index lost = unreached - loose;
  if (lost > 0) {
    notes.push_back(counted(lost, "vertex lies", "vertices lie") +
                    " in components without a source (there are " +
                    counted(mesh.components, "component", "components") +
                    "); their distance is infinite");
  }
  return notes;
}

}  // namespace geotherm::app
