// SPDX-License-Identifier: MIT
#include <sstream>

#include "app/session/model.h"
#include "app/session/settings.h"
#include "bench/models/generate.h"
#include "geotherm/io.h"
#include "tests/ui/driver.h"
#include "ui/key_map.h"
#include "ui/source_edit.h"

namespace geotherm::ui {
namespace {

using Texts = std::vector<std::string>;

struct Click {
  const char* before;  ///< commands, one a line
  Texts items;         ///< clicked one after the other
  Texts commands;
};

class PanelClicks : public UiTest, public ::testing::WithParamInterface<Click> {};

TEST_P(PanelClicks, SendExactlyTheirCommand) {
  open_square();
  std::istringstream before(GetParam().before);
  for (std::string line; std::getline(before, line);) run(line);
  frames(2);
  for (const std::string& item : GetParam().items) click_item(item);
  EXPECT_EQ(sent(), GetParam().commands);
}

INSTANTIATE_TEST_SUITE_P(
    Sources, PanelClicks,
    ::testing::Values(Click{"", {"Sources/more"}, {"source more"}},
                      Click{"source set random:3", {"Sources/fewer"}, {"source fewer"}},
                      Click{"", {"Sources/shuffle"}, {"source shuffle"}},
                      Click{"", {"Sources/boundary"}, {"source set boundary"}},
                      Click{"", {"Sources/clear"}, {"source clear"}},
                      Click{"", {"Sources/set random"}, {"source set random:5"}},
                      Click{"source set 3 4 5", {"Sources/remove 1"}, {"source remove 1"}}));

INSTANTIATE_TEST_SUITE_P(
    Solver, PanelClicks,
    ::testing::Values(
        Click{"", {"Solver/backend", "Solver/backend=cg"}, {"backend cg"}},
        Click{"", {"Solver/method", "Solver/method=wavefront"}, {"method wavefront"}},
        Click{"",
              {"Solver/time-step", "Solver/time-step=mean-face-area"},
              {"time-step mean-face-area"}},
        Click{"", {"Solver/constraint", "Solver/constraint=penalty"}, {"constraint penalty:10"}},
        Click{"", {"Solver/constraint", "Solver/constraint=pin-vertex"}, {"constraint pin-vertex"}},
        Click{"", {"Solver/heat", "Solver/heat=hold"}, {"heat hold"}},
        Click{"", {"Solver/boundary", "Solver/boundary=average"}, {"boundary average"}},
        Click{"", {"Solver/laplacian", "Solver/laplacian=cotan"}, {"laplacian cotan"}},
        Click{"", {"Solver/variant", "Solver/variant=classic"}, {"variant classic"}},
        Click{"", {"Solver/precision", "Solver/precision=refined"}, {"precision refined"}},
        Click{"", {"Solver/backend", "Solver/backend=native"}, {}}));  // what it is already

INSTANTIATE_TEST_SUITE_P(
    AAndB, PanelClicks,
    ::testing::Values(Click{"", {"A and B/keep"}, {"keep"}},
                      Click{"keep", {"A and B/swap"}, {"swap"}},
                      Click{"keep", {"A and B/forget"}, {"forget"}},
                      Click{"keep\nbackend cg", {"A and B/show b"}, {"show b"}},
                      Click{"keep\nshow b", {"A and B/show a"}, {"show a"}},
                      Click{"keep", {"A and B/show difference"}, {"show difference"}}));
INSTANTIATE_TEST_SUITE_P(
    View, PanelClicks,
    ::testing::Values(
        Click{"", {"View/view", "View/view=smooth"}, {"view smooth"}},
        Click{"", {"View/colour-map", "View/colour-map=viridis"}, {"colour-map viridis"}},
        Click{"", {"View/light", "View/light=headlight"}, {"light headlight"}},
        Click{"", {"View/background", "View/background=dark"}, {"background dark"}},
        Click{"", {"View/samples", "View/samples=1"}, {"samples 1"}},
        Click{"", {"View/projection", "View/projection=orthographic"}, {"projection orthographic"}},
        Click{"", {"View/fit", "View/fit=tight"}, {"fit tight"}},
        Click{"", {"View/reverse"}, {"reverse on"}}, Click{"", {"View/bar"}, {"bar off"}},
        Click{"", {"View/caption"}, {"caption off"}}, Click{"", {"View/markers"}, {"markers off"}},
        Click{"", {"View/frame"}, {"camera frame"}},
        Click{"camera orbit 10 10", {"View/reset"}, {"camera frame", "camera place 30 20 1 0 0"}}));

INSTANTIATE_TEST_SUITE_P(
    ExactError, PanelClicks,
    ::testing::Values(Click{"", {"Exact error/check", "Exact error/check=auto"}, {"check auto"}},
                      Click{"check exact", {"Exact error/show"}, {"view exact-error"}},
                      Click{"", {"Menu/View", "Menu/Exact error"}, {"view exact-error"}},
                      Click{"", {"Menu/View", "Menu/Nearest sources"}, {"view regions"}}));

INSTANTIATE_TEST_SUITE_P(
    Others, PanelClicks,
    ::testing::Values(Click{"pick face:3:1:0:0", {"Point/forget"}, {"pick none"}},
                      Click{"source set 0,1", {"Sources/centre median"}, {"source centre median"}},
                      Click{"target 7", {"Point/forget paths"}, {"target none"}},
                      Click{"", {"Compare backends/run"}, {"compare all"}},
                      Click{"", {"Menu/Edit", "Menu/Clear sources"}, {"source clear"}},
                      Click{"", {"Menu/View", "Menu/Flat"}, {"view flat"}},
                      Click{"", {"Menu/Solve", "Menu/Keep as B"}, {"keep"}},
                      Click{"", {"Menu/File", "Menu/Quit"}, {"quit"}},
                      Click{"keep", {"Menu/Solve", "Menu/Flip A and B"}, {"flip"}}));

class Panels : public UiTest {};

TEST_F(Panels, TurnTheModel) {
  open_square();
  click_item("View/rotate");
  EXPECT_EQ(sent().at(0), "rotate on");
}

TEST_F(Panels, ShowEverySettingOfTheMethodAndThePicture) {
  open_square();
  click_item("View/Figure");
  for (const app::Setting& setting : app::settings()) {
    const std::string name(setting.name);
    if (name == "size") continue;  // in the dialog that saves a picture
    std::string in = setting.of_method() ? "Solver/" : "View/";
    if (name == "check") in = "Exact error/";
    const std::string item = name == "range" ? "range min" : name == "pan" ? "pan up" : name;
    EXPECT_TRUE(is_drawn(in + item)) << name;
  }
}

TEST_F(Panels, ShowASettingThatIsAddedToTheTable) {
  static std::string dial;
  dial = "1";
  const app::ExtraSetting extra({.name = "test-dial",
                                 .help = "for this test",
                                 .get = [](const app::ViewerState&) { return dial; },
                                 .set =
                                     [](app::ViewerState&, const std::string& text) {
                                       dial = text;
                                       return Result<void>();
                                     }});
  open_square();
  ASSERT_TRUE(is_drawn("Solver/test-dial"));
  click_item("Solver/test-dial");
  type("4");
  click_item("Quality/");
  EXPECT_EQ(sent(), Texts{"test-dial 4"});
}

TEST_F(Panels, SliderMovesTheTimeFactorThroughItsDecades) {
  open_square();
  const ImVec2 at = middle_of("Solver/time-factor slider");
  drag(at, {at.x + 20, at.y});
  const Texts texts = sent();
  ASSERT_FALSE(texts.empty());
  for (const std::string& text : texts) EXPECT_EQ(text.rfind("time-factor ", 0), 0U) << text;
  EXPECT_GT(session_.state().options.time_step.factor, 3);
  EXPECT_LT(session_.state().options.time_step.factor, 1000);
}

TEST_F(Panels, SlidersMoveTheSliceAndThePeel) {
  open_square();
  run("slice x");
  run("peel below:0.5");
  frame();
  for (const std::string name : {"slice-at ", "peel below:"}) {
    const bool slice = name == "slice-at ";
    const ImVec2 at = middle_of(slice ? "View/slice-at slider" : "View/peel-at slider");
    drag(at, {at.x + 15, at.y});
    for (const std::string& text : sent()) EXPECT_EQ(text.rfind(name, 0), 0U) << text;
    const auto& picture = session_.state().picture;
    EXPECT_GT(slice ? picture.slice_at : picture.peel.share, 0.5);
  }
}

TEST_F(Panels, AbsoluteTimeBeginsWithTheOneThatHolds) {
  open_square();
  const double t =
      app::time_on_mesh(session_.state().options.time_step, *session_.explored().model->mesh);
  click_item("Solver/time-step");
  click_item("Solver/time-step=absolute");
  ASSERT_EQ(session_.state().options.time_step.rule, TimeRule::kAbsolute);
  EXPECT_NEAR(session_.state().options.time_step.absolute, t, 1e-3 * t);
}

TEST_F(Panels, CompareLeavesOutWhatIsNotTicked) {
  open_square();
  click_item("Compare backends/with cg");
  click_item("Compare backends/run");
  const Texts texts = sent();
  ASSERT_EQ(texts.size(), 1U);
  EXPECT_EQ(texts[0].find("cg"), std::string::npos);
  EXPECT_EQ(texts[0].rfind("compare ", 0), 0U);
  frames(2);
  EXPECT_GE(session_.compare().rows.size(), 1U);
}

TEST_F(Panels, OfferModelsWhereNoneIsOpen) {
  frame();
  for (const app::BundledModel& model : app::bundled_models()) {
    EXPECT_TRUE(is_drawn("Hint/" + std::string(model.name)));
  }
  click_item("Hint/bunny");
  EXPECT_EQ(sent(), Texts{"open bunny"});
  frame();
  EXPECT_FALSE(is_drawn("Hint/bunny"));
  EXPECT_TRUE(session_.explored().model);
}

TEST_F(Panels, TellAFailureOverThePicture) {
  open_square();
  panels_->drop({"/no/such/file.obj"});
  frames(3);
  ASSERT_TRUE(is_drawn("Notices/close"));
  EXPECT_TRUE(session_.explored().model);  // what was shown stays
  click_item("Notices/log");
  EXPECT_TRUE(panels_->layout().log);
  EXPECT_FALSE(is_drawn("Notices/close"));
}

TEST_F(Panels, AFailureThatIsMendedIsSaidNoLonger) {
  open_square();
  EXPECT_FALSE(session_.submit(*app::parse_command("source set 99999")));
  frames(3);
  EXPECT_TRUE(is_drawn("Notices/close"));
  run("undo");
  frames(1);
  EXPECT_FALSE(is_drawn("Notices/close"));
}

TEST_F(Panels, SayBelowATitleWhichOfAAndBIsShown) {
  open_square();
  run("keep");
  frame();
  const auto top = [this] { return panels_->place_of_item("Picture/shown")->y; };
  const float usual = top();
  canvas_.title = 60;
  frame();
  EXPECT_LT(usual, panels_->canvas().y + 60);
  EXPECT_GE(top(), panels_->canvas().y + 60);
}

TEST_F(Panels, OfferWhatMayHelpAfterAFailure) {
  open_square();
  for (const char* line :
       {"source set 0", "strict on", "backend eigen-ldlt", "memory-limit 1e-6"}) {
    (void)session_.submit(*app::parse_command(line));
  }
  frames(3);
  click_item("Notices/backend cg");
  frames(3);
  EXPECT_EQ(session_.state().options.backend, "cg");
  EXPECT_EQ(session_.failure(), "");
}

TEST_F(Panels, WorkWithTheLightThemeAndLargerLetters) {
  open_square();
  click_item("Menu/View");
  click_item("Menu/Light theme");
  EXPECT_EQ(panels_->layout().theme, Theme::kLight);
  click_item("Menu/View");
  click_item("Menu/Size of letters");
  frames(30);
  click_item("Menu/150 %");
  EXPECT_EQ(panels_->layout().scale, 1.5F);
  panels_->set_scale(1.5F);
  frames(2);
  EXPECT_EQ(panels_->scale(), 1.5F);
  EXPECT_EQ(sent(), Texts{});
}

app::SessionHooks in_the_background() {
  app::SessionHooks hooks;
  hooks.wake = [] {};
  return hooks;
}

/// Can be seen at work.
class BusyPanels : public UiTest {
 protected:
  BusyPanels() : UiTest(in_the_background()) {}
  void SetUp() override {
    // So large that reading takes longer than this test needs.
    const auto path = folder() / "large.ply";
    ASSERT_TRUE(write_mesh(path.string(), *generate_model("cube", 2'000'000)));
    run("open \"" + path.string() + "\"");
    ASSERT_TRUE(session_.work().busy);
    frames(2);
    ASSERT_TRUE(session_.work().busy);
  }
};

TEST_F(BusyPanels, CancelOverTheEmptyPicture) {
  ASSERT_TRUE(is_drawn("Reading/cancel"));
  const ImVec2 at = middle_of("Reading/cancel");
  move(at.x, at.y);
  press();
  release();
  EXPECT_TRUE(last_.cancel);
  (void)session_.finish();
  frame();
  EXPECT_FALSE(session_.work().busy);
  EXPECT_FALSE(session_.explored().model);
}

TEST_F(BusyPanels, CancelInTheSolverSection) {
  ASSERT_TRUE(is_drawn("Solver/cancel"));
  const ImVec2 at = middle_of("Solver/cancel");
  move(at.x, at.y);
  press();
  release();
  EXPECT_TRUE(last_.cancel);
}

TEST_F(BusyPanels, CancelWithEscape) {
  ImGui::GetIO().KeysDown[kKeyEscape] = true;
  frame();
  EXPECT_TRUE(last_.cancel);
  EXPECT_EQ(sent(), Texts{});
}

TEST_F(Panels, SleepWhereNothingHappens) {
  open_square();
  frames(6);
  EXPECT_FALSE(frame().animating);
  type("2");
  EXPECT_TRUE(last_.animating);
}

class ErrorPanel : public UiTest {};

TEST_F(ErrorPanel, GoesToTheWorstVertex) {
  open_square();
  run("check exact");
  frames(2);
  ASSERT_TRUE(is_drawn("Exact error/plot"));
  click_item("Exact error/worst");
  ASSERT_TRUE(session_.state().picked);
  const app::FacePoint& point = *session_.state().picked;
  const Index worst = session_.explored().a->error->figures.worst;
  const Face& face = session_.explored().model->model.mesh->faces()[point.face];
  const auto corner = std::ranges::max_element(point.weights) - point.weights.begin();
  EXPECT_EQ(face[static_cast<std::size_t>(corner)], worst);
}

class MethodPanel : public UiTest {};

TEST_F(MethodPanel, HidesWhatAnotherMethodDoesNotHave) {
  open_square();
  frames(2);
  EXPECT_TRUE(is_drawn("Solver/constraint"));
  run("method wavefront");
  frames(2);
  EXPECT_FALSE(is_drawn("Solver/constraint"));
  EXPECT_FALSE(is_drawn("Solver/backend"));
  EXPECT_TRUE(is_drawn("Solver/method"));
}

}  // namespace
}  // namespace geotherm::ui
