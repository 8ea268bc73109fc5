// SPDX-License-Identifier: MIT
#include "ui/key_map.h"

#include <set>

#include "tests/ui/driver.h"

namespace geotherm::ui {
namespace {

using Texts = std::vector<std::string>;

struct TypedKey {
  const char* characters;
  const char* command;
};

class TypedKeys : public UiTest, public ::testing::WithParamInterface<TypedKey> {};

TEST_P(TypedKeys, SendExactlyTheirCommand) {
  open_square();
  type(GetParam().characters);
  frames(2);
  EXPECT_EQ(sent(), Texts{GetParam().command});
}

INSTANTIATE_TEST_SUITE_P(
    Report, TypedKeys,
    ::testing::Values(TypedKey{"1", "view wireframe"}, TypedKey{"2", "view flat"},
                      TypedKey{"3", "view smooth"}, TypedKey{"4", "view sources"},
                      TypedKey{"5", "view heat-gradient"}, TypedKey{"6", "view gradient-error"},
                      TypedKey{"7", "view contours"}, TypedKey{"8", "view exact-error"},
                      TypedKey{"9", "view regions"}, TypedKey{"0", "view eikonal-error"},
                      TypedKey{"g", "view lost-gradients"}, TypedKey{"t", "view triangle-quality"},
                      TypedKey{"n", "view non-delaunay"}, TypedKey{"+", "source more"},
                      TypedKey{"-", "source fewer"}, TypedKey{"h", "source shuffle"},
                      TypedKey{"f", "camera frame"}, TypedKey{"k", "keep"},
                      TypedKey{"K", "keep"}));  // with the caps lock

struct HeldKey {
  bool ctrl, shift;
  int code;
  const char* before;  ///< a command that makes it possible, or none
  const char* command;
};

class HeldKeys : public UiTest, public ::testing::WithParamInterface<HeldKey> {};

TEST_P(HeldKeys, SendExactlyTheirCommand) {
  open_square();
  if (*GetParam().before) run(GetParam().before);
  hold(GetParam().ctrl, GetParam().shift, false);
  key(GetParam().code);
  EXPECT_EQ(sent(), Texts{GetParam().command});
}

INSTANTIATE_TEST_SUITE_P(Keys, HeldKeys,
                         ::testing::Values(HeldKey{false, false, kKeyTab, "keep", "flip"},
                                           HeldKey{true, false, 'Z', "source set 3", "undo"},
                                           HeldKey{true, false, 'Q', "", "quit"}));

class KeyMap : public UiTest {};

TEST_F(KeyMap, RedoesWithBothOfItsKeys) {
  open_square();
  run("source set 3");
  run("undo");
  hold(true, false, false);
  key('Y');
  EXPECT_EQ(sent(), Texts{"redo"});
  run("undo");
  hold(true, true, false);
  key('Z');
  EXPECT_EQ(sent(), Texts{"redo"});
}

TEST_F(KeyMap, TurnsTheModelByTheTimeThatPasses) {
  open_square();
  type("p");
  EXPECT_EQ(sent(), Texts{"rotate on"});
  const FrameOutput out = frame();
  EXPECT_TRUE(out.animating);
  const auto texts = sent();
  ASSERT_EQ(texts.size(), 1U);
  const auto command = app::parse_command(texts[0]);
  const auto* orbit = std::get_if<app::command::Orbit>(&*command);
  ASSERT_TRUE(orbit);
  EXPECT_NEAR(orbit->azimuth, 20.0 / 60, 1e-6);
  EXPECT_EQ(orbit->elevation, 0);
  type("p");
  frame();
  EXPECT_EQ(sent().at(0), "rotate off");
  frames(5);
  sent();
  EXPECT_FALSE(frame().animating);
  EXPECT_EQ(sent(), Texts{});
}

TEST_F(KeyMap, LeavesTypingInAFieldAlone) {
  open_square();
  run("keep");
  run("source set 3");
  click_item("Sources/ids");
  type("1");
  type("7");
  hold(true, false, false);
  key('Z');
  hold(false, false, false);
  key(kKeyTab);
  EXPECT_EQ(sent(), Texts{});
  EXPECT_EQ(session_.state().picture.view, app::View::kContours);
}

TEST_F(KeyMap, DoesNothingWhileADialogIsOpen) {
  open_square();
  key(kKeyF1);
  ASSERT_TRUE(is_drawn("Keys/close"));
  type("1");
  type("h");
  EXPECT_EQ(sent(), Texts{});
  key(kKeyEscape);
  frame();
  EXPECT_FALSE(is_drawn("Keys/close"));
}

TEST_F(KeyMap, TabIsAKeyOfThePictureAfterAClickOnAPanel) {
  open_square();
  run("keep");
  click_item("Model/");
  click_item("Model/");
  sent();
  key(kKeyTab);
  EXPECT_EQ(sent(), Texts{"flip"});
  type("2");
  EXPECT_EQ(sent(), Texts{"view flat"});
}

TEST_F(KeyMap, TurnsPanelsOnAndOff) {
  frame();
  key(kKeyF1 + 1);
  EXPECT_FALSE(panels_->layout().left);
  key(kKeyF1 + 2);
  EXPECT_FALSE(panels_->layout().right);
  key(kKeyF1 + 3);
  EXPECT_TRUE(panels_->layout().log);
  key(kKeyF1 + 3);
  EXPECT_FALSE(panels_->layout().log);
}

TEST_F(KeyMap, ListsEveryKeyAndEveryStroke) {
  key(kKeyF1);
  frame();
  for (const KeyBinding& binding : key_bindings()) {
    EXPECT_TRUE(is_drawn("Keys/" + std::string(binding.keys))) << binding.keys;
  }
  for (const MouseBinding& binding : mouse_bindings()) {
    EXPECT_TRUE(is_drawn("Keys/" + std::string(binding.stroke))) << binding.stroke;
  }
}

TEST_F(KeyMap, HasNoKeyTwice) {
  std::set<std::string_view> keys;
  for (const KeyBinding& binding : key_bindings()) EXPECT_TRUE(keys.insert(binding.keys).second);
  for (const MouseBinding& binding : mouse_bindings()) {
    EXPECT_TRUE(keys.insert(binding.stroke).second);
  }
}

TEST_F(KeyMap, CancelsTheWorkOnEscapeOnly) {
  open_square();
  type("b");
  key(kKeyEscape);  // ends the brush first
  EXPECT_FALSE(last_.cancel);
  hold(false, false, false);
  move(seen(0.5, 0.5).x, seen(0.5, 0.5).y);
  EXPECT_EQ(sent(), Texts{});
}

}  // namespace
}  // namespace geotherm::ui
