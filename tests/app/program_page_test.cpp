// SPDX-License-Identifier: MIT
// Pages from the built program: what is in them, and in a browser (chromium, where it is installed)
// what they show, held against pictures.
#include <cstdlib>
#include <set>

#include "app/drawing/page_shaders.h"
#include "tests/app/png_reader.h"
#include "tests/app/program_fixture.h"

namespace geotherm::test {
namespace {

std::string between(const std::string& text, const std::string& begin, const std::string& end) {
  const std::size_t from = text.find(begin);
  if (from == std::string::npos) return {};
  return text.substr(from + begin.size(), text.find(end, from) - from - begin.size());
}

bool runs(const std::string& command) { return std::system(command.c_str()) == 0; }

class ProgramPage : public Program {
 protected:
  std::string page(const std::vector<std::string>& more) {
    std::vector<std::string> arguments = {"render"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    arguments.insert(arguments.end(), {"-o", "a.html"});
    run(arguments);
    return bytes_of(folder.path("a.html"));
  }
  static Json scene_in(const std::string& page) {
    return Json::parse(between(page, "id=\"scene\">", "</script>"), nullptr, false);
  }
  static std::set<std::string> views_in(const Json& scene) {
    std::set<std::string> names;
    for (const Json& view : scene["views"]) names.insert(view["name"]);
    return names;
  }
};

TEST_F(ProgramPage, AsksNoNetworkForAnything) {
  const std::string text = page({"bunny", "-s", "17"});
  for (const char* word : {"http", "src=", "@import", "import(", "url(", "fetch(", "WebSocket"}) {
    EXPECT_EQ(text.find(word), std::string::npos) << word;
  }
}

TEST_F(ProgramPage, HoldsWhatThePictureHas) {
  const Json solved = json({"solve", "bunny", "-s", "17", "--json", "-"});
  const Json scene = scene_in(page({"bunny", "-s", "17", "--size", "640x400"}));
  ASSERT_FALSE(scene.is_discarded());
  EXPECT_EQ(scene["size"], Json({640, 400}));
  EXPECT_EQ(views_in(scene),
            (std::set<std::string>{"contours", "smooth", "flat", "wireframe", "sources"}));
  EXPECT_EQ(scene["value"]["unit"], solved["distance"]["max"]);
  const Json bar = scene["views"][0]["legend"]["bar"];
  EXPECT_GE(bar["ticks"].size(), 3U);
  EXPECT_EQ(bar["ticks"][0][1], "0");
  EXPECT_NE(scene["caption"].get<std::string>().find("bunny"), std::string::npos);
  EXPECT_NE(scene["about"].dump().find("render bunny"), std::string::npos);
}

TEST_F(ProgramPage, IsUtf8WhateverTheModelIsCalled) {
  folder.write("caf\xe9.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  const std::string text = page({"caf\xe9.obj", "--view", "smooth"});
  EXPECT_EQ(text.find('\xe9'), std::string::npos);
  EXPECT_NE(text.find("<title>caf?"), std::string::npos) << between(text, "<title>", "</title>");
}

TEST_F(ProgramPage, HasTheViewsOfItsAnswer) {
  EXPECT_EQ(views_in(scene_in(page({"bunny", "--view", "triangle-quality"}))),
            (std::set<std::string>{"triangle-quality", "smooth", "flat", "wireframe"}));
  const Json heat = scene_in(page({"bunny", "-s", "0", "--view", "heat-gradient"}));
  EXPECT_TRUE(views_in(heat).contains("gradient-error"));
  EXPECT_EQ(heat["asked"], "heat-gradient");
  const Json bare =
      scene_in(page({"bunny", "-s", "0", "--no-bar", "--no-caption", "--no-markers"}));
  EXPECT_EQ(bare["caption"], "");
  EXPECT_FALSE(bare["views"][0]["legend"].contains("bar"));
  EXPECT_EQ(bare["views"][0]["markers"], false);
}

TEST_F(ProgramPage, IsClosedAgainstNamesThatEndIt) {
  folder.write("<b>{{data}}.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  const std::string text = page({"<b>{{data}}.obj", "-s", "0"});
  EXPECT_EQ(text.find("<b>"), std::string::npos);
  EXPECT_FALSE(scene_in(text).is_discarded());
}

TEST_F(ProgramPage, TakesAtMost25BytesAFace) {
  const Json told = json({"render", "gargoyle", "-s", "17", "-o", "a.html", "--json", "-"});
  const double faces = told["model"]["faces"];
  const std::string text = bytes_of(folder.path("a.html"));
  EXPECT_EQ(told["picture"]["bytes"], text.size());
  EXPECT_LT(static_cast<double>(text.size()), 25 * faces);
}

TEST_F(ProgramPage, ShadersAreThoseOfWebGl2) {
  if (!runs("glslangValidator --version > /dev/null 2>&1")) {
    GTEST_SKIP() << "glslangValidator is not installed (package glslang-tools)";
  }
  const auto valid = [this](const app::PageShader& shader, unsigned features) {
    std::string text = shader.text;
    text.insert(text.find('\n') + 1, "#define FEATURES " + std::to_string(features) + "u\n");
    folder.write(shader.name, text);
    return runs("glslangValidator " + folder.path(shader.name) + " > " + folder.path("said.txt"));
  };
  const std::vector<app::PageShader> shaders = app::page_shaders();
  EXPECT_EQ(shaders.size(), 8U);
  for (const app::PageShader& shader : shaders) {
    for (const unsigned features : {0U, 1U, 22U, 26U, 84U}) {
      EXPECT_TRUE(valid(shader, features)) << shader.name << bytes_of(folder.path("said.txt"));
    }
  }
  EXPECT_FALSE(valid({"wrong.frag", "#version 300 es\nvoid main() { nothing }\n"}, 0));
}

/// Pages and pictures, compared where neither has an edge.
class BrowserPage : public DrawingProgram,
                    public testing::WithParamInterface<std::vector<std::string>> {
 protected:
  void SetUp() override {
    DrawingProgram::SetUp();
    if (IsSkipped() || HasFatalFailure()) return;
    if (!runs("chromium --version > /dev/null 2>&1")) {
      GTEST_SKIP() << "chromium is not installed, in which pages are looked at";
    }
  }

  PngContent screenshot() {
    const std::string command =
        "HOME=" + folder.path(".") +
        " timeout 120 chromium --headless=new --no-sandbox "
        "--use-gl=angle --use-angle=swiftshader --enable-unsafe-swiftshader --hide-scrollbars "
        "--disable-dev-shm-usage --no-first-run --user-data-dir=" +
        folder.path("profile") + " --screenshot=" + folder.path("page.png") +
        " --window-size=960,600 file://" + folder.path("a.html") + " > " + folder.path("said.txt") +
        " 2>&1";
    // The browser may take its picture before the page, which unpacks its data beside, has drawn.
    constexpr int kTries = 3;
    PngContent picture;
    for (int turn = 0; turn < kTries && is_blank(picture); ++turn) {
      EXPECT_TRUE(runs(command)) << bytes_of(folder.path("said.txt"));
      picture = read_png(bytes_of(folder.path("page.png")));
    }
    return picture;
  }

  static bool is_blank(const PngContent& picture) {
    const auto& pixels = picture.pixels;
    const auto step = static_cast<std::size_t>(picture.channels);
    for (std::size_t at = step; at < pixels.size(); ++at) {
      if (pixels[at] != pixels[at % step]) return false;
    }
    return true;
  }
};

constexpr int kTolerance = 8;  // of 255
constexpr int kEdge = 12;      // between neighbours: a line, letters, the outline

int channel(const PngContent& picture, int x, int y, int k) {
  return picture.pixels[static_cast<std::size_t>((y * picture.width + x) * picture.channels + k)];
}

bool has_edge(const PngContent& picture, int x, int y) {
  for (int k = 0; k < 3; ++k) {
    int least = 255, most = 0;
    for (int dy = -2; dy <= 2; ++dy) {
      for (int dx = -2; dx <= 2; ++dx) {
        const int value = channel(picture, x + dx, y + dy, k);
        least = std::min(least, value);
        most = std::max(most, value);
      }
    }
    if (most - least > kEdge) return true;
  }
  return false;
}

TEST_P(BrowserPage, ShowsWhatPicturesShow) {
  std::vector<std::string> arguments = {"render"};
  arguments.insert(arguments.end(), GetParam().begin(), GetParam().end());
  arguments.insert(arguments.end(), {"--size", "960x600", "-o"});
  for (const char* output : {"a.png", "a.html"}) {
    std::vector<std::string> all = arguments;
    all.emplace_back(output);
    run(all);
  }
  const PngContent drawn = read_png(bytes_of(folder.path("a.png")));
  const PngContent shown = screenshot();
  ASSERT_TRUE(shown.valid);
  ASSERT_EQ(shown.width, drawn.width);
  ASSERT_EQ(shown.height, drawn.height);
  double compared = 0, alike = 0, painted = 0;
  for (int y = 2; y + 2 < drawn.height; ++y) {
    for (int x = 2; x + 2 < drawn.width; ++x) {
      if (has_edge(drawn, x, y) || has_edge(shown, x, y)) continue;
      int difference = 0, from_corner = 0;
      for (int k = 0; k < 3; ++k) {
        difference =
            std::max(difference, std::abs(channel(drawn, x, y, k) - channel(shown, x, y, k)));
        from_corner =
            std::max(from_corner, std::abs(channel(drawn, x, y, k) - channel(drawn, 3, 300, k)));
      }
      ++compared;
      alike += difference <= kTolerance;
      painted += from_corner > kTolerance;
    }
  }
  EXPECT_GT(compared, 0.4 * drawn.width * drawn.height);
  EXPECT_GT(painted, 0.04 * drawn.width * drawn.height) << "there is a model to compare";
  EXPECT_GE(alike, 0.99 * compared) << alike / compared << " of what is compared";
}

using Scene = std::vector<std::string>;
INSTANTIATE_TEST_SUITE_P(
    Of, BrowserPage,
    testing::Values(Scene{"bunny", "-s", "17"},
                    Scene{"sleeve", "-s", "random:3", "--view", "regions", "--background", "dark"},
                    Scene{"cube", "-s", "17", "--view", "heat-gradient", "--azimuth", "50"},
                    Scene{"bunny", "-s", "0", "--path", "1500", "--spacing", "0", "--colour-map",
                          "viridis", "--projection", "orthographic"},
                    Scene{"bunny", "--view", "triangle-quality", "--light", "headlight"},
                    Scene{"terrain", "-s", "17", "--view", "flat", "--slice", "x", "--zoom",
                          "1.5"}),
    [](const auto& test) { return "scene" + std::to_string(test.index); });

}  // namespace
}  // namespace geotherm::test
