// SPDX-License-Identifier: MIT
#include "ui/source_edit.h"

#include <gtest/gtest.h>

#include <limits>

#include "tests/support/source_texts.h"

namespace geotherm::ui {
namespace {

/// Sources 5, random:2 (on 7 and 9) and a curve over 1 and 2.
app::Explored three_entries() {
  app::Explored explored;
  explored.sources = test::sources_in({"5", "random:2", "curve:1,2"});
  const auto place = [](int entry, Index vertex, bool alone) {
    return app::SourcePlace{entry, SurfacePoint::at_vertex(vertex), Vec3(vertex, 0, 0), alone};
  };
  explored.places = {place(0, 5, true), place(1, 7, false), place(1, 9, false), place(2, 1, false),
                     place(2, 2, false)};
  return explored;
}

TEST(SourceEdit, MakesSourcesWhoseTextsReadBackExactly) {
  const double third = 1.0 / 3, tiny = std::numeric_limits<double>::denorm_min();
  const app::SourceSpec point =
      source_at(SurfacePoint::in_face(12, {third, 1 - third - tiny, tiny}));
  const auto back = app::parse_source(app::to_text(point));
  ASSERT_TRUE(back);
  EXPECT_EQ(*back, point);
  EXPECT_EQ(app::to_text(source_at(SurfacePoint::at_vertex(7))), "7");
}

TEST(SourceEdit, PicksNoPointThatIsNotOnTheModel) {
  EXPECT_TRUE(surface_point({3, {1, 0, 0}}, 4));
  EXPECT_FALSE(surface_point({4, {1, 0, 0}}, 4));
}

TEST(SourceEdit, MovesPointsButNoCurves) {
  const auto explored = three_entries();
  EXPECT_TRUE(is_movable(explored, explored.places[0]));
  EXPECT_TRUE(is_movable(explored, explored.places[1]));
  EXPECT_FALSE(is_movable(explored, explored.places[3]));
}

TEST(SourceEdit, TakesApartOneEntryAndLeavesTheOthers) {
  const Apart apart = taken_apart(three_entries(), 2);
  EXPECT_EQ(apart.sources, test::sources_in({"5", "7", "9", "curve:1,2"}));
  EXPECT_EQ(apart.entry, 2);
}

TEST(SourceEdit, RemovesOnePlaceOfAnEntry) {
  const auto explored = three_entries();
  EXPECT_EQ(removal(explored, 0), app::Command(app::command::RemoveSource{0}));
  EXPECT_EQ(removal(explored, 1),
            app::Command(app::command::SetSources{test::sources_in({"5", "9", "curve:1,2"})}));
  EXPECT_EQ(removal(explored, 4), app::Command(app::command::RemoveSource{2}));
}

TEST(SourceEdit, RemovesTheLastPlaceByClearing) {
  app::Explored explored;
  explored.sources = test::sources_in({"random:1"});
  explored.places = {{0, SurfacePoint::at_vertex(4), Vec3::Zero(), false}};
  EXPECT_EQ(removal(explored, 0), app::Command(app::command::ClearSources{}));
}

TEST(SourceEdit, FindsTheNearestPlace) {
  EXPECT_EQ(nearest_place(three_entries(), Vec3(8.4, 0, 0)), 2U);
  EXPECT_FALSE(nearest_place(app::Explored{}, Vec3::Zero()));
}

TEST(SourceEdit, ShortensPointsOfLogsToThousandths) {
  const double third = 1.0 / 3;
  const app::FacePoint point = short_point(SurfacePoint::in_face(4, {third, third, third}));
  EXPECT_EQ(app::to_text(point), "face:4:0.333:0.333:0.334");
  EXPECT_EQ(app::to_text(short_point(SurfacePoint::in_face(4, {0.9996, 0.0004, 0}))),
            "face:4:1:0:0");
}

}  // namespace
}  // namespace geotherm::ui
