// SPDX-License-Identifier: MIT
// What compact factors lose, and what refinement brings back. No backend of every build keeps
// factors compact, so one is added whose compact solves are off by a share of each entry.
#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <utility>

#include "geotherm/backend.h"
#include "tests/support/shapes.h"
#include "tests/support/solve.h"

namespace geotherm::test {
namespace {

/// What a compact solve is off by, relative to each entry: as in half of a double.
constexpr double kRounding = 1e-6;
/// Distances are off by a share of that, and refined ones by its square, which residuals multiply
/// by the number of edges across.
constexpr double kSpoilt = 1e-8;
constexpr double kRefined = 1e-9;

/// What was factored.
struct Counts {
  std::atomic<int> full{0}, single{0}, wide{0};
};

/// Between -1 and 1, and no pattern to speak of.
double noise(Eigen::Index i) { return std::sin(12.9898 * static_cast<double>(i + 1)); }

class RoughFactorization final : public Factorization {
 public:
  RoughFactorization(std::unique_ptr<Factorization> inner, double rounding)
      : inner_(std::move(inner)), rounding_(rounding) {}
  Result<SolveReport> solve(Block& x, std::span<const Index> support, const Progress& progress,
                            int threads) const override {
    auto done = inner_->solve(x, support, progress, threads);
    for (Eigen::Index i = 0; i < x.rows(); ++i) x.row(i) *= 1 + rounding_ * noise(i);
    return done;
  }
  Result<Eigen::MatrixXd> inverse_entries(std::span<const Index> rows) const override {
    auto entries = inner_->inverse_entries(rows);
    if (!entries) return entries;
    for (Eigen::Index i = 0; i < entries->rows(); ++i) {
      for (Eigen::Index j = 0; j < entries->cols(); ++j) {
        (*entries)(i, j) *= 1 + rounding_ * noise(i + j);
      }
    }
    return entries;
  }
  FactorStats stats() const override { return inner_->stats(); }
  Index size() const override { return inner_->size(); }

 private:
  std::unique_ptr<Factorization> inner_;
  double rounding_;
};

class RoughAnalysis final : public Analysis {
 public:
  RoughAnalysis(std::shared_ptr<const Analysis> inner, Counts& counts)
      : inner_(std::move(inner)), counts_(counts) {}
  std::span<const Index> order() const override { return inner_->order(); }
  Result<std::unique_ptr<Factorization>> factorize(std::shared_ptr<const SymmetricOperator> matrix,
                                                   const FactorOptions& options) const override {
    ++(options.storage == FactorStorage::kFull     ? counts_.full
       : options.storage == FactorStorage::kSingle ? counts_.single
                                                   : counts_.wide);
    auto made = inner_->factorize(std::move(matrix), options);
    if (!made) return made;
    return std::unique_ptr<Factorization>(std::make_unique<RoughFactorization>(
        *std::move(made), options.storage == FactorStorage::kFull ? 0.0 : kRounding));
  }

 private:
  std::shared_ptr<const Analysis> inner_;
  Counts& counts_;
};

class RoughBackend final : public Backend {
 public:
  RoughBackend(const Backend& inner, Counts& counts) : inner_(inner), counts_(counts) {}
  std::string_view name() const override { return "rough"; }
  std::string_view description() const override { return "rounds what is compact"; }
  Result<std::shared_ptr<const Analysis>> analyze(const SymmetricPattern& pattern,
                                                  std::span<const Vec3> positions,
                                                  int threads) const override {
    auto made = inner_.analyze(pattern, positions, threads);
    if (!made) return made;
    return std::shared_ptr<const Analysis>(
        std::make_shared<RoughAnalysis>(*std::move(made), counts_));
  }

 private:
  const Backend& inner_;
  Counts& counts_;
};

HeatOptions rough(Precision precision, HeatOptions options = {}) {
  options.backend = "rough";
  options.strict = true;
  options.precision = precision;
  return options;
}

class PrecisionOf : public testing::Test {
 protected:
  Counts counts;
  AddedBackend added{
      std::make_unique<RoughBackend>(**find_backend(direct_backends().back()), counts)};
};

struct PrecisionCase {
  const char* name;
  void (*set)(HeatOptions&);
  bool far = false;  ///< on a strip whose heat needs restarts
};

const PrecisionCase kPrecisionCases[] = {
    {"default", [](HeatOptions&) {}},
    {"far", [](HeatOptions&) {}, true},
    {"hold", [](HeatOptions& o) { o.heat = HeatMode::kHold; }},
    {"hold_far", [](HeatOptions& o) { o.heat = HeatMode::kHold; }, true},
    {"dirichlet", [](HeatOptions& o) { o.boundary = BoundaryRule::kDirichlet; }},
    {"average", [](HeatOptions& o) { o.boundary = BoundaryRule::kAverage; }},
    {"pin_vertex", [](HeatOptions& o) { o.constraint.mode = ConstraintMode::kPinVertex; }},
    {"conserve_energy",
     [](HeatOptions& o) { o.constraint.mode = ConstraintMode::kConserveEnergy; }},
    {"pseudo_inverse", [](HeatOptions& o) { o.constraint.mode = ConstraintMode::kPseudoInverse; }},
};

void PrintTo(const PrecisionCase& c, std::ostream* out) { *out << c.name; }

class RefinedPrecision : public PrecisionOf, public testing::WithParamInterface<PrecisionCase> {
 protected:
  // The strip is 1,500 edges long: the heat ends at 735.
  MeshPtr mesh =
      GetParam().far ? finish(plane_grid(1500, 3, 1500, 3)) : finish(jittered_plane(24, 0.35, 4));
  std::vector<double> distances(Precision precision) const {
    HeatOptions options = rough(precision);
    GetParam().set(options);
    return solve(mesh, {0, 100, mesh->vertex_count() / 2}, options).distances;
  }
};

TEST_P(RefinedPrecision, BringsBackWhatCompactFactorsLose) {
  const std::vector<double> full = distances(Precision::kFull);
  EXPECT_GE(relative_difference(distances(Precision::kCompact), full), kSpoilt);
  EXPECT_LE(relative_difference(distances(Precision::kRefined), full), kRefined);
}

INSTANTIATE_TEST_SUITE_P(Cases, RefinedPrecision, testing::ValuesIn(kPrecisionCases),
                         [](const auto& each) { return each.param.name; });

TEST_F(PrecisionOf, AMethodSaysHowItsFactorsAreKept) {
  const MeshPtr mesh = finish(jittered_plane(12, 0.3, 1));
  method_of(mesh, rough(Precision::kCompact));
  EXPECT_EQ(counts.single, 1);
  EXPECT_EQ(counts.wide, 1);
  EXPECT_EQ(counts.full, 0);
  method_of(mesh, rough(Precision::kFull));
  EXPECT_EQ(counts.full, 2);
}

TEST_F(PrecisionOf, AChangeFactorsAgainOnlyWhereTheStorageChanges) {
  const MeshPtr mesh = finish(jittered_plane(12, 0.3, 1));
  const HeatMethod compact = method_of(mesh, rough(Precision::kCompact));
  const auto refined = compact.with(rough(Precision::kRefined));
  ASSERT_TRUE(refined) << refined.error().message;
  EXPECT_EQ(counts.single + counts.wide + counts.full, 2);
  ASSERT_TRUE(refined->with(rough(Precision::kFull)));
  EXPECT_EQ(counts.single + counts.wide, 2);
  EXPECT_EQ(counts.full, 2);
}

TEST(Precision, IsNothingToIterativeBackends) {
  const MeshPtr mesh = finish(jittered_plane(16, 0.3, 1));
  for (const std::string& name : iterative_backends()) {
    HeatOptions options = with_backend(name);
    const auto compact = solve(mesh, {3, 50}, options).distances;
    options.precision = Precision::kRefined;
    EXPECT_EQ(solve(mesh, {3, 50}, options).distances, compact) << name;
    options.precision = Precision::kFull;
    EXPECT_EQ(solve(mesh, {3, 50}, options).distances, compact) << name;
  }
}

}  // namespace
}  // namespace geotherm::test
