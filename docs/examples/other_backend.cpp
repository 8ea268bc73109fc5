// SPDX-License-Identifier: MIT
// The same with each backend of this build.
#include <geotherm/geotherm.h>

#include "fail.h"

using namespace geotherm;

int main() {
  auto file = read_mesh("bunny.ply");
  if (!file) return fail(file.error());
  auto mesh = std::make_shared<const TriangleMesh>(std::move(file->mesh));
  for (const std::string& name : backend_names()) {
    auto method = HeatMethod::build(mesh, {.backend = name, .precision = Precision::kFull});
    if (!method) return fail(method.error());
    std::printf("%s: %.1f MB\n", name.c_str(), method->memory_mb());
  }
}
