// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <string>

#include "bench/measure.h"

namespace geotherm::bench {

/// How fast a backend factorises and reads its factors, apart from everything around it: the
/// numeric factorisations of A + t L and of L with one row held, side by side as HeatMethod makes
/// them, and solves of the second with a dense right side. Best of as many attempts as fit into
/// `milliseconds`, one at least. Assembly of the matrices is not counted. Empty figures for a
/// backend that is iterative or does not count its operations. Cost: one analysis more.
/// Errors: the backend's.
Result<Rates> measure_rates(std::shared_ptr<const TriangleMesh> mesh, const std::string& backend,
                            int threads, double milliseconds);

}  // namespace geotherm::bench
