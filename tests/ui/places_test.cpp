// SPDX-License-Identifier: MIT
#include "ui/layout.h"

#include <gtest/gtest.h>

#include <tuple>

#include "tests/ui/driver.h"
#include "ui/key_map.h"

namespace geotherm::ui {
namespace {

bool overlap(const Rect& a, const Rect& b) {
  return a.width > 0 && b.width > 0 && a.height > 0 && b.height > 0 && a.x < b.x + b.width &&
         b.x < a.x + a.width && a.y < b.y + b.height && b.y < a.y + a.height;
}

void expect_sound(const Places& places, float width, float height) {
  const Rect all[] = {places.menu,  places.status, places.left,
                      places.right, places.log,    places.canvas};
  for (const Rect& rect : all) {
    EXPECT_GE(rect.width, 0);
    EXPECT_GE(rect.height, 0);
    EXPECT_GE(rect.x, 0);
    EXPECT_GE(rect.y, 0);
    EXPECT_LE(rect.x + rect.width, width + 0.01F);
    EXPECT_LE(rect.y + rect.height, height + 0.01F);
  }
  for (std::size_t i = 0; i < std::size(all); ++i) {
    for (std::size_t k = 0; k < i; ++k) EXPECT_FALSE(overlap(all[i], all[k])) << i << ' ' << k;
  }
}

using Window = std::tuple<std::array<int, 2>, float>;  // size, scale

class WindowSizes : public UiTest, public ::testing::WithParamInterface<Window> {};

TEST_P(WindowSizes, PanelsLeaveTheCanvasAlone) {
  const auto [size, scale] = GetParam();
  const auto width = static_cast<float>(size[0]), height = static_cast<float>(size[1]);
  Layout wide;
  wide.log = true;
  wide.left_width = wide.right_width = wide.log_height = 900;
  Layout narrow;
  narrow.log = true;
  narrow.left_width = narrow.right_width = 160;
  for (const Layout& layout : {Layout{}, wide, narrow}) {
    const float line = 21 * scale;
    const Places places = place_panels(layout, width, height, scale, line);
    expect_sound(places, width, height);
    const float least = kMinCanvas * scale;
    EXPECT_GE(places.canvas.width, std::min(width, least));
    EXPECT_GE(places.canvas.height, std::min(height - 2 * line, least) - 0.01F);
  }
}

TEST_P(WindowSizes, AreDrawnWithoutHarm) {
  const auto [size, scale] = GetParam();
  Layout layout = everything_open();
  layout.log = true;
  ImGui::GetIO().DisplaySize = {static_cast<float>(size[0]), static_cast<float>(size[1])};
  restart(layout, scale);
  open_square();
  run("keep");
  run("pick face:3:0.2:0.3:0.5");
  frames(2);
  const Rect canvas = panels_->canvas();
  EXPECT_GT(canvas.width, 0);
  EXPECT_GE(canvas.height, 0);
  // The middle of the picture belongs to the mouse of the picture.
  move(canvas.x + canvas.width / 2, canvas.y + canvas.height / 2);
  frame();
  if (canvas.height > 100) {
    EXPECT_FALSE(ImGui::GetIO().WantCaptureMouse);
  }
}

INSTANTIATE_TEST_SUITE_P(
    Sizes, WindowSizes,
    ::testing::Combine(::testing::Values(std::array{320, 200}, std::array{640, 480},
                                         std::array{1280, 800}, std::array{200, 1600},
                                         std::array{3840, 2160}),
                       ::testing::Values(0.75F, 1.0F, 1.5F, 2.0F, 3.0F)));

TEST(Places, SurviveAWindowWithoutSize) {
  expect_sound(place_panels(Layout{}, 0, 0, 1, 21), 0, 0);
  expect_sound(place_panels(Layout{}, 1, 1, 3, 63), 1, 1);
}

TEST(Places, GiveSideBarsTheirWidthWhereThereIsRoom) {
  const Places places = place_panels(Layout{}, 1280, 800, 1, 21);
  EXPECT_EQ(places.left.width, 310);
  EXPECT_EQ(places.right.width, 310);
  EXPECT_EQ(places.canvas.width, 1280 - 620);
  EXPECT_EQ(places.log.width, 0);
}

TEST(Places, GiveUpTheRightBarFirst) {
  const Places places = place_panels(Layout{}, 600, 800, 1, 21);
  EXPECT_GT(places.left.width, 0);
  EXPECT_EQ(places.right.width, 0);
  Layout right_only;
  right_only.left = false;
  EXPECT_GT(place_panels(right_only, 600, 800, 1, 21).right.width, 0);
}

class SmallWindow : public UiTest {
 protected:
  void SetUp() override {
    ImGui::GetIO().DisplaySize = {400, 300};
    restart(Layout{}, 1);
    open_square();
  }
};

/// It would cover the bar, and the button that is let go take an entry.
TEST_F(SmallWindow, HasMenusBelowTheirBar) {
  const float bar = middle_of("Menu/View").y;
  click_item("Menu/View");
  frames(3);
  EXPECT_GT(middle_of("Menu/Wireframe").y, 2 * bar);
  EXPECT_TRUE(sent().empty());
}

/// No bar has room beside the picture there: its key brings it over the picture, which stays.
TEST_F(SmallWindow, HasEveryBarByItsKey) {
  const Rect before = panels_->canvas();
  const struct {
    int key;
    const char* item;
  } bars[] = {{kKeyF1 + 1, "View/"}, {kKeyF1 + 2, "Quality/"}, {kKeyF1 + 3, "Log/command"}};
  for (const auto& [code, item] : bars) {
    EXPECT_FALSE(is_drawn(item)) << item;
    key(code);
    frames(2);
    EXPECT_TRUE(is_drawn(item)) << item;
    EXPECT_EQ(panels_->canvas().width, before.width);
    EXPECT_EQ(panels_->canvas().height, before.height);
    key(code);
    frames(2);
    EXPECT_FALSE(is_drawn(item)) << item;
  }
  key(kKeyF1 + 1);
  frames(2);
  key(kKeyEscape);
  frames(2);
  EXPECT_FALSE(is_drawn("View/"));
}

class AskedComparison : public UiTest {};

TEST_F(AskedComparison, OfBackendsComesIntoSight) {
  Layout layout;
  layout.right = false;
  restart(layout, 1);
  open_square();
  EXPECT_FALSE(is_drawn("Compare backends/run"));
  click_item("Menu/Solve");
  click_item("Menu/Compare all backends");
  frames(4);
  ASSERT_TRUE(is_drawn("Compare backends/run"));
  const ImVec2 at = middle_of("Compare backends/run");
  EXPECT_GT(at.y, 0);
  EXPECT_LT(at.y, ImGui::GetIO().DisplaySize.y);
}

class AskedError : public UiTest {};

TEST_F(AskedError, ComesIntoSight) {
  Layout layout;
  layout.right = false;
  layout.open = {{"Exact error", false}};
  restart(layout, 1);
  open_square();
  frames(3);
  EXPECT_FALSE(is_drawn("Exact error/show"));
  click_item("Status/error");
  frames(4);
  ASSERT_TRUE(is_drawn("Exact error/show"));
  EXPECT_LT(middle_of("Exact error/show").y, ImGui::GetIO().DisplaySize.y);
}

class BarEdges : public UiTest {};

TEST_F(BarEdges, ResizeTheSideBars) {
  drag(middle_of("Bars/left edge"), {400, 600});
  EXPECT_NEAR(panels_->layout().left_width, 400, 4);
  drag(middle_of("Bars/right edge"), {1200, 600});
  EXPECT_NEAR(panels_->layout().right_width, 400, 4);
  frame();
  EXPECT_NEAR(panels_->canvas().width, 800, 8);
  drag(middle_of("Bars/left edge"), {5, 600});
  EXPECT_EQ(panels_->layout().left_width, kMinBar);
}

/// Letters twice as large leave room for one bar; the key of the other brings it instead.
TEST_F(BarEdges, TakeTurnsWhereOneHasRoomAlone) {
  ImGui::GetIO().DisplaySize = {1280, 800};
  restart(Layout{}, 2);
  open_square();
  const auto share = [this] { return panels_->canvas().width / 1280; };
  EXPECT_TRUE(is_drawn("View/"));
  EXPECT_FALSE(is_drawn("Quality/"));
  EXPECT_GE(share(), kMinCanvasShare);
  key(kKeyF1 + 2);
  frames(2);
  EXPECT_FALSE(is_drawn("View/"));
  EXPECT_TRUE(is_drawn("Quality/"));
  EXPECT_GE(share(), kMinCanvasShare);
  key(kKeyF1 + 1);
  frames(2);
  EXPECT_TRUE(is_drawn("View/"));
}

TEST_F(BarEdges, RememberWhichSectionsAreOpen) {
  click_item("Solver/");
  EXPECT_FALSE(panels_->layout().open.at("Solver"));
  EXPECT_FALSE(is_drawn("Solver/backend"));
  click_item("Solver/");
  EXPECT_TRUE(is_drawn("Solver/backend"));
}

}  // namespace
}  // namespace geotherm::ui
