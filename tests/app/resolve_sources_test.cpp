// SPDX-License-Identifier: MIT
#include "app/session/sources.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <set>

#include "app/session/surface_curve.h"
#include "geotherm/path.h"
#include "tests/support/shapes.h"

namespace geotherm::test {
namespace {

using namespace geotherm::app;

/// A 4 x 4 grid of unit squares, then a vertex in no face.
TriangleMesh grid() {
  Draft draft = plane_grid(4, 4, 4, 4);
  draft.add(Vec3(9, 9, 9));
  return *finish(std::move(draft));
}
constexpr Index kLoose = 25;

Result<ResolvedSources> resolve(const TriangleMesh& mesh, const std::vector<std::string>& texts) {
  std::vector<Source> sources;
  for (const std::string& text : texts) {
    sources.push_back({*parse_source(text), "-s " + text, ErrorCode::kBadInput});
  }
  return resolve_sources(sources, mesh);
}

ResolvedSources curve(const TriangleMesh& mesh, std::vector<Index> vertices) {
  VertexCurve curve{std::move(vertices), {}};
  for (std::size_t i = 0; i < curve.vertices.size(); ++i) {
    curve.lines.push_back(static_cast<int>(i) + 1);
  }
  const Source source{curve, "c.txt", ErrorCode::kBadFile};
  return *resolve_sources({&source, 1}, mesh);
}

TEST(Sources, AreOneSetWithoutRepetition) {
  const auto resolved = resolve(grid(), {"3,7", "7", "3", "face:0:1:0:0"});
  ASSERT_TRUE(resolved);
  EXPECT_EQ(vertices_of(resolved->set).size(), 3U);
  EXPECT_EQ(resolved->set.points.size(), 3U);
}

TEST(Sources, AtRandomAreDifferentVerticesInFacesTheSameForASeed) {
  const TriangleMesh mesh = grid();
  const auto some = *random_vertices(mesh, 10, 4);
  EXPECT_EQ(std::set<Index>(some.begin(), some.end()).size(), 10U);
  EXPECT_EQ(some, *random_vertices(mesh, 10, 4));
  EXPECT_NE(some, *random_vertices(mesh, 10, 5));
  const auto all = *random_vertices(mesh, 25, 1);
  EXPECT_EQ(std::set<Index>(all.begin(), all.end()).size(), 25U);
  EXPECT_FALSE(std::set<Index>(all.begin(), all.end()).contains(kLoose));
  EXPECT_FALSE(random_vertices(mesh, 26, 1));
}

TEST(Sources, AtRandomAreTheVerticesThatSplitmix64Chooses) {
  // By hand from the definition: the first value of seed 1 is 0x910a2dec89025cc1; modulo 25, 11.
  EXPECT_EQ(*random_vertices(grid(), 1, 1), std::vector<Index>{0x910a2dec89025cc1U % 25});
}

TEST(Sources, OnTheBoundaryAreItsEdges) {
  const auto resolved = resolve(grid(), {"boundary"});
  ASSERT_TRUE(resolved);
  EXPECT_EQ(resolved->set.edges.size(), 16U);
  EXPECT_EQ(vertices_of(resolved->set).size(), 16U);
  const auto closed = resolve(*finish(sphere(1)), {"boundary"});
  ASSERT_FALSE(closed);
  EXPECT_NE(sentence(closed.error()).find("no boundary (each of its 120 edges"), std::string::npos);
}

TEST(Sources, InSpaceAreTheClosestPointsAndFarOnesAreMentioned) {
  const auto near = resolve(grid(), {"xyz:1.2:1.3:0.001"});
  ASSERT_TRUE(near);
  EXPECT_TRUE(near->warnings.empty());
  ASSERT_EQ(near->set.points.size(), 1U);
  EXPECT_FALSE(near->set.points[0].is_vertex());
  const auto far = resolve(grid(), {"xyz:-3:-4:0"});
  ASSERT_TRUE(far);
  EXPECT_EQ(vertices_of(far->set), std::vector<Index>{0});
  ASSERT_EQ(far->warnings.size(), 1U);
  EXPECT_NE(far->warnings[0].message.find("5 away"), std::string::npos) << far->warnings[0].message;
}

TEST(Sources, InSpaceAreTheSameTogetherAndOneByOne) {
  const TriangleMesh mesh = *finish(torus(24, 12, 0.4));
  std::vector<Source> sources;
  for (int i = 0; i < 40; ++i) {
    const Vec3 place(std::sin(3.0 * i), std::cos(5.0 * i), std::sin(7.0 * i));
    sources.push_back({SpacePoint{place}, "place", ErrorCode::kBadInput});
  }
  const auto together = resolve_each(sources, mesh);
  ASSERT_TRUE(together);
  for (std::size_t i = 0; i < sources.size(); ++i) {
    EXPECT_EQ(together->sets[i], resolve_sources({&sources[i], 1}, mesh)->set) << i;
  }
}

TEST(Sources, InSpaceAreCancelledByTheirProgress) {
  const Source place{SpacePoint{Vec3(1, 1, 1)}, "place", ErrorCode::kBadFile};
  const Progress stop = [](std::string_view, double) { return false; };
  const auto one = resolve_sources({&place, 1}, grid(), stop);
  ASSERT_FALSE(one);
  EXPECT_EQ(one.error().code, ErrorCode::kCancelled);
  const std::vector<Source> many(20, place);
  int asked = 0;  // the tree over many faces asks, too
  const auto later = resolve_each(many, *finish(sphere(4)),
                                  [&](std::string_view, double) { return ++asked == 1; });
  ASSERT_FALSE(later);
  EXPECT_EQ(later.error().code, ErrorCode::kCancelled);
}

TEST(Sources, AlongACurveAreItsEdges) {
  const TriangleMesh mesh = grid();
  const ResolvedSources line = curve(mesh, {0, 1, 2, 2, 7});
  EXPECT_EQ(line.set.edges, (std::vector<std::array<Index, 2>>{{0, 1}, {1, 2}, {2, 7}}));
  EXPECT_TRUE(line.warnings.empty());
  const ResolvedSources point = curve(mesh, {4});
  EXPECT_EQ(vertices_of(point.set), std::vector<Index>{4});
  EXPECT_TRUE(point.set.edges.empty());
}

TEST(Sources, AlongACurveWithGapsAreJoinedAndThatIsSaid) {
  const ResolvedSources line = curve(grid(), {0, 1, 4});
  EXPECT_EQ(line.set.edges, (std::vector<std::array<Index, 2>>{{0, 1}, {1, 2}, {2, 3}, {3, 4}}));
  ASSERT_EQ(line.warnings.size(), 1U);
  EXPECT_NE(line.warnings[0].message.find("c.txt: 1 of 2 steps"), std::string::npos)
      << line.warnings[0].message;
  EXPECT_NE(line.warnings[0].message.find("vertex 1 to 4, line 3"), std::string::npos);
}

TEST(Sources, AlongACurveOfTextWithGapsAreJoinedAndThatIsSaid) {
  const auto line = resolve(grid(), {"curve:0,1,4"});
  ASSERT_TRUE(line);
  EXPECT_EQ(line->set.edges, (std::vector<std::array<Index, 2>>{{0, 1}, {1, 2}, {2, 3}, {3, 4}}));
  ASSERT_EQ(line->warnings.size(), 1U);
  EXPECT_EQ(
      line->warnings[0].message,
      "-s curve:0,1,4: 1 of 2 steps of the curve is no mesh edge and became the shortest path "
      "along edges (vertex 1 to 4, number 3 of the curve)");
  const auto edges = resolve(grid(), {"curve:0,1,2"});
  ASSERT_TRUE(edges);
  EXPECT_TRUE(edges->warnings.empty());
  const auto point = resolve(grid(), {"curve:4"});
  ASSERT_TRUE(point);
  EXPECT_EQ(vertices_of(point->set), std::vector<Index>{4});
  EXPECT_TRUE(point->set.edges.empty());
}

TEST(Sources, AlongACurveAcrossFacesAreStraightBetweenItsPoints) {
  const TriangleMesh mesh = grid();
  const Index last = mesh.face_count() - 1;
  const auto line =
      resolve(mesh, {"curve:face:0:0.3:0.4:0.3,face:" + std::to_string(last) + ":0.3:0.4:0.3"});
  ASSERT_TRUE(line) << sentence(line.error());
  const auto at = [&](Index face, const std::array<double, 3>& weights) {
    return position_at(mesh, SurfacePoint::in_face(face, weights));
  };
  const Vec3 from = at(0, {0.3, 0.4, 0.3}), to = at(last, {0.3, 0.4, 0.3});
  double length = 0;
  Vec3 end = from;
  for (const FaceSegment& segment : line->set.segments) {
    EXPECT_LT((at(segment.face, segment.from) - end).norm(), 1e-12);
    end = at(segment.face, segment.to);
    length += (end - at(segment.face, segment.from)).norm();
  }
  EXPECT_LT((end - to).norm(), 1e-12);
  EXPECT_NEAR(length, (to - from).norm(), 1e-9);
  EXPECT_TRUE(line->set.points.empty());

  const auto two = resolve(mesh, {"curve:face:0:1:0:0,face:0:0:1:0", "curve:face:3:0.5:0.5:0"});
  ASSERT_TRUE(two);
  EXPECT_EQ(two->set.segments.size(), 1U);
  EXPECT_EQ(two->set.points.size(), 1U) << "a curve of one point";
}

TEST(Sources, AlongACurveThatGoesOnAreThoseOfTheWholeCurve) {
  const auto mesh = std::make_shared<const TriangleMesh>(grid());
  const auto at = [](Index face) { return SurfacePoint::in_face(face, {0.3, 0.4, 0.3}); };
  const std::vector<SurfacePoint> all = {at(0), at(5), at(14), at(3)};
  const auto whole = CurveJoiner(mesh).join(all);
  ASSERT_TRUE(whole);
  ASSERT_GT(whole->size(), 3U);
  CurveJoiner joiner(mesh);
  EXPECT_TRUE(joiner.join({at(9), at(2)}));
  for (const std::size_t count : {1, 2, 4, 3, 4}) {  // one that is taken back among them
    const auto part = joiner.join({all.begin(), all.begin() + static_cast<std::ptrdiff_t>(count)});
    ASSERT_TRUE(part);
    ASSERT_LE(part->size(), whole->size());
    EXPECT_EQ(part->size() == whole->size(), count == all.size());
    for (std::size_t k = 0; k < part->size(); ++k) {
      EXPECT_EQ((*part)[k].face, (*whole)[k].face);
      EXPECT_EQ((*part)[k].from, (*whole)[k].from);
      EXPECT_EQ((*part)[k].to, (*whole)[k].to);
    }
  }
  const auto lost = joiner.join({all[0], at(mesh->face_count())});
  EXPECT_FALSE(lost);
  EXPECT_EQ(joiner.join(all)->size(), whole->size()) << "after one that failed";
}

TEST(Sources, AlongACurveOfTextThatDoNotFitAreRefusedWithTheirNumber) {
  const auto range = resolve(grid(), {"curve:0,1,26"});
  ASSERT_FALSE(range);
  EXPECT_EQ(sentence(range.error()),
            "-s curve:0,1,26: number 3 of the curve: there is no vertex 26; vertices are 0 to 25");
  Draft two = plane_grid(1, 1, 1, 1);
  append(two, plane_grid(1, 1, 1, 1));
  const auto apart = resolve(*finish(std::move(two)), {"curve:0,3,4"});
  ASSERT_FALSE(apart);
  EXPECT_TRUE(sentence(apart.error()).starts_with("-s curve:0,3,4: number 3 of the curve: "))
      << apart.error().message;
}

TEST(Sources, ThatDoNotFitAreRefusedWithTheirName) {
  struct Case {
    const char *text, *says;
  };
  for (const Case& c : {Case{"26", "vertices are 0 to 25"},
                        {"25", "belongs to no face"},
                        {"face:32:1:0:0", "faces are 0 to 31"},
                        {"random:26", "25 belong"}}) {
    const auto resolved = resolve(grid(), {c.text});
    ASSERT_FALSE(resolved) << c.text;
    EXPECT_TRUE(sentence(resolved.error()).starts_with(std::string("-s ") + c.text + ": "));
    EXPECT_NE(sentence(resolved.error()).find(c.says), std::string::npos)
        << resolved.error().message;
  }
}

}  // namespace
}  // namespace geotherm::test
