// SPDX-License-Identifier: MIT
// Figures, several models in one picture, and films, from the built program.
#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <limits>
#include <regex>

#include "tests/app/png_reader.h"
#include "tests/app/program_fixture.h"
#include "tests/app/variable.h"

namespace geotherm::test {
namespace {

class ProgramFigure : public DrawingProgram {
 protected:
  PngContent picture(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "render");
    arguments.insert(arguments.end(), {"--no-check", "-o", "a.png"});
    run(arguments);
    return read_png(bytes_of(folder.path("a.png")));
  }

  /// A program called ffmpeg in a folder of its own, which becomes PATH.
  std::string fake_ffmpeg(const std::string& script) {
    const std::string bin = folder.path("bin");
    std::filesystem::create_directories(bin);
    std::ofstream(bin + "/ffmpeg") << "#!/bin/sh\n" << script;
    std::filesystem::permissions(bin + "/ffmpeg", std::filesystem::perms::owner_all);
    return bin;
  }

  std::size_t files() const {
    std::size_t count = 0;
    for ([[maybe_unused]] const auto& each :
         std::filesystem::directory_iterator(folder.path("."))) {
      ++count;
    }
    return count;
  }
};

/// The last word of its command is the file, which holds how many bytes came.
constexpr const char* kCounting =
    "for last; do :; done\n/bin/sh -c 'exec /usr/bin/wc -c' > \"${last#file:}\"\n";

TEST_F(ProgramFigure, StandsInJsonAndInTheFile) {
  const Json made = json({"render",
                          "bunny",
                          "-s",
                          "17",
                          "--size",
                          "4cmx3cm",
                          "--title",
                          "A title",
                          "--units",
                          "mm",
                          "--bands",
                          "5",
                          "--range",
                          "0:2",
                          "--up",
                          "z",
                          "--roll",
                          "10",
                          "--number-format",
                          "fixed:1",
                          "--no-check",
                          "-o",
                          "a.png",
                          "--json",
                          "-"})["picture"];
  EXPECT_EQ(made["width"], 472);
  EXPECT_EQ(made["title"], "A title");
  EXPECT_EQ(made["bands"], "5");
  EXPECT_EQ(made["camera"]["up"], "z");
  EXPECT_EQ(made["camera"]["roll"], 10);
  EXPECT_EQ(made["clamped"], Json({false, true}));
  EXPECT_EQ(made["levels"].size(), 4U);
  const PngContent content = read_png(bytes_of(folder.path("a.png")));
  EXPECT_EQ(content.texts.at("geotherm:title"), "A title");
  EXPECT_EQ(content.texts.at("geotherm:size"), "4cmx3cm");
  EXPECT_EQ(content.texts.at("geotherm:number-format"), "fixed:1");
  EXPECT_NE(bytes_of(folder.path("a.png")).find("pHYs"), std::string::npos);
}

TEST_F(ProgramFigure, DrawsThePathThatIsAskedFor) {
  const std::vector<std::string> words = {"render", "bunny",   "-s", "3",     "--path", "400",
                                          "--size", "200x150", "-o", "a.png", "--json", "-"};
  const auto fields = [&](std::vector<std::string> more) {
    more.insert(more.begin(), words.begin(), words.end());
    std::vector<std::string> names;
    const Json made = json(more);
    for (const Json& path : made["picture"]["paths"]) names.push_back(path["field"]);
    return names;
  };
  EXPECT_EQ(fields({}), (std::vector<std::string>{"geodesic"}));
  EXPECT_EQ(fields({"--path-kind", "heat"}), (std::vector<std::string>{"heat"}));
  EXPECT_EQ(fields({"--path-kind", "all"}).size(), 3U);
}

TEST_F(ProgramFigure, RefusesMoreModelsThanPixels) {
  folder.write("face.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  const auto refused = [this](const std::string& size, const std::string& columns) {
    std::vector<std::string> words = {"render"};
    words.insert(words.end(), 20, "face.obj");
    words.insert(words.end(),
                 {"--view", "flat", "--size", size, "--columns", columns, "-o", "a.png"});
    expect_refused(words, size + " pixels");
  };
  refused("100x16", "1");
  refused("16x100", "20");
  EXPECT_EQ(files(), 1U);
}

TEST_F(ProgramFigure, RefusesWhatDoesNotGoTogether) {
  const auto refused = [&](std::vector<std::string> more, const std::string& says) {
    more.insert(more.begin(), {"render", "bunny", "-s", "17", "-o", "a.png"});
    expect_refused(more, says);
  };
  refused({"--colour-scale", "log", "--range", "0:2"}, "not above 0");
  refused({"--colour-scale", "diverging"}, "--view exact-error");
  refused({"--colour-scale", "log", "--view", "exact-error"}, "both signs");
  refused({"--path", "4", "--path-kind", "heat", "--method", "wavefront"}, "no heat to follow");
  refused({"--size", "90cmx90cm"}, "10630");
  refused({"--bands", "1"}, "2 to 64");
  refused({"--fps", "20"}, "--fps is for films");
  refused({"--columns", "2"}, "several models");
  refused({"--values", "-1,2"}, "numbers above 0");
  EXPECT_EQ(files(), 0U);
}

TEST_F(ProgramFigure, SaysWhatIsNotUsedAndWhatCannotBeWritten) {
  const auto said = [&](std::vector<std::string> more) {
    more.insert(more.begin(), {"render", "bunny", "--size", "200x150", "-o", "a.png"});
    return run(more).err;
  };
  EXPECT_NE(said({"--view", "smooth", "--units", "mm"}).find("--units is not used"),
            std::string::npos);
  const auto unused = [&](const std::string& view, std::vector<std::string> option) {
    const std::string says = option.front() + " is not used";
    option.insert(option.begin(), {"-s", "17", "--view", view});
    return said(option).find(says) != std::string::npos;
  };
  EXPECT_TRUE(unused("exact-error", {"--colour-map", "magma"}));
  EXPECT_FALSE(unused("exact-error", {"--colour-map", "red-yellow-blue"}));
  EXPECT_TRUE(unused("triangle-quality", {"--colour-map", "red-blue"}));
  EXPECT_FALSE(unused("triangle-quality", {"--colour-map", "magma"}));
  EXPECT_TRUE(unused("triangle-quality", {"--units", "mm"}));
  for (const char* view : {"smooth", "flat", "sources", "heat-gradient", "triangle-quality"}) {
    EXPECT_TRUE(unused(view, {"--line-width", "9"})) << view;
  }
  for (const char* view : {"contours", "wireframe", "regions"}) {
    EXPECT_FALSE(unused(view, {"--line-width", "9"})) << view;
  }
  EXPECT_TRUE(unused("smooth", {"--no-bar"}));
  for (const char* view : {"contours", "triangle-quality", "regions", "gradient-error"}) {
    EXPECT_FALSE(unused(view, {"--no-bar"})) << view;
  }
  EXPECT_NE(said({"--view", "smooth", "--title", "\u6f22"}).find("(U+6F22)"), std::string::npos);
  EXPECT_NE(said({"-s", "17", "--values", "50,60"}).find("none of --values 50,60"),
            std::string::npos);
  EXPECT_EQ(said({"--view", "smooth", "--title", "\u2207\u03c6"}), "");
  const std::string regions = said({"-s", "17,900", "--view", "regions", "--bands", "4"});
  EXPECT_NE(regions.find("--bands is not used: each region has a colour"), std::string::npos);
  const std::string error = said({"-s", "17", "--view", "exact-error", "--no-check"});
  EXPECT_NE(error.find("--no-check is not used: --view exact-error"), std::string::npos) << error;
  EXPECT_TRUE(unused("exact-error", {"--range", "0:1"}));
  EXPECT_FALSE(unused("exact-error", {"--range", "0:1", "--colour-scale", "diverging"}));
  EXPECT_NE(said({"-s", "17", "--units", "mm"}).find("no room for the colour bar at 200 x 150"),
            std::string::npos);
  const std::string small =
      run({"render", "bunny", "--view", "smooth", "--title", "a", "--size", "80x80", "-o", "a.png"})
          .err;
  EXPECT_NE(small.find("no room for the title at 80 x 80 pixels; ask for a larger --size"),
            std::string::npos)
      << small;
  const auto titled = [&](const std::string& size, const std::string& file) {
    return run({"render", "bunny", "--view", "smooth", "--title", "a", "--text-size", size,
                "--size", "80x80", "-o", file})
        .err;
  };
  EXPECT_NE(titled("9", "a.png").find("ask for a larger --size"), std::string::npos);
  EXPECT_EQ(titled("9", "a.html").find("no room"), std::string::npos) << "the browser makes it";
}

TEST_F(ProgramFigure, HasItsSizeOnPaper) {
  const auto file = [&](const std::string& name, std::vector<std::string> more) {
    more.insert(more.begin(), {"render", "bunny", "--view", "smooth", "-o", name});
    run(more);
    return bytes_of(folder.path(name));
  };
  // 708.66 and 531.5 pixels, rounded.
  EXPECT_NE(file("a.svg", {"--size", "6cmx4.5cm"}).find("width=\"60.02"), std::string::npos);
  EXPECT_NE(file("a.pdf", {"--size", "600x300", "--dpi", "300"}).find("/MediaBox [ 0 0 144 72 ]"),
            std::string::npos);
}

TEST_F(ProgramFigure, OfSeveralModelsHasShapesInEachCell) {
  run({"render", "bunny", "cube", "-s", "17", "--size", "400x200", "--grid", "2x1", "--no-check",
       "-o", "a.svg"});
  const std::string svg = bytes_of(folder.path("a.svg"));
  double least = 400, most = 0;  // of the strokes, which Cairo's versions write in two ways
  const std::regex stroke("fill(:none;|=.none.)[^>]*? d=\"M ([0-9.]+)");
  for (std::sregex_iterator at(svg.begin(), svg.end(), stroke), end; at != end; ++at) {
    const double x = std::strtod((*at)[2].str().c_str(), nullptr);
    least = std::min(least, x);
    most = std::max(most, x);
  }
  EXPECT_LT(least, 150);
  EXPECT_GT(most, 180);
  EXPECT_LT(most, 400);
  expect_refused({"render", "bunny", "cube", "-s", "17", "--grid", "2x2", "-o", "b.png"},
                 "give 2x1");
}

TEST_F(ProgramFigure, OfSeveralModelsHasOneScale) {
  const Json both = json({"render", "bunny", "sleeve", "-s", "17", "--size", "480x240",
                          "--no-check", "-o", "a.png", "--json", "-"});
  ASSERT_EQ(both["models"].size(), 2U);
  double most = 0;
  for (const Json& model : both["models"]) {
    most = std::max(most, model["distance"]["max"].get<double>());
  }
  EXPECT_DOUBLE_EQ(both["picture"]["range"][1], most);
  const PngContent content = read_png(bytes_of(folder.path("a.png")));
  EXPECT_EQ(content.width, 480);
  // Something is drawn in both halves of what the bar leaves.
  const auto drawn = [&](int from, int to) {
    int count = 0;
    for (int y = 0; y < content.height; ++y) {
      for (int x = from; x < to; ++x) {
        count += content.pixels[static_cast<std::size_t>(3 * (y * content.width + x))] < 200;
      }
    }
    return count;
  };
  EXPECT_GT(drawn(0, 180), 1000);
  EXPECT_GT(drawn(200, 380), 1000);
}

TEST_F(ProgramFigure, OfATurnIsAFilmByFfmpeg) {
  const Variable path("PATH", fake_ffmpeg(kCounting).c_str());
  run({"render", "bunny", "-s", "17", "--size", "64x48", "--turntable", "5", "--no-check", "-o",
       "turn.mp4"});
  EXPECT_EQ(std::stoi(bytes_of(folder.path("turn.mp4"))), 5 * 64 * 48 * 4);
  EXPECT_EQ(files(), 2U) << "the folder of ffmpeg, and the film";
}

TEST_F(ProgramFigure, OfASequenceIsAFilmThatReplacesTheOneBehindALink) {
  run({"generate", "cube", "--faces", "600", "--frames", "3", "-o", "walk.npy"});
  run({"generate", "cube", "--faces", "600", "-o", "cube.obj"});
  const Variable path("PATH", fake_ffmpeg(kCounting).c_str());
  folder.write("old.mp4", "an older film");
  std::filesystem::create_symlink("old.mp4", folder.path("walk.mp4"));
  run({"render", "cube.obj", "--sequence", "walk.npy", "-s", "17", "--size", "64x48", "--no-check",
       "-o", "walk.mp4"});
  EXPECT_TRUE(std::filesystem::is_symlink(folder.path("walk.mp4")));
  EXPECT_EQ(std::stoi(bytes_of(folder.path("old.mp4"))), 3 * 64 * 48 * 4);
  EXPECT_EQ(files(), 5U) << "ffmpeg's folder, array, model, film, link";
}

TEST_F(ProgramFigure, NeedsFfmpegBeforeAnythingIsSolvedAndLeavesNoHalfFilm) {
  std::filesystem::create_directories(folder.path("empty"));
  const std::vector<std::string> film = {"render",     "bunny", "-s",          "17",
                                         "--size",     "64x48", "--turntable", "5",
                                         "--no-check", "-o",    "turn.gif"};
  {
    const Variable path("PATH", folder.path("empty").c_str());
    expect_refused(film, "apt-get install ffmpeg");
  }
  for (const char* script :
       {"echo no such codec >&2; exit 1\n",
        "/usr/bin/head -c 100 > /dev/null; echo no such codec >&2; exit 3\n"}) {
    const Variable path("PATH", fake_ffmpeg(script).c_str());
    expect_refused(film, "turn.gif: ffmpeg could not make the film: no such codec");
  }
  expect_refused({"render", "bunny", "-s", "17", "-o", "turn.mp4"}, "one picture is no film");
  EXPECT_EQ(files(), 2U) << "the folders made here";
}

TEST_F(ProgramFigure, IsolinesLieAtTheValuesThatAreAskedFor) {
  const Json lines =
      json({"isolines", "bunny", "-s", "17", "--values", "1,0.5", "--no-check", "--json", "-"});
  EXPECT_EQ(lines["levels"], Json({0.5, 1.0}));
  for (const Json& line : lines["lines"]) EXPECT_TRUE(line["value"] == 0.5 || line["value"] == 1);
  expect_refused({"isolines", "bunny", "-s", "17", "--values", "1", "--count", "3"}, "two of them");
  expect_refused({"isolines", "bunny", "-s", "17", "--values", "0,1"}, "above 0");
}

TEST_F(ProgramFigure, OfValuesInAFileIsThatOfTheSameDistances) {
  run({"solve", "bunny", "-s", "17", "--no-check", "-o", "d.npy"});
  const std::vector<std::string> same = {"--no-caption", "--no-markers", "--bar-label", "d",
                                         "--size",       "500x400"};
  std::vector<std::string> solved = {"bunny", "-s", "17"}, given = {"bunny", "--field", "d.npy"};
  solved.insert(solved.end(), same.begin(), same.end());
  given.insert(given.end(), same.begin(), same.end());
  const std::vector<std::uint8_t> a = picture(solved).pixels, b = picture(given).pixels;
  ASSERT_EQ(a.size(), b.size());
  std::size_t others = 0;  // where isolines, which are computed in two ways, fade
  for (std::size_t i = 0; i < a.size(); ++i) others += std::abs(a[i] - b[i]) > 16 ? 1 : 0;
  EXPECT_LT(others, a.size() / 100);
}

/// How many of the numbers of two pictures differ.
double share_of_others(const std::vector<std::uint8_t>& a, const std::vector<std::uint8_t>& b) {
  EXPECT_EQ(a.size(), b.size());
  std::size_t others = 0;
  for (std::size_t i = 0; i < a.size(); ++i) others += std::abs(a[i] - b[i]) > 16 ? 1 : 0;
  return static_cast<double>(others) / static_cast<double>(a.size());
}

TEST_F(ProgramFigure, OfVectorsHasArrowsAndOfLogMapsLines) {
  const std::vector<std::string> plain = {"--no-caption", "--no-markers", "--no-bar", "--size",
                                          "500x400"};
  const auto of = [&](std::vector<std::string> words) {
    words.insert(words.end(), plain.begin(), plain.end());
    return picture(words).pixels;
  };
  run({"transport", "bunny", "--vector", "17:1:0", "-o", "v.npy"});
  run({"transport", "bunny", "--vector", "17:0:1", "-o", "w.npy"});
  const auto along = of({"bunny", "--field", "v.npy"}), across = of({"bunny", "--field", "w.npy"});
  const double turned = share_of_others(along, across);
  EXPECT_GT(turned, 0.01);  // arrows
  EXPECT_LT(turned, 0.3);
  run({"logmap", "bunny", "-s", "17", "-o", "map.npy"});
  run({"solve", "bunny", "-s", "17", "--method", "exact", "-o", "d.npy"});
  const double rays =
      share_of_others(of({"bunny", "--field", "map.npy"}), of({"bunny", "--field", "d.npy"}));
  EXPECT_GT(rays, 0.002);  // lines
  EXPECT_LT(rays, 0.2);
}

/// A .npy file of four values, and the tetrahedron that they are of.
void write_four_values(const TemporaryDirectory& folder, const std::vector<float>& values) {
  const std::string header =
      "{'descr': '<f4', 'fortran_order': False, 'shape': (4,), }" + std::string(60, ' ');
  std::string bytes("\x93NUMPY\x01\x00", 8);
  bytes += {static_cast<char>(header.size()), 0};
  bytes += header;
  for (const float value : values) {
    bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
  }
  std::ofstream(folder.path("v.npy"), std::ios::binary) << bytes;
  std::ofstream(folder.path("t.obj"))
      << "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n";
}

TEST_F(ProgramFigure, OfValuesBelowZeroHasZeroInTheMiddle) {
  write_four_values(folder, {-1, 2, 0.5F, std::numeric_limits<float>::quiet_NaN()});
  const Json made = json({"render", "t.obj", "--field", "v.npy", "-o", "a.png", "--json", "-"});
  EXPECT_EQ(made["picture"]["range"], Json({-2, 2}));
  EXPECT_EQ(made["picture"]["field"], "v.npy");
}

TEST_F(ProgramFigure, OfValuesNearEachOtherSaysWhereTheyAre) {
  write_four_values(folder, {1e8F, 1e8F + 8, 1e8F, 1e8F});
  const std::vector<std::string> words = {"render", "t.obj", "--field", "v.npy", "-o", "a.png"};
  const auto with = [&](std::vector<std::string> more) {
    more.insert(more.begin(), words.begin(), words.end());
    return run(more);
  };
  EXPECT_NE(with({}).out.find("from 100000000 to 100000008"), std::string::npos);
  const std::string near = "so near to each other";
  EXPECT_EQ(with({}).err.find(near), std::string::npos);
  EXPECT_NE(with({"--colour-scale", "log"}).err.find(near), std::string::npos);
  write_four_values(folder, {5, 5, 5, 5});
  EXPECT_NE(with({"--values", "5"}).err.find("no isoline: all values are 5"), std::string::npos);
}

TEST_F(ProgramFigure, OfNoNumberAtAllIsRefused) {
  write_four_values(folder, std::vector<float>(4, std::numeric_limits<float>::quiet_NaN()));
  expect_refused({"render", "t.obj", "--field", "v.npy", "-o", "a.png"},
                 "none of the 4 values of v.npy is a finite number");
}

}  // namespace
}  // namespace geotherm::test
