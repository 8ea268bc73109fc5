// SPDX-License-Identifier: MIT
#include "bench/render_bench.h"

namespace geotherm::bench {

RenderBench measure_render(const Say&) {
  return {.device = "", .peak_mb = 0, .rows = {}, .failure = "this build has no renderer"};
}

}  // namespace geotherm::bench
