// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string>
#include <vector>

#include "app/session/sources.h"
#include "geotherm/mesh.h"
#include "geotherm/options.h"
#include "geotherm/sources.h"

namespace geotherm::app {

struct ResolvedSources {
  SourceSet set;  ///< no vertex and no edge twice
  std::vector<std::string> warnings;
};

/// Places sources on a mesh, all in one set. Errors: the blame of the source, its `where`, and what
/// does not fit (a vertex or face out of range, a vertex in no face, no boundary).
Result<ResolvedSources> resolve_sources(std::span<const Source> sources, const TriangleMesh& mesh);

struct EachSource {
  std::vector<SourceSet> sets;
  std::vector<std::string> warnings;
};

/// Places sources on a mesh, every point of them in a set of its own, in their order: each vertex
/// of a list, each random vertex, each point in a face or in space; what is named twice stands
/// twice. A curve and the boundary are one set each. Errors: those of resolve_sources().
Result<EachSource> resolve_each(std::span<const Source> sources, const TriangleMesh& mesh);

/// `count` different vertices that belong to a face; the same on every platform for a seed.
/// Errors: kBadInput (fewer such vertices).
Result<std::vector<Index>> random_vertices(const TriangleMesh& mesh, Index count,
                                           std::uint64_t seed);

/// Whether the pinned vertex, where one is named, is on the mesh. Errors: kBadInput.
Result<void> check_pin(const Constraint& constraint, const TriangleMesh& mesh);

/// All vertices of a set, ends of edges included, ascending, each once.
std::vector<Index> vertices_of(const SourceSet& set);

}  // namespace geotherm::app
