// SPDX-License-Identifier: MIT
// Pictures from the built program, on whatever device there is; the software one is enough.
#include <set>

#include "app/picture/picture_settings.h"
#include "tests/app/png_reader.h"
#include "tests/app/program_fixture.h"
#include "tests/app/variable.h"

namespace geotherm::test {
namespace {

class ProgramRender : public DrawingProgram {
 protected:
  /// The picture and how many colours it has.
  std::pair<PngContent, std::size_t> picture(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "render");
    arguments.insert(arguments.end(), {"--size", "240x180", "-o", "a.png"});
    run(arguments);
    PngContent content = read_png(bytes_of(folder.path("a.png")));
    EXPECT_TRUE(content.valid);
    std::set<std::string> colours;
    const auto channels = static_cast<std::size_t>(content.channels);
    for (std::size_t i = 0; channels > 0 && i < content.pixels.size(); i += channels) {
      colours.emplace(content.pixels.begin() + static_cast<std::ptrdiff_t>(i),
                      content.pixels.begin() + static_cast<std::ptrdiff_t>(i + channels));
    }
    return {std::move(content), colours.size()};
  }
};

/// Shades of a lit model alone are more than this.
constexpr std::size_t kSomeColours = 40;

class ProgramViews : public ProgramRender, public testing::WithParamInterface<std::string> {};

TEST_P(ProgramViews, ArePicturesOfTheModel) {
  const auto [content, colours] = picture({"bunny", "-s", "17", "--view", GetParam()});
  EXPECT_EQ(content.width, 240);
  EXPECT_EQ(content.height, 180);
  EXPECT_EQ(content.channels, 3);
  EXPECT_GT(colours, kSomeColours);
}

INSTANTIATE_TEST_SUITE_P(All, ProgramViews, testing::ValuesIn(all_names<app::View>()),
                         [](const auto& test) {
                           std::string name = test.param;
                           std::replace(name.begin(), name.end(), '-', '_');
                           return name;
                         });

TEST_F(ProgramRender, KeepsATransparentBackground) {
  const auto [content, colours] =
      picture({"bunny", "-s", "17", "--background", "transparent", "--no-caption"});
  ASSERT_EQ(content.channels, 4);
  EXPECT_EQ(content.pixels[3], 0);
  EXPECT_GT(colours, kSomeColours);
}

TEST_F(ProgramRender, GivesTheSamePictureTwice) {
  const std::vector<std::string> arguments = {"bunny", "-s", "17", "--no-caption"};
  const PngContent first = picture(arguments).first;
  EXPECT_EQ(picture(arguments).first.pixels, first.pixels);
}

TEST_F(ProgramRender, DrawsWhatHasNoSizeOrAnySize) {
  folder.write("flat.obj", "v 1 1 1\nv 1 1 1\nv 1 1 1\nf 1 2 3\n");
  folder.write("line.obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n");
  folder.write("huge.obj", "v 0 0 0\nv 1e200 0 0\nv 0 1e200 0\nf 1 2 3\n");
  folder.write("tiny.obj", "v 0 0 0\nv 1e-200 0 0\nv 0 1e-200 0\nf 1 2 3\n");
  for (const char* model : {"flat.obj", "line.obj", "huge.obj", "tiny.obj"}) {
    for (const char* view : {"contours", "gradient-error", "wireframe"}) {
      EXPECT_TRUE(picture({model, "-s", "0", "--view", view}).first.valid) << model << " " << view;
    }
  }
}

/// The distance that a pixel of the map `grey` stands for, of the largest: black is far.
double shade(const PngContent& picture, int x, int y) {
  const auto at = static_cast<std::size_t>(picture.channels * (y * picture.width + x));
  return picture.pixels[at] / 255.0;
}

TEST_F(ProgramRender, ASliceThroughABallShowsTheDistanceFromItsCentre) {
  run({"generate", "ball-tets", "--tets", "20000", "-o", "ball.mesh"});
  const std::vector<std::string> plain = {"ball.mesh",
                                          "-s",
                                          "0",
                                          "--method",
                                          "fast-marching",
                                          "--colour-map",
                                          "grey",
                                          "--light",
                                          "none",
                                          "--spacing",
                                          "0",
                                          "--no-bar",
                                          "--no-caption",
                                          "--no-markers",
                                          "--azimuth",
                                          "0",
                                          "--elevation",
                                          "0",
                                          "--projection",
                                          "orthographic",
                                          "--fit",
                                          "sphere"};
  const PngContent whole = picture(plain).first;
  std::vector<std::string> cut = plain;
  cut.insert(cut.end(), {"--slice", "z"});
  const PngContent sliced = picture(cut).first;
  const int x = whole.width / 2, y = whole.height / 2;
  // A ball of radius 1 fills the height but for the margins.
  int radius = 0;
  while (shade(sliced, x + radius + 1, y) < 1) ++radius;
  ASSERT_GT(radius, 60);
  const double at_centre = shade(sliced, x, y), at_border = shade(whole, x, y);
  EXPECT_GT(std::abs(at_centre - at_border), 0.5);
  constexpr double kPixel = 1.5, kGrey = 2.0 / 255;
  for (const double share : {0.25, 0.5, 0.75}) {
    const int away = static_cast<int>(share * radius);
    const double expected = at_centre + (at_border - at_centre) * away / radius;
    const double slack = kGrey + std::abs(at_border - at_centre) * kPixel / radius;
    EXPECT_NEAR(shade(sliced, x + away, y), expected, slack) << share;
    EXPECT_NEAR(shade(sliced, x, y - away), expected, slack) << share;
    EXPECT_NEAR(shade(whole, x + away, y), at_border, kGrey)
        << share;  // the border's distance is 1
  }
}

TEST_F(ProgramRender, SlicesAndPeelsEveryViewOfVolumesAndSurfaces) {
  run({"generate", "box-tets", "--tets", "1000", "-o", "box.mesh"});
  for (const char* view : {"contours", "wireframe", "flat", "regions", "heat-gradient",
                           "eikonal-error", "triangle-quality"}) {
    for (const char* model : {"box.mesh", "bunny"}) {
      const auto [content, colours] =
          picture({model, "-s", "0", "-s", "17", "--view", view, "--slice", "-1:0.5:0",
                   "--slice-at", "0.6", "--peel", "above:0.1"});
      EXPECT_GT(colours, 10U) << model << " " << view;
    }
  }
  // Nothing is left, which is no failure.
  const auto [content, colours] = picture({"box.mesh", "-s", "0", "--slice", "x", "--slice-at", "0",
                                           "--no-bar", "--no-caption", "--no-markers"});
  EXPECT_EQ(colours, 1U);
}

TEST_F(ProgramRender, ShowsASourceInsideWhereASliceOpensTheBody) {
  run({"generate", "box-tets", "--tets", "1000", "-o", "box.mesh"});
  const std::vector<std::string> plain = {
      "box.mesh",  "-s", "xyz:1.03:0.71:0.5", "--slice", "z", "--no-bar", "--no-caption",
      "--azimuth", "0",  "--elevation",       "0"};
  const PngContent marked = picture(plain).first;
  std::vector<std::string> without = plain;
  without.emplace_back("--no-markers");
  const PngContent bare = picture(without).first;
  int changed = 0, white = 0;
  for (int y = 0; y < marked.height; ++y) {
    for (int x = 0; x < marked.width; ++x) {
      const auto at = static_cast<std::size_t>(marked.channels * (y * marked.width + x));
      const bool differs =
          !std::equal(&marked.pixels[at], &marked.pixels[at] + 3, &bare.pixels[at]);
      changed += differs;
      // Inside of markers is white where it is not hidden.
      white += differs && marked.pixels[at] > 240 && marked.pixels[at + 2] > 240;
    }
  }
  EXPECT_GT(changed, 10);
  EXPECT_GT(white, 3);
}

TEST_F(ProgramRender, SaysInOneLineThatADeviceIsNotThere) {
  const ProgramRun run = run_program(
      folder.path("."), {"render", "bunny", "-s", "17", "--device", "no such", "-o", "a.png"});
  EXPECT_EQ(run.code, 1);
  EXPECT_EQ(run.out, "");
  EXPECT_TRUE(run.err.starts_with("geotherm: error: ")) << run.err;
  EXPECT_NE(run.err.find("no such"), std::string::npos) << run.err;
  EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
  EXPECT_TRUE(folder.names().empty());
}

TEST_F(Program, SaysInOneLineThatThereIsNoDriver) {
  const Variable files("VK_DRIVER_FILES", "/nowhere");
  const Variable old_files("VK_ICD_FILENAMES", "/nowhere");
  for (const std::vector<std::string>& arguments :
       {std::vector<std::string>{"devices"}, {"render", "bunny", "-s", "17", "-o", "a.png"}}) {
    const ProgramRun run = run_program(folder.path("."), arguments);
    EXPECT_EQ(run.code, 1);
    EXPECT_EQ(run.out, "");
    EXPECT_TRUE(run.err.starts_with("geotherm: error: ")) << run.err;
    EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
  }
  EXPECT_TRUE(folder.names().empty());
}

}  // namespace
}  // namespace geotherm::test
