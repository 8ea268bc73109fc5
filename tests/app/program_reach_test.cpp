// SPDX-License-Identifier: MIT
// Distances no farther than asked, at some vertices, with a part of the surface left out; many
// paths.
#include <algorithm>
#include <cmath>

#include "tests/app/npy_file.h"
#include "tests/app/program_fixture.h"

namespace geotherm::test {
namespace {

std::vector<double> distances_in(const TemporaryDirectory& folder, const char* name) {
  return npy_values<double>(bytes_of(folder.path(name)));
}

TEST_F(Program, SolvesNoFartherThanAsked) {
  for (const char* const method : {"wavefront", "fast-marching", "exact", "heat"}) {
    run({"solve", "bunny", "-s", "17", "--method", method, "-o", "all.npy"});
    const Json report = json({"solve", "bunny", "-s", "17", "--method", method, "-o", "near.npy",
                              "--max-distance", "0.3", "--json", "-"});
    const auto all = distances_in(folder, "all.npy"), near = distances_in(folder, "near.npy");
    ASSERT_EQ(all.size(), near.size());
    std::int64_t beyond = 0;
    for (std::size_t v = 0; v < all.size(); ++v) {
      beyond += all[v] <= 0.3 ? 0 : 1;
      ASSERT_EQ(near[v], all[v] <= 0.3 ? all[v] : INFINITY) << method << ", vertex " << v;
    }
    EXPECT_GT(beyond, 100);
    EXPECT_EQ(report["distance"]["unreached"], beyond);
    EXPECT_EQ(report["reach"]["max_distance"], 0.3);
    EXPECT_EQ(report["warnings"].size(), 0U) << report["warnings"];
  }
}

TEST_F(Program, LabelsNothingBeyondTheReach) {
  for (const char* const check : {"--check", "--no-check"}) {
    const Json report = json({"solve", "bunny", "-s", "0", "-s", "1200", "--labels", check,
                              "--max-distance", "0.2", "-o", "near.csv", "--json", "-"});
    std::int64_t labelled = 0;
    for (const Json& region : report["regions"]) {
      labelled += region["vertices"].get<std::int64_t>();
    }
    EXPECT_GT(labelled, 2) << check;
    EXPECT_EQ(labelled, report["model"]["vertices"].get<std::int64_t>() -
                            report["distance"]["unreached"].get<std::int64_t>())
        << check;
  }
}

TEST_F(Program, SolvesForTargetsAlone) {
  run({"solve", "bunny", "-s", "17", "--method", "wavefront", "-o", "all.npy"});
  const auto all = distances_in(folder, "all.npy");
  const Json report =
      json({"solve", "bunny", "-s", "17", "--method", "wavefront", "--target", "900,3", "--target",
            "17", "-o", "at.npy", "-o", "at.csv", "--json", "-"});
  EXPECT_EQ(distances_in(folder, "at.npy"), (std::vector<double>{all[900], all[3], 0}));
  EXPECT_EQ(report["reach"]["targets"][0]["vertex"], 900);
  EXPECT_EQ(report["reach"]["targets"][1]["distance"], all[3]);
  const std::string text = bytes_of(folder.path("at.csv"));
  EXPECT_TRUE(text.starts_with("vertex,distance\n900,")) << text;
  EXPECT_TRUE(text.ends_with("\n17,0\n")) << text;
  run({"solve", "bunny", "-s", "17,5", "--each", "--method", "wavefront", "--target", "900,3", "-o",
       "rows.npy"});
  const auto rows = distances_in(folder, "rows.npy");
  ASSERT_EQ(rows.size(), 4U);
  EXPECT_EQ(rows[0], all[900]);
  EXPECT_EQ(rows[1], all[3]);
}

TEST_F(Program, RefusesAReachThatIsNone) {
  const std::vector<std::string> solve = {"solve", "bunny", "-s", "17"};
  const auto with = [&solve](std::vector<std::string> more) {
    more.insert(more.begin(), solve.begin(), solve.end());
    return more;
  };
  expect_refused(with({"--max-distance", "-1"}), "--max-distance: '-1'");
  expect_refused(with({"--max-distance", "far"}), "is no length above 0");
  expect_refused(with({"--target", "5000"}), "--target");
  expect_refused(with({"--target", "boundary"}), "--target");
  expect_refused(with({"--each", "--target", "5", "-o", "a.npz"}), "sparse rows");
  expect_refused(with({"--mask", "nowhere.txt"}), "nowhere.txt");
}

TEST_F(Program, SparseRowsAreAFileOfTheirOwnKind) {
  const Json report = json({"solve", "bunny", "-s", "17,5,900", "--each", "--method", "wavefront",
                            "--max-distance", "0.2", "--float32", "-o", "near.npz", "--json", "-"});
  run({"solve", "bunny", "-s", "17,5,900", "--each", "--method", "wavefront", "-o", "all.npy"});
  const auto all = distances_in(folder, "all.npy");
  EXPECT_EQ(report["entries"], std::ranges::count_if(all, [](double d) { return d <= 0.2; }));
  EXPECT_EQ(report["dtype"], "float32");
  EXPECT_TRUE(bytes_of(folder.path("near.npz")).starts_with("PK"));
  EXPECT_EQ(folder.names().size(), 2U) << "nothing else is left";
}

/// A square in two halves along x = 2, in the middle a wall with a door at the top.
TEST_F(Program, AMaskIsACutMesh) {
  std::string whole, cut, mask;
  constexpr int kSide = 20;
  const auto at = [](int i, int j) { return j * (kSide + 1) + i; };
  const auto is_wall = [](int v) { return v % (kSide + 1) == kSide / 2 && v / (kSide + 1) < 15; };
  for (int v = 0; v < (kSide + 1) * (kSide + 1); ++v) {
    whole +=
        "v " + std::to_string(v % (kSide + 1)) + ' ' + std::to_string(v / (kSide + 1)) + " 0\n";
    mask += is_wall(v) ? "1\n" : "0\n";
  }
  cut = whole;
  for (int j = 0; j < kSide; ++j) {
    for (int i = 0; i < kSide; ++i) {
      const int corners[2][3] = {{at(i, j), at(i + 1, j), at(i + 1, j + 1)},
                                 {at(i, j), at(i + 1, j + 1), at(i, j + 1)}};
      for (const auto& c : corners) {
        const std::string face = "f " + std::to_string(c[0] + 1) + ' ' + std::to_string(c[1] + 1) +
                                 ' ' + std::to_string(c[2] + 1) + '\n';
        whole += face;
        if (!is_wall(c[0]) && !is_wall(c[1]) && !is_wall(c[2])) cut += face;
      }
    }
  }
  folder.write("whole.obj", whole);
  folder.write("cut.obj", cut);
  folder.write("wall.txt", mask);
  for (const char* const method : {"wavefront", "exact", "fast-marching", "heat"}) {
    run({"solve", "whole.obj", "--mask", "wall.txt", "-s", "0", "--method", method, "-o", "a.npy",
         "--no-check"});
    run({"solve", "cut.obj", "-s", "0", "--method", method, "-o", "b.npy", "--no-check"});
    const auto a = distances_in(folder, "a.npy"), b = distances_in(folder, "b.npy");
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t v = 0; v < a.size(); ++v) {
      ASSERT_EQ(std::isinf(a[v]), is_wall(static_cast<int>(v))) << v;
      if (std::isinf(a[v])) continue;
      ASSERT_NEAR(a[v], b[v], 1e-12 * 50) << method << ", vertex " << v;
    }
  }
  // Round the corners of the door to (20, 0): (9, 14), (10, 15) and (11, 15), for of the faces at
  // the top of the wall one has no vertex in it.
  run({"solve", "whole.obj", "--mask", "wall.txt", "-s", "0", "--method", "exact", "-o", "a.npy"});
  EXPECT_NEAR(distances_in(folder, "a.npy")[static_cast<std::size_t>(at(20, 0))],
              std::hypot(9, 14) + std::sqrt(2) + 1 + std::hypot(9, 15), 1e-9);
  expect_refused({"solve", "whole.obj", "--mask", "wall.txt", "-s", "10"}, "10");
  const Json said = json({"solve", "whole.obj", "--mask", "wall.txt", "-s", "0", "--json", "-"});
  EXPECT_EQ(said["warnings"].dump().find("corner"), std::string::npos) << said["warnings"];
  const std::string info = run({"info", "whole.obj", "--mask", "wall.txt"}).err;
  EXPECT_NE(info.find("leaves out 15 vertices"), std::string::npos) << info;
  EXPECT_EQ(info.find("repeat a corner"), std::string::npos) << info;
}

TEST_F(Program, PathsOfATreeAreThoseOfOneAfterTheOther) {
  const Json tree = json({"path", "bunny", "--from", "17", "--to", "random:6:3", "--to", "5",
                          "--json", "-", "--lengths", "lengths.csv"});
  ASSERT_EQ(tree["paths"].size(), 7U);
  EXPECT_EQ(tree["method"], "exact");
  std::string expected = "from,to,via,length\n";
  for (const Json& path : tree["paths"]) {
    const Json one =
        json({"path", "bunny", "--from", "17", "--to", path["to"].dump(), "--json", "-"});
    EXPECT_EQ(one["method"], "wavefront");
    EXPECT_NEAR(path["length"].get<double>(), one["length"].get<double>(), 1e-12);
    ASSERT_EQ(path["faces"], one["faces"]) << "they begin elsewhere, and are the same to round-off";
    expected += "17," + path["to"].dump() + ",0," + path["length"].dump() + '\n';
  }
  EXPECT_EQ(bytes_of(folder.path("lengths.csv")), expected);
  run({"path", "bunny", "--from", "17", "--to", "random:6:3", "--to", "5", "--lengths", "l.npy"});
  const auto lengths = npy_values<double>(bytes_of(folder.path("l.npy")));
  ASSERT_EQ(lengths.size(), 7U);
  for (std::size_t i = 0; i < 7; ++i) EXPECT_EQ(lengths[i], tree["paths"][i]["length"]);
  expect_refused({"path", "bunny", "--from", "17", "--to", "5", "--lengths", "l.xls"}, ".csv .npy");
}

TEST_F(Program, PathsOfAFileGoThroughThePointsOfALine) {
  folder.write("pairs.txt", "# two paths\n17 5\n\n3 99 512 7\n");
  const Json both = json({"path", "bunny", "--pairs", "pairs.txt", "--json", "-"});
  ASSERT_EQ(both["paths"].size(), 2U);
  const Json through = json(
      {"path", "bunny", "--from", "3", "--via", "99", "--via", "512", "--to", "7", "--json", "-"});
  EXPECT_EQ(both["paths"][1]["length"], through["length"]);
  EXPECT_EQ(both["paths"][1]["via"], through["via"]);
  folder.write("one.txt", "17\n");
  expect_refused({"path", "bunny", "--pairs", "one.txt"}, "line 1 has one point");
  folder.write("none.txt", "\n");
  expect_refused({"path", "bunny", "--pairs", "none.txt"}, "none.txt: there are no points in it");
  expect_refused({"path", "bunny", "--pairs", "pairs.txt", "--from", "3"}, "leave --from");
  expect_refused({"path", "bunny", "--to", "3"}, "--from and --to");
}

}  // namespace
}  // namespace geotherm::test
