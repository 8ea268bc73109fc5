// SPDX-License-Identifier: MIT
#include "bench/measure.h"

#include <gtest/gtest.h>

#include <cmath>

#include "bench/bench_mesh.h"
#include "solver/geometry/fem_operator.h"
#include "solver/heat/surface.h"
#include "solver/linear/elimination_tree.h"

namespace geotherm::test {
namespace {

class RatesOfBackend : public ::testing::TestWithParam<std::string> {};

TEST_P(RatesOfBackend, AreAboveZeroWhereItFactorises) {
  const auto mesh = std::make_shared<const TriangleMesh>(*bench::make_mesh("torus", 4000));
  const auto rates = bench::measure_rates(mesh, GetParam(), 2, 0);
  ASSERT_TRUE(rates) << rates.error().message;
  if ((*find_backend(GetParam()))->iterative()) {
    EXPECT_TRUE(std::isnan(rates->factor_gflops));
    EXPECT_TRUE(std::isnan(rates->solve_gbs));
    return;
  }
  EXPECT_TRUE(rates->factor_gflops > 0 && std::isfinite(rates->factor_gflops));
  EXPECT_TRUE(rates->solve_gbs > 0 && std::isfinite(rates->solve_gbs));
  EXPECT_GT(rates->factor_bytes, 0);
}

/// A backend may store zeros and work on them, so it may count more than there must be, though not
/// many times more.
TEST_P(RatesOfBackend, CountTheOperationsOfTheColumns) {
  const auto mesh = std::make_shared<const TriangleMesh>(*bench::make_mesh("torus", 4000));
  const Backend& backend = **find_backend(GetParam());
  const auto surface = build_surface(mesh, backend, LaplacianKind::kCotan, 1);
  ASSERT_TRUE(surface);
  const auto& operators = (*surface)->operators;
  const auto factor =
      (*surface)->analysis->factorize(std::make_shared<const FemOperator>(operators, 1.0, 1.0), {});
  ASSERT_TRUE(factor);
  const auto operations = static_cast<double>((*factor)->stats().operations);
  if (backend.iterative()) {
    EXPECT_EQ(operations, 0);
    return;
  }
  const SymmetricPattern pattern = pattern_of_faces(operators->size(), operators->faces);
  double least = 0;
  for (const double below : count_columns(pattern).below) least += (below + 1) * (below + 1);
  EXPECT_GE(operations, least * 0.999);
  EXPECT_LE(operations, least * 3);
}

INSTANTIATE_TEST_SUITE_P(Backends, RatesOfBackend, ::testing::ValuesIn(backend_names()),
                         [](const auto& backend) {
                           std::string name = backend.param;
                           std::erase(name, '-');
                           return name;
                         });

TEST(RatesOfBackend, ThatDoesNotExistIsAnError) {
  const auto mesh = std::make_shared<const TriangleMesh>(*bench::make_mesh("torus", 400));
  EXPECT_FALSE(bench::measure_rates(mesh, "no-such-backend", 1, 0));
}

}  // namespace
}  // namespace geotherm::test
