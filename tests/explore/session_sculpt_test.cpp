// SPDX-License-Identifier: MIT
// Strokes as commands of a session: replayed, undone, saved, solved on.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "app/session/script.h"
#include "bench/models/volumes.h"
#include "geotherm/io.h"
#include "tests/explore/session_fixture.h"
#include "tests/support/source_texts.h"

namespace geotherm::app {
namespace {

/// Between methods that have taken something over and fresh ones: round-off alone.
constexpr double kSameDistance = 1e-8;

class SessionSculpt : public SessionFixture {
 protected:
  static std::vector<Vec3> positions_of(const Session& of) {
    const auto all = of.explored().model->model.mesh->positions();
    return {all.begin(), all.end()};
  }
  std::vector<Vec3> positions() const { return positions_of(session); }

  /// A radius that holds some dozens of vertices.
  std::string radius() const {
    const MeshReport& mesh = *session.explored().model->mesh;
    return std::to_string(0.15 * (mesh.box_max - mesh.box_min).norm());
  }
  /// Two strokes as a hand makes them, touch by touch.
  void sculpt() {
    run({"sculpt pull " + radius() + " 0.5 face:100:0.2:0.3:0.5",
         "sculpt extend face:101:0.2:0.3:0.5", "sculpt extend face:104:0.2:0.3:0.5",
         "sculpt smooth " + radius() + " 0.5 face:300:0.5:0.25:0.25"});
  }
};

TEST_F(SessionSculpt, ALogHasALineForEachStrokeAndReplaysToTheSameBits) {
  run({"open " + small_model(), "source set 5"});
  const std::vector<Vec3> flat = positions();
  sculpt();
  run({"undo", "redo", "save log " + folder() + "l.geotherm",
       "save session " + folder() + "s.geotherm"});
  const std::vector<Vec3> bent = positions();
  EXPECT_NE(bent, flat);
  const auto lines = read_script(folder() + "l.geotherm");
  ASSERT_TRUE(lines);
  const auto strokes = std::ranges::count_if(
      *lines, [](const ScriptLine& line) { return to_text(line.command).starts_with("sculpt "); });
  EXPECT_EQ(strokes, 2);
  for (const char* file : {"l.geotherm", "s.geotherm"}) {
    Session replay;
    ASSERT_TRUE(replay.submit(command::Run{folder() + file})) << file;
    EXPECT_EQ(positions_of(replay), bent) << file;
    EXPECT_EQ(replay.state(), session.state()) << file;
  }
}

TEST_F(SessionSculpt, UndoTakesAStrokeBackAsAWholeToTheSameBits) {
  run({"open " + small_model(), "source set 5"});
  const std::vector<Vec3> flat = positions();
  const std::vector<double> before = session.explored().a->result.distances;
  run({"sculpt pull " + radius() + " 0.5 face:100:0.2:0.3:0.5",
       "sculpt extend face:101:0.2:0.3:0.5"});
  const std::vector<Vec3> bent = positions();
  EXPECT_NE(bent, flat);
  EXPECT_NE(session.explored().a->result.distances, before);
  run({"undo"});
  EXPECT_EQ(positions(), flat);
  run({"redo"});
  EXPECT_EQ(positions(), bent);
  run({"undo", "undo"});
  EXPECT_EQ(test::texts_of(session.state().sources), std::vector<std::string>{"random:1"});
}

TEST_F(SessionSculpt, LightStaysUnderTheHandAndIsFoundAnewAtRest) {
  const auto light = [this] {
    std::vector<float> out;
    for (const auto& at : session.explored().model->base->openness) {
      out.insert(out.end(), {at.front, at.back});
    }
    return out;
  };
  run({"open " + small_model(), "source set 5"});
  const std::vector<float> before = light();
  const auto flat = session.explored().model->base->positions;
  session.set_dragging(true);
  sculpt();
  EXPECT_NE(session.explored().model->base->positions, flat);
  EXPECT_EQ(light(), before);
  session.set_dragging(false);
  ASSERT_TRUE(session.finish());
  const std::vector<float> at_rest = light();
  EXPECT_NE(at_rest, before);
  // As bright as one that was opened in this shape.
  run({"save mesh " + folder() + "bent.ply", "open " + folder() + "bent.ply"});
  const std::vector<float> opened = light();
  ASSERT_EQ(opened.size(), at_rest.size());
  double apart = 0;
  for (std::size_t i = 0; i < opened.size(); ++i) apart += std::abs(opened[i] - at_rest[i]);
  EXPECT_LE(apart, 0.02 * static_cast<double>(opened.size()));  // its scene has another scale
}

TEST_F(SessionSculpt, DistancesAreThoseOfTheMeshThatIsWritten) {
  run({"open " + small_model(), "source set 5 face:200:0.2:0.3:0.5"});
  sculpt();
  const std::vector<double> here = session.explored().a->result.distances;
  run({"save mesh " + folder() + "bent.ply", "open " + folder() + "bent.ply",
       "source set 5 face:200:0.2:0.3:0.5"});
  const std::vector<double> fresh = session.explored().a->result.distances;
  ASSERT_EQ(here.size(), fresh.size());
  const double largest = session.explored().a->distance.max;
  for (std::size_t v = 0; v < here.size(); ++v) {
    EXPECT_NEAR(here[v], fresh[v], kSameDistance * largest) << v;
  }
  EXPECT_TRUE(session.state().sculpture.strokes.empty()) << "it belonged to the other model";
}

TEST_F(SessionSculpt, AllThatIsShownFollowsTheSurface) {
  run({"open " + small_model(), "source set face:100:0.2:0.3:0.5"});
  const Explored before = session.explored();
  sculpt();
  const Explored& after = session.explored();
  const TriangleMesh& mesh = *after.model->model.mesh;
  const SurfacePoint point = SurfacePoint::in_face(100, {0.2, 0.3, 0.5});
  EXPECT_EQ(after.places[0].position, position_at(mesh, point));
  EXPECT_NE(after.places[0].position, before.places[0].position);
  EXPECT_NE(after.model->base->positions, before.model->base->positions);
  EXPECT_EQ(after.model->base->model_per_scene, before.model->base->model_per_scene);
  EXPECT_NE(after.model->mesh->area, before.model->mesh->area);
  EXPECT_EQ(after.a->mesh.area, after.model->mesh->area);
  EXPECT_EQ(after.a->model.name, "small (sculpted)");
  // Where a ray meets the surface now.
  const Vec3 place = position_at(mesh, point), up(0, 1, 0);
  const auto hit = after.model->rays->first_hit(place + 1e-3 * up, -up);
  ASSERT_TRUE(hit);
  EXPECT_NEAR(hit->distance, 1e-3, 1e-9);
}

TEST_F(SessionSculpt, AnswersAreHeldAgainstWavesOnTheSculptedSurface) {
  run({"open " + small_model(), "source set 5", "check wavefront-fine"});
  sculpt();
  const AccuracyReport error = *session.explored().a->error;
  run({"save mesh " + folder() + "bent.ply", "open " + folder() + "bent.ply", "source set 5"});
  EXPECT_NEAR(error.figures.mean_relative, session.explored().a->error->figures.mean_relative,
              kSameDistance);
}

TEST_F(SessionSculpt, AAndBAreBothOnTheSculptedSurface) {
  run({"open " + small_model(), "source set 5", "time-factor 4", "keep", "time-factor 1"});
  sculpt();
  const auto difference = session.explored().difference->values;
  run({"save mesh " + folder() + "bent.ply", "open " + folder() + "bent.ply", "source set 5"});
  const double largest = session.explored().a->distance.max;
  for (std::size_t v = 0; v < difference.size(); ++v) {
    EXPECT_NEAR(difference[v], session.explored().difference->values[v], kSameDistance * largest);
  }
}

TEST_F(SessionSculpt, OpeningAndResettingForgetTheStrokes) {
  run({"open " + small_model()});
  const std::vector<Vec3> flat = positions();
  sculpt();
  run({"reset"});
  EXPECT_EQ(positions(), flat);
  sculpt();
  run({"open " + small_model()});
  EXPECT_EQ(positions(), flat);
}

TEST_F(SessionSculpt, SaysWhatCannotBeSculpted) {
  run({"open " + small_model()});
  EXPECT_EQ(refused("sculpt extend face:1:1:0:0"),
            "there is no stroke to extend; begin one with sculpt pull RADIUS STRENGTH POINT");
  EXPECT_NE(refused("sculpt pull 1 0.5 face:99999:1:0:0").find("no face 99999 to sculpt"),
            std::string::npos);
  run({"undo"});
  EXPECT_FALSE(session.stale());
  EXPECT_NE(refused("sculpt pull 0 0.5 face:1:1:0:0").find("column 13"), std::string::npos);
  EXPECT_NE(refused("sculpt pull 1 1.5 face:1:1:0:0").find("column 15"), std::string::npos);
  EXPECT_NE(refused("sculpt pull 1 1 17").find("expected a point in a face"), std::string::npos);
  EXPECT_NE(refused("sculpt pull 1 1 face:1:1:0:0@2").find("no offset"), std::string::npos);
  EXPECT_NE(refused("save mesh " + small_model()).find("is the model itself"), std::string::npos);
  EXPECT_NE(refused("save mesh " + folder() + "a.png").find(".obj"), std::string::npos);
}

TEST_F(SessionSculpt, AVolumeIsRefused) {
  ASSERT_TRUE(write_tets(folder() + "ball.mesh", *generate_volume("ball-tets", 2000)));
  run({"open " + folder() + "ball.mesh"});
  const auto done = session.submit(*parse_command("sculpt pull 1 0.5 face:1:1:0:0"));
  ASSERT_FALSE(done);
  EXPECT_NE(sentence(done.error()).find("strokes are of triangle meshes"), std::string::npos)
      << sentence(done.error());
}

}  // namespace
}  // namespace geotherm::app
