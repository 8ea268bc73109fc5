// SPDX-License-Identifier: MIT
#include "solver/distributed/shared_heat.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "solver/accuracy/check_heat.h"
#include "solver/core/text.h"
#include "solver/heat/diffuse.h"
#include "solver/heat/factor_memory.h"

namespace geotherm {
namespace {

/// Numbers at the edge of a block that differ by more than 2^this are solved for one after the
/// other: what comes of each must have room to fall within the range of doubles.
constexpr std::int32_t kBand = 350;
/// Columns that are solved together.
constexpr std::size_t kColumns = 16;
/// A block is solved again where a number at its edge has changed by more than this share. At a
/// diffusion length a ring it has fallen by e^-16 where it counts.
constexpr double kNews = 1e-6;
/// Rounds after which there is no end: heat passes a block in one or two.
constexpr int kMaxHeatRounds = 2000;
/// No row may be off by more than this share of its largest term.
constexpr double kWorstRow = 1e-4;
/// Levels of a HeatField, in powers of two.
constexpr std::int32_t kLevel = 900;

bool is_news(const WideNumber& now, const WideNumber& before) {
  if (now.mantissa == before.mantissa && now.exponent == before.exponent) return false;
  if (now.mantissa == 0 || before.mantissa == 0) return now.mantissa != before.mantissa;
  const std::int32_t reference = std::max(now.exponent, before.exponent);
  const double a = now.relative_to(reference), b = before.relative_to(reference);
  return !(std::abs(a - b) <= kNews * std::max(std::abs(a), std::abs(b)));
}

/// What a source gives: one unit of heat, in squares of the mean edge of all.
double heat_of_source(const SharedTask& task, const MeshBlock& block) {
  const double ratio = task.components.mean_edge / block.surface->unit;
  return ratio * ratio;
}

/// The rows of a block that are sources.
std::vector<Index> source_rows(const SharedTask& task, const MeshBlock& block) {
  std::vector<Index> rows;
  for (Index row = 0; row < block.surface->size(); ++row) {
    if (task.is_source[static_cast<std::size_t>(block.part_vertex(row))]) rows.push_back(row);
  }
  return rows;
}

/// One block and what it has heard.
class Listener {
 public:
  Listener(const SharedTask& task, const MeshBlock& block)
      : task_(task), block_(block), heard_(block.edge.size()) {
    for (const Index row : source_rows(task, block)) {
      if (!block.heat->matrix().is_held(row)) sources_.push_back(row);
    }
    has_news_ = !sources_.empty();
  }

  void listen(const std::vector<WideNumber>& u) {
    for (std::size_t k = 0; k < heard_.size() && !has_news_; ++k) {
      has_news_ = is_news(u[block_.part_vertex(block_.edge[k])], heard_[k]);
    }
  }
  bool has_news() const { return has_news_; }

  /// The exponent of the largest number that it would solve with: the nearest to a source.
  std::int32_t top(const std::vector<WideNumber>& u) const {
    std::int32_t top = sources_.empty() ? std::numeric_limits<std::int32_t>::min() : 1;
    for (const Index row : block_.edge) {
      const WideNumber& value = u[block_.part_vertex(row)];
      if (value.mantissa != 0) top = std::max(top, value.exponent);
    }
    return top;
  }

  /// Writes u of the own vertices.
  Result<void> solve(std::vector<WideNumber>& u) {
    has_news_ = false;
    const std::int32_t top = this->top(u);
    for (std::size_t k = 0; k < heard_.size(); ++k) {
      heard_[k] = u[block_.part_vertex(block_.edge[k])];
    }
    std::map<std::int32_t, std::vector<std::size_t>> bands;  // of heard_
    if (!sources_.empty()) bands[(top - 1) / kBand];
    for (std::size_t k = 0; k < heard_.size(); ++k) {
      if (heard_[k].mantissa != 0) bands[(top - heard_[k].exponent) / kBand].push_back(k);
    }
    for (Index here = 0; here < block_.own(); ++here) u[block_.vertex[here]] = {};
    while (!bands.empty()) {
      const auto count = static_cast<Eigen::Index>(std::min(bands.size(), kColumns));
      Block b = Block::Zero(block_.surface->size(), count);
      std::vector<std::int32_t> base;
      for (Eigen::Index c = 0; c < count; ++c) {
        const auto band = bands.begin();
        base.push_back(top - band->first * kBand);
        for (const std::size_t k : band->second) {
          b(block_.edge[k], c) = heard_[k].relative_to(base.back());
        }
        if (!sources_.empty() && band->first == (top - 1) / kBand) {
          for (const Index row : sources_) {
            b(row, c) = std::ldexp(heat_of_source(task_, block_), -base.back());
          }
        }
        bands.erase(band);
      }
      if (auto added = add_answers(std::move(b), base, u); !added) return added;
    }
    return {};
  }

 private:
  Result<void> add_answers(Block b, const std::vector<std::int32_t>& base,
                           std::vector<WideNumber>& u) {
    const Components& parts = block_.surface->operators->components;
    std::vector<std::vector<char>> reached;
    for (Eigen::Index c = 0; c < b.cols(); ++c) {
      auto& flags = reached.emplace_back(static_cast<std::size_t>(parts.count), 0);
      for (const Index row : block_.edge) {
        if (b(row, c) != 0) flags[parts.of[row]] = 1;
      }
      for (const Index row : sources_) {
        if (b(row, c) != 0) flags[parts.of[row]] = 1;
      }
    }
    BlockPool pool;
    const auto field = diffuse(*block_.heat, parts, std::move(b), sources_, reached, kDirectFloor,
                               {pool, task_.threads});
    if (!field) return field.error();
    const WideNumber step(field->step, 0);
    const Eigen::Index columns = field->u.cols();
    for (Index here = 0; here < block_.own(); ++here) {
      const Index row = block_.row(here);
      if (row == kNoIndex) continue;
      WideNumber& sum = u[block_.vertex[here]];
      for (Eigen::Index c = 0; c < columns; ++c) {
        const double value = field->u(row, c);
        if (std::abs(value) < kDirectFloor) continue;
        WideNumber wide(value, base[static_cast<std::size_t>(c)]);
        const int levels =
            field->level.empty() ? 0 : field->level[static_cast<std::size_t>(row * columns + c)];
        for (int l = 0; l < levels; ++l) {
          wide = {wide.mantissa * step.mantissa, wide.exponent + step.exponent};
        }
        sum = sum.plus(wide);
      }
    }
    return {};
  }

  const SharedTask& task_;
  const MeshBlock& block_;
  std::vector<WideNumber> heard_;  ///< at the edge, when it was solved last
  std::vector<Index> sources_;     ///< rows
  bool has_news_ = false;
};

/// Each block that has heard something new solves once, the nearest to a source first. The other
/// blocks of this rank hear its result at once, so that heat passes all of them in one round.
Result<void> solve_in_turn(std::vector<Listener>& listeners, std::vector<WideNumber>& u,
                           bool& any) {
  std::vector<Listener*> left;
  for (Listener& each : listeners) left.push_back(&each);
  for (;;) {
    Listener** next = nullptr;
    std::int32_t most = 0;
    for (Listener*& each : left) {
      each->listen(u);
      if (!each->has_news()) continue;
      const std::int32_t top = each->top(u);
      if (next == nullptr || top > most) next = &each, most = top;
    }
    if (next == nullptr) return {};
    any = true;
    if (auto done = (*next)->solve(u); !done) return done;
    left.erase(left.begin() + (next - left.data()));
  }
}

/// Vertices that others own and these rows need.
std::vector<Index> beyond(const MeshPart& part, const std::vector<char>& wanted) {
  std::vector<Index> out;
  for (Index v = part.own; v < part.size(); ++v) {
    if (wanted[v]) out.push_back(v);
  }
  return out;
}

/// Looks at every row. Errors: kNumericalFailure.
Result<void> check_rows(const SharedTask& task, std::span<const MeshBlock> blocks,
                        SharedHeat& heat) {
  double square = 0, given = 0, lost = 0, worst = 0;
  for (const MeshBlock& block : blocks) {
    if (!block.surface) continue;
    const double source = heat_of_source(task, block);
    for (Index here = 0; here < block.own(); ++here) {
      const Index row = block.row(here), v = block.vertex[here];
      if (row == kNoIndex || !task.reached[static_cast<std::size_t>(task.components.of[v])])
        continue;
      const WideNumber& own = heat.u[v];
      if (own.mantissa == 0) {
        ++lost;
        continue;
      }
      const double term = block.heat->matrix().diagonal()[row] * own.mantissa;
      double left = block.heat->matrix().product_at(row, [&](Index other) {
        return heat.u[block.part_vertex(other)].relative_to(own.exponent);
      });
      if (task.is_source[static_cast<std::size_t>(v)]) {
        left -= std::ldexp(source, -own.exponent);
        given += 1;
      }
      const double off = std::abs(left / term);
      worst = std::isfinite(off) ? std::max(worst, off) : kUnreached;
      const double absolute = std::ldexp(left, std::max(own.exponent, -1000)) / source;
      square += absolute * absolute;
    }
  }
  heat.row_residual = task.ranks.max(worst);
  heat.residual = std::sqrt(task.ranks.sum(square) / task.ranks.sum(given));
  lost = task.ranks.sum(lost);
  if (lost == 0 && heat.row_residual <= kWorstRow) return {};
  const std::string what =
      lost > 0 ? "heat does not reach " +
                     counted_text(static_cast<std::size_t>(lost), "vertex", "vertices") +
                     " that are joined to a source"
               : "a row of the heat step is off by " + rounded_text(heat.row_residual) +
                     " of its largest term, where " + rounded_text(kWorstRow) + " is allowed";
  return with_time_hint({ErrorCode::kNumericalFailure,
                         what,
                         {"try ", SettingHint{"laplacian", {"intrinsic-delaunay"}}, " and ",
                          SettingHint{"precision", {"full"}}}},
                        task.times.extreme, task.options.time_step.rule);
}

/// How far log u falls over each component.
void measure_extent(const SharedTask& task, SharedHeat& heat) {
  std::vector<double> ends(2 * task.components.sizes.size(), -kUnreached);  // high, and -low
  for (Index v = 0; v < task.part.own; ++v) {
    if (!(heat.u[v].mantissa > 0)) continue;
    const auto c = static_cast<std::size_t>(task.components.of[v]);
    const double log_u = heat.u[v].logarithm();
    ends[2 * c] = std::max(ends[2 * c], log_u);
    ends[2 * c + 1] = std::max(ends[2 * c + 1], -log_u);
  }
  task.ranks.all_reduce(ends, RankGroup::Reduction::kMax);
  for (std::size_t c = 0; c < task.components.sizes.size(); ++c) {
    heat.extent.push_back({ends[2 * c], -ends[2 * c + 1], task.components.sizes[c].area});
  }
}

}  // namespace

Result<void> factorise_blocks(const SharedTask& task, std::vector<MeshBlock>& blocks) {
  const auto factorise = [&]() -> Result<void> {
    for (MeshBlock& block : blocks) {
      if (!block.surface) continue;
      const double square = block.surface->unit * block.surface->unit;
      const PerComponent t(block.per_component(
          task.components, [&](Index c) { return task.times.t.of(c) / square; }));
      const PerComponent relative(
          block.per_component(task.components, [&](Index c) { return task.times.relative.of(c); }));
      auto system = LinearSystem::build(*block.surface, 1.0, t, block.held,
                                        {.threads = task.threads,
                                         .storage = heat_storage(task.options.precision),
                                         .memory = nullptr,
                                         .earlier = nullptr},
                                        consistent_share(task.options.variant, relative));
      if (!system) {
        return with_time_hint(system.error(), task.times.extreme, task.options.time_step.rule);
      }
      block.heat = (*system)->refined(task.options.precision == Precision::kRefined);
    }
    return {};
  };
  return task.ranks.agree(factorise());
}

Result<SharedHeat> diffuse_over_ranks(const SharedTask& task, std::span<const MeshBlock> blocks) {
  SharedHeat out;
  out.u.resize(static_cast<std::size_t>(task.part.size()));
  std::vector<Listener> listeners;
  std::vector<char> at_edge(out.u.size(), 0), beside(out.u.size(), 0);
  listeners.reserve(blocks.size());
  for (const MeshBlock& block : blocks) {
    if (!block.surface) continue;
    listeners.emplace_back(task, block);
    for (const Index row : block.edge) at_edge[block.part_vertex(row)] = 1;
    for (const Face& face : block.surface->operators->faces) {
      const bool own = std::ranges::any_of(
          face, [&](Index row) { return block.surface->vertex_of_row[row] < block.own(); });
      for (const Index row : face) {
        if (own) beside[block.part_vertex(row)] = 1;
      }
    }
  }
  const Halo edge(task.ranks, task.part, beyond(task.part, at_edge));
  for (;; ++out.rounds) {
    bool any = false;
    Result<void> done = solve_in_turn(listeners, out.u, any);
    if (done && out.rounds > kMaxHeatRounds) {
      done = Error{ErrorCode::kNumericalFailure,
                   "blocks of the heat step do not come to an end within " +
                       std::to_string(kMaxHeatRounds) + " rounds",
                   {"try ", SettingHint{"laplacian", {"intrinsic-delaunay"}}}};
    }
    if (auto all = task.ranks.agree(done); !all) {
      return with_time_hint(all.error(), task.times.extreme, task.options.time_step.rule);
    }
    if (task.ranks.max(any ? 1 : 0) == 0) break;
    edge.fetch(task.ranks, out.u);
  }
  out.beside = beyond(task.part, beside);
  Halo(task.ranks, task.part, out.beside).fetch(task.ranks, out.u);
  if (auto right = check_rows(task, blocks, out); !right) return right.error();
  measure_extent(task, out);
  return out;
}

SourceAnchors anchors_in(const SharedTask& task, const MeshBlock& block) {
  SourceSet set;
  for (const Index row : source_rows(task, block)) {
    set.points.push_back(SurfacePoint::at_vertex(block.surface->vertex_of_row[row]));
  }
  if (set.points.empty()) return {};
  auto placed = block.surface->place(set);
  return placed ? *std::move(placed) : SourceAnchors();  // vertices with a row have a place
}

std::shared_ptr<const Surface> faces_alone(const Surface& surface, bool analysis) {
  auto out = std::make_shared<Surface>();
  out->operators = surface.operators;
  if (analysis) out->analysis = surface.analysis;
  out->intrinsic.twin = surface.intrinsic.twin;
  out->is_delaunay = surface.is_delaunay;
  out->unit = surface.unit;
  out->vertex_of_row = surface.vertex_of_row;
  out->row_of_vertex = surface.row_of_vertex;
  return out;
}

BlockField field_of(const SharedTask& task, const SharedHeat& heat, const MeshBlock& block) {
  const Surface& surface = *block.surface;
  const double square = surface.unit * surface.unit;
  BlockField out;
  if (task.options.variant != Variant::kClassic) {
    out.t = PerComponent(
        block.per_component(task.components, [&](Index c) { return task.times.t.of(c) / square; }));
    out.extent = block.per_component(task.components, [&](Index c) {
      FaceField::Extent extent = heat.extent[static_cast<std::size_t>(c)];
      extent.area /= square;
      return extent;
    });
  }
  out.heat.step = std::ldexp(1.0, -kLevel);
  out.heat.u = Block::Zero(surface.size(), 1);
  std::int32_t top = std::numeric_limits<std::int32_t>::min();
  for (Index row = 0; row < surface.size(); ++row) {
    const WideNumber& u = heat.u[block.part_vertex(row)];
    if (u.mantissa != 0) top = std::max(top, u.exponent);
  }
  out.heat.level.assign(static_cast<std::size_t>(surface.size()), 0);
  for (Index row = 0; row < surface.size(); ++row) {
    const WideNumber& u = heat.u[block.part_vertex(row)];
    if (u.mantissa == 0) continue;
    const std::int32_t level = (top - u.exponent) / kLevel;
    out.heat.level[row] = static_cast<HeatField::Level>(level);
    out.heat.u(row, 0) = u.relative_to(top - level * kLevel);
  }
  return out;
}

}  // namespace geotherm
