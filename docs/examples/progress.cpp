// SPDX-License-Identifier: MIT
// Long work reports and is cancelled: here after a fifth of a second.
#include <geotherm/geotherm.h>

#include <chrono>

#include "require.h"

using namespace geotherm;
using Clock = std::chrono::steady_clock;

int main() {
  auto mesh = std::make_shared<const TriangleMesh>(require(read_mesh("gargoyle.ply")).mesh);
  auto end = Clock::now() + std::chrono::milliseconds(200);
  auto method = build_method(mesh, {}, [&](std::string_view stage, double share) {
    std::printf("%s %.0f %%\n", std::string(stage).c_str(), 100 * share);
    return Clock::now() < end;  // false: stop
  });
  if (!method && method.error().code == ErrorCode::kCancelled) std::puts("cancelled");
}
