// SPDX-License-Identifier: MIT
#include "app/picture/openness.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace geotherm::test {
namespace {

using app::PictureData;

struct Sheet {
  std::vector<PictureData::Vector> positions;
  std::vector<std::array<std::uint32_t, 3>> faces;

  std::vector<PictureData::Openness> openness() const { return app::openness_of(positions, faces); }
};

/// A grid over [-1, 1]^2 at place(x, y), counter-clockwise from above.
template <class Place>
Sheet sheet(std::uint32_t cells, Place&& place) {
  Sheet out;
  for (std::uint32_t j = 0; j <= cells; ++j) {
    for (std::uint32_t i = 0; i <= cells; ++i) {
      const float n = static_cast<float>(cells);
      out.positions.push_back(
          place(2 * static_cast<float>(i) / n - 1, 2 * static_cast<float>(j) / n - 1));
    }
  }
  for (std::uint32_t j = 0; j < cells; ++j) {
    for (std::uint32_t i = 0; i < cells; ++i) {
      const std::uint32_t a = j * (cells + 1) + i, b = a + cells + 1;
      out.faces.push_back({a, a + 1, b + 1});
      out.faces.push_back({a, b + 1, b});
    }
  }
  return out;
}

/// A valley along y whose sides fall at 45 degrees, so that they see each other.
Sheet valley(std::uint32_t cells) {
  return sheet(cells, [](float x, float y) -> PictureData::Vector {
    return {0.35F * x, 0.75F * y, 0.35F * std::abs(x)};
  });
}

/// The middle row runs along the valley's bottom.
std::size_t middle(std::uint32_t cells) { return (cells / 2) * (cells + 1) + cells / 2; }

class OpennessOf : public testing::TestWithParam<std::uint32_t> {};
INSTANTIATE_TEST_SUITE_P(FewAndManyFaces, OpennessOf, testing::Values(8U, 40U, 160U),
                         [](const auto& test) { return std::to_string(test.param); });

TEST_P(OpennessOf, APlaneIsFull) {
  const Sheet plane = sheet(GetParam(), [](float x, float y) -> PictureData::Vector {
    return {x / 2, y / 2, 0};
  });
  for (const auto& [normal, front, back] : plane.openness()) {
    EXPECT_NEAR(normal[2], 1, 1e-5);
    EXPECT_GT(front, 0.99F);
    EXPECT_GT(back, 0.99F);
  }
}

TEST_P(OpennessOf, AValleyIsWhatItsSidesLeaveFree) {
  const auto found = valley(GetParam()).openness()[middle(GetParam())];
  EXPECT_GT(found.normal[2], 0.9F);
  // Of the light over the bottom of an endless valley the sides leave sin 45 degrees.
  constexpr double kEnds = 0.12;  // it ends, and coarse faces take the mean with their neighbours
  EXPECT_NEAR(found.front, std::numbers::sqrt2 / 2, kEnds);
  EXPECT_GT(found.back, 0.95F);
}

TEST(Openness, ChangesSidesWithItsFaces) {
  constexpr std::uint32_t kCellsAside = 40;
  Sheet turned = valley(kCellsAside);
  for (auto& face : turned.faces) std::swap(face[0], face[1]);
  const auto before = valley(kCellsAside).openness();
  const auto after = turned.openness();
  for (std::size_t v = 0; v < before.size(); ++v) {
    EXPECT_NEAR(before[v].front, after[v].back, 1e-5) << v;
    EXPECT_NEAR(before[v].back, after[v].front, 1e-5) << v;
  }
}

TEST(Openness, IsThereForWhatHasNoFaces) {
  Sheet lonely = valley(8);
  lonely.positions.push_back({0, 0, 0.1F});
  const auto found = lonely.openness();
  EXPECT_EQ(found.back().front, 1);
  EXPECT_TRUE(app::openness_of({}, {}).empty());
}

}  // namespace
}  // namespace geotherm::test
