// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <limits>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "geotherm/error.h"
#include "geotherm/mesh.h"

namespace geotherm::bench {

/// One way to get geodesic distance, as the benchmark drives it: set up once for a mesh, then ask.
class Contender {
 public:
  virtual ~Contender() = default;

  virtual std::string name() const = 0;

  /// Not another method that answers the same question.
  virtual bool heat_method() const { return true; }

  /// Everything between a mesh in memory and the first query ready. Replaces an earlier set-up.
  virtual Result<void> set_up(std::shared_ptr<const TriangleMesh> mesh) = 0;

  /// Frees what set_up() made.
  virtual void drop() = 0;

  /// Distances to one vertex.
  virtual Result<std::vector<double>> query(Index source) = 0;

  /// Distances to each of the sources, by the fastest way there is.
  virtual Result<void> batch(std::span<const Index> sources) = 0;

  /// Memory of all factors, in 2^20 bytes.
  virtual double factor_mb() const = 0;
};

/// geotherm with this backend of the heat method, or with another method, and default options.
/// `threads` 0: all cores.
std::unique_ptr<Contender> make_contender(std::string name, int threads);

/// What the backends are held against; null in a build without CHOLMOD.
std::unique_ptr<Contender> make_baseline_contender();

inline constexpr const char* kBaseline = "baseline";

inline constexpr double kNotMeasured = std::numeric_limits<double>::quiet_NaN();

/// kNotMeasured where there are no values.
double median(std::vector<double> values);

/// The largest difference over the largest of `ours`, where these are finite.
double relative_difference(std::span<const double> ours, std::span<const double> theirs);

/// How the two layers below the heat method do: figures of the best attempt.
struct Rates {
  double factor_gflops = kNotMeasured;  ///< 10^9 operations a second, both matrices side by side
  double solve_gbs = kNotMeasured;      ///< 10^9 bytes of a factor read a second, dense right side
  double factor_bytes = kNotMeasured;   ///< that one pass of that solve reads
  std::string failure = {};             ///< why there are none; empty: none failed
};

/// What one contender did on one mesh. Times are medians.
struct Figures {
  std::string name;
  bool heat_method = true;  ///< with one of its backends, or the baseline
  double setup_ms = kNotMeasured;
  double query_ms = kNotMeasured;
  double batch_ms_per_source = kNotMeasured;
  double factor_mb = kNotMeasured;
  double peak_mb = kNotMeasured;  ///< of set-up and first query, mesh not counted
  Rates rates = {};               ///< of backends that factorise
  std::string failure = {};       ///< empty: none
  std::string not_run = {};       ///< why it was left out; empty: it was not
};

/// How long a measurement may take: one contender repeats until it has used `milliseconds` and has
/// `least` results, or has used `most_milliseconds`, whatever comes first.
struct Budget {
  double milliseconds;
  std::size_t least;
  double most_milliseconds;
};

struct Effort {
  Budget setup, query;
  Budget batch;  ///< left out where single queries say that one would take longer than the most
};

using Say = std::function<void(std::string_view)>;

/// Queries of one contender in a row before the next has its turn: its factor is then in the cache
/// as far as it fits, as it is for somebody who asks several times.
inline constexpr int kQueriesPerTurn = 3;

/// Called with the number of a contender and its first answer, to the first source.
using OnAnswer = std::function<void(std::size_t, const std::vector<double>&)>;

struct Race {
  std::shared_ptr<const TriangleMesh> mesh;
  std::span<const std::unique_ptr<Contender>> contenders;
  std::span<const Index> sources;
  Effort effort;
  /// Only one contender is set up at a time, for meshes where all would not fit into memory.
  bool one_at_a_time = false;
};

/// Measures all contenders on one mesh, taking turns, so that a change of the machine's pace meets
/// them alike. With one at a time they take turns in their set-ups; each is asked after its last.
/// All are dropped in the end. Figures are in the order of the contenders.
std::vector<Figures> measure(const Race& race, const Say& say, const OnAnswer& on_answer = {});

/// How fast a backend factorises and reads its factors, apart from everything around it: the
/// numeric factorisations of A + t L and of L with one row held, side by side as HeatMethod makes
/// them, and solves of the second with a dense right side. Best of as many attempts as fit into
/// `milliseconds`, one at least. Assembly of the matrices is not counted. Empty figures for a
/// backend that is iterative or does not count its operations. Cost: one analysis more.
/// Errors: the backend's.
Result<Rates> measure_rates(std::shared_ptr<const TriangleMesh> mesh, const std::string& backend,
                            int threads, double milliseconds);

/// How much more memory the process had at its peak than when this was made, in 2^20 bytes.
/// 0 where the system does not tell, or lets no peak begin anew.
class PeakMemory {
 public:
  PeakMemory();
  double megabytes() const;

 private:
  double before_ = std::numeric_limits<double>::infinity();
};

}  // namespace geotherm::bench
