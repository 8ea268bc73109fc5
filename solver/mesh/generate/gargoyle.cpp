// SPDX-License-Identifier: MIT
#include "solver/mesh/generate/gargoyle_parts.h"
#include "solver/mesh/generate/models.h"
#include "solver/mesh/generate/noise.h"
#include "solver/mesh/generate/sculpt.h"

namespace geotherm::generate {
namespace {

/// Weathered stone: shallow pits over a fine grain. Fades where the grid is too coarse for it.
void weather(Sculpture& s) {
  const double fine = 1 - smooth_step(0.012, 0.035, s.spacing());
  if (fine <= 0) return;
  const double height = 0.006 * fine;
  s.set_detail(
      [height](const Vec3& p) {
        const double pits = gradient_noise(8 * p, 11);
        return height * (0.6 * fractal_noise(22 * p, 2, 5) - (pits > 0.2 ? 2 * (pits - 0.2) : 0));
      },
      1.6 * height);
}

Sculpture carve_gargoyle(double spacing) {
  Sculpture s(spacing);
  add_plinth(s);
  add_torso(s);
  add_limbs(s);
  add_tail(s);
  add_wings(s);
  add_head(s);
  weather(s);
  return s;
}

}  // namespace

Result<DraftMesh> make_gargoyle(Index faces, const Progress& progress) {
  return sculpt({carve_gargoyle, {-1.7, -0.45, -1.3}, {1.7, 2.6, 1.3}, 22.4}, faces, progress);
}

}  // namespace geotherm::generate
