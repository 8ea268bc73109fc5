// SPDX-License-Identifier: MIT
#pragma once

#include "geotherm/types.h"

namespace geotherm {

/// Whether two corners of the face are one vertex, so that it has no inside.
inline bool repeats_corner(const Face& f) { return f[0] == f[1] || f[1] == f[2] || f[2] == f[0]; }

}  // namespace geotherm
