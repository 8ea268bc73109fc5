// SPDX-License-Identifier: MIT
// What a session does to the mesh before it solves: refining, welding, other formats.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "app/session/explorer.h"
#include "tests/explore/session_fixture.h"

namespace geotherm::app {
namespace {

class SessionMesh : public SessionFixture {
 protected:
  /// Two unit squares whose common side is cracked by a thousandth.
  std::string cracked(const std::string& name) const {
    write(folder() + name,
          "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 1.001 0 0\nv 2 0 0\nv 2 1 0\nv 1.001 1 0\n"
          "f 1 2 3\nf 1 3 4\nf 5 6 7\nf 5 7 8\n");
    return folder() + name;
  }

  const DistanceResult& shown() const { return session.explored().a->result; }
};

TEST_F(SessionMesh, RefiningLessensTheErrorAtTheSameVertices) {
  run({"open " + small_model(), "source set 5", "check exact"});
  for (const char* method : {"heat", "fast-marching"}) {
    run({std::string("method ") + method, "refine 0"});
    const double coarse = session.explored().a->error->figures.mean_relative;
    run({"keep", "refine 2", "show difference"});
    EXPECT_LT(session.explored().a->error->figures.mean_relative, 0.8 * coarse) << method;
    EXPECT_EQ(shown().distances.size(), session.explored().b->result.distances.size());
    EXPECT_GT(session.explored().difference->most, 0);
    run({"forget"});
  }
}

TEST_F(SessionMesh, ARefinedMethodDoesNotServeForTheMeshItself) {
  run({"open " + small_model(), "source set 5"});
  for (const char* method : {"wavefront", "heat"}) {
    run({std::string("method ") + method});
    const std::vector<double> plain = shown().distances;
    run({"refine 1"});
    EXPECT_NE(shown().distances, plain) << method;
    run({"refine 0"});
    EXPECT_EQ(shown().distances, plain) << method;
  }
}

TEST_F(SessionMesh, DistancesEndWhereTheyAreTold) {
  run({"open " + small_model(), "source set 5", "max-distance 0.3"});
  EXPECT_FALSE(session.explored().a->error) << "parts would be held against all of it";
  run({"max-distance none", "method wavefront"});
  const std::vector<double> all = shown().distances;
  run({"max-distance 0.3"});
  for (std::size_t v = 0; v < all.size(); ++v) {
    EXPECT_EQ(shown().distances[v], all[v] <= 0.3 ? all[v] : kUnreached) << v;
  }
  const auto again = commands_to(session.state());
  EXPECT_EQ(std::ranges::count(again, Command(command::MaxDistance{0.3})), 1);
  run({"undo"});
  EXPECT_EQ(shown().distances, all);
  EXPECT_NE(refused("max-distance 0").find("no length above 0"), std::string::npos);
}

TEST_F(SessionMesh, TheCentreOfSourcesIsShownWithItsWays) {
  write(folder() + "square.obj",  // the mean of its corners is the middle, whatever the diagonal
        "v 0 0 0\nv 2 0 0\nv 2 2 0\nv 0 2 0\nf 1 2 3\nf 1 3 4\n");
  run({"open " + folder() + "square.obj", "source set 0,1,2,3", "check on", "source centre mean"});
  ASSERT_TRUE(session.explored().centre);
  const geotherm::Centre& centre = session.explored().centre->centres.found.front();
  const Vec3 at = position_at(*session.explored().model->model.mesh, centre.point);
  EXPECT_LT((at - Vec3(1, 1, 0)).norm(), 1e-6);
  EXPECT_NEAR(centre.energy, 2, 1e-6);
  EXPECT_TRUE(session.explored().a->error) << "it is checked all the same";
  const PictureData data = picture_of(session.explored(), Shown::kA, View::kContours);
  EXPECT_EQ(std::ranges::count(data.lines, "mean", &PictureData::Line::name), 4);
  const auto again = commands_to(session.state());
  EXPECT_EQ(std::ranges::count(again, Command(command::ShowCentre{CentreKind::kMean})), 1);
  run({"source add boundary"});
  EXPECT_FALSE(session.explored().centre);
  EXPECT_NE(session.explored().centre_failure->message.find("curves"), std::string::npos);
  run({"undo", "undo"});
  EXPECT_FALSE(session.state().centre);
  EXPECT_FALSE(session.explored().centre);
}

TEST_F(SessionMesh, WhatAFileHoldsIsShownInPlaceOfDistances) {
  run({"open " + small_model(), "source set 5", "save distances " + folder() + "d.npy"});
  const PictureData before = picture_of(session.explored(), Shown::kA, View::kContours);
  run({"source set 17", "field " + folder() + "d.npy"});
  const PictureData data = picture_of(session.explored(), Shown::kA, View::kContours);
  EXPECT_TRUE(data.is_field);
  EXPECT_EQ(data.values, before.values);
  EXPECT_TRUE(data.sources.empty());
  run({"field none"});
  EXPECT_FALSE(picture_of(session.explored(), Shown::kA, View::kContours).is_field);
  write(folder() + "other.npy", "no array");
  EXPECT_NE(refused("field " + folder() + "other.npy").find("other.npy"), std::string::npos);
}

TEST_F(SessionMesh, ErrorsOfFacesGoWhenAFileIsShown) {
  run({"open " + small_model(), "source set 5", "save distances " + folder() + "d.npy"});
  PictureData data = picture_of(session.explored(), Shown::kA, View::kEikonalError);
  ASSERT_FALSE(data.face_values.empty());
  run({"field " + folder() + "d.npy"});
  set_explored(data, session.explored(), Shown::kA, View::kEikonalError);  // as a window does
  EXPECT_TRUE(data.is_field);
  EXPECT_TRUE(data.face_values.empty());
}

TEST_F(SessionMesh, ScriptsFindWhatTheyShowBesideThem) {
  write(folder() + "values.txt", "1\n");
  write(folder() + "shows.geotherm", "open " + small_model() + "\nfield values.txt\n");
  const auto ran = session.submit(command::Run{folder() + "shows.geotherm"});
  ASSERT_FALSE(ran);  // of the wrong size, and therefore read
  EXPECT_EQ(ran.error().message.find("No such file"), std::string::npos) << ran.error().message;
  EXPECT_NE(ran.error().message.find(folder() + "values.txt"), std::string::npos)
      << ran.error().message;
}

TEST_F(SessionMesh, WeldingReadsTheModelAgainAndIsUndone) {
  run({"open " + cracked("a.obj"), "source set 0"});
  EXPECT_TRUE(std::isinf(shown().distances[6]));
  run({"weld 0.002"});
  EXPECT_TRUE(std::isfinite(shown().distances[6]));
  EXPECT_EQ(shown().distances[4], shown().distances[1]);
  run({"undo"});
  EXPECT_TRUE(std::isinf(shown().distances[6]));
  run({"redo", "open " + small_model()});
  EXPECT_EQ(session.state().reading, ModelReading()) << "it belonged to the other model";
}

TEST_F(SessionMesh, ASavedSessionHoldsHowTheModelIsRead) {
  const std::string saved = folder() + "s.geotherm";
  std::vector<Command> commands;
  for (const std::string& line : {"open " + cracked("a.txt"), std::string("format obj"),
                                  std::string("weld 0.002"), std::string("source set 0")}) {
    commands.push_back(*parse_command(line));
  }
  const auto done = session.submit_all(commands);
  ASSERT_TRUE(done) << done.error().message;
  run({"save session " + saved, "open " + small_model(), "run " + saved});
  EXPECT_EQ(session.state().reading.format, "obj");
  EXPECT_TRUE(std::isfinite(shown().distances[6]));
}

TEST_F(SessionMesh, SaysWhyAModelCannotBeReadSo) {
  run({"open " + cracked("b.obj"), "source set 0"});
  const auto done = session.submit(*parse_command("weld 9"));
  ASSERT_FALSE(done);
  EXPECT_NE(sentence(done.error()).find("every face collapses"), std::string::npos);
  run({"undo"});
  EXPECT_EQ(shown().distances[0], 0);
  EXPECT_FALSE(session.submit(*parse_command("open -")));
}

/// What an explorer hands out of a model before it is done, and what it ends with.
struct HandedOut {
  std::vector<Explored> early;
  Result<Explored> last;
};

HandedOut handed_out(const std::string& model, const char* source, const Pose& pose = {}) {
  ExploreRequest request;
  request.pose = pose;
  request.model = model;
  request.sources = {*parse_source(source)};
  Explorer explorer;
  std::vector<Explored> early;
  auto last = explorer.explore(request, {}, [&](Explored part) { early.push_back(part); });
  return {std::move(early), std::move(last)};
}

TEST_F(SessionMesh, NeitherThePictureNorDistancesWaitForLight) {
  const auto [early, last] = handed_out(small_model(), "5");
  ASSERT_TRUE(last);
  ASSERT_EQ(early.size(), 2U);
  EXPECT_FALSE(early[0].a) << "the picture comes first,";
  EXPECT_TRUE(early[1].a && !early[1].shown) << "then there are distances";
  for (const Explored& part : early) {
    EXPECT_TRUE(part.model->base->openness.empty());
    EXPECT_FALSE(part.model->mesh) << "what is said of the mesh comes after them";
  }
  EXPECT_TRUE(last->model->mesh);
  EXPECT_EQ(last->a, early[1].a);
  EXPECT_TRUE(last->shown && last->model->rays);
  const PictureData whole = picture_of(*last->model->model.mesh);
  ASSERT_EQ(last->model->base->openness.size(), whole.openness.size());
  for (std::size_t v = 0; v < whole.openness.size(); ++v) {
    EXPECT_EQ(last->model->base->openness[v].front, whole.openness[v].front);
  }
}

TEST_F(SessionMesh, AModelWhoseSourcesAreNotFoundIsLitAndCanBePickedOn) {
  const auto [early, last] = handed_out(small_model(), "999999");
  ASSERT_FALSE(last);
  ASSERT_FALSE(early.empty());
  EXPECT_FALSE(early.back().model->base->openness.empty());
  EXPECT_TRUE(early.back().model->rays);
  run({"open " + small_model()});
  const auto opens = [](const LogLine& line) { return line.text.starts_with("opened "); };
  EXPECT_EQ(std::ranges::count_if(session.log(), opens), 1) << "whatever comes of it later";
}

TEST_F(SessionMesh, AModelWhoseFramesAreMissingIsDescribedAndCanBePickedOn) {
  const auto [early, last] = handed_out(small_model(), "5", {folder() + "none*.ply", 0, {}});
  ASSERT_FALSE(last);
  ASSERT_EQ(early.size(), 2U);
  EXPECT_FALSE(early[0].model->mesh);
  EXPECT_TRUE(early[1].model->mesh && early[1].model->rays);
  EXPECT_EQ(early[1].model->model.mesh, early[0].model->model.mesh);
}

TEST_F(SessionMesh, WhatIsWrongWithAModelIsSaidOnce) {
  run({"open " + cracked("c.obj"), "source set 0", "source set 1", "method wavefront"});
  ASSERT_TRUE(session.explored().model->mesh);
  ASSERT_FALSE(session.explored().model->warnings.empty());
  for (const Warning& warning : session.explored().model->warnings) {
    const auto says = [&](const LogLine& line) { return line.text.find(warning.message) == 0; };
    EXPECT_EQ(std::ranges::count_if(session.log(), says), 1) << warning.message;
  }
}

}  // namespace
}  // namespace geotherm::app
