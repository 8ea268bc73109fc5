// SPDX-License-Identifier: MIT
// Methods, the error of answers, nearest sources and paths, in a session.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>

#include "app/session/command.h"
#include "app/session/explored.h"
#include "app/session/session.h"
#include "geotherm/backend.h"
#include "tests/explore/session_fixture.h"

namespace geotherm::app {
namespace {

class SessionTruth : public SessionFixture {
 protected:
  /// From a vertex to vertex 60.
  double exact_distance(Index from) const {
    MethodOptions options;
    options.method = MethodKind::kExact;
    const auto method = build_method(session.explored().model->model.mesh, options);
    return (*method)->solve(SourceSet::of_vertices({from}))->distances[60];
  }

  PictureData shown() const {
    return picture_of(session.explored(), session.state().shown, session.state().picture.view);
  }
};

TEST_F(SessionTruth, MethodsAreSwitchedLiveAndShareTheModel) {
  run({"open " + small_model(), "source set 5"});
  for (const std::string& name : all_names<MethodKind>()) {
    run({"method " + name});
    ASSERT_TRUE(session.explored().a);
    EXPECT_EQ(to_text(session.explored().a->method->kind()), name);
    EXPECT_EQ(session.explored().a->result.distances[5], 0);
  }
}

TEST_F(SessionTruth, TheErrorFollowsTheTimeFactor) {
  run({"open " + small_model(), "source set 5"});
  ASSERT_TRUE(session.explored().a->error) << "nobody asked, and it is said";
  EXPECT_EQ(session.explored().a->error->reference, MethodKind::kExact) << "it has few faces";
  run({"check wavefront-fine"});
  EXPECT_EQ(session.explored().a->error->reference, MethodKind::kWavefrontFine);
  run({"check exact"});
  ASSERT_TRUE(session.explored().a->error);
  const double usual = session.explored().a->error->figures.mean_relative;
  run({"time-factor 100"});
  EXPECT_GT(session.explored().a->error->figures.mean_relative, 2 * usual);
  run({"method exact"});
  EXPECT_EQ(session.explored().a->error->figures.max, 0);
}

TEST_F(SessionTruth, AnAnswerIsCheckedWhenItRestsUnlessThatIsTurnedOff) {
  run({"open " + small_model(), "source set 5"});
  const auto lines = [&](const std::string& words) {
    return std::ranges::count_if(session.log(), [&](const LogLine& line) {
      return line.text.find(words) != std::string::npos;
    });
  };
  const auto solved = lines("solved with"), checked = lines("of the largest distance, at vertex");
  const std::size_t queries = session.queries().size();
  run({"source set 8"});
  EXPECT_EQ(lines("solved with"), solved + 1) << "the check is no second answer";
  EXPECT_EQ(session.queries().size(), queries + 1);
  EXPECT_EQ(lines("of the largest distance, at vertex"), checked + 1);
  session.set_dragging(true);
  run({"source set 6"});
  EXPECT_FALSE(session.explored().a->error) << "it moves";
  session.set_dragging(false);
  ASSERT_TRUE(session.finish());
  EXPECT_TRUE(session.explored().a->error);
  EXPECT_FALSE(session.stale());
  run({"check off", "source set 7"});
  EXPECT_FALSE(session.explored().a->error);
}

TEST_F(SessionTruth, APoorAnswerNamesASettingThatIsRight) {
  run({"open " + small_model(), "source set 5", "time-factor 3000"});
  const auto& error = session.explored().a->error;
  ASSERT_TRUE(error && error->is_poor());
  EXPECT_TRUE(error->remedy) << error->verdict;
}

TEST_F(SessionTruth, TheErrorBelongsToTheSources) {
  run({"open " + small_model(), "source set 5", "check exact", "source set 40"});
  EXPECT_EQ(session.explored().a->error->values[40], 0);
}

TEST_F(SessionTruth, TheViewOfTheErrorIsSignedAndAsksForIt) {
  run({"open " + small_model(), "source set 5", "view exact-error"});
  const PictureData data = shown();
  EXPECT_TRUE(data.is_signed);
  const double unit = session.explored().a->error->figures.max;
  EXPECT_DOUBLE_EQ(data.value_unit, unit);
  EXPECT_NE(data.value_title.find("exact"), std::string::npos);
}

TEST_F(SessionTruth, ViewsOfFacesHaveAValueForEachAndLeaveNoneBehind) {
  run({"open " + small_model(), "source clear", "view triangle-quality"});
  const std::size_t faces = shown().faces.size();
  EXPECT_EQ(shown().face_values.size(), faces) << "without a solve";
  EXPECT_EQ(shown().largest_face_value, 1);
  run({"view eikonal-error"});
  EXPECT_TRUE(shown().face_values.empty()) << "there are no distances yet";
  run({"source set 5"});
  EXPECT_EQ(shown().face_values.size(), faces);
  run({"view lost-gradients"});
  EXPECT_EQ(shown().face_values, std::vector<float>(faces, 0));
  run({"view contours"});
  EXPECT_TRUE(shown().face_values.empty());
}

TEST_F(SessionTruth, BothAnswersHaveTheirError) {
  run({"open " + small_model(), "source set 5", "check exact", "keep", "time-factor 50"});
  const Explored& explored = session.explored();
  ASSERT_TRUE(explored.a->error && explored.b->error);
  EXPECT_GT(explored.a->error->figures.mean_relative, explored.b->error->figures.mean_relative);
}

TEST_F(SessionTruth, RegionsAreNearestToTheirSources) {
  run({"open " + small_model(), "source set 5 40", "view regions"});
  const PictureData data = shown();
  ASSERT_EQ(data.nearest.size(), data.positions.size());
  EXPECT_EQ(data.nearest[5], 0);
  EXPECT_EQ(data.nearest[40], 1);
  run({"view contours"});
  EXPECT_EQ(session.explored().a->result.distances[5], 0);
}

TEST_F(SessionTruth, PathsLeadFromTheTargetToTheNearestSource) {
  run({"open " + small_model(), "source set 5 40", "target 60"});
  const Explored& explored = session.explored();
  ASSERT_EQ(explored.paths.size(), 3U) << session.failure();
  const double direct =
      (explored.model->model.mesh->positions()[60] -
       position_at(*explored.model->model.mesh, explored.paths[0].path.points.front()))
          .norm();
  for (const TargetPath& path : explored.paths) {
    const auto to_40 = exact_distance(40), to_5 = exact_distance(5);
    EXPECT_EQ(path.path.points.front().vertex, to_40 < to_5 ? 40 : 5) << "the nearer one";
    EXPECT_EQ(path.path.points.back().vertex, 60);
    EXPECT_GE(path.path.length, direct * (1 - 1e-12)) << "nothing is shorter than a straight line";
    EXPECT_GE(path.path.length, explored.paths[0].path.length * (1 - 1e-9))
        << "the geodesic is the shortest of the three";
  }
  EXPECT_EQ(shown().lines.size(), 3U);
  run({"target none"});
  EXPECT_TRUE(session.explored().paths.empty());
}

TEST_F(SessionTruth, SavedDistancesNameTheNearestSource) {
  run({"open " + small_model(), "source set 5 40", "save distances " + folder() + "d.ply",
       "save distances " + folder() + "d.csv"});
  const auto text = [&](const char* name) {
    std::ifstream file(folder() + name, std::ios::binary);
    return std::string(std::istreambuf_iterator<char>(file), {});
  };
  EXPECT_NE(text("d.ply").find("property int nearest_source"), std::string::npos);
  EXPECT_EQ(text("d.csv").find("nearest_source"), std::string::npos);
}

TEST_F(SessionTruth, PathsFindASourceInsideTheTargetsFace) {
  write(folder() + "square.obj", "v 0 0 0\nv 10 0 0\nv 10 10 0\nv 0 10 0\nf 1 2 3\nf 1 3 4\n");
  run({"open " + folder() + "square.obj", "source set face:0:0.34:0.33:0.33 1",
       "target face:0:0.3:0.4:0.3"});
  ASSERT_FALSE(session.explored().paths.empty());
  EXPECT_LT(session.explored().paths[0].path.length, 1) << "not the vertex, which is 4 away";
}

TEST_F(SessionTruth, AMethodIsNotCheckedAgainstALesserOne) {
  run({"open " + small_model(), "source set 5", "method exact", "check wavefront-fine"});
  EXPECT_EQ(session.explored().a->error->reference, MethodKind::kExact);
  EXPECT_TRUE(session.explored().a->error->values.empty());
  run({"method wavefront-fine"});
  EXPECT_TRUE(session.explored().a->error->values.empty());
  EXPECT_EQ(session.explored().a->error->verdict.find("most accurate method there is"),
            std::string::npos);
}

TEST_F(SessionTruth, AMethodWithoutHeatHasNoPathOfHeat) {
  run({"open " + small_model(), "source set 5", "method wavefront", "target 60"});
  EXPECT_EQ(session.explored().paths.size(), 2U);
}

TEST_F(SessionTruth, TheStateLeadsBackFromItsCommands) {
  run({"open " + small_model(), "method wavefront", "source set 5@0.25 40", "check exact",
       "target face:3:0.25:0.25:0.5", "view exact-error"});
  ViewerState again = initial_state();
  for (const Command& command : commands_to(session.state())) {
    again = *app::apply(again, *parse_command(to_text(command)));
  }
  EXPECT_EQ(again, session.state());
}

TEST_F(SessionTruth, OffsetsHoldTheDistanceBack) {
  run({"open " + small_model(), "method wavefront", "source set 5@0.001 40"});
  EXPECT_EQ(session.explored().a->result.distances[5], 0.001);
  const auto failed = session.submit(*parse_command("method heat"));
  ASSERT_FALSE(failed);
  EXPECT_NE(session.failure().find("offset"), std::string::npos);
}

TEST_F(SessionTruth, ComparesMethodsWithTheirErrors) {
  run({"open " + small_model(), "source set 5",
       "compare " + backend_names().front() + ",wavefront,exact"});
  const auto& rows = session.compare().rows;
  ASSERT_EQ(rows.size(), 3U);
  EXPECT_EQ(rows[1].name(), "wavefront");
  ASSERT_TRUE(rows[0].mean_error && rows[1].mean_error);
  EXPECT_LT(*rows[1].mean_error, *rows[0].mean_error);
  EXPECT_FALSE(rows[2].mean_error) << "there is nothing better to hold it against";
}

TEST_F(SessionTruth, DistanceUnderThePointerIsAtMostStraightToASourceInTheFace) {
  const std::string source = "face:100:0.25:0.25:0.5";
  run({"open " + small_model(), "method exact", "check off", "source set " + source, "keep"});
  const auto figures = [this](std::array<double, 3> weights) {
    return figures_at(session.explored(), Shown::kA, SurfacePoint::in_face(100, weights));
  };
  const Vec3 here = figures({0.25, 0.25, 0.5}).position;
  EXPECT_EQ(figures({0.25, 0.25, 0.5}).distance, 0);
  EXPECT_EQ(figures({0.25, 0.25, 0.5}).difference, 0);
  const PointFigures near = figures({0.25, 0.5, 0.25});
  EXPECT_NEAR(*near.distance, (near.position - here).norm(), 1e-12);
  const Index corner = session.explored().model->model.mesh->faces()[100][1];
  EXPECT_EQ(figures({0, 1, 0}).distance, session.explored().a->result.distances[corner]);

  run({"source set " + source + "@0.5"});
  EXPECT_NEAR(*figures({0.25, 0.25, 0.5}).distance, 0.5, 1e-12);
  run({"source set " + std::to_string(corner)});
  const double edge = (figures({1, 0, 0}).position - figures({0, 1, 0}).position).norm();
  EXPECT_NEAR(*figures({0.5, 0.5, 0}).distance, edge / 2, 1e-12);
  run({"source set curve:face:100:0.5:0.25:0.25,face:100:0.25:0.25:0.5"});
  EXPECT_NEAR(*figures({0.375, 0.25, 0.375}).distance, 0, 1e-12) << "on the curve";
}

TEST_F(SessionTruth, ColourScalesThatTheViewCannotHaveAreRefused) {
  run({"open " + small_model(), "source set 5", "view triangle-quality"});
  EXPECT_NE(refused("colour-scale log").find("choose view contours"), std::string::npos);
  run({"view contours"});
  EXPECT_NE(refused("colour-scale diverging").find("view exact-error"), std::string::npos);
  EXPECT_EQ(session.state().picture.colour_scale, ColourScale::kLinear);
  run({"colour-scale log", "view triangle-quality", "save session " + folder() + "s.geotherm"});
  Session again;
  ASSERT_TRUE(again.submit(command::Run{folder() + "s.geotherm"})) << "as it was left";
  EXPECT_EQ(again.state(), session.state());
  run({"view contours", "keep", "colour-scale diverging"});
}

}  // namespace
}  // namespace geotherm::app
