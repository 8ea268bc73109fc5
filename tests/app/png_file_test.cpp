// SPDX-License-Identifier: MIT
#include "app/picture/png_file.h"

#include <gtest/gtest.h>

#include "tests/app/png_reader.h"

namespace geotherm::test {
namespace {

using app::DrawnPicture;
using app::png_bytes;

DrawnPicture gradient(int width, int height, std::uint8_t alpha) {
  DrawnPicture picture{width, height, {}};
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      picture.pixels.push_back(static_cast<std::uint8_t>(5 * x));
      picture.pixels.push_back(static_cast<std::uint8_t>(7 * y));
      picture.pixels.push_back(static_cast<std::uint8_t>(x + y));
      picture.pixels.push_back(alpha);
    }
  }
  return picture;
}

TEST(PngFile, ReadsBackWithItsTransparency) {
  DrawnPicture picture = gradient(31, 17, 255);
  picture.pixels[7] = 3;
  const auto bytes = png_bytes(picture);
  ASSERT_TRUE(bytes) << bytes.error().message;
  const PngContent read = read_png(*bytes);
  ASSERT_TRUE(read.valid);
  EXPECT_EQ(read.width, 31);
  EXPECT_EQ(read.height, 17);
  EXPECT_EQ(read.channels, 4);
  EXPECT_EQ(read.pixels, picture.pixels);
  EXPECT_TRUE(read.srgb);
}

TEST(PngFile, OfAnOpaquePictureHasThreeChannels) {
  const DrawnPicture picture = gradient(31, 17, 255);
  const auto bytes = png_bytes(picture);
  ASSERT_TRUE(bytes) << bytes.error().message;
  const PngContent read = read_png(*bytes);
  ASSERT_EQ(read.channels, 3);
  for (std::size_t p = 0; p < read.pixels.size() / 3; ++p) {
    for (std::size_t c = 0; c < 3; ++c) {
      ASSERT_EQ(read.pixels[3 * p + c], picture.pixels[4 * p + c]) << p;
    }
  }
}

TEST(PngFile, KeepsItsTexts) {
  const auto bytes = png_bytes(
      gradient(1, 1, 255), std::vector<app::FileText>{{"Software", "geotherm"},
                                                      {"geotherm:model", "M\u00f6bius \u2202.obj"},
                                                      {"Broken",
                                                       "a\xff\xc3"
                                                       "b\xe2\x88"},
                                                      {"Lines", "one\ntwo"},
                                                      {"Long", std::string(100'000, 'x')},
                                                      {"Empty", ""}});
  ASSERT_TRUE(bytes) << bytes.error().message;
  PngContent read = read_png(*bytes);
  ASSERT_TRUE(read.valid);
  EXPECT_EQ(read.texts["Software"], "geotherm");
  EXPECT_EQ(read.texts["geotherm:model"], "M\u00f6bius \u2202.obj");
  EXPECT_EQ(read.texts["Broken"], "a??b??");
  EXPECT_EQ(read.texts["Lines"], "one?two");
  EXPECT_EQ(read.texts["Long"].size(), 100'000U);
  EXPECT_EQ(read.texts.count("Empty"), 1U);
  EXPECT_NE(bytes->find("tEXtSoftware"), std::string::npos);
  EXPECT_NE(bytes->find("iTXtgeotherm:model"), std::string::npos);
}

TEST(PngFile, OfNoPixelsIsAnErrorAndNotTheEndOfTheProgram) {
  const auto bytes = png_bytes(DrawnPicture{0, 5, {}});
  ASSERT_FALSE(bytes);
  EXPECT_NE(sentence(bytes.error()).find("0 x 5"), std::string::npos) << bytes.error().message;
}

}  // namespace
}  // namespace geotherm::test
