// SPDX-License-Identifier: MIT
// The heat method beside wavefronts, and how far it is from them.
#include <geotherm/geotherm.h>

#include "fail.h"

using namespace geotherm;

int main() {
  auto file = read_mesh("bunny.ply");
  if (!file) return fail(file.error());
  auto mesh = std::make_shared<const TriangleMesh>(std::move(file->mesh));
  auto heat = build_method(mesh), waves = build_method(mesh, {.method = MethodKind::kWavefront});
  if (!heat || !waves) return fail(!heat ? heat.error() : waves.error());
  auto fast = (*heat)->solve(SourceSet::of_vertices({17}));
  auto good = (*waves)->solve(SourceSet::of_vertices({17}));
  if (!fast || !good) return fail(!fast ? fast.error() : good.error());
  DistanceError error = distance_error(fast->distances, good->distances);
  std::printf("%s: %.2g on average\n", to_text(grade_of(error)).c_str(), error.mean_relative);
}
