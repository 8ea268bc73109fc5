// SPDX-License-Identifier: MIT
// Models that are no triangle mesh: volumes of tets and points without faces.
#include <algorithm>
#include <cmath>
#include <cstdio>

#include "geotherm/domains.h"
#include "tests/app/npy_file.h"
#include "tests/app/program_fixture.h"
#include "tests/support/shapes.h"

namespace geotherm::test {
namespace {

class ProgramInVolumes : public Program {
 protected:
  void SetUp() override {
    run({"generate", "ball-tets", "--tets", "20000", "-o", "ball.mesh"});
    volume = std::make_shared<const TetMesh>(read_tets(folder.path("ball.mesh"))->mesh);
  }

  /// Mean of |d - |x - from|| over the mean distance: the ball is convex.
  double error(const std::vector<double>& distances, const Vec3& from) const {
    double off = 0, sum = 0;
    for (std::size_t v = 0; v < distances.size(); ++v) {
      const double line = (volume->positions()[v] - from).norm();
      off += std::abs(distances[v] - line);
      sum += line;
    }
    return off / sum;
  }
  std::vector<double> distances(const std::vector<std::string>& more) {
    std::vector<std::string> arguments = {"solve", "ball.mesh", "-o", "d.npy"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    run(arguments);
    return npy_values<double>(bytes_of(folder.path("d.npy")));
  }

  std::shared_ptr<const TetMesh> volume;
};

TEST_F(ProgramInVolumes, DistanceFromTheCentreIsTheRadius) {
  const Vec3 centre = volume->positions()[0];
  // 2 % is asked of 100,000 tets; the edges of 20,000 are longer by the cube root of five.
  EXPECT_LE(error(distances({"-s", "0"}), centre), 0.02 * std::cbrt(5));
}

TEST_F(ProgramInVolumes, FastMarchingIsExactInAConvexBody) {
  constexpr double kRounding = 1e-9;
  const Vec3 source = volume->positions()[100];
  EXPECT_LE(error(distances({"-s", "100", "--method", "fast-marching"}), source), kRounding);
}

TEST_F(ProgramInVolumes, APlaceInsideIsASource) {
  const Vec3 place(0.3, 0.2, 0.1);
  const auto exact = distances({"-s", "xyz:0.3:0.2:0.1", "--method", "fast-marching"});
  EXPECT_LE(error(exact, place), 0.01);
  EXPECT_LE(error(distances({"-s", "xyz:0.3:0.2:0.1", "--boundary", "average"}), place), 0.05);
}

TEST_F(ProgramInVolumes, TheBoundaryIsTheWholeBorder) {
  const auto depth = distances({"-s", "boundary", "--method", "fast-marching"});
  // The ball's faces cut off what lies between them and the sphere.
  EXPECT_NEAR(depth[0], 1.0, 0.05);
  EXPECT_EQ(*std::ranges::min_element(depth), 0);
}

TEST_F(ProgramInVolumes, HeatIsHeldAgainstFastMarching) {
  const Json report = json({"solve", "ball.mesh", "-s", "random:2:5", "--json", "-"});
  EXPECT_EQ(report["model"]["domain"], "tets");
  EXPECT_EQ(report["model"]["tets"], volume->tet_count());
  EXPECT_EQ(report["error"]["reference"], "fast-marching");
  EXPECT_TRUE(report["error"]["mean_relative"].is_number());
}

TEST_F(ProgramInVolumes, AStudyIsHeldAgainstFastMarching) {
  const Json study =
      json({"study", "ball.mesh", "-s", "17", "--factors", "1:100:2", "--json", "-"});
  EXPECT_EQ(study["reference"], "fast-marching");
  EXPECT_EQ(study["rows"].size(), 2U * 2 * 3 * 5);  // rules, factors, boundary rules, constraints
  EXPECT_EQ(study["best"]["time_factor"], 1);
  EXPECT_LT(study["best"]["mean_relative"].get<double>(), 0.1);
  const double edge = study["mean_edge_length"];
  const Json& row = study["rows"][0];
  EXPECT_NEAR(row["t"].get<double>(), row["t_over_h2"].get<double>() * edge * edge, 1e-9);
}

TEST_F(ProgramInVolumes, PoorDistancesNameWhatWasTriedOrAnswerBetter) {
  // In a ball straight lines make good what is too smooth: the published method has none.
  const std::vector<std::string> poor = {"solve",   "ball.mesh",     "-s", "17", "--variant",
                                         "classic", "--time-factor", "300"};
  const auto with = [&poor](std::vector<std::string> more) {
    more.insert(more.begin(), poor.begin(), poor.end());
    return more;
  };
  const ProgramRun kept = run(poor);
  EXPECT_NE(kept.err.find("poor distances"), std::string::npos) << kept.err;
  const Json tried = json(with({"--check", "--json", "-"}))["error"];
  EXPECT_EQ(tried["cause"]["option"], "variant") << tried;
  EXPECT_EQ(tried["cause"]["value"], "corrected") << tried;
  const ProgramRun better = run(with({"--on-poor", "better"}));
  EXPECT_NE(better.err.find("the method fast-marching answered"), std::string::npos) << better.err;
}

TEST_F(ProgramInVolumes, PointsInCellsAreSourcesOfManyAndOfNoPair) {
  const std::string inside = "xyz:0.1:0.1:0.1";
  expect_refused({"solve", "ball.mesh", "-s", inside, "-s", "5", "--pairs", "-o", "p.npy"},
                 "source 1 is no vertex");
  expect_refused({"solve", "ball.mesh", "-s", "5", "-s", "boundary", "--pairs", "-o", "p.npy"},
                 "source 2 is no vertex");
  run({"solve", "ball.mesh", "-s", inside, "-s", "boundary", "--each", "-o", "e.npy", "--json",
       "e.json"});
  const Json sources = Json::parse(bytes_of(folder.path("e.json")))["sources"];
  EXPECT_EQ(sources[0]["weights"].size(), 4U);
  EXPECT_EQ(sources[1]["points"], boundary(*volume)->vertices.size());
}

TEST_F(ProgramInVolumes, APointOfTheBorderIsASource) {
  const auto border = boundary(*volume);
  for (const std::size_t face : {1U, 7U, 40U}) {
    const std::string source = "face:" + std::to_string(face) + ":0.3:0.3:0.4";
    Vec3 place = Vec3::Zero();
    const std::array<double, 3> weights = {0.3, 0.3, 0.4};
    for (std::size_t k = 0; k < 3; ++k) {
      place += weights[k] * volume->positions()[border->faces[face][k]];
    }
    EXPECT_LE(error(distances({"-s", source}), place), 0.06) << source;
  }
}

TEST_F(ProgramInVolumes, DistancesReadBackFromVtu) {
  run({"solve", "ball.mesh", "-s", "0", "-o", "d.vtu"});
  const auto back = read_tets(folder.path("d.vtu"));
  ASSERT_TRUE(back);
  EXPECT_EQ(back->mesh.tet_count(), volume->tet_count());
  EXPECT_NE(bytes_of(folder.path("d.vtu")).find("distance"), std::string::npos);
}

TEST_F(ProgramInVolumes, RowsOfManySourcesAreThoseOfOne) {
  run({"solve", "ball.mesh", "-s", "5", "-s", "900", "--each", "-o", "rows.npy"});
  const auto rows = npy_values<double>(bytes_of(folder.path("rows.npy")));
  const auto one = distances({"-s", "900"});
  constexpr double kBlocks = 1e-9;  // blocks of two columns round otherwise
  for (std::size_t v = 0; v < one.size(); ++v) EXPECT_NEAR(rows[one.size() + v], one[v], kBlocks);
}

TEST_F(ProgramInVolumes, WhatIsOfSurfacesIsRefusedInOneLine) {
  expect_refused({"path", "ball.mesh", "--from", "0", "--to", "5", "-o", "p.obj"},
                 "paths are of triangle meshes, and ball is a volume");
  expect_refused({"sample", "ball.mesh", "-n", "3"}, "samples are of triangle meshes");
  expect_refused({"solve", "ball.mesh", "-s", "0", "--method", "exact"}, "is of surfaces");
  expect_refused({"solve", "ball.mesh", "-s", "0", "--refine", "1"}, "refined");
  expect_refused({"solve", "ball.mesh", "-s", "0", "--weld", "0"}, "welded vertices are");
  expect_refused({"solve", "bunny", "-s", "0", "-o", "d.vtu"}, "holds tets");
}

TEST_F(ProgramInVolumes, AsTrianglesAreTheirBorder) {
  const std::string source = std::to_string(boundary(*volume)->vertices.front());
  const Json report =
      json({"solve", "ball.mesh", "--domain", "triangles", "-s", source, "--json", "-"});
  EXPECT_FALSE(report["model"].contains("domain"));
  EXPECT_EQ(report["model"]["faces"], std::ssize(boundary(*volume)->faces));
}

TEST_F(ProgramInVolumes, CompareHoldsBackendsAgainstFastMarching) {
  run({"compare", "ball.mesh", "--backends", "native,cg", "--json", "rows.json"});
  const Json rows = Json::parse(bytes_of(folder.path("rows.json")))["rows"];
  ASSERT_EQ(rows.size(), 2U);
  for (const Json& row : rows) {
    EXPECT_EQ(row["error_reference"], "fast-marching") << row;
    EXPECT_LE(row["mean_error"].get<double>(), 0.1) << row;
  }
}

TEST_F(Program, FacesStayPolygonsWhereTheyAreAskedFor) {
  constexpr int kSquares = 30;
  std::string text;
  for (int i = 0; i <= kSquares; ++i) {
    for (int j = 0; j <= kSquares; ++j) {
      text += "v " + std::to_string(i) + " " + std::to_string(j) + " 0\n";
    }
  }
  for (int i = 0; i < kSquares; ++i) {
    for (int j = 1; j <= kSquares; ++j) {
      const int a = i * (kSquares + 1) + j, b = a + kSquares + 1;
      text += "f";
      for (const int corner : {a, b, b + 1, a + 1}) text += " " + std::to_string(corner);
      text += "\n";
    }
  }
  folder.write("quads.obj", text);
  const std::vector<std::string> words = {"--domain", "polygons", "--json", "-"};
  std::vector<std::string> solve = {"solve", "quads.obj", "-s", "xyz:15.2:14.9:0"};
  solve.insert(solve.end(), words.begin(), words.end());
  const Json report = json(solve);
  EXPECT_EQ(report["model"]["domain"], "polygons");
  EXPECT_EQ(report["model"]["polygons"], kSquares * kSquares);
  EXPECT_EQ(report["sources"][0], 15 * (kSquares + 1) + 15);
  EXPECT_EQ(report["error"]["reference"], "wavefront");
  EXPECT_LE(report["error"]["mean_relative"].get<double>(), 0.03);
  const std::string triangles = "d.ply holds the triangles that the polygons are drawn by";
  EXPECT_EQ(report["warnings"].dump().find(triangles), std::string::npos);
  solve.insert(solve.end(), {"-o", "d.ply"});
  EXPECT_NE(json(solve)["warnings"].dump().find(triangles), std::string::npos);
  EXPECT_NE(run({"info", "quads.obj", "--domain", "polygons"}).out.find("900 polygons"),
            std::string::npos);
  for (const auto& [arguments, says] :
       {std::pair<std::vector<std::string>, std::string>{
            {"path", "quads.obj", "--from", "0", "--to", "9", "--domain", "polygons"},
            "with --domain triangles its triangulation is one"},
        {{"solve", "quads.obj", "-s", "0", "--domain", "points"}, "of points"},
        {{"solve", "quads.obj", "-s", "0", "--domain", "polygons", "--refine", "1"},
         "polygons cannot be refined"}}) {
    expect_refused(arguments, says);
  }
}

TEST_F(Program, PointsWithoutFacesHaveDistances) {
  // A sphere of points in the order of a spiral (Fibonacci).
  constexpr int kPoints = 4000;
  std::string text;
  const double golden = std::acos(-1.0) * (3 - std::sqrt(5.0));
  for (int i = 0; i < kPoints; ++i) {
    const double z = 1 - 2 * (i + 0.5) / kPoints, r = std::sqrt(1 - z * z);
    char line[120];
    std::snprintf(line, sizeof line, "%.9g %.9g %.9g\n", r * std::cos(golden * i),
                  r * std::sin(golden * i), z);
    text += line;
  }
  folder.write("sphere.xyz", text);
  const Json report = json({"solve", "sphere.xyz", "-s", "0", "--json", "-"});
  EXPECT_EQ(report["model"]["domain"], "points");
  EXPECT_EQ(report["model"]["vertices"], kPoints);
  // Half round the sphere; good distances are off by up to 4.5 % of the largest.
  EXPECT_NEAR(report["distance"]["max"].get<double>(), std::acos(-1.0), 0.045 * std::acos(-1.0));
  EXPECT_LE(report["error"]["mean_relative"].get<double>(), 0.02);
}

TEST_F(DrawingProgram, AVolumeIsDrawnByItsBorder) {
  run({"generate", "box-tets", "--tets", "3000", "-o", "box.mesh"});
  const ProgramRun drawn =
      run({"render", "box.mesh", "-s", "0", "--size", "200x150", "-o", "box.png"});
  EXPECT_FALSE(bytes_of(folder.path("box.png")).empty());
  EXPECT_NE(drawn.out.find("200 x 150"), std::string::npos) << drawn.out;
}

}  // namespace
}  // namespace geotherm::test
