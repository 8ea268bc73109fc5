// SPDX-License-Identifier: MIT
// The loops compiled for each instruction set, against the definition of what they compute.
#include "solver/linear/solve_kernels.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <random>
#include <tuple>
#include <vector>

#include "tests/linear/backend_fixture.h"

namespace geotherm::test {
namespace {

// Sums of up to 60 terms of order 1 in another order, divided by pivots of order 1.
constexpr double kSolveRoundOff = 1e-12;
constexpr Index kRows = 60;

/// A random supernode: `width` columns from row 3 on, and `under` rows below them.
struct RandomPanel {
  RandomPanel(Index width, Index under, bool padded, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> entry(-0.3, 0.3), pivot(1, 2);
    for (Index r = 0; r < kRows - 3 - width; ++r) rows.push_back(3 + width + r);
    std::shuffle(rows.begin(), rows.end(), random);
    rows.resize(static_cast<std::size_t>(under));
    std::sort(rows.begin(), rows.end());
    const Index height = width + under;
    for (Index c = 0; c < width; ++c) {
      for (Index r = 0; r < height; ++r) data.push_back(r == c ? pivot(random) : entry(random));
    }
    for (Index c = 0; c < width; ++c) inverse_diagonal.push_back(1 / data[c * height + c]);
    // What stands behind the panel must not matter.
    if (padded) data.insert(data.end(), kPanelPadding, 1e100);
    panel = {3, width, height, rows.data(), data.data(), inverse_diagonal.data(), padded};
  }
  RandomPanel(const RandomPanel&) = delete;
  RandomPanel& operator=(const RandomPanel&) = delete;

  /// The panel as a lower triangular matrix that is the identity elsewhere.
  Eigen::MatrixXd matrix() const {
    Eigen::MatrixXd L = Eigen::MatrixXd::Identity(kRows, kRows);
    for (Index c = 0; c < panel.width; ++c) {
      for (Index r = c; r < panel.height; ++r) {
        const Index row = r < panel.width ? panel.first + r : panel.rows[r - panel.width];
        L(row, panel.first + c) = panel.values[c * panel.height + r];
      }
    }
    return L;
  }

  std::vector<Index> rows;
  std::vector<double> data, inverse_diagonal;
  Panel panel{};
};

using KernelCase = std::tuple<int, InstructionSet, bool>;

class Kernels : public testing::TestWithParam<KernelCase> {
 protected:
  int group = std::get<0>(GetParam());
  SolveKernels kernels = solve_kernels(group, std::get<1>(GetParam()));
  bool padded = std::get<2>(GetParam());
  /// Wider than the group: columns beyond it must stay as they are.
  Index stride = group + 3;
  Block x = random_block(kRows, stride, 2);
  std::vector<double> scratch =
      std::vector<double>(static_cast<std::size_t>(kRows * group + kPanelPadding));

  void expect_columns(const Block& got, const Eigen::MatrixXd& expected) const {
    EXPECT_LE((got.leftCols(group) - expected).cwiseAbs().maxCoeff(),
              kSolveRoundOff * expected.cwiseAbs().maxCoeff());
    EXPECT_EQ(got.rightCols(3), x.rightCols(3));
  }
};

TEST_P(Kernels, PanelsSolveWithTheirTriangle) {
  for (Index width = 1; width <= 13; ++width) {
    for (const Index under : {0, 1, 3, 4, 5, 8, 17, 30}) {
      SCOPED_TRACE(std::to_string(width) + " columns, " + std::to_string(under) + " rows below");
      const RandomPanel random(width, under, padded, static_cast<unsigned>(100 * width + under));
      const Eigen::MatrixXd L = random.matrix(), right = x.leftCols(group);
      Block forward = x, backward = x;
      kernels.panel_forward(random.panel, forward.data(), stride, scratch.data());
      expect_columns(forward, L.triangularView<Eigen::Lower>().solve(right));
      kernels.panel_backward(random.panel, backward.data(), stride, scratch.data());
      expect_columns(backward, L.transpose().triangularView<Eigen::Upper>().solve(right));
    }
  }
}

std::string kernel_name(const testing::TestParamInfo<KernelCase>& info) {
  const char* const names[] = {"plain", "avx2", "avx512"};
  return std::string(names[static_cast<int>(std::get<1>(info.param))]) + "_" +
         std::to_string(std::get<0>(info.param)) + (std::get<2>(info.param) ? "_padded" : "");
}
// A set that this processor lacks stands for the best one below it.
INSTANTIATE_TEST_SUITE_P(Sets, Kernels,
                         testing::Combine(testing::Values(1, 2, 4, 8, 16),
                                          testing::Values(InstructionSet::kPlain,
                                                          InstructionSet::kAvx2,
                                                          InstructionSet::kAvx512),
                                          testing::Bool()),
                         kernel_name);

}  // namespace
}  // namespace geotherm::test
