// SPDX-License-Identifier: MIT
#pragma once

#include <regex>
#include <span>
#include <string>
#include <vector>

#include "geotherm/types.h"

namespace geotherm::bench {

/// A mesh that contenders are measured on.
struct Case {
  const char* mesh;  ///< as make_mesh() knows it
  Index faces;       ///< about
  bool regular;      ///< nearly every vertex has six neighbours, in rows
  bool quick;        ///< part of the quick run
};

struct SolvePlan {
  bool quick = false;
  int threads = 0;                    ///< 0: all cores
  std::vector<std::string> backends;  ///< that this build has, and other methods
  std::regex only = {};               ///< rows "MESH-THOUSANDSk/BACKEND" in which it is found
  bool chosen = false;                ///< `only` was given: it alone says which meshes
};

/// All there are, by ascending size: each can be estimated from those before.
std::span<const Case> all_cases();

/// "torus-1100k".
std::string case_name(const Case& c);

/// The plan's backends for this case; empty when it is not part of the plan.
std::vector<std::string> backends_for(const Case& c, const SolvePlan& plan);

}  // namespace geotherm::bench
