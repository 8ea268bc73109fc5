// SPDX-License-Identifier: MIT
// The same with each backend of this build.
#include <geotherm/geotherm.h>

#include "require.h"

using namespace geotherm;

int main() {
  auto mesh = std::make_shared<const TriangleMesh>(require(read_mesh("bunny.ply")).mesh);
  for (const std::string& name : backend_names()) {
    HeatOptions options;
    options.backend = name;
    auto method = require(HeatMethod::build(mesh, options));
    std::printf("%s: %.1f MB\n", name.c_str(), method.memory_mb());
  }
}
