// SPDX-License-Identifier: MIT
#include "engine/overlay/overlay.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

namespace geotherm::test {
namespace {

using namespace geotherm::engine;
using glm::vec2;
using glm::vec3;

constexpr vec3 kInk(0.1F, 0.2F, 0.3F);  // no colour of the bar below

Legend sample() {
  Legend legend;
  legend.bar = true;
  legend.colours = {{1, 0, 0}, {1, 1, 1}, {0, 0, 1}};
  legend.ticks = {{0, "0"}, {0.25F, "0.5"}, {0.5F, "1"}, {0.75F, "1.5"}, {1, "2"}};
  for (int i = 0; i <= 20; ++i) legend.lines.push_back(static_cast<float>(i) / 20);
  legend.title = "geodesic distance (mm)";
  legend.caption =
      "gargoyle \xC2\xB7 200,000 faces \xC2\xB7 t = 1.2e-4 (mean-edge, m = 1) \xC2\xB7 cholmod";
  legend.ink = kInk;
  return legend;
}

struct Box {
  vec2 min, max;
};

/// The quads that letters (or, without `letters`, plain shapes) cover.
std::vector<Box> quads(const Overlay& overlay, bool letters) {
  std::vector<Box> boxes;
  for (std::size_t i = 0; i < overlay.vertices.size(); i += 6) {
    if ((overlay.vertices[i].uv == overlay.atlas.white_uv()) == letters) continue;
    Box box{overlay.vertices[i].position, overlay.vertices[i].position};
    for (std::size_t k = i; k < i + 6; ++k) {
      box.min = glm::min(box.min, overlay.vertices[k].position);
      box.max = glm::max(box.max, overlay.vertices[k].position);
    }
    boxes.push_back(box);
  }
  return boxes;
}

bool overlap(const Box& a, const Box& b) {
  return glm::all(glm::lessThan(a.min, b.max)) && glm::all(glm::lessThan(b.min, a.max));
}

/// Quads with a colour that only the bar has.
int bar_quads(const Overlay& overlay) {
  return static_cast<int>(
             std::count_if(overlay.vertices.begin(), overlay.vertices.end(),
                           [](const Overlay::Vertex& v) { return vec3(v.colour) != kInk; })) /
         6;
}

class LegendOfSize : public testing::TestWithParam<vec2> {
 protected:
  vec2 extent() const { return GetParam(); }
  float side() const { return std::min(extent().x, extent().y); }
};

TEST_P(LegendOfSize, StaysInsideThePicture) {
  for (const float scale : {0.2F, 1.0F, 1.7F, 5.0F, 40.0F}) {
    Legend legend = sample();
    legend.scale = scale;
    const LegendLayout layout = lay_out(legend, extent());
    for (const Overlay::Vertex& v : layout.overlay.vertices) {
      ASSERT_TRUE(v.position.x >= 0 && v.position.x <= extent().x) << scale << " " << v.position.x;
      ASSERT_TRUE(v.position.y >= 0 && v.position.y <= extent().y) << scale << " " << v.position.y;
      ASSERT_TRUE(v.uv.x >= 0 && v.uv.x <= 1 && v.uv.y >= 0 && v.uv.y <= 1);
    }
  }
}

TEST_P(LegendOfSize, LeavesTheModelWhatItsInsetsSay) {
  for (const float scale : {0.5F, 1.0F, 2.0F}) {
    Legend legend = sample();
    legend.scale = scale;
    const LegendLayout layout = lay_out(legend, extent());
    const auto& insets = layout.insets;
    const Box model{{insets.left, insets.top},
                    {extent().x - insets.right, extent().y - insets.bottom}};
    EXPECT_GE(model.max.x, extent().x / 3);
    EXPECT_GE(model.max.y, extent().y / 2);
    for (const bool letters : {false, true}) {
      for (const Box& box : quads(layout.overlay, letters)) {
        ASSERT_FALSE(overlap(box, model)) << scale;
      }
    }
  }
}

TEST_P(LegendOfSize, HasNoTwoLettersInOnePlace) {
  Legend legend = sample();
  for (int i = 0; i <= 40; ++i) {  // far too many
    legend.ticks.push_back({static_cast<float>(i) / 40, std::to_string(i)});
  }
  const LegendLayout layout = lay_out(legend, extent());
  const std::vector<Box> letters = quads(layout.overlay, true);
  for (std::size_t i = 0; i < letters.size(); ++i) {
    for (std::size_t k = i + 1; k < letters.size(); ++k) {
      // Neighbours of a word may share a column of pixels.
      const Box shrunk{letters[k].min + vec2(1, 0), letters[k].max - vec2(1, 0)};
      ASSERT_FALSE(overlap(letters[i], shrunk)) << i << " " << k;
    }
  }
}

TEST_P(LegendOfSize, HasABarWhereThereIsRoom) {
  const LegendLayout layout = lay_out(sample(), extent());
  if (side() >= 300) {
    EXPECT_EQ(bar_quads(layout.overlay), 2);
    const bool portrait = extent().y > extent().x;
    EXPECT_EQ(layout.insets.right > 0, !portrait);
    EXPECT_GT(portrait ? layout.insets.bottom : layout.insets.right, side() / 20);
  } else if (side() < 160) {
    EXPECT_EQ(bar_quads(layout.overlay), 0);
    EXPECT_EQ(layout.insets.right, 0);
  }
}

INSTANTIATE_TEST_SUITE_P(Pictures, LegendOfSize,
                         testing::Values(vec2(1280, 720), vec2(640, 480), vec2(400, 300),
                                         vec2(1920, 1080), vec2(3840, 2160), vec2(600, 900),
                                         vec2(16384, 16384), vec2(16384, 200), vec2(200, 4000),
                                         vec2(333, 301), vec2(180, 170), vec2(160, 160),
                                         vec2(159, 800), vec2(100, 100), vec2(64, 48), vec2(7, 5),
                                         vec2(1, 1)),
                         [](const auto& param_info) {
                           return std::to_string(static_cast<int>(param_info.param.x)) + "x" +
                                  std::to_string(static_cast<int>(param_info.param.y));
                         });

TEST(Legend, WithoutPartsTakesNothing) {
  const LegendLayout layout = lay_out({}, {1280, 720});
  EXPECT_TRUE(layout.overlay.vertices.empty());
  EXPECT_EQ(layout.insets.left + layout.insets.top, 0);
  EXPECT_EQ(layout.insets.right + layout.insets.bottom, 0);
}

TEST(Legend, OfACaptionAloneTakesTheLowerEdgeOnly) {
  Legend legend;
  legend.caption = "sphere";
  const LegendLayout layout = lay_out(legend, {1280, 720});
  EXPECT_FALSE(layout.overlay.vertices.empty());
  EXPECT_EQ(layout.insets.right, 0);
  EXPECT_GT(layout.insets.bottom, 20);
  EXPECT_LT(layout.insets.bottom, 60);
}

TEST(Legend, HasTheLastColourAtTheTop) {
  const LegendLayout layout = lay_out(sample(), {1280, 720});
  float red = 0;
  float blue = 0;
  for (const Overlay::Vertex& v : layout.overlay.vertices) {
    if (vec3(v.colour) == vec3(1, 0, 0)) red = v.position.y;
    if (vec3(v.colour) == vec3(0, 0, 1)) blue = v.position.y;
  }
  EXPECT_GT(red, blue + 100);
}

TEST(Legend, GrowsWithThePictureAndItsScale) {
  const float small = lay_out(sample(), {1280, 720}).insets.right;
  const float large = lay_out(sample(), {2560, 1440}).insets.right;
  EXPECT_NEAR(large, 2 * small, 0.1F * large);
  Legend scaled = sample();
  scaled.scale = 2;
  EXPECT_NEAR(lay_out(scaled, {1280, 720}).insets.right, large, 0.1F * large);
}

TEST(Legend, KeepsEveryTickThatHasRoom) {
  Legend legend = sample();
  legend.title.clear();
  legend.caption.clear();
  legend.lines.clear();
  legend.ticks = {{0, "0"}, {0.5F, "5"}, {0.505F, "6"}, {1, "9"}};
  EXPECT_EQ(quads(lay_out(legend, {1280, 720}).overlay, true).size(), 3U);
}

TEST(Legend, IgnoresPlacesThatAreNotOnTheBar) {
  Legend legend = sample();
  const std::size_t plain = lay_out(legend, {1280, 720}).overlay.vertices.size();
  for (const float place : {-0.1F, 1.1F, std::numeric_limits<float>::quiet_NaN(),
                            std::numeric_limits<float>::infinity()}) {
    legend.ticks.push_back({place, "3"});
    legend.lines.push_back(place);
  }
  EXPECT_EQ(lay_out(legend, {1280, 720}).overlay.vertices.size(), plain);
}

TEST(Legend, LeavesIsolinesOutThatWouldHideTheBar) {
  Legend legend = sample();
  legend.lines.clear();
  const std::size_t none = lay_out(legend, {1280, 720}).overlay.vertices.size();
  for (int i = 0; i <= 1000; ++i) legend.lines.push_back(static_cast<float>(i) / 1000);
  EXPECT_EQ(lay_out(legend, {1280, 720}).overlay.vertices.size(), none);
}

TEST(Legend, OfASmallPictureHasBarAndKeysInPlacesOfTheirOwn) {
  Legend legend = sample();
  legend.title = "distance (model\u00a0units)";
  legend.caption = "two";
  legend.line_height = 39;  // 8pt at 300 pixels an inch
  legend.keys = {{.label = "not reached", .patches = {vec3(0.62F)}}};
  for (const vec2 extent : {vec2(472, 472), vec2(945, 709), vec2(480, 700)}) {
    const LegendLayout layout = lay_out(legend, extent);
    EXPECT_TRUE(layout.left_out.empty());
    EXPECT_GT(layout.bar_max.x, 0);
    const std::vector<Box> letters = quads(layout.overlay, true);
    const Box model{{0, layout.insets.top}, extent - vec2(layout.insets.right, 0)};
    for (const Box& letter : letters) {
      EXPECT_FALSE(letter.max.y < extent.y / 2 && overlap(letter, model));
    }
    for (std::size_t i = 0; i < letters.size(); ++i) {
      for (std::size_t k = i + 1; k < letters.size(); ++k) {
        const Box shrunk{letters[k].min + vec2(1, 0), letters[k].max - vec2(1, 0)};
        ASSERT_FALSE(overlap(letters[i], shrunk)) << extent.x << ": " << i << " " << k;
      }
    }
    for (const Overlay::Text& text : layout.overlay.texts) {
      EXPECT_FALSE(text.text.ends_with(kEllipsis)) << text.text;
    }
  }
}

TEST(Legend, SaysWhatHasNoRoom) {
  Legend legend = sample();
  EXPECT_TRUE(lay_out(legend, {1280, 720}).left_out.empty());
  legend.line_height = 300;
  const LegendLayout layout = lay_out(legend, {960, 720});
  EXPECT_EQ(layout.left_out, (std::vector<std::string>{"the caption", "the colour bar"}));
  legend.heading = "a title";
  EXPECT_EQ(lay_out(legend, {80, 80}).left_out,
            (std::vector<std::string>{"the caption", "the title", "the colour bar"}));
}

TEST(Legend, CutsACaptionThatIsTooLong) {
  Legend legend;
  legend.caption = std::string(5000, 'm');
  const LegendLayout layout = lay_out(legend, {640, 480});
  const std::vector<Box> letters = quads(layout.overlay, true);
  EXPECT_LT(letters.size(), 100U);
  EXPECT_GT(letters.back().max.x, 600);  // it uses the line
  EXPECT_LT(letters.back().max.x, 640);
  EXPECT_LT(letters.back().max.y - letters.back().min.y, 4);  // dots, not an m
}

TEST(Legend, ShowsTheColoursOfItsKeys) {
  const std::vector<vec3> patches = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  Legend legend;
  legend.ink = kInk;
  legend.keys = {{vec3(1, 1, 0), "path", vec3(0)}, {{}, "regions", {}, patches}};
  const LegendLayout layout = lay_out(legend, {1280, 720});
  EXPECT_EQ(bar_quads(layout.overlay), 2 + 3);  // the stroke, its rim, the patches
  EXPECT_GT(layout.insets.top, 30);
  float right = 0;
  for (const Box& box : quads(layout.overlay, false)) {
    EXPECT_GE(box.min.x, 0);
    right = std::max(right, box.max.x);
  }
  EXPECT_LT(right, 80);
}

TEST(Legend, WithLabelsTooWideForThePictureHasNoBar) {
  Legend legend = sample();
  legend.ticks[2].label.assign(60, '8');
  EXPECT_EQ(bar_quads(lay_out(legend, {400, 300}).overlay), 0);
}

TEST(Legend, OfAPictureHigherThanWideRunsToTheRight) {
  const LegendLayout layout = lay_out(sample(), {600, 900});
  float left = 600, right = 0;
  for (const Overlay::Vertex& v : layout.overlay.vertices) {
    if (vec3(v.colour) == kInk) continue;
    if (v.colour.r > v.colour.b) left = std::min(left, v.position.x);
    if (v.colour.b > v.colour.r) right = std::max(right, v.position.x);
  }
  EXPECT_GT(right - left, 200) << "from red to blue";
  EXPECT_EQ(layout.insets.right, 0);
}

TEST(Legend, StaysAtTheSideOnRequestWhateverThePicturesShape) {
  Legend legend = sample();
  legend.at_side = true;
  for (const glm::vec2 extent : {glm::vec2(660, 540), {660, 730}, {600, 900}}) {
    const LegendLayout layout = lay_out(legend, extent);
    EXPECT_GT(layout.insets.right, 0);
    const glm::vec2 size = layout.bar_max - layout.bar_min;
    EXPECT_GT(size.y, 5 * size.x);
  }
}

TEST(Legend, TakesTheOtherShapeWhereItsOwnHasNoRoom) {
  Legend legend = sample();
  for (Tick& tick : legend.ticks) tick.label = "a label that is long";
  EXPECT_GT(lay_out(legend, {420, 400}).insets.right, 0);
  EXPECT_EQ(lay_out(legend, {270, 300}).insets.right, 0);
  EXPECT_GT(lay_out(legend, {270, 300}).insets.bottom, 60);
}

TEST(Legend, HasArrowsWhereValuesLieBeyondItsEnds) {
  const auto reach = [](bool below, bool above) {
    Legend legend = sample();
    legend.below = below;
    legend.above = above;
    Box box{vec2(1e6F), vec2(0)};
    for (const Overlay::Vertex& v : lay_out(legend, {1280, 720}).overlay.vertices) {
      if (vec3(v.colour) == kInk) continue;
      box.min = glm::min(box.min, v.position);
      box.max = glm::max(box.max, v.position);
    }
    return box;
  };
  const Box none = reach(false, false), low = reach(true, false), high = reach(false, true);
  const float length = none.max.y - none.min.y;
  EXPECT_GT(low.max.y - low.min.y, length + 4) << "red below";
  EXPECT_GT(high.max.y - high.min.y, length + 4) << "blue above";
}

TEST(Legend, HasAHeadingInTheMiddleOfTheUpperEdge) {
  Legend legend;
  legend.heading = "A heading";
  const LegendLayout layout = lay_out(legend, {1000, 600});
  EXPECT_GT(layout.insets.top, 0);
  Box box{vec2(1e6F), vec2(0)};
  for (const Box& letter : quads(layout.overlay, true)) {
    box = {glm::min(box.min, letter.min), glm::max(box.max, letter.max)};
  }
  EXPECT_NEAR((box.min.x + box.max.x) / 2, 500, 3);
  EXPECT_LT(box.max.y, layout.insets.top);
}

TEST(Legend, HasLettersOfTheHeightThatIsAskedFor) {
  Legend legend = sample();
  legend.line_height = 40;
  EXPECT_NEAR(lay_out(legend, {1280, 720}).overlay.atlas.line_height(), 40, 4);
}

TEST(MissingLetters, AreThoseThatTheFontLacksEachOnce) {
  EXPECT_TRUE(missing_letters("d(x) = \u2207\u03c6 \u2014 \u00e9\u20ac").empty());
  const auto missing = missing_letters("a\u6f22b\u5b57\u6f22");
  ASSERT_EQ(missing.size(), 2U);
  EXPECT_EQ(missing[0], "\u6f22");
  EXPECT_EQ(missing[1], "\u5b57");
}

TEST(Legend, SurvivesSizesThatAreNone) {
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  for (const vec2 extent : {vec2(0, 0), vec2(-100, 500), vec2(kNan, 500), vec2(500, kNan)}) {
    EXPECT_TRUE(lay_out(sample(), extent).overlay.vertices.empty());
  }
  Legend legend = sample();
  legend.scale = kNan;
  EXPECT_EQ(bar_quads(lay_out(legend, {1280, 720}).overlay), 2);
}

}  // namespace
}  // namespace geotherm::test
