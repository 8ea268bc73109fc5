// SPDX-License-Identifier: MIT
#include "app/session/sources.h"

#include <gtest/gtest.h>

#include <random>

#include "tests/mesh/mesh_files.h"

namespace geotherm::test {
namespace {

using namespace geotherm::app;

template <class Spec>
Spec parsed(std::string_view text) {
  const auto spec = parse_source(text);
  EXPECT_TRUE(spec) << text;
  const Spec* found = spec ? std::get_if<Spec>(&*spec) : nullptr;
  EXPECT_NE(found, nullptr) << text;
  return found ? *found : Spec{};
}

TEST(SourceText, NamesVertices) {
  EXPECT_EQ(parsed<VertexList>("17").vertices, std::vector<Index>{17});
  EXPECT_EQ(parsed<VertexList>("3,99,512").vertices, (std::vector<Index>{3, 99, 512}));
}

TEST(SourceText, NamesCurves) {
  EXPECT_EQ(parsed<VertexCurve>("curve:3,99,3"), (VertexCurve{{3, 99, 3}, {}}));
  EXPECT_EQ(parsed<VertexCurve>("curve:7"), (VertexCurve{{7}, {}}));
  EXPECT_EQ(parsed<SurfaceCurve>("curve:face:7:0.5:0.25:0.25,face:8:1:0:0"),
            (SurfaceCurve{{{7, {0.5, 0.25, 0.25}}, {8, {1, 0, 0}}}}));
  EXPECT_FALSE(parse_source("curve:face:7:1:0:0,8"));
  EXPECT_FALSE(parse_source("curve:8,face:7:1:0:0"));
}

TEST(SourceText, NamesRandomVertices) {
  EXPECT_EQ(parsed<RandomVertices>("random:5").count, 5);
  EXPECT_EQ(parsed<RandomVertices>("random:5").seed, RandomVertices{}.seed);
  EXPECT_EQ(parsed<RandomVertices>("random:5:18446744073709551615").seed, 18446744073709551615U);
}

TEST(SourceText, NamesTheBoundary) { parsed<WholeBoundary>("boundary"); }

TEST(SourceText, NamesPointsInFacesAndInSpace) {
  const FacePoint inside = parsed<FacePoint>("face:7:0.5:0.25:.25");
  EXPECT_EQ(inside.face, 7);
  EXPECT_EQ(inside.weights, (std::array<double, 3>{0.5, 0.25, 0.25}));
  EXPECT_EQ(parsed<SpacePoint>("xyz:-1:+2.5:3e-2").position, Vec3(-1, 2.5, 0.03));
}

TEST(SourceText, ScalesWeightsThatNearlySumToOne) {
  const auto weights = parsed<FacePoint>("face:7:0.333:0.333:0.333").weights;
  EXPECT_DOUBLE_EQ(weights[0] + weights[1] + weights[2], 1.0);
}

TEST(SourceText, KeepsWeightsThatSumToOneButForRoundOff) {
  const std::array<double, 3> thirds = {1.0 / 3, 1.0 / 3, 1.0 / 3 + 1e-16};
  EXPECT_EQ(parsed<FacePoint>(to_text(FacePoint{7, thirds})).weights, thirds);
  const auto scaled = parsed<FacePoint>("face:7:0.333:0.333:0.333");
  EXPECT_EQ(parsed<FacePoint>(to_text(scaled)), scaled);
}

TEST(SourceText, IsReadBackAsTheSameValue) {
  const SourceSpec specs[] = {
      VertexList{{17}},
      VertexList{{3, 99, 2147483647}},
      VertexCurve{{4, 0, 4}, {}},
      VertexCurve{{5}, {}},
      SurfaceCurve{{{7, {0.5, 0.25, 0.25}}, {8, {1, 0, 0}}}},
      RandomVertices{12, RandomVertices{}.seed},
      RandomVertices{1, 18446744073709551615U},
      WholeBoundary{},
      FacePoint{0, {0, 1, 0}},
      FacePoint{2147483647, {0.1, 0.2, 0.7}},
      FacePoint{3, {5e-324, 1 - 0x1p-53, 0x1p-53}},
      SpacePoint{Vec3(-0.1, 1.0 / 3, 6.02214076e23)},
      SpacePoint{Vec3(-5e-324, 1.7976931348623157e308, 0)},
  };
  for (const SourceSpec& spec : specs) {
    const auto again = parse_source(to_text(spec));
    ASSERT_TRUE(again) << to_text(spec) << ": " << again.error().message;
    EXPECT_EQ(*again, spec) << to_text(spec);
  }
}

TEST(SourceText, IsReadBackAsTheSameRandomPoint) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> uniform(0, 1);
  for (int i = 0; i < 1000; ++i) {
    std::array<double, 3> weights = {uniform(random), uniform(random), uniform(random)};
    const double sum = weights[0] + weights[1] + weights[2];
    for (double& w : weights) w /= sum;
    const FacePoint point{i, weights};
    EXPECT_EQ(parsed<FacePoint>(to_text(point)), point);
    const SpacePoint place{Vec3(weights[0], -1e9 * weights[1], 1e-9 * weights[2])};
    EXPECT_EQ(parsed<SpacePoint>(to_text(place)), place);
  }
}

TEST(SourceText, IsCanonical) {
  EXPECT_EQ(to_text(parsed<VertexList>("03, 99")), "3,99");
  EXPECT_EQ(to_text(parsed<RandomVertices>("random:+5:1")), "random:5");
  EXPECT_EQ(to_text(parsed<FacePoint>("face:7:.5:0.250:25e-2")), "face:7:0.5:0.25:0.25");
  EXPECT_EQ(to_text(VertexCurve{{1, 2}, {8, 9}}), "curve:1,2") << "lines are not part of the text";
}

class WrongSourceText : public testing::TestWithParam<const char*> {};

TEST_P(WrongSourceText, IsRefusedWithAHint) {
  const auto spec = parse_source(GetParam());
  ASSERT_FALSE(spec) << GetParam();
  EXPECT_EQ(spec.error().code, ErrorCode::kBadInput);
  EXPECT_NE(sentence(spec.error()).find_first_of(":;"), std::string::npos);
}

INSTANTIATE_TEST_SUITE_P(
    All, WrongSourceText,
    testing::Values("", "x", "-1", "1.5", "3,,4", "3,", "1e3", "99999999999", "0x10", "random",
                    "random:", "random:0", "random:-1", "random:x", "random:1:", "random:1:2:3",
                    "random:1:-2", "boundary:1", "face", "face:1", "face:1:1:0", "face:-1:1:0:0",
                    "face:1:1:1:0", "face:1:2:-1:0", "face:1:nan:0:0", "face:1:1:0:0:0", "xyz",
                    "xyz:1:2", "xyz:1:2:3:4", "xyz:1:2:inf", "xyz:1,5:2:3", "xyz: 1:2:3", "curve",
                    "curve:", "curve:1,", "curve:1,,2", "curve:1,-2", "curve:1:2", "curve:x"));

TEST(SourceText, OfMoreRandomVerticesThanThereCanBeSaysTheMost) {
  EXPECT_EQ(sentence(parse_source("random:99999999999999").error()),
            "'random:99999999999999' asks for more vertices than a model can have; give at most "
            "2147483647");
}

class SourceFile : public testing::Test {
 protected:
  Result<std::vector<Source>> read(std::string_view text, bool curve = false) {
    return read_source_file(folder.write("s.txt", text), curve);
  }
  TemporaryDirectory folder;
};

TEST_F(SourceFile, HoldsIdsAndPointsBlankLinesAndComments) {
  const auto sources =
      read("\xef\xbb\xbf# ids\r\n5\r\n\n  6  # six\nface:1:1:0:0\nxyz:1:2:3\n\t1 2.5 -3e0\n7");
  ASSERT_TRUE(sources) << sources.error().message;
  ASSERT_EQ(sources->size(), 6U);
  EXPECT_EQ(std::get<VertexList>((*sources)[1].spec).vertices, std::vector<Index>{6});
  EXPECT_EQ(std::get<SpacePoint>((*sources)[4].spec).position, Vec3(1, 2.5, -3));
  EXPECT_TRUE((*sources)[1].where.ends_with("s.txt: line 4"));
  EXPECT_EQ((*sources)[1].blame, ErrorCode::kBadFile);
}

TEST_F(SourceFile, HasALineForEachCr) {
  const auto sources = read("5\r6\r7\r");
  ASSERT_TRUE(sources) << sources.error().message;
  ASSERT_EQ(sources->size(), 3U);
  EXPECT_EQ(std::get<VertexList>((*sources)[2].spec).vertices, std::vector<Index>{7});
}

TEST_F(SourceFile, ThatIsACurveIsOnePolyline) {
  const auto sources = read("5\n6\n\n7\n5\n", true);
  ASSERT_TRUE(sources);
  ASSERT_EQ(sources->size(), 1U);
  const auto& curve = std::get<VertexCurve>(sources->front().spec);
  EXPECT_EQ(curve.vertices, (std::vector<Index>{5, 6, 7, 5}));
  EXPECT_EQ(curve.lines, (std::vector<int>{1, 2, 4, 5}));
}

TEST_F(SourceFile, ThatIsWrongIsRefusedWithTheLine) {
  for (const char* text : {"1\n2\nx\n", "1\n2\n1 2\n", "1\n2\n1 2 y\n", "1\n2\nrandom:3\n",
                           "1\n2\n3,4\n", "1\n2\n-4\n", "1\n2\n1 2 3 4\n", "1\n\nface:1:2:3:4\n"}) {
    const auto sources = read(text);
    ASSERT_FALSE(sources) << text;
    EXPECT_EQ(sources.error().code, ErrorCode::kBadFile);
    EXPECT_NE(sentence(sources.error()).find("line 3: "), std::string::npos);
  }
  EXPECT_FALSE(read("# nothing\n\n"));
  EXPECT_FALSE(read("1\n1 2 3\n", true));
}

}  // namespace
}  // namespace geotherm::test
