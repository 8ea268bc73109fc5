// SPDX-License-Identifier: MIT
// The bars over the picture: sculpting, and the timeline.
#include <algorithm>
#include <cmath>
#include <fstream>

#include "app/session/sources.h"
#include "tests/ui/driver.h"
#include "ui/key_map.h"

namespace geotherm::ui {
namespace {

using Texts = std::vector<std::string>;

class Sculpting : public UiTest {
 protected:
  void SetUp() override {
    open_square();
    type("s");
    frames(3);  // until the bar has found its width
    sent();
  }

  /// The strokes that were sent, extensions in their places.
  std::vector<app::Stroke> strokes() {
    std::vector<app::Stroke> all;
    for (const std::string& text : sent()) {
      const auto command = app::parse_command(text);
      EXPECT_TRUE(command) << text;
      if (const auto* begun = std::get_if<app::command::Sculpt>(&*command)) {
        all.push_back(begun->stroke);
      } else if (const auto* more = std::get_if<app::command::ExtendStroke>(&*command)) {
        auto& points = all.back().points;
        points.insert(points.end(), more->points.begin(), more->points.end());
      } else {
        ADD_FAILURE() << text;
      }
    }
    return all;
  }
};

TEST_F(Sculpting, ADragIsAStrokeOfEvenlySpacedTouches) {
  drag(seen(0.2, 0.5), seen(0.8, 0.5));
  const auto all = strokes();
  ASSERT_EQ(all.size(), 1U);
  EXPECT_EQ(all[0].tool, app::SculptTool::kPull);
  EXPECT_NEAR(all[0].radius, 0.06 * std::sqrt(2.0), 1e-4) << "of the square's diagonal";
  ASSERT_GT(all[0].points.size(), 5U);
  for (std::size_t i = 1; i < all[0].points.size(); ++i) {
    // On the square as it was: strokes of a flat canvas leave its x and y.
    const auto place = [&](std::size_t k) {
      const app::FacePoint& p = all[0].points[k];
      return position_at(*session_.explored().model->model.mesh,
                         SurfacePoint::in_face(p.face, p.weights));
    };
    EXPECT_NEAR((place(i) - place(i - 1)).head<2>().norm(), all[0].radius / 4, 1e-3);
  }
  EXPECT_EQ(session_.state().sculpture.strokes.size(), 1U);
  EXPECT_TRUE(session_.can_undo());
}

TEST_F(Sculpting, ModifiersChooseTheTool) {
  hold(true, false, false);
  drag(seen(0.2, 0.5), seen(0.4, 0.5));
  hold(false, true, false);
  drag(seen(0.2, 0.5), seen(0.4, 0.5));
  hold(false, false, false);
  const auto all = strokes();
  ASSERT_EQ(all.size(), 2U);
  EXPECT_EQ(all[0].tool, app::SculptTool::kPush);
  EXPECT_EQ(all[1].tool, app::SculptTool::kSmooth);
}

TEST_F(Sculpting, TheBarChoosesTheTool) {
  click_item("Sculpt/push");
  const ImVec2 middle = seen(0.5, 0.5);
  click(middle.x, middle.y);
  click_item("Sculpt/smooth");
  click(middle.x, middle.y);
  const auto all = strokes();
  ASSERT_EQ(all.size(), 2U);
  EXPECT_EQ(all[0].tool, app::SculptTool::kPush);
  EXPECT_EQ(all[0].points.size(), 1U) << "a click is a touch";
  EXPECT_EQ(all[1].tool, app::SculptTool::kSmooth);
  click_item("Sculpt/undo");
  EXPECT_EQ(sent(), Texts{"undo"});
  EXPECT_EQ(session_.state().sculpture.strokes.size(), 1U);
}

TEST_F(Sculpting, BesideTheModelADragRotates) {
  const Rect canvas = panels_->canvas();
  drag({canvas.x + 10, canvas.y + canvas.height / 2}, {canvas.x + 60, canvas.y + 200});
  for (const std::string& text : sent()) EXPECT_EQ(text.rfind("camera orbit", 0), 0U) << text;
  EXPECT_TRUE(session_.state().sculpture.strokes.empty());
}

TEST_F(Sculpting, EndsByItsKeyItsBarAndTheBrush) {
  ASSERT_TRUE(is_drawn("Sculpt/pull"));
  key(kKeyEscape);
  frame();
  EXPECT_FALSE(is_drawn("Sculpt/pull"));
  type("s");
  frame();
  click_item("Sculpt/close");
  frame();
  EXPECT_FALSE(is_drawn("Sculpt/pull"));
  type("s");
  type("b");
  sent();
  frame();
  EXPECT_FALSE(is_drawn("Sculpt/pull"));
  drag(seen(0.2, 0.5), seen(0.4, 0.5));
  EXPECT_EQ(sent().front().rfind("source add curve:", 0), 0U);
}

class TimelineBar : public UiTest {
 protected:
  static constexpr int kFrames = 3;

  /// The square, which rises from frame to frame.
  void SetUp() override {
    open_square();
    const TriangleMesh& mesh = *session_.explored().model->model.mesh;
    for (int k = 0; k < kFrames; ++k) {
      std::ofstream file(folder() / ("f_" + std::to_string(k) + ".obj"));
      for (const Vec3& p : mesh.positions()) {
        file << "v " << p.x() << ' ' << p.y() << ' ' << k * p.x() << '\n';
      }
      for (const Face& face : mesh.faces()) {
        file << "f " << face[0] + 1 << ' ' << face[1] + 1 << ' ' << face[2] + 1 << '\n';
      }
    }
    run("sequence \"" + (folder() / "f_%d.obj").string() + "\"");
    frames(2);
    sent();
  }
  int shown() const { return session_.state().timeline.frame; }
};

TEST_F(TimelineBar, StepsRoundTheEnds) {
  click_item("Timeline/next");
  click_item("Timeline/previous");
  click_item("Timeline/previous");
  type(".");
  type(",");
  EXPECT_EQ(sent(), (Texts{"frame 1", "frame 0", "frame 2", "frame 0", "frame 2"}));
}

TEST_F(TimelineBar, PlaysFrameAfterFrameInItsTimeAndStopsWhereItDoesNotLoop) {
  click_item("Timeline/loop");
  key(kKeySpace);
  EXPECT_TRUE(session_.state().timeline.playing);
  EXPECT_TRUE(last_.dragging) << "no figures of quality while it plays";
  int most = 0, drawn = 0;
  for (; session_.state().timeline.playing && drawn < 60; ++drawn) {
    const int before = shown();
    frame();
    EXPECT_LE(shown(), before + 1);
    most = std::max(most, shown());
  }
  EXPECT_EQ(most, kFrames - 1);
  EXPECT_GE(drawn, 4) << "24 frames a second, drawn at 60";
  const Texts all = sent();
  EXPECT_EQ(all, (Texts{"loop off", "play on", "frame 1", "frame 2", "play off"}));
}

TEST_F(TimelineBar, PlaysFromTheFirstFrameAgainWhereNoneFollowsTheLast) {
  run("loop off");
  run("frame " + std::to_string(kFrames - 1));
  frames(2);
  sent();
  key(kKeySpace);
  for (int i = 0; session_.state().timeline.playing && i < 60; ++i) frame();
  EXPECT_EQ(sent(), (Texts{"frame 0", "play on", "frame 1", "frame 2", "play off"}));
}

TEST_F(TimelineBar, LeavesRoomForWhatIsSaid) {
  EXPECT_FALSE(session_.submit(app::command::ShowFrame{99}));
  frames(3);
  const auto bar = panels_->place_of_item("Timeline/frame");
  const auto close = panels_->place_of_item("Notices/close");
  ASSERT_TRUE(bar && close);
  EXPECT_LT(close->y + close->height, bar->y);
}

TEST_F(TimelineBar, SaysTheFrameBesideTheSlider) {
  const auto number = panels_->place_of_item("Timeline/number");
  const auto slider = panels_->place_of_item("Timeline/frame");
  ASSERT_TRUE(number && slider);
  EXPECT_LT(number->x + number->width, slider->x) << "its grab would cover the number";
  run("frame " + std::to_string(kFrames - 1));
  frames(2);
  EXPECT_EQ(panels_->place_of_item("Timeline/frame")->x, slider->x);
}

TEST_F(TimelineBar, ScrubsAndCloses) {
  const ImVec2 middle = middle_of("Timeline/frame");
  drag(middle, {middle.x + 4000, middle.y});
  EXPECT_EQ(shown(), kFrames - 1);
  EXPECT_EQ(session_.explored().model->model.mesh->positions()[kCells].z(), kFrames - 1);
  sent();
  click_item("Timeline/close");
  EXPECT_EQ(sent(), Texts{"sequence none"});
  frame();
  EXPECT_FALSE(is_drawn("Timeline/frame"));
}

}  // namespace
}  // namespace geotherm::ui
