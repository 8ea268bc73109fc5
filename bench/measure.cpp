// SPDX-License-Identifier: MIT
#include "bench/measure.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <sstream>
#include <string>

#include "geotherm/backend.h"
#include "solver/core/memory.h"
#include "solver/core/parallel.h"
#include "solver/core/stopwatch.h"
#include "solver/geometry/fem_operator.h"
#include "solver/heat/surface.h"

namespace geotherm::bench {
namespace {

/// A line of /proc/self/status that holds kilobytes, in 2^20 bytes; 0 where there is none.
double status_megabytes(const std::string& key) {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);) {
    if (!line.starts_with(key)) continue;
    std::istringstream rest(line.substr(key.size()));
    double kilobytes = 0;
    rest >> kilobytes;
    return kilobytes / 1024;
  }
  return 0;
}

}  // namespace

PeakMemory::PeakMemory() {
  release_freed_memory();  // must not serve what is measured
  std::ofstream refs("/proc/self/clear_refs");
  if (refs << 5 << std::flush) before_ = status_megabytes("VmRSS:");  // the peak starts anew
}

double PeakMemory::megabytes() const { return std::max(0.0, status_megabytes("VmHWM:") - before_); }

double median(std::vector<double> values) {
  if (values.empty()) return kNotMeasured;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  if (values.size() % 2 == 1) return *middle;
  return (*middle + *std::max_element(values.begin(), middle)) / 2;
}

double relative_difference(std::span<const double> ours, std::span<const double> theirs) {
  double largest = 0, difference = 0;
  for (std::size_t v = 0; v < ours.size(); ++v) {
    if (!std::isfinite(ours[v])) continue;
    largest = std::max(largest, ours[v]);
    difference = std::max(difference, std::abs(ours[v] - theirs[v]));
  }
  return difference / largest;
}

namespace {

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

/// Its times, of one kind each.
struct Lap {
  Times setup, query, batch;
  std::size_t asked = 0;
};

class Running {
 public:
  Running(const Race& race, const Say& say, const OnAnswer& on_answer)
      : race_(race),
        say_(say),
        on_answer_(on_answer),
        laps_(race.contenders.size()),
        figures_(race.contenders.size()) {
    for (std::size_t c = 0; c < figures_.size(); ++c) {
      figures_[c].name = race.contenders[c]->name();
      figures_[c].heat_method = race.contenders[c]->heat_method();
    }
  }

  /// Everybody's set-ups, then everybody's queries, then the batches.
  void all_together() {
    rounds(&Lap::setup, race_.effort.setup, [this](std::size_t c) { return set_up(c); });
    rounds(&Lap::query, race_.effort.query, [this](std::size_t c) { return ask(c); });
    rounds(&Lap::batch, race_.effort.batch, [this](std::size_t c) { return ask_batch(c); });
    for (const auto& contender : race_.contenders) contender->drop();
  }

  void one_at_a_time() {
    rounds(&Lap::setup, race_.effort.setup, [this](std::size_t c) {
      auto done = set_up(c);
      const Lap& lap = laps_[c];
      while (done && lap.setup.enough(race_.effort.setup)) {
        if (!lap.query.enough(race_.effort.query)) {
          done = ask(c);
        } else if (!lap.batch.enough(race_.effort.batch)) {
          done = ask_batch(c);
        } else {
          break;
        }
      }
      race_.contenders[c]->drop();
      return done;
    });
  }

  std::vector<Figures> finish() {
    const auto count = static_cast<double>(race_.sources.size());
    for (std::size_t c = 0; c < figures_.size(); ++c) {
      figures_[c].setup_ms = laps_[c].setup.typical();
      figures_[c].query_ms = laps_[c].query.typical();
      figures_[c].batch_ms_per_source = laps_[c].batch.typical() / count;
    }
    return std::move(figures_);
  }

 private:
  /// Round after round, until all have enough. A turn that fails is the contender's last.
  template <class Turn>
  void rounds(Times Lap::*times, const Budget& budget, Turn&& turn) {
    for (bool active = true; active;) {
      active = false;
      for (std::size_t c = 0; c < laps_.size(); ++c) {
        if (!figures_[c].failure.empty() || (laps_[c].*times).enough(budget)) continue;
        if (const Result<void> done = turn(c); !done) {
          figures_[c].failure = sentence(done.error());
          continue;
        }
        active = true;
      }
    }
  }

  Result<void> set_up(std::size_t c) {
    say_("set-up of " + figures_[c].name);
    Contender& contender = *race_.contenders[c];
    contender.drop();
    const PeakMemory peak;
    const Stopwatch watch;
    if (auto done = contender.set_up(race_.mesh); !done) return done;
    laps_[c].setup.add(watch.milliseconds());
    if (!std::isnan(figures_[c].peak_mb)) return {};
    const auto first = contender.query(race_.sources[0]);
    if (!first) return first.error();
    figures_[c].peak_mb = peak.megabytes();
    figures_[c].factor_mb = contender.factor_mb();
    if (on_answer_) on_answer_(c, *first);
    return {};
  }

  Result<void> ask(std::size_t c) {
    say_("queries to " + figures_[c].name);
    Lap& lap = laps_[c];
    for (int k = 0; k < kQueriesPerTurn && !lap.query.enough(race_.effort.query); ++k) {
      const Index source = race_.sources[lap.asked++ % race_.sources.size()];
      const Stopwatch watch;
      if (auto answer = race_.contenders[c]->query(source); !answer) return answer.error();
      lap.query.add(watch.milliseconds());
    }
    return {};
  }

  Result<void> ask_batch(std::size_t c) {
    const auto count = static_cast<double>(race_.sources.size());
    if (laps_[c].query.typical() * count > race_.effort.batch.most_milliseconds) {
      laps_[c].batch.give_up();
      return {};
    }
    say_("batch of " + std::to_string(race_.sources.size()) + " to " + figures_[c].name);
    const Stopwatch watch;
    if (auto done = race_.contenders[c]->batch(race_.sources); !done) return done;
    laps_[c].batch.add(watch.milliseconds());
    return {};
  }

  const Race& race_;
  const Say& say_;
  const OnAnswer& on_answer_;
  std::vector<Lap> laps_;
  std::vector<Figures> figures_;
};

}  // namespace

std::vector<Figures> measure(const Race& race, const Say& say, const OnAnswer& on_answer) {
  Running running(race, say, on_answer);
  if (race.one_at_a_time) {
    running.one_at_a_time();
  } else {
    running.all_together();
  }
  return running.finish();
}

namespace {

/// One of the two matrices, and how HeatStep and PoissonSolver keep its factor.
struct Side {
  std::shared_ptr<const FemOperator> matrix;
  FactorOptions options;
  Result<std::unique_ptr<Factorization>> factor = std::unique_ptr<Factorization>();
};

/// Milliseconds of the quickest of the attempts that fit into `budget`; the first error ends them.
template <class Attempt>
Result<double> least_time(double budget, Attempt&& attempt) {
  const Stopwatch all;
  double least = std::numeric_limits<double>::infinity();
  do {
    const Result<double> elapsed = attempt();
    if (!elapsed) return elapsed.error();
    least = std::min(least, *elapsed);
  } while (all.milliseconds() < budget);
  return least;
}

/// The last row of each component, as the heat method holds them: without them L is singular.
std::vector<Index> pins(const OperatorMesh& mesh) {
  std::vector<Index> out(static_cast<std::size_t>(mesh.components.count));
  for (Index row = 0; row < mesh.size(); ++row) out[mesh.components.of[row]] = row;
  return out;
}

Result<double> factorise(const Analysis& analysis, Side& heat, Side& poisson, int threads) {
  heat.factor = std::unique_ptr<Factorization>();  // the last attempt's go first
  poisson.factor = std::unique_ptr<Factorization>();
  const Stopwatch watch;
  run_both(
      threads, [&] { heat.factor = analysis.factorize(heat.matrix, heat.options); },
      [&] { poisson.factor = analysis.factorize(poisson.matrix, poisson.options); });
  const double elapsed = watch.milliseconds();
  if (!heat.factor) return heat.factor.error();
  if (!poisson.factor) return poisson.factor.error();
  return elapsed;
}

Result<double> solve(const Factorization& factor, const Block& b, int threads) {
  Block x = b;
  const Stopwatch watch;
  if (const auto solved = factor.solve(x, {}, {}, threads); !solved) return solved.error();
  return watch.milliseconds();
}

}  // namespace

Result<Rates> measure_rates(std::shared_ptr<const TriangleMesh> mesh, const std::string& backend,
                            int threads, double milliseconds) {
  const auto found = find_backend(backend);
  if (!found) return found.error();
  if ((*found)->iterative()) return Rates{};
  const auto surface = build_surface(std::move(mesh), **found, LaplacianKind::kAuto, threads);
  if (!surface) return surface.error();
  const Analysis& analysis = *(*surface)->analysis;
  const auto& operators = (*surface)->operators;

  constexpr double kTime = 1;  // h^2: the intrinsic mesh's mean edge is 1
  Side heat{.matrix = std::make_shared<const FemOperator>(operators, 1.0, kTime),
            .options = {std::max(1, threads / 2), FactorStorage::kWideExponent}};
  Side poisson{.matrix = std::make_shared<const FemOperator>(operators, 0.0, 1.0, pins(*operators)),
               .options = {std::max(1, threads - threads / 2), FactorStorage::kSingle}};
  heat.matrix->assembled();
  poisson.matrix->assembled();

  const auto factor_ms =
      least_time(milliseconds, [&] { return factorise(analysis, heat, poisson, threads); });
  if (!factor_ms) return factor_ms.error();
  const FactorStats heat_stats = (*heat.factor)->stats();
  const FactorStats stats = (*poisson.factor)->stats();
  heat.factor = std::unique_ptr<Factorization>();

  Rates rates;
  const auto operations = static_cast<double>(heat_stats.operations + stats.operations);
  if (operations > 0) rates.factor_gflops = operations / *factor_ms * 1e-6;
  if (stats.bytes <= 0) return rates;
  const Block b = Block::Ones(operators->size(), 1);
  ThreadCrew crew(threads);  // as in a query
  const auto solve_ms =
      least_time(milliseconds, [&] { return solve(**poisson.factor, b, threads); });
  if (!solve_ms) return solve_ms.error();
  rates.factor_bytes = static_cast<double>(stats.bytes);
  rates.solve_gbs = 2 * rates.factor_bytes / *solve_ms * 1e-6;  // forward and backward
  return rates;
}

}  // namespace geotherm::bench
