// SPDX-License-Identifier: MIT
#include "solver/distributed/shared_notes.h"

#include <algorithm>
#include <array>

#include "solver/accuracy/distance_bounds.h"
#include "solver/core/text.h"
#include "solver/geometry/clean_faces.h"
#include "solver/geometry/intrinsic_refinement.h"
#include "solver/geometry/tufted_cover.h"
#include "solver/heat/normalize.h"

namespace geotherm {
namespace {

/// Faces whose first corner by global numbers is this rank's, and that come after the same three
/// corners.
double count_duplicates(const MeshPart& part) {
  std::vector<Face> faces;
  for (Face face : std::span(part.corners).first(static_cast<std::size_t>(part.own_faces))) {
    std::ranges::sort(face, {}, [&](Index v) { return part.id[v]; });
    if (face[0] < part.own && !repeats_corner(face)) faces.push_back(face);
  }
  std::ranges::sort(faces);
  return static_cast<double>(std::ssize(faces) -
                             (std::unique(faces.begin(), faces.end()) - faces.begin()));
}

struct NeedCounts {
  double large = 0, obtuse = 0;
};

/// The faces of a block, counted by their owners, that cannot carry the heat method as they are.
NeedCounts count_needs(const MeshPart& part, const SharedComponents& components,
                       const MeshBlock& block, int threads) {
  const Surface& surface = *block.surface;
  const IntrinsicMesh& mesh = surface.intrinsic;
  std::vector<double> part_edge(static_cast<std::size_t>(surface.parts.count));
  for (std::size_t v = 0; v < block.vertex.size(); ++v) {
    const Index here = surface.parts.of[v];
    if (here == kNoIndex) continue;
    part_edge[here] = components.sizes[components.of[block.vertex[v]]].mean_edge / mesh.unit;
  }
  const auto is_own = [&](Index face) {
    const Index first =
        std::ranges::min(mesh.faces[face], {}, [&](Index v) { return part.id[block.vertex[v]]; });
    return first < block.own();
  };
  const RefinementNeeds needs = find_refinement_needs(mesh, surface.parts, part_edge, threads);
  const auto count = [](auto number) { return static_cast<double>(number); };
  return {
      count(std::ranges::count_if(needs.large, is_own)),
      count(std::ranges::count_if(needs.obtuse, [&](Side side) { return is_own(face_of(side)); }))};
}

/// Where one process would insert vertices. Waves need none in large faces.
void note_needs(double large, double obtuse, bool heat, std::vector<Warning>& notes) {
  if (!heat) large = 0;
  if (large == 0 && obtuse == 0) return;
  std::string what;
  if (large > 0) {
    what = counted_text(static_cast<std::size_t>(large), "face is", "faces are") +
           " too large for the diffusion time";
  }
  if (obtuse > 0) {
    what += (what.empty() ? "" : ", and ") +
            counted_text(static_cast<std::size_t>(obtuse), "edge of the boundary lies",
                         "edges of the boundary lie") +
            " opposite an obtuse angle";
  }
  Hint hint = {"start without mpirun where one machine holds the mesh"};
  if (heat) {
    hint.insert(hint.end(), {", or use ", SettingHint{"method", {"wavefront"}}});
  }
  notes.push_back({what + ": one process would insert vertices there, which ranks do not, and " +
                       (heat ? "distances around them may be far off"
                             : "distances behind them may be too short"),
                   std::move(hint)});
}

}  // namespace

std::vector<Warning> notes_of(const RankGroup& ranks, const MeshPart& part,
                              const SharedComponents& components, std::span<const MeshBlock> blocks,
                              const MethodOptions& options, double repeated) {
  const bool heat = options.method == MethodKind::kHeat;
  const bool automatic = options.laplacian == LaplacianKind::kAuto;
  double lengthened = 0, covers = 0, duplicates = 0;
  std::array<double, 2> needs{};
  for (const MeshBlock& block : blocks) {
    if (!block.surface) continue;
    const IntrinsicMesh& mesh = block.surface->intrinsic;
    lengthened = std::max(lengthened, mesh.mollified.most * mesh.unit * part.unit);
    const Index vertices = block.surface->mesh->vertex_count();
    if (!faces_that_need_cover(*block.surface->kept, vertices).empty()) covers = 1;
    if (block.surface->kept->duplicate > 0) duplicates = 1;
    if (heat && !automatic) continue;
    const NeedCounts more = count_needs(part, components, block, options.threads);
    needs[0] += more.large;
    needs[1] += more.obtuse;
  }
  CleanFaces left_out;
  left_out.repeated_corner = static_cast<Index>(ranks.sum(repeated));
  if (ranks.max(duplicates) > 0) {
    left_out.duplicate = static_cast<Index>(ranks.sum(count_duplicates(part)));
  }
  std::vector<Warning> notes = cleaning_notes(left_out);
  lengthened = ranks.max(lengthened);
  if (lengthened > 0) {
    notes.push_back({"faces that are degenerate or nearly so had edges lengthened, by up to " +
                     rounded_text(lengthened) + "; distances across such a face may be too long"});
  }
  ranks.all_reduce(needs, RankGroup::Reduction::kSum);
  note_needs(needs[0], needs[1], heat, notes);
  if (ranks.max(covers) > 0 && heat && automatic) {  // waves need no cover
    notes.push_back(
        {"the surface is no oriented manifold everywhere: edges there are not flipped, "
         "where one process would take the tufted Laplacian"});
  }
  return notes;
}

std::vector<SharedSource> sources_of(const SharedTask& task) {
  const MeshPart& part = task.part;
  std::vector<SharedSource> own;
  for (Index v = 0; v < part.own; ++v) {
    const Vec3& at = part.positions[v];
    if (task.is_source[v]) own.push_back({part.id[v], task.components.of[v], at[0], at[1], at[2]});
  }
  return task.ranks.all_gather(own);
}

void check_lines(const SharedTask& task, std::span<const SharedSource> sources,
                 DistanceResult& result) {
  const MeshPart& part = task.part;
  const auto own = std::span(part.positions).first(static_cast<std::size_t>(part.own));
  std::vector<LineSource> lines;
  for (const SharedSource& source : sources) lines.push_back({source.place(), source.place(), 0.0});
  const double edge = task.components.mean_edge;
  const BelowLine below = uses_what_is_known(task.options) ? BelowLine::kRaised : BelowLine::kKept;
  apply_straight_line_bound(own, StraightLine(lines, edge), edge, 1,
                            bound_tolerance(MethodKind::kHeat), below, task.threads, result);
  Quality& q = result.quality;
  std::array<double, 2> sums = {static_cast<double>(q.reached_vertices),
                                static_cast<double>(q.below_straight_line)};
  task.ranks.all_reduce(sums, RankGroup::Reduction::kSum);
  q.reached_vertices = static_cast<Index>(sums[0]);
  q.below_straight_line = static_cast<Index>(sums[1]);
  q.most_below_straight_line = task.ranks.max(q.most_below_straight_line);
  q.clamped_reach = task.ranks.max(q.clamped_reach) * part.unit;
}

}  // namespace geotherm
