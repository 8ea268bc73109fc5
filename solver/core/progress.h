// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <string_view>

namespace geotherm {

/// Called now and then during long work with the stage's name and the share done (0 to 1, or
/// negative when unknown). Returning false asks the work to stop with ErrorCode::kCancelled.
/// An empty function means: nobody watches.
using Progress = std::function<bool(std::string_view stage, double share)>;

inline bool report(const Progress& progress, std::string_view stage, double share) {
  return !progress || progress(stage, share);
}

}  // namespace geotherm
