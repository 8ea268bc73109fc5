// SPDX-License-Identifier: MIT
#include "solver/heat/surface.h"

#include <algorithm>

#include "solver/accuracy/distance_bounds.h"
#include "solver/core/parallel.h"
#include "solver/core/stopwatch.h"
#include "solver/core/text.h"
#include "solver/geometry/fem_operator.h"
#include "solver/geometry/operator_mesh.h"
#include "solver/heat/moved_surface.h"
#include "solver/heat/unit_field.h"

namespace geotherm {
namespace {

/// Share of the work at which the analysis begins, and ends.
constexpr double kAnalyzeFrom = 0.4, kAnalyzeTo = 0.8;

FlipRule flip_rule(LaplacianKind laplacian) {
  switch (laplacian) {
    case LaplacianKind::kIntrinsicDelaunay:
    case LaplacianKind::kTufted:
    case LaplacianKind::kRefined:
      return FlipRule::kAlways;
    case LaplacianKind::kAuto:
      return FlipRule::kWhereNeeded;
    default:
      return FlipRule::kNever;
  }
}

CoverRule cover_rule(LaplacianKind laplacian) {
  switch (laplacian) {
    case LaplacianKind::kTufted:
      return CoverRule::kAlways;
    case LaplacianKind::kAuto:
    case LaplacianKind::kRefined:
      return CoverRule::kWhereNeeded;
    default:
      return CoverRule::kNever;
  }
}

RefineRule refine_rule(LaplacianKind laplacian) {
  const bool may = laplacian == LaplacianKind::kAuto || laplacian == LaplacianKind::kRefined;
  return may ? RefineRule::kWhereNeeded : RefineRule::kNever;
}

/// The vertices that faces use, inserted ones last, as the pattern numbers them.
struct UsedVertices {
  std::vector<Index> vertices;
  std::vector<Index> local;  ///< number of a vertex in `vertices`, or kNoIndex
  std::vector<Vec3> positions;
  Components parts;

  explicit UsedVertices(const IntrinsicSurface& surface)
      : local(static_cast<std::size_t>(surface.vertex_count()), kNoIndex) {
    const auto own = static_cast<std::size_t>(surface.mesh->vertex_count());
    for (std::size_t v = 0; v < local.size(); ++v) {
      if (v < own && !surface.kept->on_surface[v]) continue;
      local[v] = static_cast<Index>(vertices.size());
      vertices.push_back(static_cast<Index>(v));
      positions.push_back(surface.position(vertices.back()));
      parts.of.push_back(surface.parts.of[v]);
    }
    parts.count = surface.parts.count;
  }
};

/// Which rows lie on the boundary: an edge of the mesh with one face, or such an edge where it was
/// split.
std::vector<char> find_boundary(const Surface& surface) {
  std::vector<char> on_boundary(surface.vertex_of_row.size(), 0);
  const EdgeTable& edges = surface.kept->edges;
  for (Index e = 0; e < edges.edge_count(); ++e) {
    if (edges.sides(e).size() != 1) continue;
    on_boundary[surface.row_of_vertex[edges.low(e)]] = 1;
    on_boundary[surface.row_of_vertex[edges.high(e)]] = 1;
  }
  const Index own = surface.mesh->vertex_count();
  for (Index p = 0; p < surface.refinement.points; ++p) {
    if (surface.refinement.on_boundary[p]) on_boundary[surface.row_of_vertex[own + p]] = 1;
  }
  return on_boundary;
}

/// Sizes of the components; of the only one the mean edge is exactly 1.
std::vector<ComponentSize> measure_components(const Surface& surface) {
  const OperatorMesh& mesh = *surface.operators;
  std::vector<ComponentSize> sizes(static_cast<std::size_t>(mesh.components.count));
  std::vector<Index> vertices(sizes.size(), 0);
  for (Index i = 0; i < mesh.size(); ++i) {
    ComponentSize& size = sizes[mesh.components.of[i]];
    const Index part = surface.parts.of[surface.vertex_of_row[i]];
    ++vertices[mesh.components.of[i]];
    if (surface.vertex_of_row[i] >= surface.mesh->vertex_count()) ++size.inserted;
    size.mean_edge = surface.part_edge[part];
    if (!surface.refinement.grading.empty()) size.grading = surface.refinement.grading[part];
  }
  for (const Face& face : surface.kept->faces) {
    ++sizes[mesh.components.of[surface.row_of_vertex[face[0]]]].cells;
  }
  for (std::size_t c = 0; c < sizes.size(); ++c) {
    sizes[c].area = mesh.area[c];
    sizes[c].inserted /= vertices[c];
  }
  return sizes;
}

class MeshInput final : public Domain::Input {
 public:
  MeshInput(std::shared_ptr<const TriangleMesh> mesh, std::shared_ptr<const Surface> earlier,
            TriangulationReady ready)
      : mesh_(std::move(mesh)), earlier_(std::move(earlier)), ready_(std::move(ready)) {}

  Index cell_count() const override { return mesh_->face_count(); }
  std::array<const char*, 2> cell_names() const override { return {"face", "faces"}; }
  Result<std::shared_ptr<const Domain>> make(const Backend& backend, LaplacianKind laplacian,
                                             int threads, const Progress& progress) const override {
    auto made = build_surface(mesh_, backend, laplacian, threads, progress, earlier_.get(), ready_);
    if (!made) return made.error();
    return std::shared_ptr<const Domain>(*std::move(made));
  }

 private:
  std::shared_ptr<const TriangleMesh> mesh_;
  std::shared_ptr<const Surface> earlier_;
  TriangulationReady ready_;
};

LaplacianKind kind_of(const IntrinsicSurface& surface) {
  if (surface.refinement.points > 0) return LaplacianKind::kRefined;
  if (surface.tufted) return LaplacianKind::kTufted;
  return surface.delaunay ? LaplacianKind::kIntrinsicDelaunay : LaplacianKind::kCotan;
}

/// Order, analysis and operators from the pattern alone.
Result<void> order_afresh(int threads, const Progress& progress, Stopwatch& watch, Surface& out) {
  const UsedVertices used(out);
  if (out.corners.vertex_count() == 0) {
    out.corners = CornerTable(out.vertex_count(), out.intrinsic.faces, threads);
  }
  const SymmetricPattern pattern =
      surface_pattern(out.intrinsic, out.corners, used.vertices, used.local, threads);
  out.timing.stages.pattern = watch.lap();
  out.timing.operators += out.timing.stages.pattern;
  if (!report(progress, "analyze", kAnalyzeFrom)) return cancelled_error();
  auto analysis = out.backend->analyze(pattern, used.positions, threads);
  if (!analysis) return analysis.error();
  out.kept_order = nullptr;
  out.analysis = std::move(*analysis);
  out.timing.analyze += watch.lap();

  if (!report(progress, "operators", kAnalyzeTo)) return cancelled_error();
  const std::span<const Index> order = out.analysis->order();
  out.operators =
      build_operator_mesh(out.intrinsic, pattern, used.local, order, used.parts, threads);
  std::vector<Index> vertices;
  for (const Index k : order) vertices.push_back(used.vertices[k]);
  out.number_rows(std::move(vertices), out.vertex_count());
  return {};
}

}  // namespace

Result<std::shared_ptr<const Surface>> build_surface(std::shared_ptr<const TriangleMesh> mesh,
                                                     const Backend& backend,
                                                     LaplacianKind laplacian, int threads,
                                                     const Progress& progress,
                                                     const Surface* earlier,
                                                     const TriangulationReady& ready) {
  Stopwatch watch;
  const bool little = earlier != nullptr && moved_little(*earlier, *mesh);
  auto built = build_intrinsic_surface(std::move(mesh),
                                       {.flip = flip_rule(laplacian),
                                        .cover = cover_rule(laplacian),
                                        .refine = refine_rule(laplacian),
                                        .parts = true,
                                        .same_unit = little},
                                       part_of(progress, 0.0, kAnalyzeFrom), threads, earlier);
  if (!built) return built.error();
  auto out = std::make_shared<Surface>();
  static_cast<IntrinsicSurface&>(*out) = std::move(*built);
  out->laplacian = kind_of(*out);
  out->asked = laplacian;
  out->is_delaunay =
      flip_rule(laplacian) != FlipRule::kNever || count_non_delaunay(out->intrinsic, threads) == 0;
  out->backend = &backend;
  out->unit = out->intrinsic.unit;
  out->input_vertices = out->mesh->vertex_count();
  out->findings = std::move(out->warnings);
  out->input = surface_input(out->mesh);
  if (ready && out->serves_waves()) ready(out);  // what follows leaves the triangulation as it is

  if (earlier != nullptr) {
    out->factor_memory =
        earlier->factor_memory ? earlier->factor_memory : std::make_shared<BufferPool>();
    if (!report(progress, "analyze", kAnalyzeFrom)) return cancelled_error();
  }

  SetupTiming& timing = out->timing;
  timing.stages = {out->times.clean, out->times.intrinsic, out->times.flips, 0, 0};
  timing.operators = watch.lap();
  const bool kept = earlier != nullptr && keep_order(*earlier, little && out->unit == earlier->unit,
                                                     threads, watch, *out);
  if (!kept) {
    if (auto made = order_afresh(threads, progress, watch, *out); !made) return made.error();
  }
  out->corners = {};
  out->on_boundary = find_boundary(*out);
  out->component_sizes = measure_components(*out);
  if (std::ranges::none_of(out->component_sizes, [](const auto& size) { return size.area > 0; })) {
    return Error{ErrorCode::kBadInput, "the mesh has no area; all its faces are degenerate"};
  }
  timing.stages.renumber = watch.lap();
  timing.operators += timing.stages.renumber;
  return std::shared_ptr<const Surface>(std::move(out));
}

std::shared_ptr<const Domain::Input> surface_input(std::shared_ptr<const TriangleMesh> mesh,
                                                   std::shared_ptr<const Surface> earlier,
                                                   TriangulationReady ready) {
  return std::make_shared<const MeshInput>(std::move(mesh), std::move(earlier), std::move(ready));
}

std::shared_ptr<const DomainOperator> Surface::combine(double mass_factor,
                                                       const PerComponent& stiffness_factor,
                                                       std::vector<Index> held,
                                                       const PerComponent& consistent_share,
                                                       int threads) const {
  return std::make_shared<const FemOperator>(operators, mass_factor, stiffness_factor,
                                             std::move(held), consistent_share, threads);
}

void Surface::apply_stiffness(std::span<const double> x, std::span<double> y, int threads) const {
  const OperatorMesh& m = *operators;
  std::ranges::fill(y, 0.0);
  const auto add_faces = [&](Index first, Index end) {
    for (Index f = first; f < end; ++f) {
      const Face& face = m.faces[f];
      const auto g = gradient(m.layout[f], x[face[0]], x[face[1]], x[face[2]]);
      const auto d = divergence(m.layout[f], g[0], g[1]);
      for (int k = 0; k < 3; ++k) y[face[k]] += d[k];
    }
  };
  for_ranges(m.ranges, threads, 1,
             [&](const RowRange& range) { add_faces(range.first_cell, range.end_cell); });
  add_faces(m.crossing, m.face_count());
}

Result<SourceAnchors> Surface::place(const SourceSet& sources) const {
  return place_sources(*this, sources);
}

std::unique_ptr<const UnitField> Surface::unit_field(const HeatField& heat, const PerComponent& t,
                                                     const Workspace& work) const {
  return std::make_unique<const FaceField>(*this, heat, t, work);
}

Result<std::vector<NearVertex>> Surface::near_field(const SourceAnchors& anchors) const {
  return find_near_field(*this, anchors);
}

void Surface::apply_straight_line_bound(const SourceSet& sources, BelowLine below, int threads,
                                        DistanceResult& result) const {
  geotherm::apply_straight_line_bound(*this, sources, 1, bound_tolerance(MethodKind::kHeat), below,
                                      threads, result);
}

}  // namespace geotherm
