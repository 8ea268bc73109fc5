// SPDX-License-Identifier: MIT
// `geotherm view` with a window and a device that only take notes.
#include <gtest/gtest.h>

#include <filesystem>

#include "app/cli/command_line.h"
#include "app/picture/picture_scale.h"
#include "app/session/command.h"
#include "tests/app/fake_drawing.h"
#include "tests/mesh/mesh_files.h"
#include "tests/support/source_texts.h"

namespace geotherm::test {
namespace {

class ViewCommand : public testing::Test {
 protected:
  int run(const std::vector<std::string>& arguments) {
    testing::internal::CaptureStdout();
    testing::internal::CaptureStderr();
    const int code = app::run_command_line(arguments, drawing, window);
    out = testing::internal::GetCapturedStdout();
    err = testing::internal::GetCapturedStderr();
    return code;
  }

  /// The state that the window was to begin with.
  app::ViewerState start() {
    app::ViewerState state = app::initial_state();
    EXPECT_TRUE(window.started) << err;
    if (!window.started) return state;
    for (const app::Command& command : window.started->commands) {
      auto next = app::apply(state, command);
      EXPECT_TRUE(next);
      if (next) state = *next;
    }
    return state;
  }

  bool exists(const char* name) const { return std::filesystem::exists(folder.path(name)); }

  FakeDrawing drawing;
  FakeWindow window;
  TemporaryDirectory folder;
  std::string out, err;
};

TEST_F(ViewCommand, AModelAloneOpensTheWindow) {
  EXPECT_EQ(run({"bunny"}), 0) << err;
  EXPECT_EQ(start().model, "bunny");
  EXPECT_EQ(test::texts_of(start().sources), std::vector<std::string>{"random:1"});
  EXPECT_EQ(start().picture.camera.fit, app::PictureFit::kSphere);
}

TEST_F(ViewCommand, EveryOptionOfSolveAndRenderReachesTheWindow) {
  folder.write("ids.txt", "3\n4\n");
  EXPECT_EQ(run({"view",
                 "bunny",
                 "-s",
                 "17",
                 "-s",
                 "face:3:0.5:0.25:0.25",
                 "--source-file",
                 folder.path("ids.txt"),
                 "--backend",
                 "cg",
                 "--time-step",
                 "mean-face-area",
                 "-m",
                 "2",
                 "--constraint",
                 "penalty:5",
                 "--heat",
                 "hold",
                 "--boundary",
                 "average",
                 "--laplacian",
                 "cotan",
                 "--variant",
                 "classic",
                 "--precision",
                 "full",
                 "--threads",
                 "1",
                 "--view",
                 "flat",
                 "--samples",
                 "1",
                 "--colour-map",
                 "viridis",
                 "--reverse",
                 "--range",
                 "0:3",
                 "--spacing",
                 "0.5",
                 "--light",
                 "none",
                 "--background",
                 "dark",
                 "--no-bar",
                 "--no-caption",
                 "--no-markers",
                 "--azimuth",
                 "12",
                 "--elevation",
                 "5",
                 "--zoom",
                 "3",
                 "--pan",
                 "0.1:0.2",
                 "--projection",
                 "orthographic",
                 "--centre",
                 "1:2:3",
                 "--device",
                 "soft",
                 "--size",
                 "900x700",
                 "--scale",
                 "2",
                 "--validation"}),
            0)
      << err;
  const app::ViewerState state = start();
  EXPECT_EQ(test::texts_of(state.sources),
            (std::vector<std::string>{"17", "face:3:0.5:0.25:0.25", "3", "4"}));
  EXPECT_EQ(state.options.backend, "cg");
  EXPECT_EQ(state.options.time_step, (TimeStep{TimeRule::kMeanFaceArea, 2, 0}));
  EXPECT_EQ(state.options.constraint.penalty, 5);
  EXPECT_EQ(state.options.heat, HeatMode::kHold);
  EXPECT_EQ(state.options.boundary, BoundaryRule::kAverage);
  EXPECT_EQ(state.options.laplacian, LaplacianKind::kCotan);
  EXPECT_EQ(state.options.variant, Variant::kClassic);
  EXPECT_EQ(state.options.precision, Precision::kFull);
  EXPECT_EQ(state.options.threads, 1);
  const app::PictureSettings& picture = state.picture;
  EXPECT_EQ(picture.view, app::View::kFlat);
  EXPECT_EQ(picture.samples, 1);
  EXPECT_EQ(picture.colour_map, "viridis");
  EXPECT_TRUE(picture.reverse);
  EXPECT_EQ(picture.range_max, 3);
  EXPECT_EQ(picture.line_spacing, 0.5);
  EXPECT_EQ(picture.light, app::PictureLight::kNone);
  EXPECT_EQ(picture.background, app::PictureBackground::kDark);
  EXPECT_FALSE(picture.bar || picture.caption || picture.markers);
  EXPECT_EQ(picture.camera.azimuth, 12);
  EXPECT_EQ(picture.camera.zoom, 3);
  EXPECT_EQ(picture.camera.pan_up, 0.2);
  EXPECT_TRUE(picture.camera.orthographic);
  EXPECT_EQ(picture.camera.centre, (std::array<double, 3>{1, 2, 3}));
  EXPECT_EQ(window.started->device, "soft");
  EXPECT_EQ(window.started->width, 900);
  EXPECT_EQ(window.started->scale, 2);
  EXPECT_TRUE(window.started->validation);
}

TEST_F(ViewCommand, AWindowThatCannotOpenIsOneLineAndNoOutput) {
  window.failure = Error{ErrorCode::kNoDevice, "no window can be opened; geotherm render can"};
  EXPECT_EQ(run({"bunny"}), 1);
  EXPECT_EQ(out, "");
  EXPECT_EQ(err, "geotherm: error: no window can be opened; geotherm render can\n");
}

TEST_F(ViewCommand, AScriptGoesToTheWindowUnlessItIsHeadless) {
  EXPECT_EQ(run({"view", "--script", "a.geotherm"}), 0) << err;
  EXPECT_EQ(window.started->script, "a.geotherm");
  window.started.reset();
  folder.write("b.geotherm", "open bunny\nsource set 5\n");
  EXPECT_EQ(run({"view", "--headless", "--script", folder.path("b.geotherm")}), 0) << err;
  EXPECT_FALSE(window.started);
  EXPECT_NE(out.find("opened bunny"), std::string::npos) << out;
  EXPECT_TRUE(drawing.calls.empty()) << "nothing was to be drawn";
}

TEST_F(ViewCommand, AReplayWritesNothingButTheOutput) {
  folder.write("log.geotherm", "open bunny\nsource set 5\nsave distances " + folder.path("d.csv") +
                                   "\nsave picture " + folder.path("p.png") + "\nquit\n");
  EXPECT_EQ(run({"view", "--replay", folder.path("log.geotherm"), "-o", folder.path("o.png")}), 0)
      << err;
  EXPECT_TRUE(exists("o.png"));
  EXPECT_FALSE(exists("d.csv"));
  EXPECT_FALSE(exists("p.png"));
  EXPECT_NE(out.find("not written: save distances"), std::string::npos);
}

TEST_F(ViewCommand, AFailingScriptLeavesNoPictureAndSaysItsLine) {
  folder.write("bad.geotherm", "open bunny\nredo\n");
  EXPECT_EQ(run({"view", "--script", folder.path("bad.geotherm"), "-o", folder.path("o.png")}), 2);
  EXPECT_NE(err.find("bad.geotherm: line 2: "), std::string::npos) << err;
  EXPECT_EQ(out, "");
  EXPECT_FALSE(exists("o.png"));
}

TEST_F(ViewCommand, ABadLineStopsTheScriptBeforeItsFirstCommand) {
  folder.write("bad.geotherm", "save log " + folder.path("x") + "\nopen\n");
  EXPECT_EQ(run({"view", "--headless", "--script", folder.path("bad.geotherm")}), 1);
  EXPECT_NE(err.find("line 2, column 5: expected open MODEL"), std::string::npos) << err;
  EXPECT_FALSE(exists("x"));
}

TEST_F(ViewCommand, ThePictureHasTheSizeOfTheCommandOrOfTheState) {
  folder.write("s.geotherm", "open bunny\nsize 320x200\nsave picture " + folder.path("a.png") +
                                 "\nsave picture " + folder.path("b.png") + " 64x48\n");
  EXPECT_EQ(run({"view", "--headless", "--script", folder.path("s.geotherm")}), 0) << err;
  EXPECT_EQ(drawing.drawn->width, 64);
  EXPECT_TRUE(exists("a.png"));
}

TEST_F(ViewCommand, PanelsNeedAWindow) {
  folder.write("s.geotherm", "open bunny\nsave picture " + folder.path("a.png") + " panels\n");
  EXPECT_EQ(run({"view", "--headless", "--script", folder.path("s.geotherm")}), 2);
  EXPECT_NE(err.find("no panels without a window"), std::string::npos) << err;
}

TEST_F(ViewCommand, TheDifferenceIsDrawnWithASymmetricRange) {
  folder.write("s.geotherm",
               "open bunny\nsource set 5\nkeep\ntime-factor 30\nshow difference\nsave picture " +
                   folder.path("a.png") + "\n");
  EXPECT_EQ(run({"view", "--headless", "--script", folder.path("s.geotherm")}), 0) << err;
  EXPECT_TRUE(drawing.data->is_signed);
  const app::PictureScale scale = app::picture_scale(*drawing.data, *drawing.drawn);
  EXPECT_EQ(scale.min, -scale.max);
  EXPECT_EQ(app::colour_map_of(*drawing.data, *drawing.drawn), "cool-warm");
}

}  // namespace
}  // namespace geotherm::test
