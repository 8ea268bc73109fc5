// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "geotherm/error.h"
#include "geotherm/types.h"

namespace geotherm::app {

/// A model that comes with the program, as the file NAME.ply.
struct BundledModel {
  std::string_view name;
  Index faces;  ///< about
  std::string_view description;
  std::string_view feature;  ///< what menus say beside the name
};

/// All of them: terrain, sleeve, cube, gargoyle, bunny.
std::span<const BundledModel> bundled_models();

bool is_bundled(std::string_view name);

/// The path of a bundled model's file: in the folder that the variable GEOTHERM_MODELS of the
/// environment names; without it, in the data folder of the installed program, else in the source
/// tree that the program was built from. Errors: kBadFile, with the folders that were looked in.
Result<std::string> bundled_file(std::string_view name);

}  // namespace geotherm::app
