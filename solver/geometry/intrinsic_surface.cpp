// SPDX-License-Identifier: MIT
#include "solver/geometry/intrinsic_surface.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <utility>

#include "solver/core/parallel.h"
#include "solver/core/stopwatch.h"
#include "solver/core/text.h"
#include "solver/geometry/clean_faces.h"
#include "solver/geometry/tufted_cover.h"

namespace geotherm {
namespace {

/// Minimum faces per thread.
constexpr std::int64_t kMinFacesPerThread = 1 << 15;

/// Vertices are inserted up to as many as there are, and so many more on small meshes.
constexpr Index kFewInserted = 1000;

void note_mollification(const IntrinsicMesh& intrinsic, Strictness strictness,
                        std::vector<Warning>& warnings) {
  const Mollification& mollified = intrinsic.mollified;
  if (mollified.most > 0) {
    warnings.push_back(
        {counted_text(static_cast<std::size_t>(mollified.faces), "face is", "faces are") +
         " degenerate or nearly so: " +
         counted_text(static_cast<std::size_t>(mollified.edges), "edge was", "edges were") +
         " lengthened in " +
         counted_text(static_cast<std::size_t>(mollified.components), "component", "components") +
         ", by up to " + rounded_text(mollified.most) +
         " mean edge lengths; distances across such a face may be too long by up to " +
         (strictness == Strictness::kHeights ? "1e-5" : "0.3 %") + " of its longest side"});
  }
}

/// Flips what is not Delaunay, and notes it. False where nothing is flipped.
Result<bool> flip_where_needed(IntrinsicSurface& surface, int threads, const Progress& progress) {
  std::vector<Side> sides = non_delaunay_sides(surface.intrinsic, threads);
  if (sides.empty()) return false;
  surface.delaunay = true;
  auto flips = flip_to_delaunay(surface.intrinsic, std::move(sides), progress);
  if (!flips) return flips.error();
  if (surface.edits.empty()) {
    surface.edits = std::move(*flips);
  } else {
    surface.edits.insert(surface.edits.end(), flips->begin(), flips->end());
  }
  return true;
}

void note_refinement(const RefinementCounts& refinement, std::vector<Warning>& warnings) {
  if (refinement.complete) return;
  warnings.push_back(
      {counted_text(static_cast<std::size_t>(refinement.points), "vertex was", "vertices were") +
           " inserted into the triangulation, which is the most for this mesh; where faces are "
           "still large or the boundary obtuse, distances may be wrong",
       {"use ", SettingHint{"method", {"exact"}}}});
}

/// A flag per clean face, empty where none is to be doubled.
std::vector<char> faces_to_double(const CleanFaces& clean, Index vertex_count, CoverRule rule) {
  switch (rule) {
    case CoverRule::kAlways:
      return std::vector<char>(clean.faces.size(), 1);
    case CoverRule::kWhereNeeded:
      return faces_that_need_cover(clean, vertex_count);
    case CoverRule::kNever:
      break;
  }
  return {};
}

/// Whether lengths can be measured in units of the mean edge.
Result<void> check_mean_edge(const TriangleMesh& mesh, const CleanFaces& clean, double mean_edge) {
  if (!std::isfinite(mean_edge)) {
    double most = 0;
    for (const Vec3& p : mesh.positions()) most = std::max(most, p.cwiseAbs().maxCoeff());
    return Error{ErrorCode::kBadInput,
                 "the edges of the mesh are too long to be added up (coordinates go up to " +
                     rounded_text(most) + ")",
                 {"scale the model down"}};
  }
  if (clean.faces.empty() || !(mean_edge > 0)) {
    return Error{ErrorCode::kBadInput,
                 "the mesh has no face with area (" +
                     counted_text(static_cast<std::size_t>(mesh.face_count()), "face", "faces") +
                     ", " +
                     counted_text(static_cast<std::size_t>(clean.repeated_corner),
                                  "repeats a corner", "repeat a corner") +
                     ", mean edge length " + rounded_text(mean_edge) + ")",
                 {"check how it was exported"}};
  }
  return {};
}

/// A mean edge below this, in those of the whole mesh, is that of a point.
constexpr double kPointEdge = 1e-60;

/// The faces of a part that is a point were given areas by mollification, and these say how long
/// its edges are.
void measure_points(IntrinsicSurface& surface) {
  std::vector<double> area(surface.part_edge.size(), 0.0);
  std::vector<Index> faces(area.size(), 0);
  for (Index f = 0; f < surface.intrinsic.face_count(); ++f) {
    const Index part = surface.parts.of[surface.intrinsic.faces[f][0]];
    const FaceLayout p = lay_out(surface.intrinsic.lengths[f]);
    area[part] += p.base * p.height / 2;
    ++faces[part];
  }
  for (std::size_t c = 0; c < area.size(); ++c) {
    double& edge = surface.part_edge[c];
    if (!(edge > kPointEdge)) edge = std::sqrt(area[c] / faces[c]);
  }
}

/// Which connected part each vertex of the mesh belongs to, kNoIndex where in no face.
Components parts_of(const std::vector<Face>& clean, Index vertex_count) {
  const FaceComponents faces = face_components(clean, vertex_count);
  Components parts{std::vector<Index>(static_cast<std::size_t>(vertex_count), kNoIndex),
                   faces.count};
  for (std::size_t f = 0; f < clean.size(); ++f) {
    for (const Index v : clean[f]) parts.of[v] = faces.of[f];
  }
  return parts;
}

/// The mean lengths of the edges of each part; where that of the mesh is the unit, that of the only
/// part is exactly 1.
void measure_parts(IntrinsicSurface& surface) {
  const Components& parts = surface.parts;
  surface.part_edge.assign(static_cast<std::size_t>(parts.count),
                           surface.mean_edge / surface.length_unit());
  if (parts.count == 1) return;
  std::vector<double> sum(surface.part_edge.size(), 0.0);
  std::vector<Index> count(sum.size(), 0);
  const auto positions = surface.mesh->positions();
  const EdgeTable& edges = surface.kept->edges;
  for (Index e = 0; e < edges.edge_count(); ++e) {
    const Vec3 &low = positions[edges.low(e)], &high = positions[edges.high(e)];
    const Index part = parts.of[edges.low(e)];
    sum[part] += safe_norm(low - high) / surface.length_unit();
    ++count[part];
  }
  for (std::size_t c = 0; c < sum.size(); ++c) surface.part_edge[c] = sum[c] / count[c];
  if (std::ranges::min(surface.part_edge) <= kPointEdge) measure_points(surface);
}

/// What lengths are divided by.
double unit_for(double mean_edge, const SurfaceRules& rules, const IntrinsicSurface* earlier) {
  if (!rules.same_unit || earlier == nullptr) return mean_edge;
  const double before = earlier->length_unit();
  return mean_edge < 2 * before && before < 2 * mean_edge ? before : mean_edge;
}

}  // namespace

std::vector<Warning> cleaning_notes(const CleanFaces& clean) {
  std::vector<Warning> notes;
  // What a mask leaves out is no news.
  const Index repeated = clean.repeated_corner - clean.one_vertex;
  if (repeated > 0) {
    notes.push_back(
        {counted_text(static_cast<std::size_t>(repeated), "face repeats a corner and was left out",
                      "faces repeat a corner and were left out")});
  }
  if (clean.duplicate > 0) {
    notes.push_back({counted_text(static_cast<std::size_t>(clean.duplicate),
                                  "duplicate face was left out", "duplicate faces were left out")});
  }
  return notes;
}

std::shared_ptr<KeptFaces> keep_faces(CleanFaces& clean, const TriangleMesh& mesh, bool parts,
                                      int threads) {
  auto kept = std::make_shared<KeptFaces>();
  kept->of_face.assign(static_cast<std::size_t>(mesh.face_count()), kNoIndex);
  kept->on_surface.resize(static_cast<std::size_t>(mesh.vertex_count()));
  parallel_each<Index>(threads, std::ssize(clean.original), kMinFacesPerThread,
                       [&](Index c) { kept->of_face[clean.original[c]] = c; });
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    kept->on_surface[v] = clean.corners.at(v).empty() ? 0 : 1;
  }
  CornerTable corners = std::move(clean.corners);
  static_cast<CleanFaces&>(*kept) = std::exchange(clean, {});
  clean.corners = std::move(corners);
  kept->original = {};
  if (parts) kept->parts = parts_of(kept->faces, mesh.vertex_count());
  return kept;
}

Result<IntrinsicSurface> build_intrinsic_surface(std::shared_ptr<const TriangleMesh> mesh,
                                                 const SurfaceRules& rules,
                                                 const Progress& progress, int threads,
                                                 const IntrinsicSurface* earlier) {
  if (!report(progress, "operators", 0.0)) return cancelled_error();
  Stopwatch watch;
  IntrinsicSurface out;
  out.mesh = std::move(mesh);
  const bool names_parts = rules.parts || rules.refine != RefineRule::kNever;
  if (earlier != nullptr && !earlier->kept->turned_by_shape &&
      (earlier->kept->parts.count > 0 || !names_parts)) {
    out.kept = earlier->kept;
  } else {
    CleanFaces clean = clean_faces(*out.mesh, threads);
    out.kept = keep_faces(clean, *out.mesh, names_parts, threads);
    if (earlier == nullptr) out.corners = std::move(clean.corners);
  }
  const KeptFaces& clean = *out.kept;
  const auto positions = out.mesh->positions();
  out.times.clean = watch.lap();
  out.mean_edge = mean_edge_length(positions, clean.edges, threads);
  if (const auto valid = check_mean_edge(*out.mesh, clean, out.mean_edge); !valid) {
    return valid.error();
  }
  if (!report(progress, "operators", 0.5)) return cancelled_error();
  const bool flips = rules.flip != FlipRule::kNever;
  out.intrinsic = build_intrinsic_mesh(positions, clean, unit_for(out.mean_edge, rules, earlier),
                                       threads, flips ? Strictness::kHeights : rules.strictness);
  const Index vertices = out.mesh->vertex_count();
  const std::vector<char> doubled = faces_to_double(clean, vertices, rules.cover);
  out.tufted = !doubled.empty();
  if (out.tufted) make_tufted_cover(out.intrinsic, positions, clean, doubled);

  if (!report(progress, "operators", 0.75)) return cancelled_error();
  out.times.intrinsic = watch.lap();
  out.delaunay = rules.flip == FlipRule::kAlways;
  // Flips remove flat triangles but for some along the boundary; what is lengthened then may have
  // to be flipped again.
  constexpr int kMaxRounds = 3;
  bool is_strict = rules.strictness == Strictness::kHeights;
  for (int round = 0; flips && round < kMaxRounds; ++round) {
    const auto flipped = flip_where_needed(out, threads, part_of(progress, 0.75, 1.0));
    if (!flipped) return flipped.error();
    if (is_strict && !*flipped) break;
    if (mollify(out.intrinsic, rules.strictness, threads) == 0) break;
    is_strict = true;
  }
  out.warnings = cleaning_notes(clean);
  note_mollification(out.intrinsic, rules.strictness, out.warnings);
  if (names_parts) {
    out.parts = clean.parts;
    measure_parts(out);
  }
  if (rules.refine != RefineRule::kNever) {
    auto refined =
        refine_triangulation(out.intrinsic, out.edits, out.parts, out.part_edge, positions,
                             vertices + kFewInserted, threads, part_of(progress, 0.75, 1.0));
    if (!refined) return refined.error();
    out.refinement = *std::move(refined);
    note_refinement(out.refinement, out.warnings);
  }
  out.flips = static_cast<Index>(std::ranges::count(out.edits, Edit::Kind::kFlip, &Edit::kind));
  out.times.flips = watch.lap();
  if (earlier == nullptr && (!out.edits.empty() || out.tufted)) {
    out.corners = CornerTable(out.vertex_count(), out.intrinsic.faces, threads);
  }
  out.times.clean += watch.lap();
  return out;
}

bool same_triangles(const IntrinsicSurface& a, const IntrinsicSurface& b, int threads) {
  const bool plain = a.edits.empty() && b.edits.empty() && !a.tufted && !b.tufted;
  if (a.kept == b.kept && plain) return true;
  const IntrinsicMesh &mesh = a.intrinsic, &other = b.intrinsic;
  if (a.refinement.points != b.refinement.points || mesh.faces.size() != other.faces.size() ||
      mesh.back != other.back) {
    return false;
  }
  constexpr std::int64_t kFacesAPiece = 1 << 15;
  std::atomic<bool> same = true;
  parallel_for(threads, mesh.face_count(), kFacesAPiece, [&](std::int64_t begin, std::int64_t end) {
    const bool here = std::equal(mesh.faces.begin() + begin, mesh.faces.begin() + end,
                                 other.faces.begin() + begin) &&
                      std::equal(mesh.twin.begin() + 3 * begin, mesh.twin.begin() + 3 * end,
                                 other.twin.begin() + 3 * begin);
    if (!here) same = false;
  });
  return same;
}

}  // namespace geotherm
