// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "engine/target.h"

namespace geotherm::test {

/// Compares a picture with the one that is kept under this name (tests/engine/golden/NAME.png). At
/// most `share` of its pixels may differ by more than 2/255. Where more do the picture is written
/// to the build tree, and the test fails with its path. GEOTHERM_UPDATE_GOLDEN=1 keeps it instead.
void expect_golden(const engine::Image& image, const std::string& name, double share);

}  // namespace geotherm::test
