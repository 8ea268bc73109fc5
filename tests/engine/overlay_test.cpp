// SPDX-License-Identifier: MIT
#include "engine/overlay/overlay.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <vector>

namespace geotherm::test {
namespace {

using namespace geotherm::engine;
using glm::vec2;
using glm::vec4;

const std::string kSample = "Distance 0.25 \xC2\xB7 \xCE\xB1\xE2\x80\xA6";

std::vector<char32_t> letters_of(std::string_view text) {
  std::vector<char32_t> letters;
  while (!text.empty()) letters.push_back(take_letter(text));
  return letters;
}

void expect_within(const GlyphAtlas& atlas, const GlyphAtlas::Glyph& glyph) {
  EXPECT_GE(std::min(glyph.uv_min.x, glyph.uv_min.y), 0);
  EXPECT_LE(std::max(glyph.uv_max.x, glyph.uv_max.y), 1);
  const vec2 texels = (glyph.uv_max - glyph.uv_min) * vec2(atlas.width(), atlas.height());
  EXPECT_LE(glm::length(texels - glyph.size), 1e-2F);  // one texel a pixel: crisp
}

/// Coverage of a glyph, summed over its texels.
int ink_of(const GlyphAtlas& atlas, const GlyphAtlas::Glyph& glyph) {
  const vec2 size(atlas.width(), atlas.height());
  const vec2 min = glm::round(glyph.uv_min * size);
  const vec2 max = glm::round(glyph.uv_max * size);
  int ink = 0;
  for (int y = static_cast<int>(min.y); y < static_cast<int>(max.y); ++y) {
    for (int x = static_cast<int>(min.x); x < static_cast<int>(max.x); ++x) {
      ink += atlas.pixels()[static_cast<std::size_t>(y) * atlas.width() + x];
    }
  }
  return ink;
}

TEST(Utf8, IsReadLetterByLetter) {
  EXPECT_EQ(letters_of("a\xC3\xA9\xE2\x82\xAC\xF0\x9F\x98\x80z"),
            (std::vector<char32_t>{U'a', 0xE9, 0x20AC, 0x1F600, U'z'}));
}

TEST(Utf8, ThatIsMalformedNeverHidesTheLettersAfterIt) {
  for (const char* bad : {"\x80", "\xFF", "\xC3", "\xE2\x82", "\xF0\x9F\x98", "\xC0\xAF",
                          "\xED\xA0\x80", "\xF4\x90\x80\x80", "\xF8"}) {
    const std::vector<char32_t> letters = letters_of(std::string(bad) + "a");
    ASSERT_GE(letters.size(), 2U) << bad;
    EXPECT_EQ(letters.front(), kMalformed) << bad;
    EXPECT_EQ(letters.back(), U'a') << bad;
  }
}

TEST(Utf8, ThatEndsInTheMiddleOfALetterIsMalformed) {
  EXPECT_EQ(letters_of("\xE2\x82"), std::vector<char32_t>{kMalformed});
}

class AtlasOfHeight : public testing::TestWithParam<float> {};

TEST_P(AtlasOfHeight, HoldsEveryGlyphWithinItself) {
  const GlyphAtlas atlas = GlyphAtlas::build(GetParam(), {kSample});
  EXPECT_EQ(atlas.pixels().size(),
            static_cast<std::size_t>(atlas.width()) * static_cast<std::size_t>(atlas.height()));
  for (const char32_t letter : letters_of(kSample)) expect_within(atlas, atlas.glyph(letter));
}

TEST_P(AtlasOfHeight, DrawsLettersAboutAsHighAsAsked) {
  const GlyphAtlas atlas = GlyphAtlas::build(GetParam(), {"Dj"});
  EXPECT_NEAR(atlas.line_height(), GetParam(), 1.5F + 0.1F * GetParam());
  const GlyphAtlas::Glyph& high = atlas.glyph(U'D');
  const GlyphAtlas::Glyph& low = atlas.glyph(U'j');
  EXPECT_NEAR(high.size.y, 0.63F * GetParam(), 1.5F + 0.1F * GetParam());
  EXPECT_LE(-high.offset.y, atlas.ascent());
  EXPECT_LE(low.offset.y + low.size.y, atlas.line_height() - atlas.ascent());
}

TEST_P(AtlasOfHeight, PutsNoTwoGlyphsIntoOnePlace) {
  const GlyphAtlas atlas = GlyphAtlas::build(GetParam(), {kSample});
  const vec2 white = atlas.white_uv();
  const std::vector<char32_t> letters = letters_of(kSample);
  for (const char32_t a : letters) {
    const auto& one = atlas.glyph(a);
    EXPECT_FALSE(glm::all(glm::lessThan(one.uv_min, white)) &&
                 glm::all(glm::lessThan(white, one.uv_max)));
    for (const char32_t b : letters) {
      const auto& other = atlas.glyph(b);
      if (a == b) continue;
      EXPECT_FALSE(glm::all(glm::lessThan(one.uv_min, other.uv_max)) &&
                   glm::all(glm::lessThan(other.uv_min, one.uv_max)));
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Pixels, AtlasOfHeight, testing::Values(4, 9, 13, 19, 28, 56, 400));

TEST(GlyphAtlas, HasAWhiteTexel) {
  const GlyphAtlas atlas = GlyphAtlas::build(19, {kSample});
  const vec2 texel = atlas.white_uv() * vec2(atlas.width(), atlas.height());
  EXPECT_EQ(atlas.pixels()[static_cast<std::size_t>(texel.y) * atlas.width() +
                           static_cast<std::size_t>(texel.x)],
            255);
  EXPECT_EQ(GlyphAtlas().pixels(), std::vector<std::uint8_t>{255});
}

TEST(GlyphAtlas, DrawsLettersButNotBlanks) {
  const GlyphAtlas atlas = GlyphAtlas::build(19, {"a M"});
  EXPECT_GT(ink_of(atlas, atlas.glyph(U'a')), 0);
  EXPECT_GT(ink_of(atlas, atlas.glyph(U'M')), ink_of(atlas, atlas.glyph(U'a')));
  EXPECT_EQ(ink_of(atlas, atlas.glyph(U' ')), 0);
  EXPECT_GT(atlas.glyph(U' ').advance, 0);
}

TEST(GlyphAtlas, ShowsABoxForWhatItLacks) {
  const GlyphAtlas atlas = GlyphAtlas::build(19, {"a\xFF", "\xF0\x9F\xBF\xBF"});
  const GlyphAtlas::Glyph& box = atlas.glyph(kMalformed);
  EXPECT_GT(ink_of(atlas, box), 0);
  EXPECT_GT(box.advance, 0);
  EXPECT_EQ(&atlas.glyph(0x1FFFF), &box);  // not in the font
  EXPECT_EQ(&atlas.glyph(U'b'), &box);     // not asked for
  EXPECT_NE(&atlas.glyph(U'a'), &box);
}

TEST(GlyphAtlas, SurvivesAnyBytes) {
  std::mt19937 random(5);
  for (int round = 0; round < 50; ++round) {
    std::string text(static_cast<std::size_t>(random() % 60), ' ');
    for (char& c : text) c = static_cast<char>(random());
    Overlay overlay;
    overlay.atlas = GlyphAtlas::build(12, {text});
    overlay.add_text({10, 20}, text, vec4(1));
    EXPECT_GE(overlay.atlas.width_of(text), 0);
    for (const Overlay::Vertex& v : overlay.vertices) {
      EXPECT_TRUE(v.uv.x >= 0 && v.uv.x <= 1 && v.uv.y >= 0 && v.uv.y <= 1);
    }
  }
}

TEST(GlyphAtlas, GrowsWithTheScriptsThatAreWritten) {
  std::string text;
  for (unsigned i = 0; i < 1500; ++i) {  // Latin, Greek, Cyrillic: two bytes each
    const unsigned letter = 0x100 + i % 0x500;
    text += static_cast<char>(0xC0 | (letter >> 6));
    text += static_cast<char>(0x80 | (letter & 0x3F));
  }
  const GlyphAtlas atlas = GlyphAtlas::build(40, {text});
  for (const char32_t letter : letters_of(text)) expect_within(atlas, atlas.glyph(letter));
  EXPECT_LT(atlas.height(), 3 * atlas.width());
  EXPECT_LT(atlas.width(), 4096);
}

TEST(GlyphAtlas, MeasuresWhatIsDrawn) {
  Overlay overlay;
  overlay.atlas = GlyphAtlas::build(19, {kSample});
  overlay.add_text({7, 30}, kSample, vec4(1));
  float right = 0;
  for (const Overlay::Vertex& v : overlay.vertices) right = std::max(right, v.position.x);
  EXPECT_NEAR(right, 7 + overlay.atlas.width_of(kSample), 3);
  EXPECT_EQ(overlay.atlas.width_of(""), 0);
  EXPECT_EQ(overlay.atlas.width_of("DD"), 2 * overlay.atlas.width_of("D"));
}

TEST(Overlay, PlacesTextOnWholePixels) {
  Overlay overlay;
  overlay.atlas = GlyphAtlas::build(17, {kSample});
  overlay.add_text({10.3F, 20.8F}, kSample, vec4(1));
  ASSERT_FALSE(overlay.vertices.empty());
  for (const Overlay::Vertex& v : overlay.vertices) {
    EXPECT_EQ(v.position, glm::floor(v.position));
  }
}

TEST(Overlay, DrawsRectanglesWithTheWhiteTexel) {
  Overlay overlay;
  overlay.atlas = GlyphAtlas::build(17, {"a"});
  overlay.add_gradient({1, 2}, {3, 5}, vec4(1, 0, 0, 1), vec4(0, 0, 1, 0.5F));
  ASSERT_EQ(overlay.vertices.size(), 6U);
  float area = 0;  // the two triangles cover the rectangle
  for (std::size_t i = 0; i < 6; i += 3) {
    const vec2 u = overlay.vertices[i + 1].position - overlay.vertices[i].position;
    const vec2 v = overlay.vertices[i + 2].position - overlay.vertices[i].position;
    area += std::abs(u.x * v.y - u.y * v.x) / 2;
  }
  EXPECT_EQ(area, 6);
  for (const Overlay::Vertex& v : overlay.vertices) {
    EXPECT_EQ(v.uv, overlay.atlas.white_uv());
    EXPECT_EQ(v.colour, v.position.y == 2 ? vec4(1, 0, 0, 1) : vec4(0, 0, 1, 0.5F));
  }
}

TEST(TextThatIsTooLong, IsCutWithAnEllipsis) {
  const std::string text = "contours every 0.1";
  const GlyphAtlas atlas = GlyphAtlas::build(17, {text, std::string(kEllipsis)});
  const float whole = atlas.width_of(text);
  EXPECT_EQ(cut_to_width(atlas, text, whole), text);
  const std::string expected = "con" + std::string(kEllipsis);
  EXPECT_EQ(cut_to_width(atlas, text, atlas.width_of(expected)), expected);
  for (float width = 0; width < whole; width += 1) {
    const std::string cut = cut_to_width(atlas, text, width);
    EXPECT_LE(atlas.width_of(cut), width);
    EXPECT_TRUE(cut.empty() || cut.ends_with(kEllipsis)) << cut;
  }
}

TEST(TextThatIsTooLong, IsNeverCutInsideALetter) {
  const std::string text = "\xCE\xB1\xCE\xB2\xCE\xB3\xCE\xB4\xCE\xB5";
  const GlyphAtlas atlas = GlyphAtlas::build(17, {text, std::string(kEllipsis)});
  for (float width = 0; width < 80; width += 1) {
    for (const char32_t letter : letters_of(cut_to_width(atlas, text, width))) {
      EXPECT_NE(letter, kMalformed);
    }
  }
}

TEST(TextThatIsTooLong, IsWrappedAtBlanks) {
  const GlyphAtlas atlas =
      GlyphAtlas::build(17, {"geodesic distance (mm)", std::string(kEllipsis)});
  const auto lines = [&](std::string_view text, float width, std::size_t most) {
    return wrapped_lines(atlas, text, width, most);
  };
  using Lines = std::vector<std::string>;
  const float word = atlas.width_of("geodesic");
  EXPECT_EQ(lines("geodesic distance (mm)", 1000, 3), (Lines{"geodesic distance (mm)"}));
  EXPECT_EQ(lines("geodesic distance (mm)", word, 3), (Lines{"geodesic", "distance", "(mm)"}));
  EXPECT_EQ(lines("  ", 1000, 3), Lines{});
  EXPECT_EQ(lines("geodesic distance (mm)", word, 2).size(), 2U);
  EXPECT_TRUE(lines("geodesic distance (mm)", word, 2)[1].ends_with(kEllipsis));
  EXPECT_TRUE(lines("geodesicdistance", word, 3)[0].ends_with(kEllipsis));
}

}  // namespace
}  // namespace geotherm::test
