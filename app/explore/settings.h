// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "app/explore/viewer_state.h"
#include "solver/core/result.h"

namespace geotherm::app {

/// An option of the method or the picture, under the name of its command-line option. Texts are
/// those of the command line; flags are `on` and `off`.
struct Setting {
  std::string_view name;
  std::string_view help;   ///< one line
  bool of_method = false;  ///< changes the answer, not only the picture
  std::string (*get)(const ViewerState& state);
  /// Errors: kBadInput or kNotAvailable, with the text and what is expected.
  Result<void> (*set)(ViewerState& state, const std::string& text);
  /// The values there are; empty where there are too many to list.
  std::vector<std::string> (*values)();
};

std::span<const Setting> settings();
/// Null when there is no such name.
const Setting* find_setting(std::string_view name);

}  // namespace geotherm::app
