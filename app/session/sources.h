// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "app/session/model.h"
#include "geotherm/error.h"
#include "geotherm/mesh.h"
#include "geotherm/options.h"
#include "geotherm/progress.h"
#include "geotherm/sources.h"
#include "geotherm/types.h"

namespace geotherm::app {

class CurveJoiner;

// What a source is called before the mesh is known. Text forms: `17`, `3,99,512`,
// `curve:V1,V2,...`, `curve:face:ID:b0:b1:b2,...`, `random:K[:SEED]`, `boundary`,
// `face:ID:b0:b1:b2`, `xyz:x:y:z`, `sample:i:j[:k]`; those of points may end in `@OFFSET`, the
// distance there, model units: `17@0.5`.

struct VertexList {
  std::vector<Index> vertices;
  double offset = 0;
  bool operator==(const VertexList&) const = default;
};

/// A polyline of vertices, all of which is a source; a step that is no mesh edge is the shortest
/// path along edges. One vertex is a point.
struct VertexCurve {
  std::vector<Index> vertices;
  std::vector<int> lines;  ///< of the file, one for each vertex; empty when no file gave them
  bool operator==(const VertexCurve&) const = default;
};

struct FacePoint {
  Index face = 0;
  std::array<double, 3> weights{};
  double offset = 0;
  bool operator==(const FacePoint&) const = default;
};

/// A polyline of points in faces, all of which is a source; two that follow each other are joined
/// straight across the faces between them (CurveJoiner). One point is that.
struct SurfaceCurve {
  std::vector<FacePoint> points;  ///< without offsets
  bool operator==(const SurfaceCurve&) const = default;
};

struct RandomVertices {
  Index count = 1;
  std::uint64_t seed = 1;
  double offset = 0;
  bool operator==(const RandomVertices&) const = default;
};

struct WholeBoundary {
  bool operator==(const WholeBoundary&) const = default;
};

struct SpacePoint {
  Vec3 position = Vec3::Zero();
  double offset = 0;
  bool operator==(const SpacePoint&) const = default;
};

/// A sample of a grid by its place along x, y and z.
struct GridSample {
  std::array<Index, 3> place{};
  double offset = 0;
  bool operator==(const GridSample&) const = default;
};

using SourceSpec = std::variant<VertexList, VertexCurve, RandomVertices, WholeBoundary, FacePoint,
                                SpacePoint, GridSample, SurfaceCurve>;

/// A source as the user wrote it.
struct Source {
  SourceSpec spec;
  std::string where;                       ///< "-s 3,99", "ids.txt: line 4": begins messages
  ErrorCode blame = ErrorCode::kBadInput;  ///< kBadFile when it came from a file
};

/// Errors: kBadInput, one sentence with the text and what is expected. A vertex id must fit the
/// mesh, which is checked when the source is placed on one.
Result<SourceSpec> parse_source(std::string_view text);

/// Whether it is one point without an offset: a vertex, a point in a face or in space.
bool is_single_point(const SourceSpec& spec);

/// The offset of a source; null for one that has none, an edge.
double* offset_of(SourceSpec& spec);

/// The text that parse_source() reads back as the same value, to the last digit; a curve's `lines`
/// are not part of it. Preconditions: one vertex at least; finite numbers; weights >= 0 whose sum
/// differs from 1 by round-off alone.
std::string to_text(const SourceSpec& spec);

/// x, y, z as three numbers. Errors: kBadInput.
Result<SourceSpec> parse_space_point(const std::array<std::string_view, 3>& numbers);

/// Reads one source a line: a vertex id, `face:...`, `xyz:...` or `x y z`; blank lines and what
/// follows a # are skipped. `curve`: only ids, which form one polyline.
/// Errors: kBadFile with the number of the line.
Result<std::vector<Source>> read_source_file(const std::string& path, bool curve);

/// Puts sources together into one set: no vertex and no edge twice, and curves across faces with
/// numbers of their own. A vertex keeps its smallest offset.
class SetUnion {
 public:
  void add(const SurfacePoint& point, double offset);
  void add_edge(Index a, Index b) { edges_.insert({std::min(a, b), std::max(a, b)}); }
  void add(const SourceSet& more);
  void add(CellPoint point) { set_.cell_points.push_back(std::move(point)); }
  SourceSet take();  ///< what was added since the last call

 private:
  SourceSet set_;
  Index curves_ = 0;                       ///< numbers of curves across faces
  std::map<Index, std::size_t> vertices_;  ///< to their place among the points
  std::set<std::array<Index, 2>> edges_;
};

/// Where sources are placed: on a surface, or in a space, of which `mesh` is what is drawn.
struct SourceSpace {
  const TriangleMesh& mesh;
  const Space* space = nullptr;
  CurveJoiner* joiner = nullptr;  ///< of `mesh`; null: each call has its own

  SourceSpace(const TriangleMesh& surface) : mesh(surface) {}     // NOLINT
  SourceSpace(const Model& model, CurveJoiner* curves = nullptr)  // NOLINT
      : mesh(*model.mesh), space(model.space.get()), joiner(curves) {}
};

struct ResolvedSources {
  SourceSet set;  ///< no vertex and no edge twice
  std::vector<Warning> warnings;
};

/// Places sources, all in one set. In a space the boundary are vertices, and a point in a face or
/// at a place is the nearest point of the space. Errors: the blame of the source,
/// its `where`, and what does not fit (a vertex or face out of range, a vertex in no face or
/// cell, no boundary, a curve in a space that is no surface); kCancelled.
Result<ResolvedSources> resolve_sources(std::span<const Source> sources, const SourceSpace& space,
                                        const Progress& progress = {});

struct EachSource {
  std::vector<SourceSet> sets;
  std::vector<Warning> warnings;
};

/// Places sources on a mesh, every point of them in a set of its own, in their order: each vertex
/// of a list, each random vertex, each point in a face or in space; what is named twice stands
/// twice. A curve and the boundary are one set each. Errors: those of resolve_sources().
Result<EachSource> resolve_each(std::span<const Source> sources, const SourceSpace& space,
                                const Progress& progress = {});

/// `count` different numbers below `pool`; the same on every platform for a seed. Precondition:
/// there are as many. Cost: O(count).
std::vector<std::int64_t> draw_numbers(std::int64_t pool, Index count, std::uint64_t seed);

/// `count` different vertices that belong to a face; the same on every platform for a seed.
/// Errors: kBadInput (fewer such vertices).
Result<std::vector<Index>> random_vertices(const SourceSpace& space, Index count,
                                           std::uint64_t seed);

/// Whether the pinned vertex, where one is named, is on the mesh. Errors: kBadInput.
Result<void> check_pin(const Constraint& constraint, const SourceSpace& space);

/// The point of a triangle mesh that is all of a set, whatever its offset; null where it is not
/// one.
const SurfacePoint* only_point(const SourceSet& set);

/// All vertices of a set, ends of edges included, ascending, each once.
std::vector<Index> vertices_of(const SourceSet& set);

}  // namespace geotherm::app
