// SPDX-License-Identifier: MIT
// Sessions of the built program without a window, on whatever device there is.
#include <sys/resource.h>

#include <algorithm>
#include <cstdlib>

#include "tests/app/png_reader.h"
#include "tests/app/program_fixture.h"

namespace geotherm::test {
namespace {

class ProgramView : public DrawingProgram {
 protected:
  std::vector<std::uint8_t> pixels(const std::string& name) {
    const PngContent content = read_png(bytes_of(folder.path(name)));
    EXPECT_TRUE(content.valid) << name;
    return content.pixels;
  }
};

TEST_F(ProgramView, AReplayEqualsThePictureOfRender) {
  folder.write("log.geotherm",
               "open terrain\nsource set 17\ncamera orbit 10 5\ntime-factor 3\nview flat\n"
               "backend eigen-ldlt\nsource set 40 300\nview contours\nsize 320x200\n"
               "camera place 50 35 1.5 0.1 -0.05\nundo\nredo\n");
  run({"view", "--replay", "log.geotherm", "-o", "replay.png"});
  run({"render",      "terrain",    "-s",     "40,300",    "--time-factor", "3",
       "--backend",   "eigen-ldlt", "--size", "320x200",   "--azimuth",     "50",
       "--elevation", "35",         "--zoom", "1.5",       "--pan",         "0.1:-0.05",
       "--fit",       "sphere",     "-o",     "direct.png"});
  EXPECT_EQ(pixels("replay.png"), pixels("direct.png"));
}

TEST_F(ProgramView, SavesFiguresAsRenderDoes) {
  folder.write(
      "s.geotherm",
      "open terrain\nsource set 40\nsize 320x200\nsave picture f.svg\nsave picture f.pdf\n");
  run({"view", "--headless", "--script", "s.geotherm"});
  run({"render", "terrain", "-s", "40", "--size", "320x200", "--fit", "sphere", "-o", "r.svg"});
  EXPECT_EQ(bytes_of(folder.path("f.svg")), bytes_of(folder.path("r.svg")));
  EXPECT_EQ(bytes_of(folder.path("f.pdf")).substr(0, 5), "%PDF-");
  folder.write("p.geotherm", "open terrain\nsave picture p.svg panels\n");
  const ProgramRun refused =
      run_program(folder.path("."), {"view", "--headless", "--script", "p.geotherm"});
  EXPECT_EQ(refused.code, 2);
  EXPECT_NE(refused.err.find("panels are pixels"), std::string::npos) << refused.err;
}

TEST_F(ProgramView, SavesFiguresInSizesOnPaperAsRenderDoes) {
  run({"render", "terrain", "-s", "40", "--size", "80mmx6cm", "--fit", "sphere", "-o", "r.svg"});
  const std::string rendered = bytes_of(folder.path("r.svg"));
  folder.write("s.geotherm", "open terrain\nsource set 40\nsave picture s.svg 80mmx6cm\n");
  run({"view", "--headless", "--script", "s.geotherm"});
  EXPECT_EQ(bytes_of(folder.path("s.svg")), rendered);
  folder.write("t.geotherm", "open terrain\nsource set 40\n");
  run({"view", "t.geotherm", "--size", "80mmx6cm", "-o", "t.svg"});
  EXPECT_EQ(bytes_of(folder.path("t.svg")), rendered);
}

TEST_F(ProgramView, ASavedSessionAndALogGiveTheSamePicture) {
  folder.write("s.geotherm",
               "open bunny\nsource set random:3:4\nkeep\ntime-factor 9\nview gradient-error\n"
               "camera orbit 100 -10\ncamera zoom 1.3 0.1 0.2\nshow b\nsize 320x200\n"
               "background dark\nsave session saved.geotherm\nsave log log.geotherm\n"
               "save picture first.png\n");
  run({"view", "--headless", "--script", "s.geotherm"});
  run({"view", "--replay", "saved.geotherm", "-o", "saved.png"});
  folder.write("NAMED.GEOTHERM", bytes_of(folder.path("saved.geotherm")));
  run({"view", "NAMED.GEOTHERM", "-o", "named.png"});
  run({"view", "--replay", "log.geotherm", "-o", "log.png"});
  const auto first = pixels("first.png");
  EXPECT_EQ(pixels("saved.png"), first);
  EXPECT_EQ(pixels("named.png"), first);
  EXPECT_EQ(pixels("log.png"), first);
}

TEST_F(ProgramView, AScriptReplacesNoPictureThatIsThere) {
  folder.write("s.geotherm", "open bunny\nsize 64x48\nsave picture p.png\nsave picture p.png\n");
  run({"view", "--headless", "--script", "s.geotherm"});
  const std::string before = bytes_of(folder.path("p.png"));
  const ProgramRun refused =
      run_program(folder.path("."), {"view", "--headless", "--script", "s.geotherm"});
  EXPECT_EQ(refused.code, 2);
  EXPECT_NE(refused.err.find("p.png: is there already"), std::string::npos) << refused.err;
  EXPECT_EQ(bytes_of(folder.path("p.png")), before);
  run({"view", "--headless", "--replay", "s.geotherm", "-o", "p.png"});
}

TEST_F(ProgramView, NeedsNoMoreAddressSpaceThanARender) {
  // The least limit, in steps, under which a picture is rendered.
  const auto code_under = [this](rlim_t megabytes, const std::vector<std::string>& arguments) {
    rlimit before{};
    ::getrlimit(RLIMIT_AS, &before);
    const rlimit limit{megabytes << 20, before.rlim_max};
    ::setrlimit(RLIMIT_AS, &limit);
    const int code = run_program(folder.path("."), arguments).code;
    ::setrlimit(RLIMIT_AS, &before);
    return code;
  };
  constexpr rlim_t kStep = 250, kMin = 1250, kMax = 8000;
  const std::vector<std::string> picture = {"bunny", "--size", "64x48", "-o", "p.png"};
  std::vector<std::string> render = picture, view = picture;
  render.insert(render.begin(), "render");
  render.insert(render.end(), {"-s", "3"});
  view.insert(view.begin(), "view");
  rlim_t least = kMin;
  while (least < kMax && code_under(least, render) != 0) least += kStep;
  ASSERT_LT(least, kMax);
  EXPECT_EQ(code_under(least + kStep, view), 0) << "under " << least + kStep << " MB";
}

TEST_F(ProgramView, TheCentreIsInTheMiddleOfThePicture) {
  // The lower left of the terrain fills the picture that is centred there and zoomed into.
  run({"view", "terrain", "--no-bar", "--no-caption", "--centre", "0:0:0", "--zoom", "4", "--size",
       "200x200", "-o", "middle.png"});
  run({"view", "terrain", "--no-bar", "--no-caption", "--centre", "50:0:0", "--zoom", "4", "--size",
       "200x200", "-o", "beside.png"});
  const auto white = [](const std::vector<std::uint8_t>& all) {
    return std::ranges::count(all, 255) == static_cast<std::ptrdiff_t>(all.size());
  };
  EXPECT_FALSE(white(pixels("middle.png")));
  EXPECT_TRUE(white(pixels("beside.png")));
}

TEST_F(ProgramView, ThePictureSaysHowItWasMade) {
  run({"view", "bunny", "-s", "17", "-o", "a.png", "--size", "200x150"});
  const PngContent content = read_png(bytes_of(folder.path("a.png")));
  const auto text = [&content](const std::string& name) {
    const auto found = content.texts.find(name);
    return found == content.texts.end() ? std::string("none") : found->second;
  };
  EXPECT_EQ(text("geotherm:command"), "geotherm view bunny -s 17 -o a.png --size 200x150");
  EXPECT_EQ(text("geotherm:sources"), "17");
  EXPECT_EQ(text("geotherm:view"), "contours");
}

TEST_F(ProgramView, FiguresAreThoseOfSolve) {
  folder.write("s.geotherm", "open bunny\nsource set 17\nsave figures f.json\n");
  run({"view", "--headless", "--script", "s.geotherm"});
  const std::string bytes = bytes_of(folder.path("f.json"));
  const Json saved = Json::parse(bytes, nullptr, false);
  const Json solved = json({"solve", "bunny", "-s", "17", "--json", "-"});
  EXPECT_EQ(saved["distance"], solved["distance"]);
  EXPECT_EQ(saved["model"], solved["model"]);
  EXPECT_EQ(saved["options"], solved["options"]);
}

TEST_F(ProgramView, WithoutADisplayTheWindowNamesTheOtherWays) {
  ::unsetenv("DISPLAY");
  ::unsetenv("WAYLAND_DISPLAY");
  const ProgramRun result = run_program(folder.path("."), {"bunny"});
  EXPECT_EQ(result.code, 1);
  EXPECT_EQ(result.out, "");
  EXPECT_EQ(result.err.find("geotherm: error: no window can be opened"), 0U) << result.err;
  EXPECT_NE(result.err.find("geotherm render"), std::string::npos);
  EXPECT_EQ(std::ranges::count(result.err, '\n'), 1);
}

}  // namespace
}  // namespace geotherm::test
