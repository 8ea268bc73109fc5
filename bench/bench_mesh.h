// SPDX-License-Identifier: MIT
#pragma once

#include <regex>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "geotherm/error.h"
#include "geotherm/mesh.h"
#include "geotherm/types.h"

namespace geotherm::bench {

/// A surface to measure on, by name. `grid`: a torus with bumps whose squares are all cut the same
/// way. `torus`: the same with its vertices moved about and its squares cut along either diagonal,
/// as after a scan or remeshing. `sphere`: a subdivided icosahedron. Else a bundled model. Vertices
/// are numbered as the generator makes them. Errors: generate_model()'s.
Result<TriangleMesh> make_mesh(std::string_view name, Index faces);

/// `count` vertices spread at random, the same on every run.
std::vector<Index> pick_sources(Index vertex_count, std::size_t count);

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
