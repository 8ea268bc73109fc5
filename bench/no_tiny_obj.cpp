// SPDX-License-Identifier: MIT
#include "bench/load_bench.h"

namespace geotherm::bench {

Result<bool> read_with_tinyobjloader(const std::string&) { return false; }

}  // namespace geotherm::bench
