// SPDX-License-Identifier: MIT
// What stands in for the parts of the benchmark that this build lacks (CMakeLists.txt says which).
#include "bench/benches.h"
#include "bench/measure.h"

namespace geotherm::bench {

#ifndef GEOTHERM_BENCH_BASELINE
std::unique_ptr<Contender> make_baseline_contender() { return nullptr; }
#endif

#ifndef GEOTHERM_BENCH_RENDER
RenderBench measure_render(const Say&) {
  return {.device = "", .peak_mb = 0, .rows = {}, .failure = "this build has no renderer"};
}
#endif

#ifndef GEOTHERM_BENCH_VIEWER
ExploreBench measure_explore(const Say&) { return {{}, "this build has no viewer"}; }
#endif

}  // namespace geotherm::bench
