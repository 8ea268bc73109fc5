// SPDX-License-Identifier: MIT
// Distances from a vertex of a model, written beside it.
#include <geotherm/geotherm.h>  // find_package(geotherm CONFIG), link geotherm::solver

#include "fail.h"

using namespace geotherm;

int main() {
  auto file = read_mesh("bunny.ply");
  if (!file) return fail(file.error());
  auto mesh = std::make_shared<const TriangleMesh>(std::move(file->mesh));
  auto method = build_method(mesh);  // everything that does not depend on the sources
  if (!method) return fail(method.error());
  auto result = (*method)->solve(SourceSet::of_vertices({17}));
  if (!result) return fail(result.error());
  auto written = write_distances("-", *mesh, result->distances);
  return written ? 0 : fail(written.error());
}
