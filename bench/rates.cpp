// SPDX-License-Identifier: MIT
#include "bench/rates.h"

#include <algorithm>
#include <limits>

#include "geotherm/backend.h"
#include "solver/core/parallel.h"
#include "solver/core/stopwatch.h"
#include "solver/geometry/fem_operator.h"
#include "solver/heat/surface.h"

namespace geotherm::bench {
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
