// SPDX-License-Identifier: MIT
// Pictures of a surface that moves, by the built program.
#include <algorithm>

#include "tests/app/png_reader.h"
#include "tests/app/program_fixture.h"

namespace geotherm::test {
namespace {

class RenderSequence : public DrawingProgram {
 protected:
  PngContent picture(const std::string& name) {
    PngContent content = read_png(bytes_of(folder.path(name)));
    EXPECT_TRUE(content.valid) << name;
    return content;
  }

  /// The columns of a picture in which something is drawn, the first and the last.
  static std::pair<int, int> columns(const PngContent& picture) {
    std::pair<int, int> out(picture.width, -1);
    for (int y = 0; y < picture.height; ++y) {
      for (int x = 0; x < picture.width; ++x) {
        const auto at = static_cast<std::size_t>(4 * (y * picture.width + x) + 3);
        if (picture.pixels[at] == 0) continue;
        out = {std::min(out.first, x), std::max(out.second, x)};
      }
    }
    return out;
  }
};

/// A square that is 4 units further to the right in every frame, and twice as large in the last.
std::string square(int k) {
  const auto at = [k](int x, int y) {
    const int size = k == 2 ? 2 : 1;
    return "v " + std::to_string(4 * k + size * x) + " " + std::to_string(size * y) + " 0\n";
  };
  return at(0, 0) + at(1, 0) + at(1, 1) + at(0, 1) + "f 1 2 3\nf 1 3 4\n";
}

TEST_F(RenderSequence, HasOneCameraAndOneScaleForAllFrames) {
  folder.write("body.obj", square(0));
  for (int k = 0; k < 3; ++k) folder.write("f" + std::to_string(k + 5) + ".obj", square(k));
  const Json report = json({"render",
                            "body.obj",
                            "--sequence",
                            "f%d.obj",
                            "-s",
                            "0",
                            "--size",
                            "320x160",
                            "--azimuth",
                            "0",
                            "--elevation",
                            "0",
                            "--background",
                            "transparent",
                            "--no-caption",
                            "--no-bar",
                            "--no-markers",
                            "--projection",
                            "orthographic",
                            "-o",
                            "p_%03d.png",
                            "--json",
                            "-"});
  EXPECT_EQ(report["picture"]["files"], (Json{"p_005.png", "p_006.png", "p_007.png"}));
  EXPECT_EQ(report["frames"]["count"], 3);
  std::vector<std::pair<int, int>> seen;
  for (const char* name : {"p_005.png", "p_006.png", "p_007.png"}) {
    const PngContent content = picture(name);
    EXPECT_EQ(content.texts.at("geotherm:range"), picture("p_005.png").texts.at("geotherm:range"));
    EXPECT_NE(content.texts.at("Description").find(" faces, t = "), std::string::npos);
    seen.push_back(columns(content));
  }
  // The squares lie from 0 to 1, 4 to 5 and 8 to 10 of a scene of 10 units.
  const double unit = (seen[2].second - seen[0].first) / 10.0;
  constexpr double kPixels = 2;
  EXPECT_GT(unit, 20);
  EXPECT_NEAR(seen[0].second - seen[0].first, unit, kPixels);
  EXPECT_NEAR(seen[1].first - seen[0].first, 4 * unit, kPixels);
  EXPECT_NEAR(seen[1].second - seen[1].first, unit, kPixels);
  EXPECT_NEAR(seen[2].first - seen[0].first, 8 * unit, kPixels);
  EXPECT_NEAR(seen[2].second - seen[2].first, 2 * unit, kPixels);
}

TEST_F(RenderSequence, LeavesOutBadFramesWhereAskedAndOtherwiseLeavesNothing) {
  folder.write("body.obj", square(0));
  for (int k = 0; k < 3; ++k) folder.write("f" + std::to_string(k) + ".obj", square(k));
  folder.write("f1.obj", "this is no mesh");
  const auto before = folder.names();
  std::vector<std::string> arguments = {"render", "body.obj", "--sequence", "f%d.obj", "-s",
                                        "0",      "--size",   "80x60",      "-o",      "p%d.png"};
  const ProgramRun failed = run_program(folder.path("."), arguments);
  EXPECT_EQ(failed.code, 1);
  EXPECT_NE(failed.err.find("error: f1.obj: "), std::string::npos) << failed.err;
  EXPECT_EQ(folder.names(), before);
  arguments.emplace_back("--skip-bad");
  const ProgramRun done = run(arguments);
  EXPECT_NE(done.err.find("left out: f1.obj: "), std::string::npos) << done.err;
  EXPECT_NE(done.out.find("3 of f%d.obj, 1 of them bad"), std::string::npos) << done.out;
  const auto names = folder.names();
  EXPECT_EQ(std::ranges::count(names, std::string("p1.png")), 0);
  EXPECT_TRUE(picture("p0.png").valid && picture("p2.png").valid);
}

TEST_F(RenderSequence, RefusesWhatDoesNotGoWithIt) {
  folder.write("body.obj", square(0));
  folder.write("f0.obj", square(0));
  const std::vector<std::pair<std::vector<std::string>, std::string>> wrong = {
      {{"-o", "p.png"}, "has no place for a number"},
      {{"-o", "p%d.jpg"}, "give -o 'frame_%04d.png'"},
      {{"-o", "p%d.png", "--turntable", "4"}, "--turntable does not go with --sequence"},
      {{"-o", "p%d.png", "--path", "2"}, "--path does not go with --sequence"},
      {{"-o", "p%d.png", "--field", "body.obj"}, "--field does not go with --sequence"},
      {{"-o", "p%d.png", "--view", "exact-error"}, "--view exact-error does not go"},
      {{"-o", "p%d.png", "--view", "regions"}, "add --method wavefront"}};
  for (const auto& [words, what] : wrong) {
    std::vector<std::string> arguments = {"render", "body.obj", "--sequence", "f%d.obj", "-s", "0"};
    arguments.insert(arguments.end(), words.begin(), words.end());
    const ProgramRun failed = run_program(folder.path("."), arguments);
    EXPECT_EQ(failed.code, 2);
    EXPECT_NE(failed.err.find(what), std::string::npos) << failed.err;
  }
}

}  // namespace
}  // namespace geotherm::test
