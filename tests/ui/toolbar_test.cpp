// SPDX-License-Identifier: MIT
// The tools above the picture, sources as things that can be pointed at, and what the panels say.
#include <algorithm>
#include <fstream>

#include "app/session/explored.h"
#include "tests/ui/driver.h"
#include "ui/canvas.h"
#include "ui/key_map.h"

namespace geotherm::ui {
namespace {

using Texts = std::vector<std::string>;

class Tools : public UiTest {
 protected:
  void SetUp() override { open_square(); }

  /// What one click in the middle of the square sends.
  std::string click_sends() {
    wait();
    const ImVec2 at = seen(0.3, 0.6);
    click(at.x, at.y);
    const Texts texts = sent();
    EXPECT_LE(texts.size(), 1U) << ::testing::PrintToString(texts);
    return texts.empty() ? std::string() : texts.front().substr(0, texts.front().find(':'));
  }
};

TEST_F(Tools, DecideWhatAClickDoes) {
  EXPECT_EQ(click_sends(), "source set face");
  click_item("Tools/View");
  EXPECT_EQ(click_sends(), "");
  click_item("Tools/Path");
  EXPECT_EQ(click_sends(), "target face");
  click_item("Tools/Pick");
  EXPECT_EQ(click_sends(), "pick face");
  click_item("Tools/Brush");
  EXPECT_EQ(click_sends(), "source add curve");
  click_item("Tools/Source");
  run("source set 0");  // elsewhere: a click on a source chooses it
  EXPECT_EQ(click_sends(), "source set face");
}

TEST_F(Tools, HaveKeysAndEscapeLeadsBack) {
  type("v");
  EXPECT_EQ(click_sends(), "");
  type("r");
  EXPECT_EQ(click_sends(), "target face");
  type("i");
  EXPECT_EQ(click_sends(), "pick face");
  key(kKeyEscape);
  EXPECT_EQ(click_sends(), "source set face");
}

TEST_F(Tools, AddOneMoreWithShiftWhateverTheToolIs) {
  type("v");
  hold(false, true, false);
  EXPECT_EQ(click_sends(), "source add face");
}

TEST_F(Tools, DragsTurnWithEachThatSetsPoints) {
  for (const char* tool : {"v", "r", "i"}) {
    type(tool);
    sent();
    drag(seen(0.5, 0.5), seen(0.7, 0.5));
    const Texts texts = sent();
    ASSERT_FALSE(texts.empty()) << tool;
    EXPECT_EQ(texts.front().rfind("camera orbit", 0), 0U) << texts.front();
  }
}

class SourceThings : public Tools {};

TEST_F(SourceThings, DeleteRemovesTheOneThatIsPointedAt) {
  run("source set 0 40 80");
  frame();
  move(seen(0.5, 0.5).x, seen(0.5, 0.5).y);
  frames(2);
  key(kKeyDelete);
  EXPECT_EQ(sent(), Texts{"source remove 1"});
}

TEST_F(SourceThings, DeleteDoesNothingBesideThem) {
  move(seen(0.3, 0.6).x, seen(0.3, 0.6).y);
  frames(2);
  key(kKeyDelete);
  EXPECT_EQ(sent(), Texts{});
}

TEST_F(SourceThings, AreChosenByAClickAndStayChosen) {
  run("source set 0 40");
  frame();
  click(seen(0.5, 0.5).x, seen(0.5, 0.5).y);
  EXPECT_EQ(sent(), Texts{}) << "there is a source already";
  move(seen(0.2, 0.7).x, seen(0.2, 0.7).y);
  frames(2);
  key(kKeyDelete);
  EXPECT_EQ(sent(), Texts{"source remove 1"});
}

TEST_F(SourceThings, AreFoundWhereTheSurfaceHidesThem) {
  run("source set 0 40");
  canvas_.front = SurfacePoint::in_face(0, {1, 0, 0});  // far from vertex 40: it is behind
  frame();
  move(seen(0.5, 0.5).x, seen(0.5, 0.5).y);
  frames(2);
  key(kKeyDelete);
  EXPECT_EQ(sent(), Texts{"source remove 1"});
}

TEST_F(SourceThings, ComeBackWhereOneClickReplacedSeveral) {
  run("source set 0 40 80");
  frame();
  EXPECT_EQ(click_sends(), "source set face");
  frames(2);
  click_item("Notices/bring back");
  EXPECT_EQ(sent(), Texts{"source set 0 40 80"});
  frames(2);
  EXPECT_FALSE(is_drawn("Notices/bring back"));
}

TEST_F(SourceThings, AreNotOfferedAgainAfterAnUndo) {
  run("source set 0 40 80");
  frame();
  EXPECT_EQ(click_sends(), "source set face");
  frames(2);
  EXPECT_TRUE(is_drawn("Notices/bring back"));
  run("undo");
  frames(2);
  EXPECT_FALSE(is_drawn("Notices/bring back"));
}

TEST_F(SourceThings, AreReplacedWithoutAWordWhereThereIsOne) {
  EXPECT_EQ(click_sends(), "source set face");
  frames(2);
  EXPECT_FALSE(is_drawn("Notices/bring back"));
}

TEST_F(SourceThings, ComeBackAfterTheMenuOfThePointReplacedThem) {
  run("source set 0 40 80");
  frame();
  click(seen(0.5, 0.75).x, seen(0.5, 0.75).y, 1);
  click_item("point menu/Source here");
  frames(2);
  EXPECT_TRUE(is_drawn("Notices/bring back"));
}

TEST_F(SourceThings, ComeBackAfterARowOfSeveralWasRemoved) {
  run("source set random:5:7");
  frame();
  click_item("Sources/remove 0");
  frames(2);
  EXPECT_TRUE(is_drawn("Notices/bring back"));
}

TEST_F(SourceThings, AreChosenInTheListAndDeleted) {
  run("source set 3 40");
  frames(2);
  sent();
  click_item("Sources/source 1");
  move(5, 5);
  key(kKeyDelete);
  frame();
  EXPECT_EQ(sent(), Texts{"source remove 1"});
}

/// A list of ImGui's numbers its vertices with 16 bits.
TEST_F(SourceThings, AreRingedWhileTheirListCanNumberTheRings) {
  const auto vertices = [] {
    int count = 0;
    const ImDrawData& drawn = *ImGui::GetDrawData();
    for (int i = 0; i < drawn.CmdListsCount; ++i) {
      count = std::max(count, drawn.CmdLists[i]->VtxBuffer.Size);
    }
    return count;
  };
  constexpr int kSide = 40;
  std::ofstream file(folder() / "large.obj");
  for (int i = 0; i < kSide * kSide; ++i) {
    file << "v " << double(i % kSide) / kSide << ' ' << double(i / kSide) / kSide << " 0\n";
  }
  for (int i = 1; i + kSide < kSide * kSide; ++i) {
    if (i % kSide == 0) continue;
    file << "f " << i << ' ' << i + 1 << ' ' << i + kSide << '\n';
    file << "f " << i + kSide + 1 << ' ' << i + kSide << ' ' << i + 1 << '\n';
  }
  file.close();
  run("open \"" + (folder() / "large.obj").string() + "\"");
  run("source set random:1500");
  frames(3);
  const int before = vertices();
  const ImVec2 name = middle_of("Sources/source 0");
  move(name.x, name.y);
  frames(2);
  EXPECT_GT(vertices(), before) << "there are rings";
  EXPECT_LT(vertices(), 1 << 16);
}

TEST_F(Tools, AreDrawnWhereOneListHasMoreVerticesThanIndicesCanNumber) {
  ImGui::NewFrame();
  ImDrawList& list = *ImGui::GetBackgroundDrawList();
  for (int i = 0; i < 20000; ++i) list.AddRectFilled({0, 0}, {9, 9}, IM_COL32_WHITE);
  ImGui::Render();
  EXPECT_GT(list.VtxBuffer.Size, 1 << 16);
  EXPECT_GT(list.CmdBuffer.back().VtxOffset, 0U);
}

using Said = Tools;

TEST_F(Said, WithTheRemedyOfAPoorAnswer) {
  run("source set 0");
  run("time-factor 3000");
  frames(3);
  const auto& error = session_.explored().a->error;
  ASSERT_TRUE(error && error->remedy);
  const auto remedies = settings_of(error->advice);
  ASSERT_FALSE(remedies.empty());
  const std::string change = remedies[0].name + ' ' + remedies[0].values.at(0);
  EXPECT_TRUE(is_drawn("Quality/" + change)) << change;
  click_item("Exact error/" + change);
  EXPECT_EQ(sent().back(), change);
  frames(3);
  EXPECT_FALSE(is_drawn("Exact error/" + change));
}

TEST_F(Said, WithTheRemedyOfAPoorB) {
  run("source set 0");
  run("time-factor 3000");
  run("keep");
  run("time-factor 1");
  run("show b");
  frames(3);
  const auto& error = session_.explored().b->error;
  ASSERT_TRUE(error && error->remedy);
  const auto remedies = settings_of(error->advice);
  const std::string change = remedies.at(0).name + ' ' + remedies[0].values.at(0);
  sent();
  click_item("Exact error/" + change);
  EXPECT_EQ(sent(), (Texts{"swap", "show a", change, "show a"})) << "A keeps its settings";
}

TEST_F(Said, HowNearANearExactMethodIs) {
  run("method wavefront");
  frames(3);
  click_item("Exact error/check auto");
  EXPECT_EQ(sent(), Texts{"check auto"});
  frames(3);
  EXPECT_TRUE(session_.explored().a->error->measured);
}

TEST_F(Said, AFailureStaysWhateverHappensToTheSources) {
  EXPECT_FALSE(session_.submit(app::command::Open{"/no/such.obj"}) && session_.failure().empty());
  frames(3);
  EXPECT_TRUE(is_drawn("Notices/close"));
  run("source clear");
  frames(3);
  EXPECT_TRUE(is_drawn("Notices/close"));
}

TEST_F(Said, WhichOfSeveralDroppedFilesIsOpened) {
  panels_->drop({session_.state().model, "/no/other.obj"});
  frames(2);
  EXPECT_TRUE(is_drawn("Notices/close"));
}

TEST(SourceNames, AreShort) {
  const auto name = [](const char* text) { return short_name(*app::parse_source(text)); };
  EXPECT_EQ(name("17"), "vertex 17");
  EXPECT_EQ(name("3,4,5"), "3 vertices");
  EXPECT_EQ(name("random:5:7"), "5 random");
  EXPECT_EQ(name("boundary"), "the whole boundary");
  EXPECT_EQ(name("face:12:0.123456789:0.2:0.676543211"), "point in face 12");
  EXPECT_EQ(name("curve:3,99,5"), "curve of 3 vertices");
  EXPECT_EQ(name("xyz:0.123456789:1:0"), "point 0.123, 1, 0");
}

TEST_F(Tools, SettingsThatFewPeopleChangeWaitUntilTheyAreAskedFor) {
  restart({});
  frames(2);
  EXPECT_TRUE(is_drawn("View/view"));
  EXPECT_TRUE(is_drawn("Solver/backend"));
  EXPECT_FALSE(is_drawn("Solver/precision"));
  EXPECT_FALSE(is_drawn("View/samples"));
  click_item("Solver/Advanced settings");
  frames(2);
  EXPECT_TRUE(is_drawn("Solver/precision"));
}

TEST_F(Tools, ChangesMadeWhileBIsShownAreSeen) {
  run("keep");
  run("backend cg");
  frame();
  const float place = middle_of("A and B/show a").y;
  run("show b");
  frame();
  EXPECT_EQ(middle_of("A and B/show a").y, place) << "buttons that flip stay under the pointer";
  sent();
  fill("Solver/time-factor", "2");
  EXPECT_EQ(sent(), (Texts{"time-factor 2", "show a"}));
  run("show b");
  frame();
  click_item("A and B/swap");
  EXPECT_EQ(sent(), (Texts{"swap", "show a"}));
}

TEST_F(Tools, FilesThatWereOpenedAreOfferedAgain) {
  const Texts recent = panels_->layout().recent;
  ASSERT_EQ(recent.size(), 1U);
  EXPECT_EQ(recent[0], (folder() / "square.obj").string());
  click_item("Menu/File");
  click_item("Menu/Open recent");
  frames(2);
  click_item("Menu/" + recent[0]);
  ASSERT_FALSE(sent().empty());
}

TEST_F(Tools, ErrorOverTheTimeFactorIsWorkedOutWhereItIsLookedAt) {
  run("variant classic");  // on a square straight lines make good what is too smooth
  EXPECT_TRUE(session_.error_study().points.empty());
  click_item("Solver/Error over m");
  frames(4);
  const auto& study = session_.error_study();
  ASSERT_GE(study.points.size(), 5U);
  EXPECT_FALSE(study.running);
  for (std::size_t i = 0; i < study.points.size(); ++i) {
    EXPECT_GT(study.points[i].mean_error, 0);
    EXPECT_TRUE(i == 0 || study.points[i].factor > study.points[i - 1].factor);
  }
  EXPECT_GT(study.points.back().mean_error, study.points.front().mean_error) << "much too smooth";
  sent();
  const Rect plot = *panels_->place_of_item("Solver/study plot");
  click(plot.x + plot.width - 8, plot.y + plot.height / 2);
  EXPECT_EQ(sent(), Texts{"time-factor 64"});
  frames(3);
  EXPECT_FALSE(session_.error_study().points.empty()) << "it is the same at any factor";
  run("source set 40");
  EXPECT_TRUE(session_.error_study().points.empty()) << "and another for other sources";
}

}  // namespace
}  // namespace geotherm::ui
