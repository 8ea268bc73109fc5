// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "solver/core/result.h"

namespace geotherm {

/// How distance is computed.
enum class MethodKind {
  kHeat,           ///< the heat method (Crane, Weischedel, Wardetzky 2013)
  kWavefront,      ///< waves over edges with a sample at each midpoint: near exact
  kWavefrontFine,  ///< the same with samples at the quarters, too
  kFastMarching,   ///< first-order fast marching (Kimmel, Sethian 1998)
  kExact,          ///< exact polyhedral distance by window propagation
};

/// heat | wavefront | wavefront-fine | fast-marching | exact
std::string to_text(MethodKind kind);

/// Inverse of to_text(). Errors: kNotAvailable, with the names there are.
Result<MethodKind> parse_method(std::string_view text);

/// The names of all methods, the default first.
std::vector<std::string> method_names();

}  // namespace geotherm
