// SPDX-License-Identifier: MIT
#include "solver/distributed/shared_waves.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <string>
#include <utility>

#include "solver/accuracy/check_waves.h"
#include "solver/distributed/block_waves.h"

namespace geotherm {
namespace {

/// Both sides of a shared value know it when they differ by no more than this share.
constexpr double kSame = 1e-13;

/// What several blocks have: a vertex is owned by the block whose vertex it is, an edge by that of
/// its lower end, which has all faces at it.
class SharedValues {
 public:
  /// All ranks call it.
  SharedValues(const RankGroup& ranks, const MeshPart& part,
               std::span<const std::unique_ptr<BlockWaves>> blocks)
      : ranks_(ranks), blocks_(blocks) {
    const auto count = static_cast<std::size_t>(ranks.count());
    copies_.resize(count);
    PerRank<EdgeName> asked(count);  // a vertex: high is -1
    for (std::size_t b = 0; b < blocks.size(); ++b) {
      const MeshBlock& block = blocks[b]->block();
      const auto is_own = [&](GlobalIndex id) {
        const Index here = part.local(id, ranks.rank());
        return here != kNoIndex && here >= block.first && here < block.end;
      };
      const auto ask = [&](const EdgeName& name, Index item) {
        if (is_own(name.low)) return;
        const auto owner = static_cast<std::size_t>(part.owner(name.low));
        asked[owner].push_back(name);
        copies_[owner].push_back({b, item, kUnreached});
      };
      const std::vector<Index>& vertices = blocks[b]->tables().vertex_of_rank;
      for (std::size_t rank = 0; rank < vertices.size(); ++rank) {
        ask({part.id[block.vertex[vertices[rank]]], -1, 0}, static_cast<Index>(rank));
      }
      for (const auto& each : blocks[b]->edges()) ask(each.name, -1 - each.edge);
    }
    const GlobalIndex first = part.first[static_cast<std::size_t>(ranks.rank())];
    for (const auto& each : ranks.all_to_all(asked)) {
      auto& owned = owned_.emplace_back();
      for (const EdgeName& name : each) {
        owned.push_back(owner_of(static_cast<Index>(name.low - first), name));
      }
    }
  }

  /// Hands on what fell, to owners and from them. All ranks call it.
  void exchange() {
    tell(copies_, owned_);
    tell(owned_, copies_);
    // Not before, when an edge might have one end's old value.
    for (const auto& block : blocks_) block->wake();
  }

 private:
  struct Item {
    std::size_t block;  ///< kNone: nobody has it
    Index item;         ///< a vertex by its rank, an edge e as -1 - e
    double known;       ///< to the other side, model units
  };
  static constexpr std::size_t kNone = static_cast<std::size_t>(-1);

  Item owner_of(Index vertex, const EdgeName& name) const {
    for (std::size_t b = 0; b < blocks_.size(); ++b) {
      const MeshBlock& block = blocks_[b]->block();
      if (vertex < block.first || vertex >= block.end) continue;
      if (name.high < 0) {
        const auto& tables = blocks_[b]->tables();
        const Index rank =
            tables.faces.empty() ? kNoIndex : tables.rank_of_vertex[vertex - block.first];
        if (rank != kNoIndex) return {b, rank, kUnreached};
        continue;
      }
      if (const Index edge = blocks_[b]->find(name); edge != kNoIndex) {
        return {b, -1 - edge, kUnreached};
      }
    }
    return {kNone, 0, kUnreached};
  }

  void tell(PerRank<Item>& from, PerRank<Item>& to) {
    struct News {
      std::int64_t at;
      double value;
    };
    PerRank<News> out(from.size());
    for (std::size_t r = 0; r < from.size(); ++r) {
      for (std::size_t k = 0; k < from[r].size(); ++k) {
        Item& item = from[r][k];
        if (item.block == kNone) continue;
        const double value = blocks_[item.block]->value_at(item.item);
        if (!(value < item.known - kSame * std::abs(item.known)) && item.known < kUnreached) {
          continue;
        }
        if (!(value < kUnreached)) continue;
        item.known = value;
        out[r].push_back({static_cast<std::int64_t>(k), value});
      }
    }
    const PerRank<News> in = ranks_.all_to_all(out);
    for (std::size_t r = 0; r < in.size(); ++r) {
      for (const News& news : in[r]) {
        Item& item = to[r][static_cast<std::size_t>(news.at)];
        item.known = std::min(item.known, news.value);
        if (item.block != kNone) blocks_[item.block]->note(item.item, news.value);
      }
    }
    for (const auto& block : blocks_) block->hear();
  }

  const RankGroup& ranks_;
  std::span<const std::unique_ptr<BlockWaves>> blocks_;
  PerRank<Item> copies_, owned_;
};

}  // namespace

Result<SharedWaves> wave_over_ranks(const RankGroup& ranks, const MeshPart& part,
                                    std::span<const MeshBlock> blocks,
                                    std::span<const char> is_source, double band) {
  std::vector<std::unique_ptr<BlockWaves>> waves;
  const auto build = [&]() -> Result<void> {
    for (const MeshBlock& block : blocks) {
      if (!block.surface) continue;
      auto made = BlockWaves::build(part, block, is_source);
      if (!made) return made.error();
      waves.push_back(*std::move(made));
    }
    return {};
  };
  if (auto built = ranks.agree(build()); !built) return built.error();
  SharedValues shared(ranks, part, waves);
  SharedWaves out;
  double from = 0, until = 0;
  for (;; ++out.rounds) {
    double next = kUnreached;
    for (const auto& each : waves) next = std::min(next, each->next());
    ranks.all_reduce({&next, 1}, RankGroup::Reduction::kMin);
    if (!(next < kUnreached)) break;
    if (!(next < until)) {
      from = next;
      until = std::max(next + band, std::nextafter(next, kUnreached));
    }
    bool ends = true;
    for (const auto& each : waves) ends = each->go_on(from, until) && ends;
    if (ranks.max(ends ? 0 : 1) > 0) {
      return Error{ErrorCode::kBudgetEnded,
                   "waves on " + std::to_string(part.faces) + " faces: distances fall without end",
                   {"use ", SettingHint{"method", {"heat"}}}};
    }
    shared.exchange();
  }
  out.distances.assign(static_cast<std::size_t>(part.own), kUnreached);
  std::array<double, 4> sums{};
  SteepSides steep(bound_tolerance(MethodKind::kWavefront));
  for (const auto& each : waves) {
    const MeshBlock& block = each->block();
    const std::vector<double> here = each->distances();
    for (Index v = 0; v < block.own(); ++v) {
      out.distances[block.vertex[v]] = here[v] * block.surface->length_unit();
    }
    const double square = block.surface->length_unit() * block.surface->length_unit();
    const IntrinsicMesh& mesh = block.surface->intrinsic;
    std::vector<char> own(mesh.faces.size());
    for (std::size_t f = 0; f < own.size(); ++f) {
      const auto id = [&](Index v) { return part.id[block.vertex[v]]; };
      own[f] = std::ranges::min(mesh.faces[f], {}, id) < block.own();
    }
    const SlopeSums slopes = sum_slopes(mesh, here, steep, own);
    sums[0] += slopes.error * square;
    sums[1] += slopes.area * square;
    sums[2] += each->visits();
  }
  steep.write_to(out.quality);
  sums[3] = out.quality.steep_edges;
  ranks.all_reduce(sums, RankGroup::Reduction::kSum);
  out.quality.eikonal_error_mean = SlopeSums{sums[0], sums[1]}.mean();
  out.visits = sums[2];
  out.quality.steep_edges = static_cast<Index>(sums[3]);
  out.quality.steepest_edge = ranks.max(out.quality.steepest_edge);
  return out;
}

AccuracyReport hold_over_ranks(const RankGroup& ranks, const MeshPart& part,
                               std::span<const double> distances, std::span<const double> waves,
                               double milliseconds) {
  constexpr double kAtSource = 1e-12;  // of the largest distance: a source, up to round-off
  AccuracyReport report = unmeasured(MethodKind::kWavefront, "no vertex has both distances");
  double range = 0;
  for (const double d : waves) range = std::max(range, d < kUnreached ? d : 0.0);
  range = ranks.max(range);
  struct Worst {
    double off = -1;
    GlobalIndex vertex = 0;
  } worst;
  std::array<double, 5> sums{};  // off, relative, and how many of both; reached by one alone
  for (Index v = 0; v < part.own; ++v) {
    const double d = distances[v], e = waves[v];
    if ((d < kUnreached) != (e < kUnreached)) ++sums[4];
    if (!(d < kUnreached && e < kUnreached)) continue;
    const double off = std::abs(d - e);
    sums[0] += d - e;
    ++sums[2];
    if (off > worst.off) worst = {off, part.file_id[v]};
    if (!(e > kAtSource * range)) continue;
    sums[1] += off / e;
    ++sums[3];
  }
  ranks.all_reduce(sums, RankGroup::Reduction::kSum);
  for (const Worst& each : ranks.all_gather(std::vector<Worst>{worst})) {
    if (each.off > worst.off || (each.off == worst.off && each.vertex < worst.vertex)) worst = each;
  }
  if (!(sums[2] > 0)) return report;
  DistanceError& figures = report.figures;
  figures.mean_signed = part.unit * sums[0] / sums[2];
  if (sums[3] > 0) figures.mean_relative = sums[1] / sums[3];
  if (range > 0) figures.max_of_range = worst.off / range;
  figures.max = part.unit * worst.off;
  figures.worst = static_cast<Index>(worst.vertex);
  figures.differently_reached = static_cast<Index>(sums[4]);
  report.measured = true;
  report.milliseconds = milliseconds;
  report.grade = grade_of(figures);
  report.verdict = to_text(report.grade);
  if (report.grade == Grade::kPoor) {
    report.advice = {"use ", SettingHint{"method", {to_text(MethodKind::kWavefront)}}};
  }
  return report;
}

AccuracyReport verdict_over_ranks(const RankGroup& ranks, const MeshPart& part, bool flipped,
                                  std::span<const double> distances,
                                  const Result<SharedWaves>& waves, double milliseconds) {
  if (flipped && waves) {
    return hold_over_ranks(ranks, part, distances, waves->distances, milliseconds);
  }
  if (!flipped) {
    auto report = unmeasured(MethodKind::kHeat, "waves need Delaunay triangles, and did not check");
    report.advice = {"use ", SettingHint{"laplacian", {"intrinsic-delaunay"}}};
    return report;
  }
  auto report =
      unmeasured(MethodKind::kHeat, "the distances were not checked: " + waves.error().message);
  report.failed = true;
  return report;
}

}  // namespace geotherm
