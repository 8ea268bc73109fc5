// SPDX-License-Identifier: MIT
#include "bench/measure.h"

#include <algorithm>
#include <cmath>

#include "bench/resident_memory.h"
#include "solver/core/stopwatch.h"

namespace geotherm::bench {
namespace {

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

}  // namespace geotherm::bench
