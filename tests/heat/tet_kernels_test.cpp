// SPDX-License-Identifier: MIT
// The pass over the tets, compiled for each instruction set, against the definition of what it
// computes.
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <random>
#include <set>
#include <tuple>
#include <utility>
#include <vector>

#include "solver/heat/field_kernels.h"
#include "tests/support/compare.h"

namespace geotherm::test {
namespace {

// Roots by iteration to some units of the last digit, sums of a few terms in another order.
constexpr double kTetRoundOff = 1e-11;
constexpr double kTetRootT = 1.2;
constexpr int kVertices = 40;
constexpr Index kTets = 53;  // that fill no register to the end

class TetKernels : public testing::TestWithParam<std::tuple<int, InstructionSet>> {
 public:
  TetKernels() {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> exponent(-200, 0), place(0, 2);
    for (int v = 0; v < kVertices; ++v) {
      positions.emplace_back(place(random), place(random), place(random));
    }
    for (int e = 0; e < kVertices * group; ++e) {
      u.push_back(std::exp(exponent(random)));
      log_u.push_back(std::log(u.back()));
    }
    std::vector<Index> all(kVertices);
    for (Index v = 0; v < kVertices; ++v) all[v] = v;
    for (Index t = 0; t < kTets; ++t) {
      std::ranges::shuffle(all, random);
      corners.insert(corners.end(), all.begin(), all.begin() + 4);
      const Eigen::Matrix3d inverse = edges(t).inverse();  // its columns are the gradients
      for (int k = 0; k < 4; ++k) {
        const Vec3 g = k == 0 ? Vec3(-inverse.rowwise().sum()) : Vec3(inverse.col(k - 1));
        gradients.insert(gradients.end(), g.data(), g.data() + 3);
      }
      measures.push_back(std::abs(edges(t).determinant()) / 6);
    }
  }

  /// From corner 0 to the others, as rows.
  Eigen::Matrix3d edges(Index tet) const {
    Eigen::Matrix3d out;
    for (int k = 0; k < 3; ++k) {
      out.row(k) = positions[corners[4 * tet + k + 1]] - positions[corners[4 * tet]];
    }
    return out;
  }

  Vec3 gradient(Index tet, int column, const std::vector<double>& values) const {
    Vec3 difference;
    const auto at = [&](int k) { return values[corners[4 * tet + k] * group + column]; };
    for (int k = 0; k < 3; ++k) difference[k] = at(k + 1) - at(0);
    return edges(tet).inverse() * difference;
  }

  /// X of a tet.
  std::array<double, 3> field(Index tet, int column) const {
    const Vec3 slope = gradient(tet, column, log_u);
    const Vec3 places = edges(tet) * slope.normalized();
    const double extent = std::max(0.0, places.maxCoeff()) - std::min(0.0, places.minCoeff());
    const double length = front_length(extent, slope.norm(), kTetRootT, 1 / kTetRootT);
    const Vec3 x = -length * gradient(tet, column, u).stableNormalized();
    return {x[0], x[1], x[2]};
  }

  /// The divergence of tets from `first` on; notes which went the careful way.
  std::vector<double> run(Index first, const std::uint16_t* level) {
    std::vector<double> b(u.size(), 0.0);
    TetPass pass{};
    pass.corners = corners.data();
    pass.gradients = gradients.data();
    pass.measures = measures.data();
    pass.first = first;
    pass.end = kTets;
    pass.u = u.data();
    pass.log_u = log_u.data();
    pass.level = level;
    pass.b = b.data();
    pass.stride = group;
    pass.root_t = kTetRootT;
    pass.context = this;
    pass.careful = [](const void* context, Index tet, int column) {
      auto& self = *static_cast<TetKernels*>(const_cast<void*>(context));
      self.careful.insert({tet, column});
      return self.field(tet, column);
    };
    add_tet_divergence(pass, group, std::get<1>(GetParam()));
    return b;
  }

  const int group = std::get<0>(GetParam());
  std::vector<Vec3> positions;
  std::vector<Index> corners;
  std::vector<double> gradients, measures, u, log_u;
  std::set<std::pair<Index, int>> careful;
};

TEST_P(TetKernels, ComputeTheDivergenceOfTheField) {
  const Index first = 5;  // begins no register
  std::vector<double> expected(u.size(), 0.0);
  for (Index t = first; t < kTets; ++t) {
    for (int c = 0; c < group; ++c) {
      const auto x = field(t, c);
      for (int k = 0; k < 4; ++k) {
        const double* const g = gradients.data() + 12 * t + 3 * k;
        expected[static_cast<std::size_t>(corners[4 * t + k] * group + c)] +=
            measures[t] * (x[0] * g[0] + x[1] * g[1] + x[2] * g[2]);
      }
    }
  }
  EXPECT_LE(relative_difference(run(first, nullptr), expected), kTetRoundOff);
}

TEST_P(TetKernels, SendTetsWithoutADirectionOrWithSeveralExponentsTheCarefulWay) {
  const int column = group - 1;
  for (int v = 0; v < kVertices; ++v) {
    u[static_cast<std::size_t>(v * group + column)] = v < 20 ? 0.5 : 0.1;
  }
  std::vector<std::uint16_t> level(u.size(), 3);
  level[static_cast<std::size_t>(30 * group)] = 2;
  run(0, level.data());
  for (Index t = 0; t < kTets / 16 * 16; ++t) {
    int warm = 0;
    bool mixed = false;
    for (int k = 0; k < 4; ++k) {
      warm += corners[4 * t + k] < 20;
      mixed |= corners[4 * t + k] == 30;
    }
    EXPECT_EQ(careful.contains({t, column}), mixed || warm == 0 || warm == 4) << t;
  }
}

INSTANTIATE_TEST_SUITE_P(Sets, TetKernels,
                         testing::Combine(testing::Values(1, 2, 4, 8, 16),
                                          testing::Values(InstructionSet::kPlain,
                                                          InstructionSet::kAvx2,
                                                          InstructionSet::kAvx512)));

}  // namespace
}  // namespace geotherm::test
