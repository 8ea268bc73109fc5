// SPDX-License-Identifier: MIT
#include "solver/method/mapped_method.h"

#include <new>
#include <utility>

#include "geotherm/mesh.h"
#include "solver/core/stopwatch.h"
#include "solver/geometry/clean_faces.h"
#include "solver/method/reach.h"

namespace geotherm {
namespace {

/// Numbers out of range stay, for whoever checks them.
Index standing_for(const TriangleMesh& mesh, Index v) {
  return v >= 0 && v < mesh.vertex_count() ? mesh.standing_for(v) : v;
}

SourceSet with_standing(const TriangleMesh& mesh, SourceSet sources) {
  if (mesh.same_as().empty()) return sources;
  for (SurfacePoint& point : sources.points) {
    if (point.is_vertex()) point.vertex = standing_for(mesh, point.vertex);
  }
  for (auto& edge : sources.edges) {
    for (Index& end : edge) end = standing_for(mesh, end);
  }
  return sources;
}

template <class Value>
void keep_own_vertices(const TriangleMesh& mesh, std::vector<Value>& values) {
  if (values.empty()) return;
  values.resize(static_cast<std::size_t>(mesh.vertex_count()));
  const auto same_as = mesh.same_as();
  for (std::size_t v = 0; v < same_as.size(); ++v) {
    values[v] = values[static_cast<std::size_t>(same_as[v])];
  }
}

}  // namespace

Result<MeshMapping> MeshMapping::build(std::shared_ptr<const TriangleMesh> mesh, int refine) {
  const Stopwatch watch;
  MeshMapping out;
  out.mesh_ = out.inner_ = std::move(mesh);
  if (refine == 0) return out;
  // Faces that are left out anyway are left out at once: they would be counted in small parts.
  CleanFaces clean = clean_faces(*out.mesh_);
  if (clean.faces.empty()) return out;  // no method can be built, and each says why
  const auto positions = out.mesh_->positions();
  const auto usable = TriangleMesh::build({positions.begin(), positions.end()}, clean.faces);
  if (!usable) return usable.error();
  auto refined = subdivide(*usable, refine);
  if (!refined) return refined.error();
  out.inner_ = std::make_shared<const TriangleMesh>(*std::move(refined));
  out.refine_ = refine;
  out.warnings_ = cleaning_notes(clean);
  out.surface_.mesh = out.mesh_;
  out.surface_.mean_edge = mean_edge_length(positions, clean.edges);
  out.surface_.kept = keep_faces(clean, *out.mesh_, false);
  out.milliseconds_ = watch.milliseconds();
  return out;
}

Result<SourceSet> MeshMapping::inner_sources(const SourceSet& sources) const {
  SourceSet set = with_standing(*mesh_, sources);
  if (refine_ == 0) return set;
  if (auto valid = check_sources(surface_, set); !valid) return valid.error();
  for (SurfacePoint& point : set.points) {
    point = subdivided_point(clean_point(surface_, point), refine_);
  }
  std::vector<std::array<Index, 2>> edges;
  for (const auto& edge : set.edges) add_edge(edge, edges);
  set.edges = std::move(edges);
  std::vector<FaceSegment> segments;
  for (const FaceSegment& segment : set.segments) {
    const auto pieces = subdivided_segment(clean_segment(surface_, segment), refine_);
    segments.insert(segments.end(), pieces.begin(), pieces.end());
  }
  set.segments = std::move(segments);
  return set;
}

void MeshMapping::add_edge(const std::array<Index, 2>& edge,
                           std::vector<std::array<Index, 2>>& edges) const {
  if (edge[0] == edge[1]) {
    edges.push_back(edge);
    return;
  }
  const Index number = find_clean_edge(surface_, edge[0], edge[1]);
  const Side side = surface_.kept->edges.sides(number).front();
  const auto line = subdivided_side(inner_->faces(), face_of(side), corner_of(side), refine_);
  for (std::size_t i = 1; i < line.size(); ++i) edges.push_back({line[i - 1], line[i]});
}

/// The first group of the sources in each of their groups on the inner mesh. More of them touch
/// there: vertices are one, and points very near a vertex are that. Cutting edges changes none.
std::vector<Index> MeshMapping::outer_groups(const SourceSet& sources) const {
  SourceSet set = with_standing(*mesh_, sources);
  if (refine_ > 0) {
    for (SurfacePoint& point : set.points) point = clean_point(surface_, point);
  }
  const SourceGroups outer = source_groups(sources), inner = source_groups(set);
  std::vector<Index> first(static_cast<std::size_t>(inner.count), kNoIndex);
  const auto note = [&first](const std::vector<Index>& in, const std::vector<Index>& out) {
    for (std::size_t i = 0; i < in.size(); ++i) {
      if (first[in[i]] == kNoIndex) first[in[i]] = out[i];
    }
  };
  note(inner.of_point, outer.of_point);
  note(inner.of_edge, outer.of_edge);
  note(inner.of_segment, outer.of_segment);
  return first;
}

void MeshMapping::take_back(const SourceSet& sources, DistanceResult& result) const {
  if (!result.nearest_source.empty()) {
    const std::vector<Index> outer = outer_groups(sources);
    for (Index& group : result.nearest_source) {
      if (group != kNoIndex) group = outer[group];
    }
  }
  if (result.vertices.empty()) {  // else they are of targets
    keep_own_vertices(*mesh_, result.distances);
    keep_own_vertices(*mesh_, result.nearest_source);
  }
  keep_own_vertices(*mesh_, result.heat);
  keep_own_vertices(*mesh_, result.log_heat);
}

MappedMethod::MappedMethod(std::shared_ptr<const MeshMapping> mapping,
                           std::shared_ptr<const DistanceMethod> inner)
    : mapping_(std::move(mapping)),
      inner_(std::move(inner)),
      timing_(inner_->timing()),
      warnings_(mapping_->warnings()) {
  warnings_.insert(warnings_.end(), inner_->warnings().begin(), inner_->warnings().end());
  // A method that took its operators over took the mesh over as well.
  if (timing_.operators > 0) {
    timing_.operators += mapping_->milliseconds();
    timing_.setup += mapping_->milliseconds();
  }
}

Result<std::vector<DistanceResult>> MappedMethod::solve_each(std::span<const SourceSet> sets,
                                                             const QueryOptions& query,
                                                             const Progress& progress) const try {
  std::vector<SourceSet> mapped;
  for (const SourceSet& set : sets) {
    auto sources = mapping_->inner_sources(set);
    if (!sources) return sources.error();
    mapped.push_back(*std::move(sources));
  }
  const TriangleMesh& mesh = mapping_->mesh();
  if (auto valid = check_reach(query.reach, mesh.vertex_count()); !valid) return valid.error();
  QueryOptions of_inner = query;
  of_inner.reach.sparse = false;
  for (Index& target : of_inner.reach.targets) target = mesh.standing_for(target);
  auto results = inner_->solve_each(mapped, of_inner, progress);
  if (!results) return results;
  for (std::size_t i = 0; i < sets.size(); ++i) {
    DistanceResult& result = (*results)[i];
    mapping_->take_back(sets[i], result);
    if (query.reach.targets.empty()) {
      keep_reach(query.reach, result);
    } else {
      result.vertices = query.reach.targets;
    }
  }
  return results;
} catch (const std::bad_alloc&) {
  return Error{
      ErrorCode::kOutOfMemory, "the memory ended in a query", {"refine the mesh less often"}};
}

}  // namespace geotherm
