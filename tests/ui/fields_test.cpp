// SPDX-License-Identifier: MIT
// Fields of the panels that are typed into.
#include "tests/ui/driver.h"
#include "ui/key_map.h"

namespace geotherm::ui {
namespace {

using Texts = std::vector<std::string>;

struct Typing {
  const char* before;
  const char* field;
  const char* text;
  Texts commands;
};

class PanelFields : public UiTest, public ::testing::WithParamInterface<Typing> {};

TEST_P(PanelFields, SendWhatWasTyped) {
  open_square();
  if (*GetParam().before) run(GetParam().before);
  frames(2);
  fill(GetParam().field, GetParam().text);
  EXPECT_EQ(sent(), GetParam().commands);
}

INSTANTIATE_TEST_SUITE_P(
    Fields, PanelFields,
    ::testing::Values(
        Typing{"", "Solver/time-factor", "2.5", {"time-factor 2.5"}},
        Typing{"", "Solver/time-factor", "1", {}},
        Typing{"time-step absolute:0.25", "Solver/absolute", "0.5", {"time-step absolute:0.5"}},
        Typing{"constraint penalty:10", "Solver/penalty", "1e6", {"constraint penalty:1e6"}},
        Typing{"constraint pin-vertex", "Solver/pin", "4", {"constraint pin-vertex:4"}},
        Typing{"", "Solver/threads", "2", {"threads 2"}},
        Typing{"", "Sources/ids", "3, 9 12", {"source set 3,9,12"}},
        Typing{"", "Sources/ids", "random:3:7", {"source set random:3:7"}},
        Typing{"", "View/range min", "0.5", {"range 0.5:"}},
        Typing{"range 0.5:", "View/range max", "2", {"range 0.5:2"}},
        Typing{"range 0.5:2", "View/range max", "", {"range 0.5:"}},
        Typing{"", "View/spacing", "0.125", {"spacing 0.125"}},
        Typing{"spacing 0.5", "View/spacing", "", {"spacing auto"}},
        Typing{"slice x", "View/slice-at", "0.25", {"slice-at 0.25"}},
        Typing{"peel above:0.5", "View/peel-at", "0.75", {"peel above:0.75"}},
        Typing{"", "View/azimuth", "75", {"azimuth 75"}},
        Typing{"", "View/elevation", "-10", {"elevation -10"}},
        Typing{"", "View/zoom", "3", {"zoom 3"}},
        Typing{"", "View/pan up", "0.25", {"pan 0:0.25"}}));

class Fields : public UiTest {};

TEST_F(Fields, ThatAreLeftSendWhatWasTyped) {
  open_square();
  click_item("Solver/time-factor");
  type("4");
  click_item("Quality/");  // drawn after it
  EXPECT_EQ(sent(), Texts{"time-factor 4"});
  click_item("Solver/time-factor");
  type("5");
  click_item("Model/");  // drawn before it
  EXPECT_EQ(sent(), Texts{"time-factor 5"});
}

TEST_F(Fields, ThatAreLeftForOneAboveSendWhatWasTyped) {
  open_square();
  ASSERT_LT(middle_of("View/zoom").y, middle_of("Solver/time-factor").y);
  click_item("Solver/time-factor");
  type("4");
  click_item("View/zoom");
  EXPECT_EQ(sent(), Texts{"time-factor 4"});
  type("2");
  click_item("Quality/");
  EXPECT_EQ(sent(), Texts{"zoom 2"});
}

TEST_F(Fields, ThatAreHiddenWhileTheyAreTypedInSendNothingLater) {
  open_square();
  click_item("Solver/time-factor");
  type("4");
  key(kKeyF1 + 1);
  frames(2);
  ASSERT_FALSE(is_drawn("Solver/time-factor"));
  run("time-factor 9");
  key(kKeyF1 + 1);
  frames(3);
  ASSERT_TRUE(is_drawn("Solver/time-factor"));
  EXPECT_EQ(sent(), Texts{});
  EXPECT_EQ(session_.state().options.time_step.factor, 9);
}

TEST_F(Fields, TakeBackWhatWasTypedOnEscape) {
  open_square();
  click_item("Solver/time-factor");
  type("7");
  key(kKeyEscape);
  frames(2);
  EXPECT_EQ(sent(), Texts{});
  EXPECT_FALSE(last_.cancel);
}

}  // namespace
}  // namespace geotherm::ui
