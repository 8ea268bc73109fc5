// SPDX-License-Identifier: MIT
#include "engine/scene/colours.h"

#include <gtest/gtest.h>

namespace geotherm::test {
namespace {

using namespace geotherm::engine;

constexpr glm::vec3 kNoRegion(0.62F);
using Faces = std::vector<std::array<std::uint32_t, 3>>;

/// How different two sRGB colours look.
float colour_distance(const glm::vec3& a, const glm::vec3& b) {
  return glm::length(oklab_of(a) - oklab_of(b));
}

TEST(Oklab, HasWhiteAtOneAndBlackAtZero) {
  constexpr float kPrinted = 1e-4F;  // its matrices have ten digits, floats seven
  EXPECT_LE(glm::length(oklab_of(glm::vec3(1)) - glm::vec3(1, 0, 0)), kPrinted);
  EXPECT_LE(glm::length(oklab_of(glm::vec3(0))), kPrinted);
}

TEST(Oklab, IsTheInverseOfItsInverse) {
  constexpr float kRounding = 1e-4F;
  for (const glm::vec3& c :
       {glm::vec3(0.9F, 0.1F, 0.2F), glm::vec3(0.02F, 0.7F, 1), glm::vec3(0.5F, 0.5F, 0.01F)}) {
    EXPECT_LE(glm::length(srgb_of(oklab_of(c)) - c), kRounding);
  }
}

TEST(RegionColours, OfTheFirstTwelveAreWellSeparated) {
  for (std::uint32_t i = 0; i < 12; ++i) {
    for (std::uint32_t k = 0; k < i; ++k) {
      EXPECT_GE(colour_distance(region_colour(i), region_colour(k)), kDistinct) << i << " " << k;
    }
  }
}

TEST(RegionColours, AreNeitherGreyNorAsDarkAsIsolines) {
  for (std::uint32_t i = 0; i < kRegionColours; ++i) {
    EXPECT_GE(colour_distance(region_colour(i), kNoRegion), 0.1F) << i;
    EXPECT_GE(colour_distance(region_colour(i), glm::vec3(0.05F)), 0.3F) << i;
  }
}

TEST(RegionColours, RepeatInTheirTable) {
  const ColourTable table = region_table();
  for (std::uint32_t i = 0; i < kColourSteps; ++i) {
    EXPECT_EQ(glm::vec3(table[i]), region_colour(i % kRegionColours)) << i;
  }
}

TEST(RegionColourPlaces, AreThoseOfTheRegionsWhereNeighboursDiffer) {
  const Faces faces = {{0, 1, 2}, {2, 3, 4}};
  EXPECT_EQ(region_colour_places(faces, std::vector<std::int32_t>{0, 1, 2, 3, -1}),
            (std::vector<std::int32_t>{0, 1, 2, 3, -1}));
}

/// Regions whose numbers would have one colour, all beside each other.
TEST(RegionColourPlaces, DifferForNeighboursWhateverTheirNumbers) {
  constexpr std::int32_t kRound = kRegionColours;
  const std::vector<std::int32_t> regions = {5, 5 + kRound, 5 + 21, 2'000'000'000, 5 + 2 * kRound};
  Faces faces;
  for (std::uint32_t i = 0; i < regions.size(); ++i) {
    for (std::uint32_t k = 0; k < i; ++k) faces.push_back({i, k, k});
  }
  const auto places = region_colour_places(faces, regions);
  for (std::size_t i = 0; i < places.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      const glm::vec3 a = region_colour(static_cast<std::uint32_t>(places[i]));
      const glm::vec3 b = region_colour(static_cast<std::uint32_t>(places[k]));
      EXPECT_GE(colour_distance(a, b), kDistinct) << i << " " << k;
    }
  }
}

TEST(RegionColourPlaces, AreInTheTableHoweverManyNeighboursThereAre) {
  Faces faces;
  std::vector<std::int32_t> regions;
  for (std::int32_t r = 0; r < 100; ++r) {
    regions.push_back(r);
    for (std::uint32_t k = 0; k < static_cast<std::uint32_t>(r); ++k) {
      faces.push_back({static_cast<std::uint32_t>(r), k, k});
    }
  }
  for (const std::int32_t place : region_colour_places(faces, regions)) {
    EXPECT_GE(place, 0);
    EXPECT_LT(place, static_cast<std::int32_t>(kRegionColours));
  }
}

TEST(RegionColourPlaces, OfNothingAreNone) {
  EXPECT_TRUE(region_colour_places({}, {}).empty());
  EXPECT_EQ(region_colour_places({}, std::vector<std::int32_t>{-1, -1}),
            (std::vector<std::int32_t>{-1, -1}));
}

}  // namespace
}  // namespace geotherm::test
