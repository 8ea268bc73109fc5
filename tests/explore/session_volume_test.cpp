// SPDX-License-Identifier: MIT
// Sessions on a volume: what is cut open, sources inside, the diffusion time.
#include <gtest/gtest.h>

#include "app/picture/cut_picture.h"
#include "bench/models/volumes.h"
#include "tests/explore/session_fixture.h"

namespace geotherm::app {
namespace {

class SessionInVolume : public SessionFixture {
 protected:
  SessionInVolume() {
    EXPECT_TRUE(write_tets(folder() + "ball.mesh", *generate_volume("ball-tets", 2000)));
    run({"open " + folder() + "ball.mesh", "check off"});
  }

  PictureData picture() const {
    return picture_of(session.explored(), session.state().shown, session.state().picture.view);
  }
};

TEST_F(SessionInVolume, AReplayedLogCutsTheSamePicture) {
  run({"source set 0", "slice 1:0:2", "slice-at 0.3", "peel above:0.25", "slice-at 0.375"});
  const CutPicture cut = cut_picture(picture(), session.state().picture);
  EXPECT_FALSE(cut.data.faces.empty());

  const std::string log = folder() + "log.geotherm", saved = folder() + "saved.geotherm";
  run({"save session " + saved});
  write(log, session.script());
  for (const std::string& script : {log, saved}) {
    SessionHooks hooks;
    hooks.writes_files = false;
    Session again(std::move(hooks));
    ASSERT_TRUE(again.submit(command::Run{script}));
    EXPECT_EQ(again.state().picture, session.state().picture);
    const PictureData data =
        picture_of(again.explored(), again.state().shown, again.state().picture.view);
    const CutPicture same = cut_picture(data, again.state().picture);
    EXPECT_EQ(same.data.positions, cut.data.positions);
    EXPECT_EQ(same.data.values, cut.data.values);
    EXPECT_EQ(same.origin, cut.origin);
  }
}

TEST_F(SessionInVolume, ASliceThatIsDraggedIsTakenBackAsAWholeAndSolvesNothing) {
  run({"source set 0", "slice y"});
  const auto before = session.explored().version;
  run({"slice-at 0.4", "slice-at 0.3", "slice-at 0.2"});
  EXPECT_EQ(session.explored().version, before);
  EXPECT_EQ(session.script().find("slice-at 0.4"), std::string::npos);
  run({"undo"});
  EXPECT_EQ(session.state().picture.slice_at, 0.5);
  EXPECT_TRUE(session.state().picture.slice);
}

TEST_F(SessionInVolume, ASourceInsideATetHasAPlaceThatCanBeMoved) {
  run({"source set 3 xyz:0.1:0.2:0.3"});
  const Explored& explored = session.explored();
  ASSERT_EQ(explored.set.cell_points.size(), 1U);
  ASSERT_EQ(explored.places.size(), 2U);
  EXPECT_EQ(explored.places[1].entry, 1);
  EXPECT_TRUE(explored.places[1].alone);
  EXPECT_LT((explored.places[1].position - Vec3(0.1, 0.2, 0.3)).norm(), 1e-12);
  EXPECT_EQ(picture().sources.size(), 2U);
}

TEST_F(SessionInVolume, TheTimeThatSettingsMeanIsThatOfTheTetsNotOfTheBorder) {
  run({"source set 0"});
  for (const char* settings :
       {"time-factor 4", "time-step mean-face-area", "time-step absolute:0.01"}) {
    // Before it is solved, by the answer that there is.
    const auto now = *app::apply(session.state(), *parse_command(settings));
    const HeatMethod before = *session.explored().a->method->heat();
    const auto forecast = time_in_space(now.options.time_step, &before);
    run({settings});
    const double used = session.explored().a->method->heat()->t();
    EXPECT_NEAR(forecast.value_or(used), used, 1e-9 * used) << settings;
    const auto known = time_in_space(now.options.time_step, session.explored().a->method->heat());
    ASSERT_TRUE(known) << settings;
    EXPECT_NEAR(*known, used, 1e-9 * used) << settings;
    const bool forecasts = now.options.time_step.rule != TimeRule::kMeanFaceArea;
    EXPECT_EQ(forecast.has_value(), forecasts) << settings;
  }
  EXPECT_FALSE(time_in_space(TimeStep(), nullptr));
}

}  // namespace
}  // namespace geotherm::app
