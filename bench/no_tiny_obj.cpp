// SPDX-License-Identifier: MIT
#include "bench/load_bench.h"

namespace geotherm::bench {

Result<double> time_tinyobjloader(const std::string&) { return kNotMeasured; }

}  // namespace geotherm::bench
