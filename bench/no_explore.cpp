// SPDX-License-Identifier: MIT
#include "bench/explore_bench.h"

namespace geotherm::bench {

ExploreBench measure_explore(const Say&) { return {{}, "this build has no viewer"}; }

}  // namespace geotherm::bench
