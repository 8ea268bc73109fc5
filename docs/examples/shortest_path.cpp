// SPDX-License-Identifier: MIT
// The shortest path between two vertices.
#include <geotherm/geotherm.h>

#include "fail.h"

using namespace geotherm;

int main() {
  auto file = read_mesh("bunny.ply");
  if (!file) return fail(file.error());
  auto mesh = std::make_shared<const TriangleMesh>(std::move(file->mesh));
  auto waves = build_method(mesh, {.method = MethodKind::kWavefront});
  if (!waves) return fail(waves.error());
  std::vector<SurfacePoint> ends = {SurfacePoint::at_vertex(0), SurfacePoint::at_vertex(1500)};
  auto found = PathFinder(mesh, *waves).find(ends);
  if (!found) return fail(found.error());
  std::printf("%zu points, length %.4f\n", found->path.points.size(), found->path.length);
}
