// SPDX-License-Identifier: MIT
// A session that does its work at once, as scripts use it.
#include "app/session/session.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>

#include "app/session/explored.h"
#include "app/session/state.h"
#include "geotherm/heat_method.h"
#include "tests/explore/session_fixture.h"
#include "tests/support/source_texts.h"

namespace geotherm::app {
namespace {

class SessionTest : public SessionFixture {};

TEST_F(SessionTest, AnOpenModelHasDistancesFromOneSource) {
  run({"open " + small_model()});
  ASSERT_TRUE(session.explored().a);
  EXPECT_FALSE(session.stale());
  EXPECT_EQ(session.explored().places.size(), 1U);
  EXPECT_GT(session.explored().a->distance.max, 0);
}

TEST_F(SessionTest, ASourceIsTheExactPoint) {
  run({"open " + small_model(), "source set face:10:0.2:0.3:0.5"});
  const Explored& explored = session.explored();
  const SurfacePoint point = SurfacePoint::in_face(10, {0.2, 0.3, 0.5});
  ASSERT_EQ(explored.places.size(), 1U);
  EXPECT_TRUE(explored.places[0].alone);
  const Vec3 place = position_at(*explored.model->model.mesh, point);
  EXPECT_EQ((explored.places[0].position - place).norm(), 0);
}

TEST_F(SessionTest, AFailureLeavesWhatIsShownAndGoesToTheLog) {
  run({"open " + small_model(), "source set 5"});
  const double largest = session.explored().a->distance.max;
  const auto failed = session.submit(*parse_command("source set 99999999"));
  ASSERT_FALSE(failed);
  EXPECT_NE(session.failure().find("there is no vertex 99999999"), std::string::npos);
  EXPECT_TRUE(session.stale());
  EXPECT_EQ(session.explored().a->distance.max, largest);
  EXPECT_EQ(session.log().back().kind, LogLine::Kind::kError);
  run({"undo"});
  EXPECT_FALSE(session.stale());
  EXPECT_EQ(session.failure(), "");
}

TEST_F(SessionTest, AModelThatDoesNotOpenLeavesTheOneThatIs) {
  run({"open " + small_model(), "source set 5"});
  ASSERT_FALSE(session.submit(command::Open{folder() + "none.obj"}));
  EXPECT_EQ(session.state().model, small_model());
  EXPECT_EQ(test::texts_of(session.state().sources), std::vector<std::string>{"5"});
  EXPECT_FALSE(session.stale());
  run({"source set 6"});
  EXPECT_EQ(test::texts_of(session.explored().sources), std::vector<std::string>{"6"});
}

TEST_F(SessionTest, OpeningAgainReadsTheFileAnew) {
  const std::string path = folder() + "changing.obj";
  write(path, "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  run({"open " + path});
  EXPECT_EQ(session.explored().model->mesh->faces, 1);
  write(path, "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nf 1 2 3\nf 2 4 3\n");
  run({"open " + path});
  EXPECT_EQ(session.explored().model->mesh->faces, 2);
}

TEST_F(SessionTest, AAndBAreSolvedOnTheSameSourcesAndSubtracted) {
  run({"open " + small_model(), "source set 5", "time-factor 1", "keep", "time-factor 30"});
  const Explored& explored = session.explored();
  ASSERT_TRUE(explored.a && explored.b && explored.difference);
  EXPECT_EQ(explored.a->options.time_step.factor, 30);
  EXPECT_EQ(explored.b->options.time_step.factor, 1);
  double most = 0, sum = 0;
  for (std::size_t i = 0; i < explored.difference->values.size(); ++i) {
    const double d = explored.a->result.distances[i] - explored.b->result.distances[i];
    EXPECT_EQ(explored.difference->values[i], d);
    most = std::max(most, std::abs(d));
    sum += std::abs(d);
  }
  EXPECT_EQ(explored.difference->most, most);
  EXPECT_DOUBLE_EQ(explored.difference->mean,
                   sum / static_cast<double>(explored.difference->values.size()));
  EXPECT_GT(most, 0);
}

TEST_F(SessionTest, ThePictureOfADifferenceHasBothSigns) {
  run({"open " + small_model(), "source set 5", "keep", "time-factor 30", "show difference"});
  const PictureData data =
      picture_of(session.explored(), session.state().shown, session.state().picture.view);
  EXPECT_TRUE(data.is_signed);
  const auto [low, high] = std::minmax_element(data.values.begin(), data.values.end());
  EXPECT_LT(*low, 0);
  EXPECT_LE(*high, 1);
  const double unit = session.explored().difference->most;
  EXPECT_DOUBLE_EQ(data.value_unit, unit);
}

TEST_F(SessionTest, ABackendThatTakesOverIsNamedAndTheLogSaysWhy) {
  run({"open " + small_model(), "source set 5", "backend eigen-ldlt", "memory-limit 0.01"});
  EXPECT_EQ(session.explored().a->options.backend, "eigen-ldlt");
  EXPECT_EQ(session.explored().a->result.backend, "cg");
  const auto said = [this](LogLine::Kind kind, const std::string& text) {
    return std::ranges::any_of(session.log(), [&](const LogLine& line) {
      return line.kind == kind && sentence(line.text, line.hint).find(text) != std::string::npos;
    });
  };
  EXPECT_TRUE(said(LogLine::Kind::kNote, "solved with cg"));
  EXPECT_TRUE(said(LogLine::Kind::kWarning, "eigen-ldlt failed: needs about"));
  ASSERT_FALSE(session.submit(*parse_command("strict on")));
  const std::vector<SettingHint> settings = settings_of(session.log().back().hint);
  EXPECT_EQ(std::ranges::count(settings, SettingHint{"backend", {"cg"}}), 1);
  EXPECT_NE(session.failure().find("backend cg"), std::string::npos) << session.failure();
  EXPECT_EQ(session.failure().find("--"), std::string::npos) << session.failure();
  run({"undo", "memory-limit free"});
  EXPECT_EQ(session.explored().a->result.backend, "eigen-ldlt");
}

TEST_F(SessionTest, SettingsAloneFactorWhatTheyMustAndNoMore) {
  run({"open " + small_model(), "source set 5"});
  const double operators = session.explored().a->setup.operators;
  run({"time-factor 2"});
  EXPECT_EQ(session.explored().a->setup.operators, operators) << "taken over";
  EXPECT_EQ(session.explored().a->method->timing().operators, 0);
  run({"source set 6"});
  EXPECT_EQ(session.explored().a->setup.operators, operators);
}

TEST_F(SessionTest, MethodsThatAreStillAskedForAreNotMadeAnew) {
  run({"open " + small_model(), "source set 5", "keep", "time-factor 2"});
  const auto a = session.explored().a->method, b = session.explored().b->method;
  EXPECT_NE(a, b);
  run({"source set 6"});
  EXPECT_EQ(session.explored().a->method, a);
  EXPECT_EQ(session.explored().b->method, b);
  run({"swap"});
  EXPECT_EQ(session.explored().a->method, b);
  EXPECT_EQ(session.explored().b->method, a);
  run({"forget"});
  EXPECT_EQ(session.explored().a->method, b);
}

TEST_F(SessionTest, UndoTakesBackADragAsAWhole) {
  run({"open " + small_model(), "source set 5 9", "source move 0 6", "source move 0 7",
       "source move 0 8", "undo"});
  EXPECT_EQ(test::texts_of(session.state().sources), (std::vector<std::string>{"5", "9"}));
  run({"redo"});
  EXPECT_EQ(test::texts_of(session.state().sources), (std::vector<std::string>{"8", "9"}));
}

TEST_F(SessionTest, UndoTakesBackABrushStrokeAsAWhole) {
  run({"open " + small_model(), "source set 5", "source add curve:1", "source extend 2",
       "source extend 3", "undo"});
  EXPECT_EQ(test::texts_of(session.state().sources), std::vector<std::string>{"5"});
}

TEST_F(SessionTest, UndoLeavesTheCameraAlone) {
  run({"open " + small_model(), "view flat", "camera orbit 50 0", "undo"});
  EXPECT_EQ(session.state().picture.view, View::kContours);
  EXPECT_EQ(session.state().picture.camera.azimuth, 80);
}

TEST_F(SessionTest, UndoOfNothingSaysSo) {
  EXPECT_FALSE(session.submit(command::Undo{}));
  EXPECT_FALSE(session.submit(command::Redo{}));
}

TEST_F(SessionTest, TheScriptLeadsToTheSameStateAndTheSameAnswer) {
  run({"open " + small_model(), "source set random:3:5", "camera orbit 12.3 4", "camera zoom 1.1",
       "camera orbit 0.1 0.2", "time-factor 2", "time-factor 3", "time-factor 4", "keep",
       "backend eigen-ldlt", "source move 0 17", "source move 0 18", "source add curve:1",
       "source extend 2", "source extend 3", "undo", "view flat", "view contours", "show b"});
  Session again;
  const std::string path = folder() + "again.geotherm";
  write(path, session.script());
  const auto ran = again.submit(command::Run{path});
  ASSERT_TRUE(ran) << ran.error().message;
  EXPECT_EQ(again.state(), session.state());
  EXPECT_EQ(again.explored().b->result.distances, session.explored().b->result.distances);
}

TEST_F(SessionTest, TheScriptHoldsOneLineForADragOfTheCamera) {
  run({"camera orbit 1 1", "camera orbit 1 1", "camera zoom 1.5 0.1 0.1", "camera pan 0.1 0"});
  const std::string script = session.script();
  EXPECT_EQ(std::ranges::count(script, '\n'), 1) << script;
  EXPECT_EQ(script.find("camera place "), 0U) << script;
}

TEST_F(SessionTest, ASavedSessionLeadsToTheSameState) {
  run({"open " + small_model(), "source set 5 boundary", "time-factor 2", "keep",
       "constraint pseudo-inverse", "view smooth", "camera orbit 10 10", "source set 5",
       "save session " + folder() + "s.geotherm"});
  Session again;
  ASSERT_TRUE(again.submit(command::Run{folder() + "s.geotherm"}));
  EXPECT_EQ(again.state(), session.state());
}

TEST_F(SessionTest, ASavedSessionLeadsThereFromAnyState) {
  run({"open " + small_model(), "source set 5", "save session " + folder() + "s.geotherm"});
  const ViewerState saved = session.state();
  run({"view flat", "backend eigen-ldlt", "keep", "background dark", "camera orbit 5 5",
       "source set 9 10", "run " + folder() + "s.geotherm"});
  EXPECT_EQ(session.state(), saved);
}

TEST_F(SessionTest, ASessionFindsTheModelThatLiesBesideIt) {
  const std::string name = std::filesystem::path(small_model()).filename().string();
  write(folder() + "s.geotherm", "open " + name + "\nsource set 5\n");
  run({"run " + folder() + "s.geotherm"});
  EXPECT_EQ(session.state().model, folder() + name);
}

TEST_F(SessionTest, AWindowKeepsItsSizeAndLettersWhenItRunsASession) {
  SessionHooks hooks;
  hooks.seen = [] {
    PictureSettings seen;
    seen.width = 640;
    seen.height = 480;
    return seen;
  };
  Session window(hooks);
  ASSERT_TRUE(window.submit(command::Open{small_model()}));
  ASSERT_TRUE(window.submit(command::SaveSession{folder() + "s.geotherm"}));
  const ViewerState saved = window.state();
  ASSERT_TRUE(window.submit(command::Run{folder() + "s.geotherm"}));
  EXPECT_EQ(window.state(), saved);
  run({"run " + folder() + "s.geotherm"});
  EXPECT_EQ(session.state().picture.width, 640) << "without a window, as it was seen";
}

TEST_F(SessionTest, ALogWithAModelThatDidNotOpenReplays) {
  run({"open " + small_model(), "source set 5", "view smooth"});
  EXPECT_FALSE(session.submit(command::Open{folder() + "none.obj"}));
  EXPECT_TRUE(session.can_undo()) << "what was done before can still be taken back";
  run({"view flat"});
  write(folder() + "log.geotherm", session.script());
  Session again;
  const auto ran = again.submit(command::Run{folder() + "log.geotherm"});
  ASSERT_TRUE(ran) << ran.error().message;
  EXPECT_EQ(again.state(), session.state());
}

TEST_F(SessionTest, ADragBackToWhereItBeganIsNothingToUndo) {
  run({"open " + small_model(), "view flat", "time-factor 2", "time-factor 1", "undo"});
  EXPECT_EQ(session.state().picture.view, View::kContours);
  write(folder() + "log.geotherm", session.script());
  Session again;
  ASSERT_TRUE(again.submit(command::Run{folder() + "log.geotherm"}));
  EXPECT_EQ(again.state(), session.state());
}

TEST_F(SessionTest, ABThatFailsLeavesTheGoodA) {
  run({"open bunny", "source set 5", "constraint pin-vertex:1500", "keep",
       "constraint pin-sources"});
  EXPECT_TRUE(session.explored().b);
  EXPECT_FALSE(session.submit(command::Open{small_model()}));  // has no vertex 1500
  EXPECT_EQ(session.failure().find("B: "), 0U) << session.failure();
  EXPECT_TRUE(session.explored().a);
  EXPECT_FALSE(session.explored().b);
  EXPECT_EQ(session.state().model, small_model());
}

TEST_F(SessionTest, SwappingAAndBFactorsNothing) {
  run({"open " + small_model(), "source set 5", "keep", "time-factor 3"});
  const Answer a = *session.explored().a;
  const Answer b = *session.explored().b;
  run({"swap"});
  EXPECT_EQ(session.explored().a->setup_ms, b.setup_ms) << "the same factors, not new ones";
  EXPECT_EQ(session.explored().b->setup_ms, a.setup_ms);
  EXPECT_EQ(session.explored().a->result.distances, b.result.distances);
}

TEST_F(SessionTest, SourcesTogetherAreThoseOfTheirEntries) {
  run({"open " + small_model(), "source set 5 boundary curve:40,60 5"});
  const std::size_t places = session.explored().places.size();
  const SourceSet first = session.explored().set;
  run({"source add 90", "source remove 4"});
  EXPECT_EQ(session.explored().places.size(), places);
  EXPECT_EQ(session.explored().set.edges, first.edges);
  EXPECT_EQ(session.explored().set.points.size(), first.points.size());
}

TEST_F(SessionTest, ScriptsSayTheirLineAndStopWhereTheyFail) {
  const std::string path = folder() + "bad.geotherm";
  write(path,
        "open " + small_model() + "\nsource set 99999999\nsave log " + folder() + "x.geotherm\n");
  const auto ran = session.submit(command::Run{path});
  ASSERT_FALSE(ran);
  EXPECT_NE(sentence(ran.error()).find("bad.geotherm: line 2: source 99999999: there is no vertex"),
            std::string::npos)
      << sentence(ran.error());
  write(path, "view flat\nview smooth\nredo\n");
  const auto undone = session.submit(command::Run{path});
  ASSERT_FALSE(undone);
  EXPECT_NE(sentence(undone.error()).find("bad.geotherm: line 3: "), std::string::npos)
      << undone.error().message;
}

TEST_F(SessionTest, ScriptsThatRunEachOtherEnd) {
  const std::string path = folder() + "circle.geotherm";
  write(path, "run " + path + "\n");
  const auto ran = session.submit(command::Run{path});
  ASSERT_FALSE(ran);
  EXPECT_NE(sentence(ran.error()).find("run each other"), std::string::npos);
}

TEST_F(SessionTest, WithoutWritingSaysWhatItLeavesOut) {
  SessionHooks hooks;
  hooks.writes_files = false;
  Session quiet(std::move(hooks));
  ASSERT_TRUE(quiet.submit(command::Open{small_model()}));
  ASSERT_TRUE(quiet.submit(command::SaveLog{folder() + "never.geotherm"}));
  EXPECT_FALSE(std::ifstream(folder() + "never.geotherm").is_open());
  EXPECT_NE(quiet.log().back().text.find("not written: save log"), std::string::npos);
}

TEST_F(SessionTest, SavesDistancesOfWhatIsShown) {
  run({"open " + small_model(), "source set 5", "keep", "time-factor 20",
       "save distances " + folder() + "a.csv", "show b", "save distances " + folder() + "b.csv",
       "show difference", "save distances " + folder() + "d.csv"});
  const auto second = [](const std::string& path, int line) {
    std::ifstream file(path);
    std::string text;
    for (int i = 0; i <= line; ++i) std::getline(file, text);
    return std::stod(text.substr(text.find(',') + 1));
  };
  const double a = second(folder() + "a.csv", 40);
  const double b = second(folder() + "b.csv", 40);
  EXPECT_NE(a, b);
  EXPECT_EQ(second(folder() + "d.csv", 40), a - b);
}

TEST_F(SessionTest, NothingIsWrittenOverTheModel) {
  run({"open " + small_model(), "source set 5"});
  const auto saved = session.submit(command::SaveDistances{small_model()});
  ASSERT_FALSE(saved);
  EXPECT_NE(sentence(saved.error()).find("the model itself"), std::string::npos);
}

TEST_F(SessionTest, FiguresOfAPointAreThoseOfItsCorners) {
  run({"open " + small_model(), "source set 5", "pick face:10:0:1:0"});
  const Explored& explored = session.explored();
  const Index corner = explored.model->model.mesh->faces()[10][1];
  const PointFigures figures =
      figures_at(explored, Shown::kA, SurfacePoint::in_face(10, {0, 1, 0}));
  EXPECT_EQ(figures.nearest_vertex, corner);
  EXPECT_EQ(figures.distance, explored.a->result.distances[corner]);
  ASSERT_TRUE(figures.heat) << "picking asks for u";
  EXPECT_EQ(figures.heat, explored.a->result.heat[corner]);
  run({"keep", "time-factor 30"});
  const PointFigures both = figures_at(explored, Shown::kA, SurfacePoint::in_face(10, {0, 1, 0}));
  EXPECT_EQ(value_shown(both, Shown::kA), explored.a->result.distances[corner]);
  EXPECT_EQ(value_shown(both, Shown::kDifference), explored.difference->values[corner]);
}

TEST_F(SessionTest, ComparesBackendsOnTheModelThatIsOpen) {
  run({"open " + small_model(), "source set 5", "compare all"});
  const SessionCompare& compare = session.compare();
  ASSERT_GE(compare.rows.size(), 2U);
  for (const CompareRow& row : compare.rows) {
    EXPECT_EQ(row.status, "ok") << row.note.message;
    EXPECT_LT(row.max_difference.value_or(1), 1e-3);
  }
}

TEST_F(SessionTest, AnUnknownColourMapIsRefusedWithTheListOfMaps) {
  SessionHooks hooks;
  hooks.colour_maps = {"red-blue", "viridis"};
  Session with_maps(std::move(hooks));
  const auto set = with_maps.submit(command::Set{"colour-map", "mauve"});
  ASSERT_FALSE(set);
  EXPECT_NE(sentence(set.error()).find("viridis"), std::string::npos);
}

TEST(DiffusionTime, IsWhatTheMethodUses) {
  for (const char* rule : {"mean-edge", "mean-face-area", "absolute:0.01"}) {
    Session session;
    ASSERT_TRUE(session.submit(command::Set{"time-step", rule}));
    ASSERT_TRUE(session.submit(command::Open{"bunny"}));
    const HeatMethod& method = *session.explored().a->method->heat();
    const double t = time_on_mesh(method.options().time_step, *session.explored().model->mesh);
    EXPECT_NEAR(t, method.t(), 1e-12 * method.t()) << rule;
  }
}

}  // namespace
}  // namespace geotherm::app
