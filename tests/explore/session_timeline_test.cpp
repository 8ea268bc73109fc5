// SPDX-License-Identifier: MIT
// A surface that moves, frame by frame, in a session.
#include <gtest/gtest.h>

#include <numbers>

#include "app/session/script.h"
#include "geotherm/io.h"
#include "tests/explore/session_fixture.h"

namespace geotherm::app {
namespace {

/// Between methods that have taken something over and fresh ones: round-off alone.
constexpr double kSameOverTime = 1e-8;
constexpr int kFrames = 4;

class SessionTimeline : public SessionFixture {
 protected:
  /// Meshes in which a wave runs through the small model, frame_0.ply to frame_3.ply.
  std::string frames() {
    const auto read = read_mesh(small_model());
    EXPECT_TRUE(read);
    for (int k = 0; k < kFrames; ++k) {
      const auto moved = read->mesh.moved(waving(read->mesh, 2 * std::numbers::pi * k / kFrames));
      EXPECT_TRUE(write_mesh(frame(k), *moved));
    }
    return folder() + "frame_%d.ply";
  }
  std::string frame(int k) const { return folder() + "frame_" + std::to_string(k) + ".ply"; }

  std::vector<Vec3> positions() const {
    const auto all = session.explored().model->model.mesh->positions();
    return {all.begin(), all.end()};
  }
  const std::vector<double>& distances() const { return session.explored().a->result.distances; }
  void expect_near(const std::vector<double>& a, const std::vector<double>& b) const {
    ASSERT_EQ(a.size(), b.size());
    const double largest = session.explored().a->distance.max;
    for (std::size_t v = 0; v < a.size(); ++v) EXPECT_NEAR(a[v], b[v], kSameOverTime * largest);
  }
};

TEST_F(SessionTimeline, EachFrameHasThePositionsAndDistancesOfItsFile) {
  run({"open " + small_model(), "source set 5", "sequence " + frames()});
  EXPECT_EQ(session.explored().model->frames, kFrames);
  for (const int k : {2, 0, 3}) {
    run({"frame " + std::to_string(k)});
    const auto here = positions();
    const auto moved = distances();
    EXPECT_EQ(session.explored().a->model.name, "small (frame_" + std::to_string(k) + ".ply)");
    const auto file = read_mesh(frame(k));
    ASSERT_TRUE(file);
    EXPECT_TRUE(std::ranges::equal(here, file->mesh.positions()));
    Session fresh;
    for (const std::string& line : {"open " + frame(k), std::string("source set 5")}) {
      ASSERT_TRUE(fresh.submit(*parse_command(line)));
    }
    expect_near(moved, fresh.explored().a->result.distances);
  }
  run({"sequence none"});
  EXPECT_EQ(session.explored().model->frames, 0);
  EXPECT_EQ(session.explored().a->model.name, "small");
}

TEST_F(SessionTimeline, SourcesGoWithTheSurface) {
  run({"open " + small_model(), "source set xyz:0.1:0:0.1"});
  const SurfacePoint point = session.explored().places[0].point;
  run({"sequence " + frames(), "frame 1"});
  EXPECT_EQ(session.explored().places[0].point, point);
  const TriangleMesh& mesh = *session.explored().model->model.mesh;
  EXPECT_EQ(session.explored().places[0].position, position_at(mesh, point));
}

TEST_F(SessionTimeline, TargetsGoWithTheSurfaceAsSourcesDo) {
  run({"open " + small_model(), "source set 5", "target xyz:0.1:0:0.1"});
  const auto target = [this] {
    const auto& paths = session.explored().paths;
    EXPECT_FALSE(paths.empty());
    return paths.empty() ? SurfacePoint() : paths[0].path.points.back();
  };
  const SurfacePoint at_rest = target();
  for (const int k : {0, 1, 2}) {
    run({k == 0 ? "sequence " + frames() : "frame " + std::to_string(k)});
    EXPECT_EQ(target(), at_rest) << k;
  }
}

TEST_F(SessionTimeline, ALogKeepsTheLastOfTheFramesThatWerePlayedAndReplays) {
  run({"open " + small_model(), "source set 5", "sequence " + frames(), "loop off", "play on",
       "frame 1", "frame 2", "frame 3", "play off", "sculpt pull 0.3 0.5 face:100:0.2:0.3:0.5",
       "frame 2", "save log " + folder() + "l.geotherm",
       "save session " + folder() + "s.geotherm"});
  const auto bent = positions();
  const auto lines = read_script(folder() + "l.geotherm");
  ASSERT_TRUE(lines);
  std::vector<std::string> shown;
  for (const ScriptLine& line : *lines) {
    const std::string text = to_text(line.command);
    if (text.starts_with("frame ")) shown.push_back(text);
  }
  EXPECT_EQ(shown, (std::vector<std::string>{"frame 3", "frame 2"}));
  for (const char* file : {"l.geotherm", "s.geotherm"}) {
    Session replay;
    ASSERT_TRUE(replay.submit(command::Run{folder() + file})) << file;
    EXPECT_EQ(replay.state(), session.state()) << file;
    EXPECT_TRUE(std::ranges::equal(replay.explored().model->model.mesh->positions(), bent)) << file;
  }
}

TEST_F(SessionTimeline, StrokesLieOnTopOfEveryFrameAndUndoLeavesTheFrame) {
  run({"open " + small_model(), "source set 5", "sequence " + frames(), "frame 1"});
  const auto first = positions();
  run({"sculpt pull 0.3 0.5 face:100:0.2:0.3:0.5", "frame 2"});
  const auto bent = positions();
  EXPECT_EQ(session.explored().a->model.name, "small (frame_2.ply, sculpted)");
  run({"undo"});
  EXPECT_EQ(session.state().timeline.frame, 2);
  EXPECT_NE(positions(), bent);
  run({"frame 1"});
  EXPECT_EQ(positions(), first);
}

TEST_F(SessionTimeline, FramesThatDoNotShowLeaveTheOneThatDoes) {
  run({"open " + small_model(), "source set 5"});
  const std::string missing = "sequence " + folder() + "none_%d.ply";
  EXPECT_NE(refused(missing), "done: " + missing);
  EXPECT_FALSE(session.stale());
  run({"source set 6", "sequence " + frames(), "frame 1", "play on"});
  const auto first = positions();
  write(frame(2), "no mesh");
  for (const std::string& line : {std::string("frame 2"), std::string("frame 99"), missing}) {
    EXPECT_NE(refused(line), "done: " + line);
    EXPECT_EQ(session.state().timeline, (Timeline{folder() + "frame_%d.ply", 1})) << line;
    EXPECT_FALSE(session.stale()) << line;
    EXPECT_EQ(session.failure(), "") << line;
    EXPECT_EQ(positions(), first) << line;
  }
  run({"method exact"});
  EXPECT_EQ(session.explored().a->options.method, MethodKind::kExact);
  write(folder() + "log.geotherm", session.script());
  Session again;
  const auto ran = again.submit(command::Run{folder() + "log.geotherm"});
  ASSERT_TRUE(ran) << ran.error().message;
  EXPECT_EQ(again.state(), session.state());
}

TEST_F(SessionTimeline, SaysWhatIsWrongWithFrames) {
  EXPECT_NE(refused("sequence a.npy").find("open one first"), std::string::npos);
  run({"open " + small_model()});
  EXPECT_EQ(refused("frame 1"),
            "there are no frames; name those of a surface that moves: sequence FRAMES");
  EXPECT_NE(refused("play on").find("there are no frames"), std::string::npos);
  EXPECT_NE(refused("sequence " + folder() + "missing.npy").find("missing.npy"), std::string::npos);
  EXPECT_EQ(session.state().timeline, Timeline());
  run({"sequence " + frames()});
  EXPECT_EQ(refused("frame 4"), "there is no frame 4; frames are 0 to 3");
  EXPECT_EQ(session.state().timeline.frame, 0);
  EXPECT_NE(refused("frame -1").find("column 7"), std::string::npos);
  run({"frame 0"});
  EXPECT_FALSE(session.stale());
  run({"open " + small_model()});
  EXPECT_EQ(session.state().timeline, Timeline()) << "it belonged to the other model";
}

}  // namespace
}  // namespace geotherm::app
