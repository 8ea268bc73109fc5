// SPDX-License-Identifier: MIT
#include "solver/distributed/shared_solve.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "solver/core/memory.h"
#include "solver/core/parallel.h"
#include "solver/core/stopwatch.h"
#include "solver/core/text.h"
#include "solver/distributed/shared_answer.h"
#include "solver/distributed/shared_heat.h"
#include "solver/distributed/shared_notes.h"
#include "solver/distributed/shared_poisson.h"
#include "solver/distributed/shared_waves.h"
#include "solver/heat/near_march.h"
#include "solver/heat/normalize.h"

namespace geotherm {
namespace {

/// Rings that a block solves for beside its own vertices, where t is the square of the mean edge,
/// and the most of them.
constexpr double kRings = 16;
constexpr int kMaxRings = 64;
/// Rings that a block of waves has: flips near a block's edge reach no farther.
constexpr int kRingsOfWaves = 6;
/// The width of the band of distances that waves settle in one round, in mean edges: half of a
/// bucket of the front in one process. In wider bands fits see more old values, and errors on good
/// planes are five times as large; narrower ones gain nothing.
constexpr double kWaveBand = 0.25;

/// Distances of own vertices to those who have their share of the file.
void hand_over(const RankGroup& ranks, const MeshPart& part, const std::vector<double>& distances,
               SharedAnswer& out) {
  struct Entry {
    GlobalIndex file_id;
    double distance;
  };
  PerRank<Entry> entries(static_cast<std::size_t>(ranks.count()));
  for (Index v = 0; v < part.own; ++v) {
    const int to = part_of_share(part.file_id[v], part.vertices, ranks.count());
    entries[static_cast<std::size_t>(to)].push_back({part.file_id[v], distances[v]});
  }
  const GlobalIndex begin = share_begin(part.vertices, ranks.rank(), ranks.count());
  out.distances.resize(static_cast<std::size_t>(
      share_begin(part.vertices, ranks.rank() + 1, ranks.count()) - begin));
  for (const auto& each : ranks.all_to_all(entries)) {
    for (const Entry& entry : each) {
      out.distances[static_cast<std::size_t>(entry.file_id - begin)] = entry.distance;
    }
  }
}

/// How many rings a block takes in, by the longest diffusion length in mean edges.
int rings_for(const TimeStep& step, double mean_edge) {
  const double m =
      step.rule == TimeRule::kAbsolute ? step.absolute / mean_edge / mean_edge : step.factor;
  return static_cast<int>(
      std::clamp(std::ceil(kRings * std::sqrt(m)), kRings, static_cast<double>(kMaxRings)));
}

/// Whether all of these are in the file. Errors: kBadInput.
Result<void> check_numbers(std::span<const GlobalIndex> sources, GlobalIndex vertices) {
  const GlobalIndex last = std::ranges::max(sources);
  if (last < vertices) return {};
  return Error{ErrorCode::kBadInput,
               "there is no vertex " + std::to_string(last),
               {"vertices are 0 to " + std::to_string(vertices - 1)}};
}

/// Flags for the own vertices of the part. Errors: kBadInput, in no face.
Result<std::vector<char>> place(const RankGroup& ranks, const MeshPart& part,
                                const SharedComponents& components,
                                std::span<const GlobalIndex> sources) {
  std::vector<char> flags(static_cast<std::size_t>(part.own), 0);
  std::vector<GlobalIndex> wanted(sources.begin(), sources.end()), loose;
  std::ranges::sort(wanted);
  for (Index v = 0; v < part.own; ++v) {
    if (!std::ranges::binary_search(wanted, part.file_id[v])) continue;
    flags[v] = 1;
    if (components.of[v] == kNoIndex) loose.push_back(part.file_id[v]);
  }
  loose = ranks.all_gather(loose);
  if (loose.empty()) return flags;
  return Error{ErrorCode::kBadInput,
               "vertex " + std::to_string(loose.front()) + " belongs to no face",
               {"choose another"}};
}

/// Completes values of the part's own vertices: values of vertices that belong to other ranks come
/// from their owners, and are `missing` until then.
template <class T>
void fetch_halo(const RankGroup& ranks, const MeshPart& part, T missing, std::vector<T>& values) {
  values.resize(static_cast<std::size_t>(part.size()), missing);
  std::vector<Index> others;
  for (Index v = part.own; v < part.size(); ++v) others.push_back(v);
  Halo(ranks, part, others).fetch(ranks, values);
}

/// No two places are farther apart, in MeshPart::unit.
constexpr double kFarthest = 4;

/// The faces of a component with a corner in the reach of a source, those of all ranks. A face
/// comes from every block that owns such a corner: a march does not mind.
NearFaces faces_within(const SharedTask& task, std::span<const MeshBlock> blocks,
                       std::span<const SharedSource> sources, double reach) {
  const MeshPart& part = task.part;
  const auto is_near = [&](Index v) {
    return std::ranges::any_of(sources, [&](const SharedSource& source) {
      return task.components.of[v] == source.component &&
             (part.positions[v] - source.place()).norm() <= reach;
    });
  };
  std::vector<NearFace> out;
  for (const MeshBlock& block : blocks) {
    for (Index here = 0; here < block.own(); ++here) {
      const Index row = block.row(here);
      if (row == kNoIndex || !is_near(block.vertex[here])) continue;
      const OperatorMesh& mesh = *block.surface->operators;
      const double unit = block.surface->unit;
      for (const Side corner : mesh.corners.at(row)) {
        const Index f = face_of(corner);
        NearFace& face = out.emplace_back();
        for (int k = 0; k < 3; ++k) face.corners[k] = part.id[block.part_vertex(mesh.faces[f][k])];
        const FaceLayout& at = mesh.layout[f];
        face.layout = {at.base * unit, at.x * unit, at.height * unit};
      }
    }
  }
  return {task.ranks.all_gather(out), reach > kFarthest};
}

bool are_delaunay(const SharedTask& task, std::span<const MeshBlock> blocks) {
  double others = 0;
  for (const MeshBlock& block : blocks) {
    others += block.surface && !block.surface->is_delaunay ? 1 : 0;
  }
  return task.ranks.sum(others) == 0;
}

/// Puts near-exact distances around the sources in the place of heat's, as one process does
/// (march_nearest()): the faces around the sources come to all ranks, which march over them alike.
/// `distances`: of own vertices, in MeshPart::unit. Cost: two or three exchanges for each component
/// that holds a source, of some hundreds of faces a source. All ranks call it.
void add_near_field(const SharedTask& task, std::span<const MeshBlock> blocks,
                    std::span<const SharedSource> sources, std::span<double> distances) {
  if (!uses_what_is_known(task.options)) return;
  if (task.options.laplacian == LaplacianKind::kCotan && !are_delaunay(task, blocks)) return;
  const MeshPart& part = task.part;
  std::vector<SharedSource> left(sources.begin(), sources.end());
  std::ranges::stable_sort(left, {}, &SharedSource::component);
  for (std::span<const SharedSource> rest = left; !rest.empty();) {
    const Index component = rest.front().component;
    const auto end = std::ranges::upper_bound(rest, component, {}, &SharedSource::component);
    const auto here = rest.first(static_cast<std::size_t>(end - rest.begin()));
    rest = rest.subspan(here.size());
    const ComponentSize& size = task.components.sizes[component];
    std::vector<NearDistance> seeds;
    for (const SharedSource& source : here) seeds.push_back({source.id, 0.0});
    const auto found =
        march_around(seeds, near_count(here.size(), size.cells), size.mean_edge,
                     [&](double reach) { return faces_within(task, blocks, here, reach); });
    for (const NearDistance& each : found) {
      const GlobalIndex own = each.vertex - part.first[task.ranks.rank()];
      if (own < 0 || own >= part.own) continue;
      const double share = share_of_heat(each.distance, found.back().distance);
      double& distance = distances[static_cast<std::size_t>(own)];
      distance = share * distance + (1 - share) * each.distance;
    }
  }
}

/// Converts all lengths of the answer from the unit of the part to model units.
void to_model_units(double unit, SharedAnswer& out) {
  for (double& d : out.distances) d *= unit;
  for (double* const length : {&out.least, &out.most, &out.mean, &out.mean_edge}) *length *= unit;
  out.area *= unit * unit;
}

}  // namespace

Result<SharedAnswer> solve_over_ranks(const RankGroup& ranks, const std::string& path,
                                      std::span<const GlobalIndex> sources,
                                      const MethodOptions& options, bool check,
                                      const Progress& progress, Index most_of_block) {
  auto lap = [&ranks, watch = Stopwatch()]() mutable { return ranks.max(watch.lap()); };
  SharedAnswer out;
  report(progress, "reading", 0.0);
  auto slice = ranks.agree_on(read_ply_slice(path, ranks.rank(), ranks.count()));
  if (!slice) return slice.error();
  out.read_ms = lap();
  if (auto there = check_numbers(sources, slice->vertices); !there) return there.error();
  const auto repeated = static_cast<double>(std::ranges::count_if(
      slice->corners, [](const auto& f) { return f[0] == f[1] || f[1] == f[2] || f[2] == f[0]; }));
  report(progress, "sharing", 0.1);
  auto shared = share_mesh(ranks, *std::move(slice));
  if (!shared) return shared.error();
  MeshPart& part = *shared;
  auto named = name_components(ranks, part);
  if (!named) return named.error();
  SharedComponents& components = *named;
  auto is_source = place(ranks, part, components, sources);
  if (!is_source) return is_source.error();
  out.share_ms = lap();

  report(progress, "operators", 0.2);
  const bool is_heat = options.method == MethodKind::kHeat;
  const double model_edge = components.mean_edge * part.unit;
  const BlockRules rules = {
      .flip = !is_heat || options.laplacian != LaplacianKind::kCotan,
      .rings = is_heat ? rings_for(options.time_step, model_edge) : kRingsOfWaves,
      .most = most_of_block,
      .threads = thread_count(options.threads)};
  auto blocks = build_blocks(ranks, rules, part);
  if (!blocks) return blocks.error();
  fetch_halo(ranks, part, kNoIndex, components.of);
  fetch_halo(ranks, part, char{0}, *is_source);
  measure_components(ranks, part, *blocks, components);
  std::vector<Warning> notes = notes_of(ranks, part, components, *blocks, options, repeated);
  part.positions.resize(static_cast<std::size_t>(part.own));  // blocks have theirs
  part.positions.shrink_to_fit();
  part.corners = {};
  part.halo = {};
  const auto times = diffusion_times(components.sizes, part.unit, options.time_step);
  if (!times) return times.error();
  std::vector<double> reached(components.sizes.size(), 0.0);
  for (Index v = 0; v < part.own; ++v) {
    if ((*is_source)[v]) reached[components.of[v]] = 1;
  }
  ranks.all_reduce(reached, RankGroup::Reduction::kMax);
  const SharedTask task = {.ranks = ranks,
                           .part = part,
                           .components = components,
                           .times = *times,
                           .options = options,
                           .is_source = *is_source,
                           .reached = {reached.begin(), reached.end()},
                           .threads = rules.threads};
  double flips = 0;
  for (const MeshBlock& block : *blocks) flips += block.surface ? block.surface->flips : 0;
  out.vertices = part.vertices;
  out.faces = part.faces;
  out.components = static_cast<Index>(components.sizes.size());
  out.mean_edge = components.mean_edge;
  for (const ComponentSize& size : components.sizes) out.area += size.area;
  out.flips = static_cast<Index>(ranks.sum(flips));
  out.blocks = static_cast<int>(ranks.sum(static_cast<double>(blocks->size())));
  const auto loose = std::count(components.of.begin(), components.of.begin() + part.own, kNoIndex);
  out.loose = static_cast<GlobalIndex>(ranks.sum(static_cast<double>(loose)));
  if (!is_heat) {
    out.set_up_ms = lap();
    const auto waves =
        wave_over_ranks(ranks, part, *blocks, *is_source, kWaveBand * components.mean_edge);
    if (!waves) return waves.error();
    out.quality = waves->quality;
    const auto distances = distances_of(task, waves->distances, out.quality);
    measure(task, distances, out);
    hand_over(ranks, part, distances, out);
    out.timing.query = lap();
    out.rounds = waves->rounds;
    out.warnings = notes;
    to_model_units(part.unit, out);
    return out;
  }
  Result<SharedWaves> waves = SharedWaves();
  double waves_ms = 0;
  if (check && rules.flip) {
    lap();
    waves = wave_over_ranks(ranks, part, *blocks, *is_source, kWaveBand * components.mean_edge);
    waves_ms = lap();
    release_freed_memory();  // of which factors would leave holes
  }
  std::vector<SourceAnchors> anchors(blocks->size());
  for (std::size_t k = 0; k < blocks->size(); ++k) {
    MeshBlock& block = (*blocks)[k];
    if (!block.surface) continue;
    anchors[k] = anchors_in(task, block);
    block.surface = faces_alone(*block.surface, true);
  }
  report(progress, "factorize", 0.3);
  if (auto made = factorise_blocks(task, *blocks); !made) return made.error();
  out.set_up_ms = lap();

  report(progress, "heat", 0.5);
  const auto heat = diffuse_over_ranks(task, *blocks);
  if (!heat) return heat.error();
  double factor_bytes = 0;
  for (MeshBlock& block : *blocks) {
    if (block.heat) factor_bytes += static_cast<double>(block.heat->factor().stats().bytes);
    block.heat = nullptr;
  }
  release_freed_memory();
  out.factor_mb = ranks.max(factor_bytes) / (1024.0 * 1024.0);
  out.timing.diffuse = lap();
  std::vector<std::unique_ptr<BlockFaces>> fields;
  std::vector<BlockFaces*> faces;
  std::vector<double> b(static_cast<std::size_t>(part.own), 0.0);
  for (std::size_t k = 0; k < blocks->size(); ++k) {
    MeshBlock& block = (*blocks)[k];
    if (!block.surface) continue;
    block.surface = faces_alone(*block.surface, false);
    fields.push_back(std::make_unique<BlockFaces>(task, *heat, block, std::move(anchors[k])));
    faces.push_back(fields.back().get());
    faces.back()->add_divergence(b);
  }
  out.timing.gradient = lap();
  report(progress, "poisson", 0.7);
  const auto phi = solve_poisson(task, *blocks, b, out.quality.iterations_poisson);
  if (!phi) return phi.error();
  DistanceResult found;
  found.quality = out.quality;
  found.distances = distances_of(task, *phi, found.quality);
  const std::vector<SharedSource> places = sources_of(task);
  add_near_field(task, *blocks, places, found.distances);
  check_lines(task, places, found);
  out.quality = found.quality;
  const std::vector<double>& distances = found.distances;
  measure(task, distances, out);
  if (check) out.error = verdict_over_ranks(ranks, part, rules.flip, distances, waves, waves_ms);
  out.timing.poisson = lap();
  out.timing.query = out.timing.diffuse + out.timing.gradient + out.timing.poisson;
  report(progress, "figures", 0.9);
  if (auto right = check_answer(task, faces, *heat, *phi, b, out); !right) return right.error();
  hand_over(ranks, part, distances, out);
  out.warnings.insert(out.warnings.begin(), notes.begin(), notes.end());
  out.t = times->model_t;
  out.relative_t = times->relative_t;
  out.rings = rules.rings;
  out.rounds = heat->rounds;
  out.row_residual = heat->row_residual;
  to_model_units(part.unit, out);
  return out;
}

}  // namespace geotherm
