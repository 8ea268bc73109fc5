// SPDX-License-Identifier: MIT
#include "app/session/command.h"

#include <gtest/gtest.h>

#include <random>

#include "app/session/settings.h"
#include "tests/support/source_texts.h"

namespace geotherm::app {
namespace {

/// The state after these lines.
ViewerState after(const std::vector<std::string>& lines, ViewerState state = initial_state()) {
  for (const std::string& line : lines) {
    const auto command = parse_command(line);
    EXPECT_TRUE(command) << command.error().message;
    const auto next = app::apply(state, *command);
    EXPECT_TRUE(next) << line << ": " << next.error().message;
    state = *next;
  }
  return state;
}

std::string refusal(const ViewerState& state, const std::string& line) {
  const auto next = app::apply(state, *parse_command(line));
  return next ? "" : sentence(next.error());
}

TEST(Apply, OpenKeepsSourcesThatFitAnyModelAndFramesIt) {
  const ViewerState state =
      after({"open a.obj", "source set 17 boundary random:3:9", "camera place 1 2 3 0.4 0.5",
             "camera centre 1 2 3", "range 0:5", "spacing 0.1", "pick face:0:1:0:0", "open b.obj"});
  EXPECT_EQ(state.model, "b.obj");
  EXPECT_EQ(test::texts_of(state.sources), (std::vector<std::string>{"boundary", "random:3:9"}));
  EXPECT_EQ(state.picture.camera.zoom, 1);
  EXPECT_FALSE(state.picture.camera.centre);
  EXPECT_FALSE(state.picture.range_max);
  EXPECT_FALSE(state.picture.line_spacing);
  EXPECT_FALSE(state.picked);
  EXPECT_EQ(state.picture.camera.azimuth, 1) << "the direction stays";
}

TEST(Apply, AModelBeginsWithOneRandomSource) {
  EXPECT_EQ(test::texts_of(after({"open bunny"}).sources), std::vector<std::string>{"random:1"});
  EXPECT_EQ(test::texts_of(after({"open a", "source set 5", "open b"}).sources),
            std::vector<std::string>{"random:1"});
}

TEST(Apply, MoreAndFewerCountTheRandomSources) {
  ViewerState state = after({"open a", "source set 17 random:1:4", "source more", "source more"});
  EXPECT_EQ(test::texts_of(state.sources), (std::vector<std::string>{"17", "random:3:4"}));
  state = after({"source fewer", "source fewer", "source fewer"}, state);
  EXPECT_EQ(test::texts_of(state.sources), std::vector<std::string>{"17"});
  EXPECT_EQ(test::texts_of(after({"source fewer"}, state).sources), std::vector<std::string>{});
  EXPECT_NE(refusal(after({"source clear"}, state), "source fewer"), "");
  EXPECT_EQ(test::texts_of(after({"source more"}, state).sources),
            (std::vector<std::string>{"17", "random:1"}));
}

TEST(Apply, ShuffleKeepsTheNumberAndChangesThePlaces) {
  const ViewerState state = after({"open a", "source set random:5:3"});
  EXPECT_EQ(test::texts_of(after({"source shuffle"}, state).sources),
            std::vector<std::string>{"random:5:4"});
  EXPECT_EQ(test::texts_of(after({"source set 1 2", "source shuffle"}, state).sources),
            std::vector<std::string>{"random:2"});
}

TEST(Apply, RandomSourcesStopAtTheLargestNumber) {
  const ViewerState state = after({"open a", "source set random:2147483647"});
  EXPECT_NE(refusal(state, "source more"), "");
  EXPECT_EQ(test::texts_of(after({"source add random:5:9", "source shuffle"}, state).sources),
            std::vector<std::string>{"random:2147483647:10"});
}

TEST(Apply, ResetLeavesTheModelAlone) {
  const ViewerState state = after({"open a", "keep", "view flat", "rotate on", "reset"});
  ViewerState fresh = initial_state();
  fresh.model = "a";
  EXPECT_EQ(state, fresh);
}

TEST(Apply, ABrushBeginsACurveAndExtendsIt) {
  const ViewerState state = after(
      {"open a", "source set 9", "source add curve:1", "source extend 2,3", "source extend 4"});
  EXPECT_EQ(test::texts_of(state.sources), (std::vector<std::string>{"9", "curve:1,2,3,4"}));
  EXPECT_NE(refusal(after({"open a", "source set 9"}), "source extend 2"), "");
  const auto across =
      after({"open a", "source set curve:face:3:1:0:0", "source extend face:4:0:1:0,face:5:0:0:1"});
  EXPECT_EQ(app::to_text(across.sources.back()), "curve:face:3:1:0:0,face:4:0:1:0,face:5:0:0:1");
  EXPECT_EQ(refusal(across, "source extend 2"),
            "the last source is a curve of another kind; begin one with source add curve:V");
}

TEST(Apply, MoveAndRemoveNameTheirSource) {
  const ViewerState state =
      after({"open a", "source set 1 2 3", "source move 1 9", "source remove 0"});
  EXPECT_EQ(test::texts_of(state.sources), (std::vector<std::string>{"9", "3"}));
  EXPECT_NE(refusal(state, "source remove 2").find("0 to 1"), std::string::npos);
  EXPECT_NE(refusal(state, "source move 7 1").find("source 7"), std::string::npos);
}

TEST(Apply, OrbitWrapsTheAzimuthAndStopsAtThePoles) {
  const CameraSettings camera = after({"camera orbit 340 500"}).picture.camera;
  EXPECT_DOUBLE_EQ(camera.azimuth, 10);  // 30 + 340 - 360
  EXPECT_EQ(camera.elevation, 90);
  EXPECT_GE(after({"camera orbit -1e300 0"}).picture.camera.azimuth, 0);
}

TEST(Apply, ZoomKeepsThePlaceUnderThePointer) {
  // A point of the model is seen at pan + zoom * v: where it is under the pointer, it stays.
  const ViewerState before = after({"camera place 0 0 2 0.1 -0.2"});
  const ViewerState state = after({"camera zoom 1.5 0.3 0.4"}, before);
  const CameraSettings& a = before.picture.camera;
  const CameraSettings& b = state.picture.camera;
  EXPECT_DOUBLE_EQ(b.zoom, 3);
  EXPECT_NEAR((0.3 - b.pan_right) / b.zoom, (0.3 - a.pan_right) / a.zoom, 1e-15);
  EXPECT_NEAR((0.4 - b.pan_up) / b.zoom, (0.4 - a.pan_up) / a.zoom, 1e-15);
}

TEST(Apply, ZoomStopsAtItsBoundsWithoutLosingThePlace) {
  ViewerState state = initial_state();
  for (int i = 0; i < 100; ++i) state = after({"camera zoom 10 0.3 0.2"}, state);
  EXPECT_EQ(state.picture.camera.zoom, 1e6);
  const double pan = state.picture.camera.pan_right;
  EXPECT_EQ(after({"camera zoom 10 0.3 0.2"}, state).picture.camera.pan_right, pan);
}

TEST(Apply, BIsKeptSwappedShownAndForgotten) {
  ViewerState state = after({"backend cg", "keep", "backend eigen-ldlt"});
  EXPECT_EQ(state.kept->backend, "cg");
  state = after({"swap"}, state);
  EXPECT_EQ(state.options.backend, "cg");
  EXPECT_EQ(after({"flip"}, state).shown, Shown::kB);
  EXPECT_EQ(after({"flip", "flip"}, state).shown, Shown::kA);
  EXPECT_EQ(after({"show difference", "flip"}, state).shown, Shown::kA);
  EXPECT_EQ(after({"show difference", "forget"}, state).shown, Shown::kA);
  for (const char* line : {"swap", "flip", "show b", "show difference"}) {
    EXPECT_NE(refusal(initial_state(), line), "") << line;
  }
}

TEST(Apply, DoesNotTouchWhatItIsGiven) {
  const ViewerState state = after({"open a", "source set 3"});
  const ViewerState copy = state;
  [[maybe_unused]] const auto next = app::apply(state, command::MoreSources{});
  EXPECT_EQ(state, copy);
}

/// A state that some hundred commands led to.
ViewerState random_state(unsigned seed) {
  std::mt19937 random(seed);
  const std::vector<std::string> lines = {"open bunny",
                                          "open \"a b.ply\"",
                                          "source set 3 boundary",
                                          "source more",
                                          "source clear",
                                          "source add face:5:0.1:0.2:0.7",
                                          "source add xyz:1:2:3",
                                          "source add curve:1,2,3",
                                          "backend cg",
                                          "backend eigen-ldlt",
                                          "time-step mean-face-area",
                                          "time-step absolute:0.0123",
                                          "time-step mean-edge",
                                          "time-factor 3.7",
                                          "time-factor 1",
                                          "constraint penalty:12.5",
                                          "constraint pin-vertex:4",
                                          "constraint pin-sources",
                                          "heat hold",
                                          "boundary average",
                                          "laplacian cotan",
                                          "variant classic",
                                          "precision refined",
                                          "precision full",
                                          "threads 2",
                                          "threads 0",
                                          "view flat",
                                          "view gradient-error",
                                          "size 640x480",
                                          "samples 1",
                                          "colour-map viridis",
                                          "reverse on",
                                          "range 0.5:",
                                          "range auto",
                                          "range 1:2",
                                          "spacing 0.25",
                                          "spacing 0",
                                          "light none",
                                          "background dark",
                                          "bar off",
                                          "caption off",
                                          "markers off",
                                          "camera orbit 12.34 -5.6",
                                          "camera zoom 1.7 0.1 0.2",
                                          "camera pan 0.3 -0.4",
                                          "camera centre 1 2 3",
                                          "camera frame",
                                          "fit tight",
                                          "projection orthographic",
                                          "rotate on",
                                          "rotate off",
                                          "keep",
                                          "forget",
                                          "pick face:3:0.5:0.25:0.25",
                                          "pick none",
                                          "source shuffle"};
  std::uniform_int_distribution<std::size_t> line(0, lines.size() - 1);
  ViewerState state = initial_state();
  for (int i = 0; i < 100; ++i) {
    if (auto next = app::apply(state, *parse_command(lines[line(random)]))) state = *next;
    if (state.kept && i % 7 == 0) state = *app::apply(state, command::Show{Shown::kDifference});
  }
  return state;
}

class StateCommands : public testing::TestWithParam<unsigned> {};

TEST_P(StateCommands, LeadBackToTheStateExactly) {
  const ViewerState state = random_state(GetParam());
  ViewerState again = initial_state();
  for (const Command& command : commands_to(state)) {
    const auto parsed = parse_command(to_text(command));
    ASSERT_TRUE(parsed) << to_text(command) << ": " << parsed.error().message;
    const auto next = app::apply(again, *parsed);
    ASSERT_TRUE(next) << to_text(command) << ": " << next.error().message;
    again = *next;
  }
  EXPECT_EQ(again, state);
}

INSTANTIATE_TEST_SUITE_P(Seeds, StateCommands, testing::Range(1U, 41U));

TEST(StateCommands, OfTheInitialStateAreNone) { EXPECT_TRUE(commands_to(initial_state()).empty()); }

TEST(UndoRule, LeavesCameraAndFilesAlone) {
  for (const char* line : {"camera orbit 1 2", "camera frame", "rotate on", "azimuth 5",
                           "save log a", "open bunny", "pick none", "undo"}) {
    EXPECT_FALSE(undo_rule(*parse_command(line)).undoable) << line;
  }
  for (const char* line :
       {"backend cg", "view flat", "source set 1", "keep", "show a", "bar off"}) {
    EXPECT_TRUE(undo_rule(*parse_command(line)).undoable) << line;
  }
  for (const Setting& setting : settings()) {
    const command::Set set{std::string(setting.name), "1"};
    EXPECT_EQ(undo_rule(set).undoable, setting.group != SettingGroup::kCamera) << setting.name;
  }
}

}  // namespace
}  // namespace geotherm::app
