// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "geotherm/build_method.h"
#include "geotherm/heat_method.h"

namespace geotherm::app {

/// What does the work, in a word: the backend of the heat method, or the name of another method.
std::string solver_name(const MethodOptions& options);

/// The same of what has given an answer, which may be another backend than the one asked for.
std::string solver_at_work(const DistanceMethod& method, const DistanceResult& result);

/// "t = 0.0123, cholmod", or the name of another method.
std::string method_caption(const DistanceMethod& method);

/// "cotan", or what else the Laplacian of a method is that was built.
std::string laplacian_name(const HeatMethod& method);

}  // namespace geotherm::app
