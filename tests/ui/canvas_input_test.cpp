// SPDX-License-Identifier: MIT
#include <cmath>

#include "app/session/sources.h"
#include "tests/ui/driver.h"
#include "ui/key_map.h"
#include "ui/source_edit.h"

namespace geotherm::ui {
namespace {

using Texts = std::vector<std::string>;

class CanvasMouse : public UiTest {
 protected:
  void SetUp() override { open_square(); }

  /// The one command that was sent, as the kind it is expected to be.
  template <class Kind>
  Kind only() {
    const Texts texts = sent();
    EXPECT_EQ(texts.size(), 1U) << ::testing::PrintToString(texts);
    if (texts.empty()) return {};
    const auto command = app::parse_command(texts.front());
    const Kind* kind = command ? std::get_if<Kind>(&*command) : nullptr;
    EXPECT_TRUE(kind) << texts.front();
    return kind ? *kind : Kind{};
  }

  /// Whether all commands that were sent begin so; some must have been.
  void expect_all(const std::string& begin) {
    const Texts texts = sent();
    EXPECT_FALSE(texts.empty());
    for (const std::string& text : texts) EXPECT_EQ(text.rfind(begin, 0), 0U) << text;
  }

  Vec3 position_in(const app::SourceSpec& source) {
    const auto* const in_face = std::get_if<app::FacePoint>(&source);
    const auto point = in_face ? surface_point(*in_face, 2 * kCells * kCells) : std::nullopt;
    EXPECT_TRUE(point) << app::to_text(source);
    if (!point) return Vec3::Zero();
    return position_at(*session_.explored().model->model.mesh, *point);
  }
};

TEST_F(CanvasMouse, LeftDragRotates) {
  drag(seen(0.5, 0.5), seen(0.8, 0.5));
  expect_all("camera orbit");
  EXPECT_LT(session_.state().picture.camera.azimuth, 30);  // the model follows the hand
}

TEST_F(CanvasMouse, ControlAndLeftDragZooms) {
  hold(true, false, false);
  drag(seen(0.5, 0.4), seen(0.5, 0.8));
  expect_all("camera zoom");
  EXPECT_GT(session_.state().picture.camera.zoom, 1);
}

TEST_F(CanvasMouse, ShiftAndLeftDragMovesThePicture) {
  hold(false, true, false);
  drag(seen(0.5, 0.5), seen(0.7, 0.6));
  expect_all("camera pan");
  const float height = panels_->canvas().height;
  EXPECT_NEAR(session_.state().picture.camera.pan_right, (seen(0.7, 0).x - seen(0.5, 0).x) / height,
              1e-4);
  EXPECT_GT(session_.state().picture.camera.pan_up, 0);
}

TEST_F(CanvasMouse, MiddleDragMovesThePicture) {
  drag(seen(0.5, 0.5), seen(0.7, 0.5), 2);
  expect_all("camera pan");
}

TEST_F(CanvasMouse, DraggingIsSaidWhileItGoesOn) {
  const ImVec2 from = seen(0.5, 0.5);
  move(from.x, from.y);
  press();
  EXPECT_FALSE(last_.dragging);
  move(from.x + 50, from.y);
  EXPECT_TRUE(last_.dragging);
  release();
  EXPECT_FALSE(last_.dragging);
}

TEST_F(CanvasMouse, WheelZoomsTowardsThePointer) {
  const ImVec2 at = seen(0.75, 0.6);
  move(at.x, at.y);
  ImGui::GetIO().MouseWheel = 1;
  frame();
  const auto zoom = only<app::command::Zoom>();
  const Rect canvas = panels_->canvas();
  EXPECT_GT(zoom.factor, 1);
  EXPECT_NEAR(zoom.right, (at.x - canvas.x - canvas.width / 2) / canvas.height, 1e-5);
  EXPECT_NEAR(zoom.up, (canvas.y + canvas.height / 2 - at.y) / canvas.height, 1e-5);
}

TEST_F(CanvasMouse, ClickSetsASourceExactlyThere) {
  const ImVec2 at = seen(0.43, 0.71);
  click(at.x, at.y);
  const auto set = only<app::command::SetSources>();
  ASSERT_EQ(set.sources.size(), 1U);
  const auto point = canvas_.surface_at(at.x, at.y);
  const auto& back = std::get<app::FacePoint>(set.sources[0]);
  EXPECT_EQ(back.face, point->face);
  EXPECT_EQ(back.weights, point->weights);  // every bit
}

TEST_F(CanvasMouse, ClickOnACutSetsASourceInside) {
  canvas_.inside = InsidePoint{{0.25, 1.0 / 3, -0.5}, 0.125};
  click(seen(0.4, 0.4).x, seen(0.4, 0.4).y);
  EXPECT_EQ(sent(), Texts{"source set xyz:0.25:0.333333:-0.5"});
  hold(false, true, false);
  click(seen(0.4, 0.4).x, seen(0.4, 0.4).y);
  EXPECT_EQ(sent(), Texts{"source add xyz:0.25:0.333333:-0.5"});
}

TEST_F(CanvasMouse, ClickWithASmallTremorIsAClick) {
  const ImVec2 at = seen(0.43, 0.71);
  move(at.x, at.y);
  press();
  move(at.x + 2, at.y + 1);
  release();
  only<app::command::SetSources>();
}

TEST_F(CanvasMouse, ClickBesideTheModelDoesNothing) {
  const Rect canvas = panels_->canvas();
  click(canvas.x + 5, canvas.y + 5);
  EXPECT_EQ(sent(), Texts{});
}

TEST_F(CanvasMouse, ShiftAndClickAddsASource) {
  hold(false, true, false);
  click(seen(0.5, 0.6).x, seen(0.5, 0.6).y);
  only<app::command::AddSources>();
  EXPECT_EQ(session_.state().sources.size(), 2U);
}

/// Window managers take Alt.
TEST_F(CanvasMouse, NothingNeedsAlt) {
  for (const MouseBinding& binding : mouse_bindings()) {
    EXPECT_EQ(binding.stroke.find("Alt"), std::string_view::npos) << binding.stroke;
  }
}

TEST_F(CanvasMouse, ControlAndClickPicksAPoint) {
  hold(true, false, false);
  click(seen(0.5, 0.6).x, seen(0.5, 0.6).y);
  EXPECT_TRUE(only<app::command::Pick>().point);
}

TEST_F(CanvasMouse, ControlShiftAndClickSetsTheTargetOfPaths) {
  hold(true, true, false);
  click(seen(0.5, 0.6).x, seen(0.5, 0.6).y);
  EXPECT_TRUE(only<app::command::Target>().point);
}

TEST_F(CanvasMouse, DoubleClickSetsTheCentreAndGivesTheSourcesBack) {
  run("source set 3 5");
  sent();
  const ImVec2 at = seen(0.25, 0.6);
  wait();
  move(at.x, at.y);
  press();
  release();
  press();
  release();
  const Texts texts = sent();
  ASSERT_EQ(texts.size(), 3U) << ::testing::PrintToString(texts);
  EXPECT_EQ(texts[0].rfind("source set face:", 0), 0U);
  EXPECT_EQ(texts[1], "source set 3 5");
  const auto command = app::parse_command(texts[2]);
  const auto* centre = std::get_if<app::command::Centre>(&*command);
  ASSERT_TRUE(centre);
  EXPECT_NEAR(centre->x, 0.25, 1e-3);
  EXPECT_NEAR(centre->y, 0.6, 1e-3);
}

TEST_F(CanvasMouse, DragOfASourceMovesItAndNotTheCamera) {
  run("source set 0 40");  // 40: the middle of the square
  frame();
  drag(seen(0.5, 0.5), seen(0.75, 0.25));
  expect_all("source move 1 face:");
  EXPECT_EQ(app::to_text(session_.state().sources[0]), "0");
  EXPECT_LT((position_in(session_.state().sources[1]) - Vec3(0.75, 0.25, 0)).norm(), 1e-3);
}

TEST_F(CanvasMouse, DragOfOneOfSeveralTakesTheirEntryApartFirst) {
  run("source set 0,40,80");
  frame();
  drag(seen(0.5, 0.5), seen(0.75, 0.25));
  const Texts texts = sent();
  ASSERT_GE(texts.size(), 2U);
  EXPECT_EQ(texts[0], "source set 0 40 80");
  EXPECT_EQ(texts[1].rfind("source move 1 face:", 0), 0U) << texts[1];
  EXPECT_EQ(session_.state().sources.size(), 3U);
}

TEST_F(CanvasMouse, DragThatLeavesTheModelKeepsTheSourceOnIt) {
  run("source set 40");
  frame();
  const Rect canvas = panels_->canvas();
  drag(seen(0.5, 0.5), {canvas.x + 3, canvas.y + 3});
  ASSERT_EQ(session_.state().sources.size(), 1U);
  position_in(session_.state().sources[0]);
  EXPECT_TRUE(session_.failure().empty());
}

TEST_F(CanvasMouse, DragThatBeginsOnAHiddenSourceRotates) {
  run("source set 40");
  frame();
  canvas_.front = SurfacePoint::in_face(0, {1, 0, 0});  // far from vertex 40: it is behind
  drag(seen(0.5, 0.5), seen(0.6, 0.5));
  expect_all("camera orbit");
}

TEST_F(CanvasMouse, BrushPaintsACurve) {
  type("b");
  sent();
  drag(seen(0.25, 0.5), seen(0.75, 0.5));
  const Texts texts = sent();
  ASSERT_GE(texts.size(), 2U);
  EXPECT_EQ(texts[0].rfind("source add curve:face:", 0), 0U) << texts[0];
  EXPECT_EQ(texts[1].rfind("source extend face:", 0), 0U) << texts[1];
  ASSERT_EQ(session_.state().sources.size(), 2U);
  const auto* const curve = std::get_if<app::SurfaceCurve>(&session_.state().sources.back());
  ASSERT_TRUE(curve);
  // The pointer, not the vertices of the grid, an eighth apart.
  for (const app::FacePoint& point : curve->points) {
    EXPECT_NEAR(position_in(point).y(), 0.5, 0.01);
  }
  EXPECT_NEAR(position_in(curve->points.front()).x(), 0.25, 0.01);
  EXPECT_NEAR(position_in(curve->points.back()).x(), 0.75, 0.03);
  double length = 0;
  for (const FaceSegment& piece : session_.explored().set.segments) {
    const TriangleMesh& mesh = *session_.explored().model->model.mesh;
    length += (position_at(mesh, SurfacePoint::in_face(piece.face, piece.from)) -
               position_at(mesh, SurfacePoint::in_face(piece.face, piece.to)))
                  .norm();
  }
  EXPECT_NEAR(length, 0.5, 0.03);
  drag(seen(0.5, 0.5), seen(0.6, 0.6), 1);
  expect_all("camera orbit");
  type("b");
  drag(seen(0.3, 0.3), seen(0.5, 0.3));
  expect_all("camera orbit");
}

TEST_F(CanvasMouse, TouchOfTheBrushIsASource) {
  type("b");
  click(seen(0.25, 0.5).x, seen(0.25, 0.5).y);
  const Texts texts = sent();
  ASSERT_EQ(texts.size(), 1U);
  EXPECT_EQ(texts[0].rfind("source add curve:face:", 0), 0U) << texts[0];
}

TEST_F(CanvasMouse, BrushMarksItsStrokeAsADrag) {
  type("b");
  move(seen(0.25, 0.5).x, seen(0.25, 0.5).y);
  press();
  EXPECT_TRUE(last_.dragging);
  release();
  EXPECT_FALSE(last_.dragging);
}

TEST_F(CanvasMouse, RightClickOpensAMenuOfThePoint) {
  const ImVec2 at = seen(0.5, 0.75);
  click(at.x, at.y, 1);
  EXPECT_EQ(sent(), Texts{});
  click_item("point menu/Add a source here");
  const auto add = only<app::command::AddSources>();
  EXPECT_LT((position_in(add.sources.at(0)) - Vec3(0.5, 0.75, 0)).norm(), 1e-3);
  frames(2);
  EXPECT_FALSE(is_drawn("point menu/Add a source here"));
}

struct MenuEntry {
  const char* label;
  const char* command;
};
class PointMenu : public CanvasMouse, public ::testing::WithParamInterface<MenuEntry> {};

TEST_P(PointMenu, SendsItsCommand) {
  click(seen(0.5, 0.75).x, seen(0.5, 0.75).y, 1);
  click_item(std::string("point menu/") + GetParam().label);
  expect_all(GetParam().command);
}

INSTANTIATE_TEST_SUITE_P(Entries, PointMenu,
                         ::testing::Values(MenuEntry{"Source here", "source set face:"},
                                           MenuEntry{"Remove the nearest source",
                                                     "source remove 0"},
                                           MenuEntry{"Turn about this point", "camera centre"},
                                           MenuEntry{"Show figures here", "pick face:"},
                                           MenuEntry{"Paths from here", "target face:"},
                                           MenuEntry{"Whole model", "camera frame"},
                                           MenuEntry{"Clear sources", "source clear"}));

TEST_F(CanvasMouse, ClickThatClosesAMenuIsNoClickOnTheModel) {
  click(seen(0.5, 0.75).x, seen(0.5, 0.75).y, 1);
  click(seen(0.2, 0.2).x, seen(0.2, 0.2).y);
  EXPECT_EQ(sent(), Texts{});
  click(seen(0.2, 0.2).x, seen(0.2, 0.2).y);
  only<app::command::SetSources>();
}

TEST_F(CanvasMouse, ClicksAndWheelOnPanelsStayThere) {
  const ImVec2 at = middle_of("Model/");
  drag(at, {at.x + 40, at.y + 60});
  ImGui::GetIO().MouseWheel = 1;
  frame();
  EXPECT_EQ(sent(), Texts{});
}

TEST_F(CanvasMouse, DragFromAPanelOverThePictureStaysAPanels) {
  drag(middle_of("Solver/backend"), seen(0.5, 0.5));
  EXPECT_EQ(sent(), Texts{});
}

TEST_F(CanvasMouse, DragFromThePictureOverAPanelGoesOn) {
  const ImVec2 from = seen(0.5, 0.5);
  move(from.x, from.y);
  press();
  move(20, from.y);
  sent();
  move(20, from.y + 30);
  EXPECT_TRUE(last_.dragging);
  expect_all("camera orbit");
  release();
}

TEST_F(CanvasMouse, DroppedFilesOpen) {
  panels_->drop({"/no/such/bunny.obj", "/second.obj"});
  frame();
  EXPECT_EQ(sent(), Texts{"open /no/such/bunny.obj"});
  panels_->drop({"/no/such/work.geotherm"});
  frame();
  EXPECT_EQ(sent(), Texts{"run /no/such/work.geotherm"});
}

}  // namespace
}  // namespace geotherm::ui
