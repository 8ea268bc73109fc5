// SPDX-License-Identifier: MIT
// One method for many sources: the factors are made once.
#include <geotherm/geotherm.h>

#include "fail.h"

using namespace geotherm;

int main() {
  auto file = read_mesh("bunny.ply");
  if (!file) return fail(file.error());
  auto method = HeatMethod::build(std::make_shared<const TriangleMesh>(std::move(file->mesh)));
  if (!method) return fail(method.error());
  std::vector<SourceSet> sets;
  for (Index v = 0; v < 100; ++v) sets.push_back(SourceSet::of_vertices({v}));
  auto results = method->solve_each(sets);  // in blocks, on all cores
  if (!results) return fail(results.error());
  std::printf("%.3f ms a source\n", (*results)[0].timing.query);
}
