// SPDX-License-Identifier: MIT
#include "bench/measure.h"

#include <algorithm>
#include <cmath>

#include "bench/resident_memory.h"
#include "solver/core/stopwatch.h"

namespace geotherm::bench {
namespace {

/// Queries of one contender in a row before the next has its turn: its factor is then in the cache
/// as far as it fits, as it is for somebody who asks several times.
constexpr int kQueriesPerTurn = 3;

/// A batch is left out where it would take longer than this.
constexpr double kLongestBatchMs = 30'000;

double median(std::vector<double> values) {
  if (values.empty()) return kNotMeasured;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  if (values.size() % 2 == 1) return *middle;
  return (*middle + *std::max_element(values.begin(), middle)) / 2;
}

class Times {
 public:
  void add(double milliseconds) {
    values_.push_back(milliseconds);
    total_ += milliseconds;
  }
  void give_up() { given_up_ = true; }
  bool enough(const Budget& budget) const {
    return given_up_ || total_ >= budget.most_milliseconds ||
           (total_ >= budget.milliseconds && values_.size() >= budget.least);
  }
  double typical() const { return median(values_); }

 private:
  std::vector<double> values_;
  double total_ = 0;
  bool given_up_ = false;
};

/// Calls turn(contender, its times), round after round, until all have enough. A turn that fails
/// is the contender's last.
template <class Turn>
std::vector<Times> take_turns(std::span<const std::unique_ptr<Contender>> contenders,
                              std::span<Figures> figures, const Budget& budget, Turn&& turn) {
  std::vector<Times> times(contenders.size());
  for (bool active = true; active;) {
    active = false;
    for (std::size_t c = 0; c < contenders.size(); ++c) {
      if (!figures[c].failure.empty() || times[c].enough(budget)) continue;
      if (const Result<void> done = turn(c, times[c]); !done) {
        figures[c].failure = done.error().message;
        continue;
      }
      active = true;
    }
  }
  return times;
}

}  // namespace

std::vector<Figures> measure(std::shared_ptr<const TriangleMesh> mesh,
                             std::span<const std::unique_ptr<Contender>> contenders,
                             std::span<const Index> sources, const Effort& effort, const Say& say) {
  std::vector<Figures> figures(contenders.size());
  for (std::size_t c = 0; c < contenders.size(); ++c) figures[c].name = contenders[c]->name();

  const auto setups = take_turns(contenders, figures, effort.setup,
                                 [&](std::size_t c, Times& times) -> Result<void> {
                                   say("set-up of " + figures[c].name);
                                   contenders[c]->drop();
                                   const PeakMemory peak;
                                   const Stopwatch watch;
                                   if (auto done = contenders[c]->set_up(mesh); !done) return done;
                                   times.add(watch.milliseconds());
                                   if (!std::isnan(figures[c].peak_mb)) return {};
                                   if (auto first = contenders[c]->query(sources[0]); !first)
                                     return first.error();
                                   figures[c].peak_mb = peak.megabytes();
                                   figures[c].factor_mb = contenders[c]->factor_mb();
                                   return {};
                                 });

  std::vector<std::size_t> asked(contenders.size(), 0);
  const auto queries = take_turns(
      contenders, figures, effort.query, [&](std::size_t c, Times& times) -> Result<void> {
        say("queries to " + figures[c].name);
        for (int k = 0; k < kQueriesPerTurn && !times.enough(effort.query); ++k) {
          const Index source = sources[asked[c]++ % sources.size()];
          const Stopwatch watch;
          if (auto answer = contenders[c]->query(source); !answer) return answer.error();
          times.add(watch.milliseconds());
        }
        return {};
      });

  const auto count = static_cast<double>(sources.size());
  const auto batches = take_turns(
      contenders, figures, effort.batch, [&](std::size_t c, Times& times) -> Result<void> {
        if (queries[c].typical() * count > kLongestBatchMs) {
          times.give_up();
          return {};
        }
        say("batch of " + std::to_string(sources.size()) + " to " + figures[c].name);
        const Stopwatch watch;
        if (auto done = contenders[c]->batch(sources); !done) return done;
        times.add(watch.milliseconds());
        return {};
      });

  for (std::size_t c = 0; c < contenders.size(); ++c) {
    figures[c].setup_ms = setups[c].typical();
    figures[c].query_ms = queries[c].typical();
    figures[c].batch_ms_per_source = batches[c].typical() / count;
  }
  return figures;
}

}  // namespace geotherm::bench
