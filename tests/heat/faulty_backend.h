// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <string>

#include "geotherm/backend.h"

namespace geotherm::test {

/// Where a backend fails.
/// kNoise: its solves are off by 1e-7 of their largest number, more than what heat leaves far away.
enum class Fault { kAnalysis, kFactor, kSolve, kNoise, kNone };

/// "faulty": the last direct backend of the build, but for one step, which ends with this error.
std::unique_ptr<const Backend> faulty_backend(Fault fault, Error error);

}  // namespace geotherm::test
