// SPDX-License-Identifier: MIT
#include "bench/contender.h"

namespace geotherm::bench {

std::unique_ptr<Contender> make_baseline_contender() { return nullptr; }

}  // namespace geotherm::bench
