// SPDX-License-Identifier: MIT
// The pass over the faces, compiled for each instruction set, against the definition of what it
// computes.
#include "solver/heat/field_kernels.h"

#include <gtest/gtest.h>

#include <cmath>
#include <iterator>
#include <limits>
#include <random>
#include <set>
#include <tuple>
#include <utility>

#include "tests/support/compare.h"
#include "tests/support/operators.h"
#include "tests/support/shapes.h"

namespace geotherm::test {
namespace {

// Roots by iteration to some units of the last digit, sums of a few terms in another order.
constexpr double kKernelRoundOff = 1e-12;
constexpr double kRootT = 1.2;

using KernelCase = std::tuple<int, InstructionSet, bool>;

class FieldKernels : public testing::TestWithParam<KernelCase> {
 public:
  FieldKernels() {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> exponent(-200, 0);
    const auto count = static_cast<std::size_t>(mesh->size() * group);
    for (std::size_t e = 0; e < count; ++e) {
      u.push_back(std::exp(exponent(random)));
      log_u.push_back(std::log(u.back()));
    }
    for (Index f = 0; f < mesh->face_count(); ++f) root_t_of_face.push_back(1 + 0.001 * (f % 7));
  }

  /// X of a face.
  std::array<double, 2> field(Index f, int column) const {
    const FaceLayout& p = mesh->layout[f];
    std::array<double, 3> at{}, log_at{};
    for (int k = 0; k < 3; ++k) {
      const auto e = static_cast<std::size_t>(mesh->faces[f][k] * group + column);
      at[k] = u[e];
      log_at[k] = log_u[e];
    }
    const double largest = std::max(std::abs(at[1] - at[0]), std::abs(at[2] - at[0]));
    const auto g = gradient(p, 0, (at[1] - at[0]) / largest, (at[2] - at[0]) / largest);
    const double norm = std::hypot(g[0], g[1]);
    const auto h = gradient(p, log_at[0], log_at[1], log_at[2]);
    const double slope = std::hypot(h[0], h[1]);
    const double root_t = each_its_own ? root_t_of_face[f] : kRootT;
    const double length =
        field_length(p.base, p.x, p.height, h[0] / slope, h[1] / slope, slope, root_t, 1 / root_t);
    return {-length * g[0] / norm, -length * g[1] / norm};
  }

  /// The divergence of faces from `first` on; notes which went the careful way.
  std::vector<double> run(Index first, const std::uint16_t* level) {
    std::vector<double> b(u.size(), 0.0);
    FieldPass pass{};
    pass.mesh = mesh.get();
    pass.first_face = first;
    pass.end_face = mesh->face_count();
    pass.u = u.data();
    pass.log_u = log_u.data();
    pass.level = level;
    pass.b = b.data();
    pass.stride = group;
    pass.root_t = kRootT;
    if (each_its_own) pass.root_t_of_face = root_t_of_face.data();
    pass.context = this;
    pass.careful = [](const void* context, Index face, int column) {
      auto& self = *static_cast<FieldKernels*>(const_cast<void*>(context));
      self.careful.insert({face, column});
      return self.field(face, column);
    };
    add_unit_divergence(pass, group, std::get<1>(GetParam()));
    return b;
  }

  const int group = std::get<0>(GetParam());
  const bool each_its_own = std::get<2>(GetParam());
  MeshPtr surface = finish(torus(33, 20, 0.4));  // faces that fill no register to the end
  std::shared_ptr<const OperatorMesh> mesh = operators_of(*surface, intrinsic_of(*surface, true));
  std::vector<double> u, log_u, root_t_of_face;
  std::set<std::pair<Index, int>> careful;
  /// Faces that fill registers; those left over may all go the careful way.
  const Index kWhole = mesh->face_count() / 16 * 16;
};

TEST_P(FieldKernels, ComputeTheDivergenceOfTheField) {
  // From a face on that begins no register.
  const Index first = 5;
  std::vector<double> expected(u.size(), 0.0);
  for (Index f = first; f < mesh->face_count(); ++f) {
    for (int c = 0; c < group; ++c) {
      const auto x = field(f, c);
      const auto d = divergence(mesh->layout[f], x[0], x[1]);
      for (int k = 0; k < 3; ++k) {
        expected[static_cast<std::size_t>(mesh->faces[f][k] * group + c)] += d[k];
      }
    }
  }
  EXPECT_LE(relative_difference(run(first, nullptr), expected), kKernelRoundOff);
}

TEST_P(FieldKernels, SendFacesWithoutADirectionTheCarefulWay) {
  const int column = group - 1;
  for (std::size_t e = static_cast<std::size_t>(column); e < u.size(); e += group) u[e] = 0.5;
  run(0, nullptr);
  for (Index f = 0; f < kWhole; ++f) {
    for (int c = 0; c < group; ++c) EXPECT_EQ(careful.contains({f, c}), c == column) << f;
  }
}

TEST_P(FieldKernels, SendFacesWithSeveralExponentsTheCarefulWay) {
  // One level everywhere is no reason, a corner that is of another is.
  std::vector<std::uint16_t> level(u.size(), 3);
  const Index vertex = mesh->faces[20][1];
  level[static_cast<std::size_t>(vertex * group + group - 1)] = 2;
  run(0, level.data());
  for (Index f = 0; f < kWhole; ++f) {
    const Face& face = mesh->faces[f];
    const bool mixed = face[0] == vertex || face[1] == vertex || face[2] == vertex;
    EXPECT_EQ(careful.contains({f, group - 1}), mixed) << f;
    if (!mixed) {
      EXPECT_FALSE(careful.contains({f, 0})) << f;
    }
  }
}

class SmallValues : public testing::TestWithParam<std::tuple<int, InstructionSet>> {};

TEST_P(SmallValues, AreThoseBelowTheFloorOfTheirColumn) {
  const auto [columns, set] = GetParam();
  constexpr std::int64_t kRows = 100;
  constexpr double kFloor = 1e-295, kNone = std::numeric_limits<double>::quiet_NaN();
  constexpr double kValues[] = {0,  kFloor, -kFloor, 0.9 * kFloor, -0.9 * kFloor, 1.1 * kFloor,
                                -1, kNone,  5e-324,  HUGE_VAL,     -HUGE_VAL};
  std::mt19937 random(5);
  std::vector<double> u(static_cast<std::size_t>(kRows * columns));
  for (double& value : u) value = kValues[random() % std::size(kValues)];
  std::vector<double> floors(static_cast<std::size_t>(columns), kFloor);
  floors.back() = 0;  // nothing is below that
  floors.front() = 1;
  std::vector<std::uint16_t> masks(kRows + 1, 0xabcd);
  mark_small(u.data(), kRows, columns, floors.data(), masks.data(), set);
  for (std::int64_t row = 0; row < kRows; ++row) {
    for (int k = 0; k < columns; ++k) {
      const double value = u[static_cast<std::size_t>(row * columns + k)];
      EXPECT_EQ((masks[row] >> k & 1) != 0, std::abs(value) < floors[k]) << value;
    }
    EXPECT_EQ(masks[row] >> columns, 0);
  }
  EXPECT_EQ(masks.back(), 0xabcd);
}

INSTANTIATE_TEST_SUITE_P(Sets, SmallValues,
                         testing::Combine(testing::Values(1, 2, 3, 4, 8, 13, 16),
                                          testing::Values(InstructionSet::kPlain,
                                                          InstructionSet::kAvx2,
                                                          InstructionSet::kAvx512)));

INSTANTIATE_TEST_SUITE_P(Sets, FieldKernels,
                         testing::Combine(testing::Values(1, 2, 4, 8, 16),
                                          testing::Values(InstructionSet::kPlain,
                                                          InstructionSet::kAvx2,
                                                          InstructionSet::kAvx512),
                                          testing::Bool()));

}  // namespace
}  // namespace geotherm::test
