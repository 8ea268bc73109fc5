// SPDX-License-Identifier: MIT
#pragma once

#include "geotherm/backend.h"
#include "geotherm/options.h"

namespace geotherm {

/// How the factor of the heat step is kept: the heat falls by hundreds of decades.
inline FactorStorage heat_storage(Precision precision) {
  return precision == Precision::kFull ? FactorStorage::kFull : FactorStorage::kWideExponent;
}

/// How that of the Poisson step is kept: distances are within a few decades of each other.
inline FactorStorage poisson_storage(Precision precision) {
  return precision == Precision::kFull ? FactorStorage::kFull : FactorStorage::kSingle;
}

inline bool same_factors(Precision a, Precision b) {
  return heat_storage(a) == heat_storage(b) && poisson_storage(a) == poisson_storage(b);
}

}  // namespace geotherm
