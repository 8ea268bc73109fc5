// SPDX-License-Identifier: MIT
#include "engine/scene/colours.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <set>
#include <string>
#include <vector>

namespace geotherm::test {
namespace {

using namespace geotherm::engine;
using glm::vec3;

/// CIE 1976 lightness of an sRGB colour, 0 to 100.
double lightness(const vec3& colour) {
  const auto linear = [](double c) {
    return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
  };
  const double y =
      0.2126 * linear(colour.r) + 0.7152 * linear(colour.g) + 0.0722 * linear(colour.b);
  return y <= 216.0 / 24389 ? y * 24389 / 27 : 116 * std::cbrt(y) - 16;
}

/// As many as the published tables have entries.
constexpr int kSteps = 256;

vec3 colour_of_step(const ColourMap& map, int i) {
  return colour_at(map, static_cast<float>(i) / (kSteps - 1));
}

std::vector<double> lightnesses(const ColourMap& map) {
  std::vector<double> all;
  all.reserve(kSteps);
  for (int i = 0; i < kSteps; ++i) all.push_back(lightness(colour_of_step(map, i)));
  return all;
}

/// The entries at which lightness turns from rising to falling or back.
int turns(const std::vector<double>& values) {
  int turns = 0;
  int direction = 0;
  for (std::size_t i = 1; i < values.size(); ++i) {
    const double step = values[i] - values[i - 1];
    if (std::abs(step) < 1e-3) continue;  // the published digits say no more
    const int now = step > 0 ? 1 : -1;
    turns += direction != 0 && now != direction;
    direction = now;
  }
  return turns;
}

class ColourMaps : public testing::TestWithParam<std::string> {
 protected:
  const ColourMap& map() const { return *find_colour_map(GetParam()); }
};

TEST_P(ColourMaps, AreFoundByTheirNames) {
  ASSERT_NE(find_colour_map(GetParam()), nullptr);
  EXPECT_EQ(map().name, GetParam());
  EXPECT_FALSE(map().description.empty());
  EXPECT_GE(map().controls.size(), 2U);
}

TEST_P(ColourMaps, HoldColoursBetweenZeroAndOne) {
  for (const vec3& colour : map().controls) {
    for (int i = 0; i < 3; ++i) EXPECT_TRUE(colour[i] >= 0 && colour[i] <= 1) << colour[i];
  }
}

TEST_P(ColourMaps, BeginAndEndAtTheirControlPoints) {
  EXPECT_EQ(colour_at(map(), 0), map().controls.front());
  EXPECT_EQ(colour_at(map(), 1), map().controls.back());
  EXPECT_EQ(colour_at(map(), -5), map().controls.front());
  EXPECT_EQ(colour_at(map(), 5), map().controls.back());
  EXPECT_EQ(colour_at(map(), std::numeric_limits<float>::quiet_NaN()), map().controls.front());
}

TEST_P(ColourMaps, HaveTablesThatHoldTheirColours) {
  const ColourTable table = colour_table(map());
  const ColourTable reversed = colour_table(map(), true);
  for (int i = 0; i < kColourSteps; ++i) {
    const float x = static_cast<float>(i) / (kColourSteps - 1);
    EXPECT_EQ(table[static_cast<std::size_t>(i)], glm::vec4(colour_at(map(), x), 1)) << i;
    EXPECT_EQ(reversed[static_cast<std::size_t>(i)], glm::vec4(colour_at(map(), x, true), 1)) << i;
  }
}

TEST_P(ColourMaps, RunBackwardsWhenReversed) {
  for (const float x : {0.0F, 0.1F, 0.5F, 0.7F, 1.0F}) {
    const vec3 there = colour_at(map(), x);
    const vec3 back = colour_at(map(), 1 - x, true);
    EXPECT_LE(glm::length(there - back), 1e-4F) << x;
  }
}

TEST_P(ColourMaps, HaveNoJumps) {
  constexpr float kLargestStep = 0.08F;  // of 1.7 between black and white, in 1 of 255 steps
  for (int i = 1; i < kSteps; ++i) {
    EXPECT_LE(glm::distance(colour_of_step(map(), i), colour_of_step(map(), i - 1)), kLargestStep)
        << i;
  }
}

std::vector<std::string> all_names() {
  return {"red-blue", "viridis", "cividis",         "magma",     "inferno",
          "plasma",   "turbo",   "red-yellow-blue", "cool-warm", "grey"};
}

std::string test_name(const testing::TestParamInfo<std::string>& param_info) {
  std::string name = param_info.param;
  std::erase(name, '-');
  return name;
}

INSTANTIATE_TEST_SUITE_P(All, ColourMaps, testing::ValuesIn(all_names()), test_name);

class SequentialMaps : public ColourMaps {};

TEST_P(SequentialMaps, GrowLighterAllTheWay) {
  const std::vector<double> values = lightnesses(map());
  EXPECT_EQ(turns(values), 0);
  EXPECT_GT(values.back() - values.front(), 50);
  EXPECT_FALSE(map().diverging);
}

INSTANTIATE_TEST_SUITE_P(All, SequentialMaps,
                         testing::Values("viridis", "cividis", "magma", "inferno", "plasma",
                                         "grey"),
                         test_name);

class TwoSidedMaps : public ColourMaps {};

TEST_P(TwoSidedMaps, AreLightestInTheMiddleAndNowhereElse) {
  const std::vector<double> values = lightnesses(map());
  EXPECT_EQ(turns(values), 1);
  const auto peak = std::max_element(values.begin(), values.end()) - values.begin();
  EXPECT_NEAR(static_cast<double>(peak), 127.5, 8);
}

INSTANTIATE_TEST_SUITE_P(All, TwoSidedMaps,
                         testing::Values("red-blue", "red-yellow-blue", "cool-warm"), test_name);

TEST(ColourMap, ListHasTheDefaultFirstAndEveryMapOnce) {
  std::set<std::string_view> names;
  for (const ColourMap& map : colour_maps()) names.insert(map.name);
  EXPECT_EQ(colour_maps().front().name, "red-blue");
  EXPECT_EQ(names.size(), colour_maps().size());
  EXPECT_EQ(colour_maps().size(), all_names().size());
}

TEST(ColourMap, OfAnUnknownNameIsNone) {
  EXPECT_EQ(find_colour_map("rainbow"), nullptr);
  EXPECT_EQ(find_colour_map(""), nullptr);
  EXPECT_EQ(find_colour_map("Viridis"), nullptr);
}

TEST(ColourMap, OfTheDefaultRunsFromRedToBlue) {
  const vec3 near = colour_at(colour_maps().front(), 0);
  const vec3 far = colour_at(colour_maps().front(), 1);
  EXPECT_GT(near.r, 0.7F);
  EXPECT_LT(std::max(near.g, near.b), 0.2F);
  EXPECT_GT(far.b, 0.5F);
  EXPECT_LT(std::max(far.r, far.g), 0.3F);
}

TEST(ColourMap, OfViridisIsThePublishedOne) {
  // First, middle and last entry of the table in matplotlib, 0 to 255.
  const auto bytes = [](int i) {
    return glm::round(255.0F * colour_of_step(*find_colour_map("viridis"), i));
  };
  EXPECT_EQ(bytes(0), vec3(68, 1, 84));
  EXPECT_EQ(bytes(128), vec3(33, 145, 140));
  EXPECT_EQ(bytes(255), vec3(253, 231, 37));
}

}  // namespace
}  // namespace geotherm::test
