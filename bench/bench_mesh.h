// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "geotherm/error.h"
#include "geotherm/mesh.h"

namespace geotherm::bench {

/// A surface to measure on, by name. `grid`: a torus with bumps whose squares are all cut the same
/// way. `torus`: the same with its vertices moved about and its squares cut along either diagonal,
/// as after a scan or remeshing. `sphere`: a subdivided icosahedron. Else a bundled model. Vertices
/// are numbered as the generator makes them. Errors: generate_model()'s.
Result<TriangleMesh> make_mesh(std::string_view name, Index faces);

/// `count` vertices spread at random, the same on every run.
std::vector<Index> pick_sources(Index vertex_count, std::size_t count);

}  // namespace geotherm::bench
