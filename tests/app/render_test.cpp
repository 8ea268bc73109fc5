// SPDX-License-Identifier: MIT
// `render` and `devices` with a drawing that only remembers.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "app/cli/command_line.h"
#include "tests/app/fake_drawing.h"
#include "tests/app/png_reader.h"
#include "tests/mesh/mesh_files.h"

namespace geotherm::test {
namespace {

using Names = std::vector<std::string>;

class Render : public testing::Test {
 protected:
  struct Run {
    int code = -1;
    std::string out, err;
  };

  Run run(const std::vector<std::string>& arguments) {
    testing::internal::CaptureStdout();
    testing::internal::CaptureStderr();
    Run result;
    result.code = app::run_command_line(arguments, drawing, window);
    result.out = testing::internal::GetCapturedStdout();
    result.err = testing::internal::GetCapturedStderr();
    return result;
  }

  FakeWindow window;

  void expect_done(const Run& result) { EXPECT_EQ(result.code, 0) << result.err; }

  void expect_failure(const Run& result, int code, const std::string& part) {
    EXPECT_EQ(result.code, code);
    EXPECT_EQ(result.out, "");
    EXPECT_TRUE(result.err.starts_with("geotherm: error: ")) << result.err;
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
    EXPECT_NE(result.err.find(part), std::string::npos) << "no " << part << " in " << result.err;
  }

  std::string path(const std::string& name) { return folder.path(name); }

  TemporaryDirectory folder;
  const std::string square =
      folder.write("square.obj",
                   "v 0 0 0\nv 2 0 0\nv 2 2 0\nv 0 2 0\nv 9 0 0\nv 9 1 0\nv 8 0 0\n"
                   "f 1 2 3\nf 1 3 4\nf 5 6 7\n");
  const std::string flat = folder.write("flat.obj", "v 1 1 1\nv 1 1 1\nv 1 1 1\nf 1 2 3\n");
  FakeDrawing drawing;
};

TEST_F(Render, WritesAPictureOfTheSizeThatWasAskedFor) {
  const Run result = run({"render", square, "-s", "0", "--size", "40x30", "-o", path("a.png")});
  expect_done(result);
  const PngContent picture = read_png(bytes_of(path("a.png")));
  EXPECT_TRUE(picture.valid);
  EXPECT_EQ(picture.width, 40);
  EXPECT_EQ(picture.height, 30);
  for (const char* part : {"a.png", "40 x 30", "contours", "red-blue", "square", "Fast GPU"}) {
    EXPECT_NE(result.out.find(part), std::string::npos) << part << " is not in\n" << result.out;
  }
}

TEST_F(Render, HandsItsSettingsToTheDrawingUnchanged) {
  expect_done(
      run({"render",     square,    "-s",          "0",         "--view",   "gradient-error",
           "--azimuth",  "-5",      "--elevation", "-30",       "--pan",    "-0.5:0.25",
           "--colormap", "viridis", "--fit",       "--reverse", "--no-bar", "--device",
           "fast",       "-o",      path("a.png")}));
  app::PictureSettings expected;
  expected.view = app::View::kGradientError;
  expected.camera.azimuth = -5;
  expected.camera.elevation = -30;
  expected.camera.pan_right = -0.5;
  expected.camera.pan_up = 0.25;
  expected.colour_map = "viridis";
  expected.reverse = true;
  expected.bar = false;
  expected.device = "fast";
  EXPECT_EQ(drawing.opened, expected);
  EXPECT_EQ(drawing.drawn, expected);
  EXPECT_EQ(drawing.data->heat_directions.size(), 3U);
}

TEST_F(Render, GivesTheDrawingDistancesSourcesAndCaption) {
  expect_done(run({"render", square, "-s", "0", "-o", path("a.png")}));
  const app::PictureData& data = *drawing.data;
  EXPECT_EQ(data.values[0], 0);
  EXPECT_EQ(data.values[2], 1);  // the far corner
  EXPECT_EQ(data.values[5], app::kNoPictureValue);
  EXPECT_EQ(data.sources.size(), 1U);
  EXPECT_TRUE(data.heat_directions.empty());
  for (const char* part : {"square", "3 faces", "t = ", "cholmod"}) {
    if (std::string(part) == "cholmod") continue;  // not in every build
    EXPECT_NE(data.caption.find(part), std::string::npos) << data.caption;
  }
}

TEST_F(Render, TellsAboutItselfInTheFile) {
  expect_done(run({"render", square, "-s", "0", "-s", "1", "-m", "2", "--range", "0:4", "--spacing",
                   "0.5", "-o", path("it's.png")}));
  PngContent picture = read_png(bytes_of(path("it's.png")));
  auto& texts = picture.texts;
  EXPECT_TRUE(texts["Software"].starts_with("geotherm "));
  EXPECT_NE(texts["Title"].find("square"), std::string::npos);
  EXPECT_EQ(texts["geotherm:model"], square);
  EXPECT_EQ(texts["geotherm:sources"], "0 1");
  EXPECT_EQ(texts["geotherm:time-factor"], "2");
  EXPECT_EQ(texts["geotherm:constraint"], "pin-sources");
  EXPECT_EQ(texts["geotherm:view"], "contours");
  EXPECT_EQ(texts["geotherm:range"], "0:4");
  EXPECT_EQ(texts["geotherm:spacing"], "0.5");
  EXPECT_EQ(texts["geotherm:device"], "Fast GPU");
  EXPECT_FALSE(texts["geotherm:t"].empty());
  EXPECT_FALSE(texts["geotherm:backend"].empty());
  EXPECT_EQ(texts["geotherm:command"], "geotherm render " + square +
                                           " -s 0 -s 1 -m 2 --range 0:4 --spacing 0.5 -o '" +
                                           folder.path("") + "it'\\''s.png'");
}

TEST_F(Render, TurnsTheModelForATurntable) {
  const Run result = run({"render", square, "-s", "0", "--size", "8x8", "--azimuth", "300",
                          "--turntable", "4", "-o", path("turn.png")});
  expect_done(result);
  EXPECT_EQ(folder.names(), (Names{"flat.obj", "square.obj", "turn-000.png", "turn-001.png",
                                   "turn-002.png", "turn-003.png"}));
  EXPECT_EQ(drawing.drawn->camera.fit, app::PictureFit::kSphere);
  const char* azimuths[] = {"300", "30", "120", "210"};
  for (int i = 0; i < 4; ++i) {
    const std::string name = "turn-00" + std::to_string(i) + ".png";
    EXPECT_EQ(read_png(bytes_of(path(name))).texts["geotherm:azimuth"], azimuths[i]) << i;
  }
  EXPECT_NE(result.out.find("turn-000.png to "), std::string::npos) << result.out;
}

TEST_F(Render, NumbersThousandsOfFramesInOrder) {
  app::PictureSettings settings;
  settings.turntable = 1001;
  const Names paths = app::frame_paths("a.b/c", settings);
  EXPECT_EQ(paths.front(), "a.b/c-0000");
  EXPECT_EQ(paths.back(), "a.b/c-1000");
  EXPECT_TRUE(std::is_sorted(paths.begin(), paths.end()));
}

TEST_F(Render, RemovesItsFramesWhenTheDeviceIsLost) {
  drawing.frames_until_lost = 2;
  const std::string before = folder.write("turn-000.png", "was there");
  expect_failure(run({"render", square, "-s", "0", "--size", "8x8", "--turntable", "4", "-o",
                      path("turn.png"), "--json", path("a.json")}),
                 1, "the device was lost");
  EXPECT_EQ(folder.names(), (Names{"flat.obj", "square.obj", "turn-000.png"}));
}

TEST_F(Render, RemovesItsFramesWhenOneCannotBeWritten) {
  expect_failure(run({"render", square, "-s", "0", "--size", "8x8", "-o", path("a.png"), "--json",
                      "/proc/a.json"}),
                 1, "/proc/a.json");
  EXPECT_EQ(folder.names(), (Names{"flat.obj", "square.obj"}));
}

TEST_F(Render, OpensTheDeviceBeforeItReadsTheModel) {
  drawing.no_open = Error{ErrorCode::kNoDevice, "there is no Vulkan loader; install libvulkan1"};
  expect_failure(run({"render", "missing.obj", "-s", "0", "-o", path("a.png")}), 1,
                 "no Vulkan loader");
  EXPECT_EQ(drawing.calls, Names{"open"});
  EXPECT_EQ(folder.names(), (Names{"flat.obj", "square.obj"}));
}

TEST_F(Render, FailsForWantOfDeviceMemoryWithOne) {
  drawing.no_open = Error{ErrorCode::kOutOfMemory, "the device has no memory left"};
  expect_failure(run({"render", square, "-s", "0", "-o", path("a.png")}), 1, "no memory left");
}

TEST_F(Render, OfAViewWithoutDistancesNeedsNoSource) {
  for (const char* view : {"wireframe", "flat", "smooth"}) {
    expect_done(run({"render", flat, "--view", view, "-o", path("a.png")}));
    EXPECT_TRUE(drawing.data->values.empty());
    EXPECT_EQ(drawing.data->caption, "flat, 1 face");
    EXPECT_EQ(read_png(bytes_of(path("a.png"))).texts.count("geotherm:t"), 0U);
  }
}

TEST_F(Render, OfDistancesNeedsASource) {
  for (const char* view : {"contours", "sources", "heat-gradient", "gradient-error"}) {
    expect_failure(run({"render", square, "--view", view, "-o", path("a.png")}), 2, "-s 17");
  }
  EXPECT_TRUE(drawing.calls.empty());
}

TEST_F(Render, OfAMeshWithoutAreaIsGreyAndSaysSo) {
  for (const char* view : {"contours", "gradient-error"}) {
    const Run result = run({"render", flat, "-s", "0", "--view", view, "-o", path("a.png")});
    expect_done(result);
    EXPECT_NE(result.err.find("geotherm: warning: there are no distances"), std::string::npos);
    EXPECT_EQ(drawing.data->values, std::vector<float>(3, app::kNoPictureValue));
  }
}

TEST_F(Render, JsonHoldsTheSolveAndThePicture) {
  const Run result =
      run({"render", square, "-s", "0", "--size", "40x30", "-o", path("a.png"), "--json", "-"});
  expect_done(result);
  const nlohmann::json json = nlohmann::json::parse(result.out);
  EXPECT_EQ(json["model"]["name"], "square");
  EXPECT_EQ(json["distance"]["unreached"], 3);
  EXPECT_TRUE(json["timing_ms"].contains("query"));
  EXPECT_EQ(json["picture"]["files"], nlohmann::json({path("a.png")}));
  EXPECT_EQ(json["picture"]["width"], 40);
  EXPECT_EQ(json["picture"]["view"], "contours");
  EXPECT_EQ(json["picture"]["device"]["name"], "Fast GPU");
  EXPECT_EQ(json["picture"]["device"]["software"], false);
  const nlohmann::json plain = nlohmann::json::parse(
      run({"render", square, "--view", "flat", "-o", path("a.png"), "--json", "-"}).out);
  EXPECT_EQ(plain["model"]["faces"], 3);
  EXPECT_FALSE(plain.contains("distance"));
}

TEST_F(Render, WritesThePictureToStandardOutputAndNothingElse) {
  const Run result = run({"render", square, "-s", "0", "--size", "8x8", "-o", "-"});
  expect_done(result);
  EXPECT_TRUE(read_png(result.out).valid);
  EXPECT_TRUE(result.out.ends_with("IEND\xae\x42\x60\x82"));
}

TEST_F(Render, AnnouncesASoftwareDevice) {
  drawing.there_are = {FakeDrawing::device("llvmpipe", false)};
  const Run result = run({"render", square, "-s", "0", "-o", path("a.png")});
  EXPECT_NE(result.out.find("llvmpipe, in software"), std::string::npos) << result.out;
}

TEST_F(Render, RefusesACommandLineBeforeAnyWork) {
  const std::string out = path("a.png");
  expect_failure(run({"render", square, "-s", "0"}), 2, "--output");
  expect_failure(run({"render", square, "-s", "0", "-o", path("a.jpg")}), 2, ".png");
  expect_failure(run({"render", square, "-s", "0", "-o", path("a")}), 2, ".png");
  expect_failure(run({"render", square, "-s", "0", "-o", path("no/a.png")}), 1, "no folder");
  expect_failure(run({"render", square, "-s", "0", "-o", "-", "--json", "-"}), 2, "twice");
  expect_failure(run({"render", square, "-s", "0", "-o", "-", "--turntable", "2"}), 2,
                 "standard output");
  expect_failure(run({"render", square, "-s", "0", "-o", out, "--view", "heat"}), 2, "contours");
  expect_failure(run({"render", square, "-s", "0", "-o", out, "--colour-map", "jet"}), 2,
                 "red-blue, viridis");
  expect_failure(run({"render", square, "-s", "0", "-o", out, "--backend", "magic"}), 2, "'magic'");
  expect_failure(run({"render", square, "-s", "0", "-o", out, "--fit", "loose"}), 2, "loose");
  EXPECT_TRUE(drawing.calls.empty());
}

TEST_F(Render, RefusesASourceThatTheMeshDoesNotHave) {
  expect_failure(run({"render", square, "-s", "99", "-o", path("a.png")}), 2, "99");
  EXPECT_EQ(drawing.calls, Names{"open"});
}

TEST_F(Render, DevicesListsThemWithTheDefaultMarkedAndReasonsAgainstTheOthers) {
  drawing.there_are.push_back(FakeDrawing::device("Old", false));
  drawing.there_are.back().lacks = {"dynamic rendering", "32-bit depth"};
  const Run result = run({"devices"});
  expect_done(result);
  EXPECT_EQ(std::count(result.out.begin(), result.out.end(), '\n'), 3) << result.out;
  for (const char* part : {"Fast GPU", "discrete GPU", "driver of Slow", "Vulkan 1.3.0", "2.0 GB",
                           "default", "cannot be used: dynamic rendering; 32-bit depth"}) {
    EXPECT_NE(result.out.find(part), std::string::npos) << part << " is not in\n" << result.out;
  }
  const nlohmann::json json = nlohmann::json::parse(run({"devices", "--json", "-"}).out);
  ASSERT_EQ(json["devices"].size(), 3U);
  EXPECT_EQ(json["devices"][0]["default"], true);
  EXPECT_EQ(json["devices"][1]["software"], true);
  EXPECT_EQ(json["devices"][2]["usable"], false);
}

TEST_F(Render, DevicesFailsWhereThereIsNone) {
  drawing.no_devices = Error{ErrorCode::kNoDevice, "there is no Vulkan loader; install libvulkan1"};
  expect_failure(run({"devices"}), 1, "no Vulkan loader");
  drawing.no_devices.reset();
  drawing.there_are.clear();
  expect_failure(run({"devices", "--json", path("d.json")}), 1, "no device");
  EXPECT_EQ(folder.names(), (Names{"flat.obj", "square.obj"}));
}

}  // namespace
}  // namespace geotherm::test
