// SPDX-License-Identifier: MIT
// What `solve --check` says of a wrong answer, and whether its cure works when it is followed.
#include <algorithm>
#include <ostream>

#include "bench/models/generate.h"
#include "geotherm/io.h"
#include "tests/app/program_fixture.h"
#include "tests/support/shapes.h"

namespace geotherm::test {
namespace {

using Words = std::vector<std::string>;

/// One option is wrong, and no other.
struct WrongOption {
  const char* name;
  Words solve;        ///< model and sources
  Words wrong;        ///< the option and its value; empty: the mesh itself is too coarse
  const char* cause;  ///< the option that is to be named
  const char* words;  ///< of the verdict
};

void PrintTo(const WrongOption& wrong, std::ostream* out) { *out << wrong.name; }

/// Obtuse triangles: a grid whose cells are `stretch` times as wide as high.
Draft needles(double stretch) {
  Draft draft = jittered_plane(12, 0.45, 3);
  for (Vec3& p : draft.positions) p.x() *= stretch;
  return draft;
}

class NamedCause : public Program, public testing::WithParamInterface<WrongOption> {
 protected:
  NamedCause() {
    EXPECT_TRUE(write_mesh(folder.path("terrain.ply"), *generate_model("terrain", 800)));
    EXPECT_TRUE(write_mesh(folder.path("needles.ply"), *finish(needles(6))));
    EXPECT_TRUE(write_mesh(folder.path("coarse.ply"), *generate_model("sleeve", 600)));
  }
  Json checked(Words words, const Words& more) {
    words.insert(words.begin(), "solve");
    words.insert(words.end(), more.begin(), more.end());
    words.insert(words.end(), {"--check", "--json", "-"});
    return json(words)["error"];
  }
};

TEST_P(NamedCause, IsTheWrongOptionAndItsCureLowersTheErrorToTheFigure) {
  const WrongOption& wrong = GetParam();
  const Json before = checked(wrong.solve, wrong.wrong);
  ASSERT_TRUE(before["cause"].is_object()) << before;
  const Json& cause = before["cause"];
  EXPECT_EQ(cause["option"], wrong.cause) << before;
  EXPECT_EQ(cause["mean_relative_before"], before["mean_relative"]);
  const std::string verdict = before["verdict"];
  EXPECT_NE(verdict.find(wrong.words), std::string::npos) << verdict;
  const std::string cure = "--" + cause["option"].get<std::string>();
  const std::string value = cause["value"];
  EXPECT_NE(verdict.find("with " + cure + ' ' + value + " it is "), std::string::npos) << verdict;

  // The same command, but for the option that was named.
  Words cured = wrong.wrong;
  if (const auto at = std::ranges::find(cured, cure); at != cured.end()) cured.erase(at, at + 2);
  cured.insert(cured.end(), {cure, value});
  const Json after = checked(wrong.solve, cured);
  // The reference is subtracted and added again.
  constexpr double kRounding = 1e-9;
  const double named = cause["mean_relative_after"];
  EXPECT_NEAR(after["mean_relative"].get<double>(), named, kRounding);
  EXPECT_LT(named, 0.8 * before["mean_relative"].get<double>());
}

const Words kTerrain = {"terrain.ply", "-s", "3"};
const Words kManySources = {"terrain.ply", "-s", "3,10,50,100,200,300,400"};

const WrongOption kCases[] = {
    {"CoarseMesh", {"coarse.ply", "-s", "3"}, {}, "refine", "too coarse"},
    {"LargeTime",
     kTerrain,
     {"--time-factor", "100"},
     "time-factor",
     "t is too large (m = 100, sqrt(t) = 10 mean edges)"},
    {"SmallTime", kTerrain, {"--time-factor", "0.001"}, "time-factor", "t is too small"},
    {"AbsoluteTime", kTerrain, {"--time-step", "absolute:10"}, "time-step", "t is too large"},
    {"Needles",
     {"needles.ply", "-s", "0"},
     {"--laplacian", "cotan"},
     "laplacian",
     "edges have a negative weight"},
    {"Border", kTerrain, {"--boundary", "dirichlet"}, "boundary", "dirichlet"},
    {"PinnedVertex", kManySources, {"--constraint", "pin-vertex"}, "constraint", "pin-vertex"},
    {"Penalty", kManySources, {"--constraint", "penalty:1e-6"}, "constraint", "penalty:1e-06"}};

INSTANTIATE_TEST_SUITE_P(Of, NamedCause, testing::ValuesIn(kCases),
                         [](const auto& test) { return std::string(test.param.name); });

TEST_F(Program, AGoodAnswerIsNotAskedForItsCause) {
  const Json error = json({"solve", "bunny", "-s", "0", "--check", "--json", "-"})["error"];
  EXPECT_EQ(error["verdict"], "good");
  EXPECT_EQ(error.at("cause"), Json(nullptr));
  EXPECT_EQ(error.at("tried"), Json::array());
}

TEST_F(Program, FieldsAreWrittenBesideTheDistancesOrRefusedInOneLine) {
  const Json solved = json({"solve", "bunny", "-s", "0", "--fields", "all", "-o", "f.vtp", "-o",
                            "f.ply", "--json", "-"});
  EXPECT_TRUE(solved.contains("error")) << "the field error checks the distances";
  for (const char* name : {"error", "eikonal_error", "gradient_angle", "lost_gradients",
                           "triangle_quality", "non_delaunay"}) {
    EXPECT_NE(bytes_of(folder.path("f.vtp")).find("Name=\"" + std::string(name) + '"'),
              std::string::npos);
    EXPECT_NE(bytes_of(folder.path("f.ply")).find(' ' + std::string(name) + '\n'),
              std::string::npos);
  }
  const auto refused = [this](const Words& more, const std::string& words) {
    Words all = {"solve", "bunny", "-s", "0", "--fields"};
    all.insert(all.end(), more.begin(), more.end());
    const ProgramRun failed = run_program(folder.path("."), all);
    EXPECT_EQ(failed.code, 2) << failed.err;
    EXPECT_NE(failed.err.find(words), std::string::npos) << failed.err;
    EXPECT_EQ(std::ranges::count(failed.err, '\n'), 1) << failed.err;
  };
  refused({"all", "-o", "x.npy"}, "write .ply or .vtp");
  refused({"eikonal-error", "-o", "x.csv"}, "write .ply or .vtp");
  refused({"error", "-o", "x.npy"}, "write .csv, .ply or .vtp");
  refused({"colour", "-o", "x.ply"}, "triangle-quality");
  refused({"error"}, "give -o");
  refused({"gradient-angle", "--method", "exact", "-o", "x.ply"}, "leave it out");
}

TEST_F(Program, AllFieldsGoWhereTheyHaveAPlace) {
  const ProgramRun done = run({"solve", "bunny", "-s", "0", "--fields", "all", "-o", "a.vtp", "-o",
                               "b.csv", "-o", "c.npy", "-o", "d.ply"});
  for (const char* file : {"a.vtp", "d.ply"}) {
    EXPECT_NE(bytes_of(folder.path(file)).find("triangle_quality"), std::string::npos) << file;
    EXPECT_EQ(done.err.find(file), std::string::npos) << done.err;
  }
  EXPECT_TRUE(bytes_of(folder.path("b.csv")).starts_with("vertex,distance,error\n"));
  EXPECT_TRUE(bytes_of(folder.path("d.ply")).starts_with("ply\nformat ascii 1.0\n"))
      << "readers of binary faces take no more than their corners";
  EXPECT_EQ(json({"solve", "d.ply", "-s", "0", "--json", "-"})["distance"],
            json({"solve", "bunny", "-s", "0", "--json", "-"})["distance"]);
  const auto said = [&done](const std::string& file) {
    const std::size_t at = done.err.find(file + " has no place for ");
    return at == std::string::npos ? std::string()
                                   : done.err.substr(at, done.err.find('\n', at) - at);
  };
  EXPECT_NE(said("b.csv").find("eikonal_error"), std::string::npos) << done.err;
  EXPECT_EQ(said("b.csv").find(" error,"), std::string::npos) << done.err;
  EXPECT_NE(said("c.npy").find(" error,"), std::string::npos) << done.err;
}

}  // namespace
}  // namespace geotherm::test
