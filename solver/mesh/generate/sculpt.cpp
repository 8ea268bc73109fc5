// SPDX-License-Identifier: MIT
#include "solver/mesh/generate/sculpt.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>

#include "solver/mesh/generate/relax.h"
#include "solver/mesh/generate/sparse_field.h"
#include "solver/mesh/generate/surface_net.h"

namespace geotherm::generate {
namespace {

constexpr int kTries = 10;
constexpr double kCloseEnough = 0.02;
constexpr int kRounds = 6;
// Faces per squared spacing of area: two per crossed edge, 1.5 such edges in the mean over normals.
constexpr double kFacesPerArea = 3.0;

/// A solid's samples and its raw surface.
struct Attempt {
  Attempt(const Sculpture& solid, const SculptureModel& model, double spacing)
      : field(solid, spacing, model.low, model.high) {}
  SparseField field;
  DraftMesh mesh;
};

/// The surface's point on the line through `target` along `normal`: `steps` secant steps.
Vec3 onto_surface(const SparseField& field, const Vec3& target, const Vec3& normal, int steps) {
  const double most = 0.5 * field.spacing();
  const double enough = 1e-3 * field.spacing();
  double way = 0;
  double slope = 1;
  double last = 0;
  for (int step = 0; step < steps; ++step) {
    const Vec3 p = target + way * normal;
    const double d = field.sculpture().distance(p, field.parts_near(p));
    if (step == 1) slope = std::clamp((d - last) / way, 0.5, 2.0);
    if (std::abs(d) < enough) break;
    last = d;
    way = std::clamp(way - d / slope, -most, most);
  }
  return target + way * normal;
}

Error cancelled() { return {ErrorCode::kCancelled, "making the model was cancelled"}; }

}  // namespace

Result<DraftMesh> sculpt(const SculptureModel& model, Index faces, const Progress& progress) {
  std::unique_ptr<Attempt> best;
  double best_error = std::numeric_limits<double>::infinity();
  double spacing = std::sqrt(kFacesPerArea * model.area / faces);
  const Sculpture solid = model.carve(spacing);  // the same for all tries, or they would not settle
  for (int i = 0; i < kTries && best_error > kCloseEnough; ++i) {
    auto attempt = std::make_unique<Attempt>(solid, model, spacing);
    if (!attempt->field.sample(progress)) return cancelled();
    attempt->mesh = extract_surface(attempt->field);
    const double ratio = static_cast<double>(attempt->mesh.faces.size()) / faces;
    if (std::abs(ratio - 1) < best_error) {
      best_error = std::abs(ratio - 1);
      best = std::move(attempt);
    }
    spacing *= std::sqrt(std::clamp(ratio, 0.25, 4.0));
  }
  if (!best) return Error{ErrorCode::kBadInput, "the sculpture has no surface"};
  DraftMesh mesh = std::move(best->mesh);
  for (int round = 0; round < kRounds; ++round) {
    if (!report(progress, "smoothing", static_cast<double>(round) / kRounds)) return cancelled();
    const int steps = round + 1 < kRounds ? 1 : 3;
    relax(mesh, 1, [&](Index, const Vec3& target, const Vec3& normal) {
      return onto_surface(best->field, target, normal, steps);
    });
  }
  smooth_slivers(mesh);
  return mesh;
}

}  // namespace geotherm::generate
