// SPDX-License-Identifier: MIT
#include "app/picture/figure.h"

#include <gtest/gtest.h>

#include <regex>

#include "app/drawing/figure_shapes.h"
#include "app/drawing/picture_scene.h"

namespace geotherm::test {
namespace {

using app::DrawnPicture;
using app::Figure;
using app::FigureFormat;
using app::FigureShapes;
using app::PictureData;

std::size_t count_of(const std::string& part, const std::string& in) {
  std::size_t count = 0;
  for (auto at = in.find(part); at != std::string::npos; at = in.find(part, at + 1)) ++count;
  return count;
}

DrawnPicture figured_picture() {
  Figure figure;
  figure.strokes.push_back({{{{1, 1}, {30, 20}}, {{5, 5}, {6, 9}}}, {1, 0, 0, 1}, 2});
  figure.strokes.push_back({{{{1, 9}, {30, 9}}}, {0, 0, 1, 0.5F}, 1, 6});
  figure.boxes.push_back({{30, 2}, {34, 28}, {{1, 1, 1, 1}, {0, 0, 0, 1}}});
  figure.letters.push_back({{2, 28}, 20, "\u2207\u03c6 0.5", {0, 0, 0, 1}});
  figure.font = engine::font_file();
  DrawnPicture out{40, 30, std::vector<std::uint8_t>(std::size_t{4} * 40 * 30, 255)};
  out.figure = std::make_shared<Figure>(std::move(figure));
  return out;
}

std::string figure_file(FigureFormat format) {
  auto bytes =
      app::figure_bytes(figured_picture(), format,
                        {{"Title", "a title"}, {"geotherm:command", "geotherm render x -o y.pdf"}});
  EXPECT_TRUE(bytes) << bytes.error().message;
  return *bytes;
}

TEST(Figures, AsPdfHoldOneImageAndAFont) {
  const std::string pdf = figure_file(FigureFormat::kPdf);
  EXPECT_EQ(pdf.substr(0, 5), "%PDF-");
  EXPECT_EQ(count_of("/Subtype /Image", pdf), 1U);
  EXPECT_GE(count_of("/FontFile2", pdf), 1U);
  EXPECT_NE(pdf.find("a title"), std::string::npos);
  EXPECT_NE(pdf.find("geotherm render x -o y.pdf"), std::string::npos);
  EXPECT_NE(pdf.find("/MediaBox [ 0 0 30 22.5 ]"), std::string::npos);  // points
}

TEST(Figures, AsSvgHoldOneImageAndShapes) {
  const std::string svg = figure_file(FigureFormat::kSvg);
  EXPECT_EQ(count_of("<image", svg), 1U);
  EXPECT_NE(svg.find("width=\"40px\" height=\"30px\""), std::string::npos) << svg.substr(0, 300);
  EXPECT_EQ(count_of("stroke-dasharray", svg), 1U);
  EXPECT_EQ(count_of("<linearGradient", svg), 1U);
  EXPECT_GE(count_of("<use", svg), 4U);  // letters
}

TEST(Figures, HaveTheSizeOfTheirPixelsAnInch) {
  const auto pdf = app::figure_bytes(figured_picture(), FigureFormat::kPdf, {}, 300);
  EXPECT_NE(pdf->find("/MediaBox [ 0 0 9.6 7.2 ]"), std::string::npos);
  const auto svg = app::figure_bytes(figured_picture(), FigureFormat::kSvg, {}, 254);
  EXPECT_NE(svg->find("width=\"4mm\" height=\"3mm\" viewBox=\"0 0 4 3\""), std::string::npos)
      << svg->substr(0, 300);
}

TEST(Figures, HaveTheSameBytesEachTime) {
  EXPECT_EQ(figure_file(FigureFormat::kPdf), figure_file(FigureFormat::kPdf));
  EXPECT_EQ(figure_file(FigureFormat::kPdf).find("Date"), std::string::npos);
  // Cairo numbers the surfaces of a process; the next process begins again.
  const std::regex number("(surface|image)[0-9]+");
  EXPECT_EQ(std::regex_replace(figure_file(FigureFormat::kSvg), number, "$1"),
            std::regex_replace(figure_file(FigureFormat::kSvg), number, "$1"));
}

TEST(Figures, AsPdfAreNoLargerThanReadersShow) {
  DrawnPicture wide = figured_picture();
  wide.width = 2100;
  wide.height = 1;
  wide.pixels.assign(std::size_t{4} * 2100, 255);
  const auto refused = app::figure_bytes(wide, FigureFormat::kPdf, {}, 10);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, ErrorCode::kBadInput);
  EXPECT_NE(refused.error().message.find("15120 x 7 points"), std::string::npos)
      << refused.error().message;
  EXPECT_TRUE(app::figure_bytes(wide, FigureFormat::kPdf, {}, 11));
  EXPECT_TRUE(app::figure_bytes(wide, FigureFormat::kSvg, {}, 10));
}

TEST(Figures, EndTheLinesOfACellWithIt) {
  DrawnPicture picture = figured_picture();
  EXPECT_EQ(count_of("<clipPath", *app::figure_bytes(picture, FigureFormat::kSvg, {})), 0U);
  Figure cells;
  cells.append(*picture.figure, {Eigen::Vector2d(10, 5), Eigen::Vector2d(25, 15)});
  EXPECT_EQ(cells.strokes[0].parts[0][0], Eigen::Vector2d(11, 6));
  EXPECT_EQ(cells.strokes[0].clip.min(), Eigen::Vector2d(10, 5));
  EXPECT_EQ(cells.strokes[0].clip.max(), Eigen::Vector2d(25, 15));
  cells.font = picture.figure->font;
  picture.figure = std::make_shared<Figure>(std::move(cells));
  EXPECT_GE(count_of("<clipPath", *app::figure_bytes(picture, FigureFormat::kSvg, {})), 1U);
}

/// A square about the z axis with distances that grow with x, before and behind each other.
void append_square(PictureData& data, float half, float z) {
  const auto first = static_cast<std::uint32_t>(data.positions.size());
  for (const auto& [x, y] : {std::pair(-half, -half), {half, -half}, {half, half}, {-half, half}}) {
    data.positions.push_back({x, y, z});
    data.values.push_back((x + 0.5F) * 0.9F);
  }
  data.faces.push_back({first, first + 1, first + 2});
  data.faces.push_back({first, first + 2, first + 3});
}

class FigureOfSquares : public testing::Test {
 protected:
  FigureOfSquares() {
    append_square(data_, 0.5F, -0.3F);
    append_square(data_, 0.25F, 0.3F);
    data_.lines.push_back({{{-0.45F, 0, -0.3F}, {0.45F, 0, -0.3F}}, {1, 0.8F, 0}, "geodesic"});
    scene_.camera = engine::make_camera({.azimuth = 0, .elevation = 0, .orthographic = true},
                                        app::scene_vectors(data_.positions), {400, 400});
    scene_.surface.paint = engine::Paint::kMap;
    scene_.surface.line_spacing = 0.3F;
    scene_.markers.visible = false;
  }

  Figure figure(const engine::Overlay& overlay = {}) const {
    auto shapes = FigureShapes::build(data_, scene_.surface);
    EXPECT_TRUE(shapes) << shapes.error().message;
    return shapes->of(data_, settings_, scene_, overlay);
  }

  PictureData data_;
  app::PictureDataSettings settings_;
  engine::Scene scene_;
};

double length_of(const Figure& figure) {
  double length = 0;
  for (const Figure::Stroke& stroke : figure.strokes) {
    EXPECT_EQ(stroke.dash, 0);
    for (const app::Outline& part : stroke.parts) length += (part.back() - part.front()).norm();
  }
  return length;
}

TEST_F(FigureOfSquares, ShowsIsolinesWhereTheyAreSeen) {
  data_.lines.clear();
  const double length = length_of(figure());
  // Levels 0.3 and 0.6 at x = -0.167 and 0.167 pass behind the square in front, which has them as
  // well; 0.9 is the edge itself, beyond which nothing is larger.
  const double pixels = scene_.camera.pixels_per_unit;
  EXPECT_NEAR(length / pixels, 2, 0.01);
  engine::Scene rest = FigureShapes::rest_of(scene_);
  EXPECT_EQ(rest.surface.line_spacing, 0);
  EXPECT_FALSE(rest.lines.visible);
}

TEST_F(FigureOfSquares, HasNoIsolinesOfTheOtherSideOfAThinBody) {
  data_ = {};
  append_square(data_, 0.5F, 0);
  scene_.surface.line_spacing = 0.3F;
  const double one = length_of(figure());
  EXPECT_GT(one, 0);
  append_square(data_, 0.5F, -0.001F);
  EXPECT_NEAR(length_of(figure()) / one, 1, 1e-3);
}

TEST_F(FigureOfSquares, HasCurvesOfSourcesHalfAsWideAsPoints) {
  data_.lines.clear();
  scene_.surface.line_spacing = 0;
  scene_.markers.visible = true;
  scene_.markers.radius = 8;
  const auto widths = [this] {
    std::vector<double> out;
    for (const Figure::Stroke& stroke : figure().strokes) out.push_back(stroke.width);
    return out;
  };
  data_.sources = {{{0.1F, 0, 0.3F}, {0.1F, 0, 0.3F}}};
  const std::vector<double> point = widths();
  ASSERT_EQ(point.size(), 2U);
  EXPECT_EQ(point[0], 16);
  data_.sources = {{{0.1F, 0, 0.3F}, {-0.1F, 0, 0.3F}}};
  EXPECT_EQ(widths(), (std::vector<double>{point[0] / 2, point[1] / 2}));
}

TEST_F(FigureOfSquares, HasNoIsolinesBeyondTheEndsOfTheMap) {
  data_.lines.clear();
  scene_.surface.levels = {0.25F, 0.5F, 0.75F};
  scene_.surface.range_max = 0.5F;
  const auto drawn = [this] { return figure().strokes.size(); };
  const std::size_t within = drawn();
  scene_.surface.levels = {0.25F, 0.5F};
  EXPECT_EQ(within, drawn()) << "a line at an end of the map is whole";
  scene_.surface.levels = {0.25F, 0.5F, 0.75F};
  scene_.surface.paint = engine::Paint::kRegions;
  EXPECT_GT(drawn(), within) << "there is no map";
}

TEST_F(FigureOfSquares, ShowsThePathsThatTheWindowShows) {
  scene_.surface.line_spacing = 0;
  const std::size_t one = figure().strokes.size();
  data_.lines.push_back({{{-0.45F, 0.1F, -0.3F}, {0.45F, 0.1F, -0.3F}}, {1, 0.8F, 0}, "heat"});
  EXPECT_EQ(figure().strokes.size(), one);
  settings_.path_kind = app::PathKind::kHeat;
  EXPECT_EQ(figure().strokes.size(), one);
  settings_.path_kind = app::PathKind::kAll;
  EXPECT_EQ(figure().strokes.size(), 2 * one);
}

TEST_F(FigureOfSquares, DashesWhatIsHiddenOfPaths) {
  scene_.surface.line_spacing = 0;
  double hidden = 0, seen = 0;
  for (const Figure::Stroke& stroke : figure().strokes) {
    if (stroke.colour[0] != 1) continue;  // a rim
    for (const app::Outline& part : stroke.parts) {
      (stroke.dash > 0 ? hidden : seen) += (part.back() - part.front()).norm();
    }
    EXPECT_EQ(stroke.colour[3]<1, stroke.dash> 0);
  }
  const double pixels = scene_.camera.pixels_per_unit;
  EXPECT_NEAR(hidden / pixels, 0.5, 0.01);
  EXPECT_NEAR(seen / pixels, 0.4, 0.01);
}

TEST_F(FigureOfSquares, JoinsTheColoursOfABar) {
  engine::Overlay overlay;
  constexpr int kPieces = 1023;
  for (int i = 0; i < kPieces; ++i) {
    const float share = static_cast<float>(i) / kPieces, next = static_cast<float>(i + 1) / kPieces;
    overlay.add_gradient({10, 100 - 90 * next}, {20, 100 - 90 * share}, {next, 0, 0, 1},
                         {share, 0, 0, 1});
  }
  overlay.add_rectangle({10, 10}, {20, 11}, {0, 0, 0, 1});
  const Figure found = figure(overlay);
  ASSERT_EQ(found.boxes.size(), 2U);
  const Figure::Box& bar = found.boxes.front();
  EXPECT_LE(bar.colours.size(), 129U);
  EXPECT_EQ(bar.colours.front()[0], 1);
  EXPECT_EQ(bar.colours.back()[0], 0);
  EXPECT_NEAR(bar.min.y(), 10, 1e-4);
  EXPECT_NEAR(bar.max.y(), 100, 1e-4);
}

}  // namespace
}  // namespace geotherm::test
