// SPDX-License-Identifier: MIT
#include "solver/distributed/shared_solve.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <utility>

#include "solver/accuracy/check_heat.h"
#include "solver/core/parallel.h"
#include "solver/core/stopwatch.h"
#include "solver/core/text.h"
#include "solver/distributed/shared_heat.h"
#include "solver/distributed/shared_notes.h"
#include "solver/distributed/shared_poisson.h"
#include "solver/distributed/shared_waves.h"

namespace geotherm {
namespace {

/// Of the largest distance: values below 0 by less are what the solver leaves of a 0.
constexpr double kRoundOffOfDistance = 1e-6;
/// Rings that a block solves for beside its own vertices, where t is the square of the mean edge,
/// and the most of them.
constexpr double kRings = 16;
constexpr int kMaxRings = 64;
/// The same for waves: flips near a block's edge reach no farther.
constexpr int kRingsOfWaves = 6;
constexpr double kBand = 0.5;  // of waves, in mean edges: in wider ones fits see more old values

/// What is asked of a block's faces after the heat step: its divergence, and figures at the end.
class BlockFaces {
 public:
  BlockFaces(const SharedTask& task, const SharedHeat& heat, const MeshBlock& block,
             SourceAnchors anchors)
      : task_(task),
        block_(block),
        anchors_(std::move(anchors)),
        given_(field_of(task, heat, block)),
        field_(*block.surface, given_.heat, given_.t, {pool_, task.threads}, given_.extent) {}

  /// Of own vertices, in MeshPart::unit.
  void add_divergence(std::vector<double>& b) const {
    const Block divergence = field_.divergence({&anchors_, 1});
    for (Index here = 0; here < block_.own(); ++here) {
      const Index row = block_.row(here);
      if (row != kNoIndex) b[block_.vertex[here]] = divergence(row, 0) * block_.surface->unit;
    }
  }

  struct Sums {
    CellCounts cells;
    Quality quality;
    double error = 0, area = 0;  ///< eikonal, by area
    double left = 0, given = 0;  ///< squares of L phi - b and of b
  };

  /// `phi`, `b`: of vertices of the part, in MeshPart::unit.
  Sums inspect(const std::vector<double>& phi, const std::vector<double>& b) const {
    const Surface& surface = *block_.surface;
    const OperatorMesh& mesh = *surface.operators;
    std::vector<double> here(static_cast<std::size_t>(surface.size())), product(here.size());
    for (Index row = 0; row < surface.size(); ++row) {
      here[row] = phi[block_.part_vertex(row)] / surface.unit;
    }
    SourceAnchors anchors = anchors_;
    anchors.components.clear();
    const auto reached = block_.per_component(
        task_.components, [&](Index c) { return task_.reached[static_cast<std::size_t>(c)]; });
    for (std::size_t c = 0; c < reached.size(); ++c) {
      if (reached[c]) anchors.components.push_back(static_cast<Index>(c));
    }
    Sums out;
    const std::vector<char> own = own_faces(task_.part, block_);
    out.cells = field_.inspect(here, anchors, own, task_.threads, out.quality);
    const double square = surface.unit * surface.unit;
    for (Index f = 0; f < mesh.face_count(); ++f) {
      if (!own[f] || !reached[mesh.components.of[mesh.faces[f][0]]]) continue;
      out.area += mesh.layout[f].base * mesh.layout[f].height * square / 2;
    }
    out.error = out.quality.eikonal_error_mean * out.area;
    surface.apply_stiffness(here, product, task_.threads);
    for (Index v = block_.first; v < block_.end; ++v) {
      const Index row = block_.row(v - block_.first);
      if (row == kNoIndex || is_pinned(task_, v)) continue;
      const double left = product[row] * surface.unit - b[v];
      out.left += left * left;
      out.given += b[v] * b[v];
    }
    return out;
  }

 private:
  const SharedTask& task_;
  const MeshBlock& block_;
  mutable BlockPool pool_;
  SourceAnchors anchors_;
  BlockField given_;
  FaceField field_;
};

/// |M u - b| / |b| that what is no news may leave (shared_heat.h): 1e-6 of the terms of the rows at
/// the edges of blocks, of which those near a source are as large as b, a few together.
constexpr double kUsualHeatResidual = 1e-5;

/// Makes distances of phi, of own vertices, and what there is to say about them.
std::vector<double> distances_of(const SharedTask& task, const std::vector<double>& phi,
                                 SharedAnswer& out) {
  std::vector<double> distances(static_cast<std::size_t>(task.part.own), kUnreached);
  double most = 0, sum = 0, unreached = 0, clamped = 0;
  std::array<double, 1> least = {kUnreached};
  for (Index v = 0; v < task.part.own; ++v) {
    const Index component = task.components.of[v];
    if (component == kNoIndex || !task.reached[static_cast<std::size_t>(component)]) {
      ++unreached;
      continue;
    }
    distances[v] = std::max(phi[v], 0.0);
    most = std::max(most, distances[v]);
    least[0] = std::min(least[0], distances[v]);
    sum += distances[v];
  }
  out.most = task.ranks.most(most);
  task.ranks.combine(least, RankGroup::Combination::kLeast);
  out.least = least[0];
  out.unreached = static_cast<GlobalIndex>(task.ranks.sum(unreached));
  const auto reached = static_cast<double>(task.part.vertices - out.unreached);
  out.mean = task.ranks.sum(sum) / reached;
  for (Index v = 0; v < task.part.own; ++v) {
    clamped += distances[v] < kUnreached && phi[v] < -kRoundOffOfDistance * out.most ? 1 : 0;
  }
  out.quality.clamped_vertices = static_cast<Index>(task.ranks.sum(clamped));
  return distances;
}

/// The quality figures, and what a person should know of them.
Result<void> check_answer(const SharedTask& task, const std::vector<BlockFaces*>& faces,
                          const SharedHeat& heat, std::vector<double> phi,
                          const std::vector<double>& b, std::vector<double>& distances,
                          SharedAnswer& out) {
  phi.resize(static_cast<std::size_t>(task.part.size()), 0.0);
  Halo(task.ranks, task.part, heat.beside).fetch(task.ranks, phi);
  std::array<double, 8> sums{};
  std::array<double, 1> steepest{};
  for (const BlockFaces* const block : faces) {
    const auto part = block->inspect(phi, b);
    const std::array<double, 8> here = {part.error,
                                        part.area,
                                        part.left,
                                        part.given,
                                        static_cast<double>(part.cells.in_reach),
                                        static_cast<double>(part.cells.without_direction),
                                        static_cast<double>(part.quality.zero_gradient_faces),
                                        static_cast<double>(part.quality.steep_edges)};
    for (std::size_t k = 0; k < sums.size(); ++k) sums[k] += here[k];
    steepest[0] = std::max(steepest[0], part.quality.steepest_edge);
  }
  task.ranks.combine(sums, RankGroup::Combination::kSum);
  task.ranks.combine(steepest, RankGroup::Combination::kMost);
  Quality& q = out.quality;
  q.eikonal_error_mean = sums[1] > 0 ? sums[0] / sums[1] : 0.0;
  q.poisson_residual = sums[3] > 0 ? std::sqrt(sums[2] / sums[3]) : 0.0;
  q.heat_residual = heat.residual;
  q.zero_gradient_faces = static_cast<Index>(sums[6]);
  q.steep_edges = static_cast<Index>(sums[7]);
  q.steepest_edge = steepest[0];
  q.edges_checked = true;
  DistanceResult result;
  result.quality = q;
  result.distances = std::move(distances);
  check_lines(task, result);
  distances = std::move(result.distances);
  q = result.quality;
  const CellCounts cells = {static_cast<Index>(sums[4]), static_cast<Index>(sums[5])};
  const auto assessed =
      assess_heat(task.options, task.times.extreme, cells, result, kUsualHeatResidual);
  out.warnings = std::move(result.warnings);
  return assessed;
}

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
  for (const auto& each : ranks.swap(entries)) {
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
  loose = ranks.gather(loose);
  if (loose.empty()) return flags;
  return Error{ErrorCode::kBadInput,
               "vertex " + std::to_string(loose.front()) + " belongs to no face",
               {"choose another"}};
}

/// Of vertices of the part: those of others come from their owners.
template <class T>
void fetch_halo(const RankGroup& ranks, const MeshPart& part, T missing, std::vector<T>& values) {
  values.resize(static_cast<std::size_t>(part.size()), missing);
  std::vector<Index> others;
  for (Index v = part.own; v < part.size(); ++v) others.push_back(v);
  Halo(ranks, part, others).fetch(ranks, values);
}

/// From the unit of the part to that of the model.
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
  auto lap = [&ranks, watch = Stopwatch()]() mutable { return ranks.most(watch.lap()); };
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
  ranks.combine(reached, RankGroup::Combination::kMost);
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
        wave_over_ranks(ranks, part, *blocks, *is_source, kBand * components.mean_edge);
    if (!waves) return waves.error();
    hand_over(ranks, part, distances_of(task, waves->distances, out), out);
    out.timing.query = lap();
    out.rounds = waves->rounds;
    out.quality = waves->quality;
    out.warnings = notes;
    to_model_units(part.unit, out);
    return out;
  }
  Result<SharedWaves> waves = SharedWaves();
  double waves_ms = 0;
  if (check && rules.flip) {
    lap();
    waves = wave_over_ranks(ranks, part, *blocks, *is_source, kBand * components.mean_edge);
    waves_ms = lap();
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
  out.factor_mb = ranks.most(factor_bytes) / (1024.0 * 1024.0);
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
  std::vector<double> distances = distances_of(task, *phi, out);
  if (check) out.error = verdict_over_ranks(ranks, part, rules.flip, distances, waves, waves_ms);
  out.timing.poisson = lap();
  out.timing.query = out.timing.diffuse + out.timing.gradient + out.timing.poisson;
  report(progress, "figures", 0.9);
  if (auto right = check_answer(task, faces, *heat, *phi, b, distances, out); !right)
    return right.error();
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
