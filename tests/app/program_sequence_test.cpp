// SPDX-License-Identifier: MIT
// Distances on a surface that moves, by the built program.
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <filesystem>
#include <regex>

#include "app/cli/commands.h"
#include "tests/app/fake_drawing.h"
#include "tests/app/npy_file.h"
#include "tests/app/program_fixture.h"
#include "tests/support/compare.h"

namespace geotherm::test {
namespace {

constexpr std::size_t kFrames = 4;
/// The tolerance is a share of the largest distance: parts of the frame before may be used, which
/// rounds otherwise.
constexpr double kRoundOffOfFrames = 1e-9;

class Sequence : public Program {
 protected:
  void SetUp() override {
    Program::SetUp();
    const std::string faces = "1000";
    run({"generate", "bunny", "--faces", faces, "-o", "body.obj"});
    run({"generate", "bunny", "--faces", faces, "--frames", "4", "-o", "f_%04d.obj"});
    run({"generate", "bunny", "--faces", faces, "--frames", "4", "-o", "walk.npy"});
  }

  static std::string frame(std::size_t k) { return "f_000" + std::to_string(k) + ".obj"; }

  std::vector<std::vector<double>> rows(const std::string& file) {
    const auto values = npy_values<double>(bytes_of(folder.path(file)));
    const auto columns = static_cast<std::ptrdiff_t>(values.size() / kFrames);
    std::vector<std::vector<double>> out;
    for (std::size_t k = 0; k < kFrames; ++k) {
      const auto begin = values.begin() + static_cast<std::ptrdiff_t>(k) * columns;
      out.emplace_back(begin, begin + columns);
    }
    return out;
  }

  /// What a run that has to fail says; it must leave the folder as it was.
  std::string refused(std::vector<std::string> arguments, int code) {
    const auto before = folder.names();
    const ProgramRun failed = run_program(folder.path("."), arguments);
    EXPECT_EQ(failed.code, code) << failed.err;
    EXPECT_EQ(std::ranges::count(failed.err, '\n'), 1) << failed.err;
    EXPECT_EQ(folder.names(), before);
    return failed.err;
  }
};

TEST_F(Sequence, HasTheRowsOfSeparateSolvesInTheOrderOfTheFrames) {
  const std::vector<std::string> sources = {"-s", "17", "-s", "face:7:0.2:0.3:0.5"};
  std::vector<std::string> all = {"solve", "body.obj", "--sequence", "f_%04d.obj",
                                  "-o",    "rows.npy", "--json",     "-"};
  all.insert(all.end(), sources.begin(), sources.end());
  const Json report = json(all);
  const std::size_t vertices = report["model"]["vertices"];
  EXPECT_TRUE(has_shape(bytes_of(folder.path("rows.npy")), kFrames, vertices));
  const auto solved = rows("rows.npy");
  for (std::size_t k = 0; k < kFrames; ++k) {
    std::vector<std::string> one = {"solve", frame(k), "-o", "one.npy"};
    one.insert(one.end(), sources.begin(), sources.end());
    run(one);
    const auto single = npy_values<double>(bytes_of(folder.path("one.npy")));
    EXPECT_LE(relative_difference(solved[k], single), kRoundOffOfFrames) << k;
    EXPECT_TRUE(k == 0 || relative_difference(solved[k - 1], single) > 1e-3) << k;
  }
  expect_keys(report,
              {{"model", keys({"name", "vertices", "faces"})},
               {"options", keys({"method", "backend", "t", "threads"})},
               {"frames", keys({"path", "count", "first", "bad", "bad_frames"})},
               {"distance", keys({"min", "max", "mean", "unreached"})},
               {"timing_ms", keys({"load", "read", "setup", "query", "frames", "frame"})},
               {"memory_mb", keys({"factor", "peak_rss"})},
               {"error", keys({"reference", "mean_relative", "verdict"})},
               {"warnings", nullptr}},
              "");
  EXPECT_EQ(report["model"]["name"], "body");
  EXPECT_EQ(report["frames"]["count"], kFrames);
  EXPECT_EQ(report["frames"]["bad"], 0);
}

TEST_F(Sequence, SaysWhichAnswerWasReplacedHoweverManyFramesThereAre) {
  const Json report = json({"solve", "body.obj", "--sequence", "f_%04d.obj", "-s", "17", "-m",
                            "1e6", "--on-poor", "better", "-o", "rows.npy", "--json", "-"});
  ASSERT_TRUE(report.contains("replaced")) << report;
  EXPECT_NE(report["options"]["method"], "heat");
  EXPECT_GT(report["replaced"]["mean_relative"], report["error"]["mean_relative"]);
}

TEST_F(Sequence, IsTheSameFromNumberedMeshesAndFromAnArray) {
  run({"solve", "body.obj", "--sequence", "f_%04d.obj", "-s", "17", "-o", "a.npy"});
  run({"solve", "body.obj", "--sequence", "walk.npy", "-s", "17", "-o", "b.npy"});
  EXPECT_EQ(bytes_of(folder.path("a.npy")), bytes_of(folder.path("b.npy")));
  const ProgramRun streamed =
      run({"solve", "body.obj", "--sequence", "walk.npy", "-s", "17", "-o", "-"});
  EXPECT_EQ(streamed.out, bytes_of(folder.path("a.npy")));
}

TEST_F(Sequence, IsOfAnyMethodAndTypeOfNumbers) {
  run({"solve", "body.obj", "--sequence", "walk.npy", "-s", "17", "--method", "exact", "-o",
       "a.npy", "--float32"});
  run({"solve", frame(3), "-s", "17", "--method", "exact", "-o", "one.npy"});
  const auto floats = npy_values<float>(bytes_of(folder.path("a.npy")));
  const auto single = npy_values<double>(bytes_of(folder.path("one.npy")));
  ASSERT_EQ(floats.size(), kFrames * single.size());
  for (std::size_t v = 0; v < single.size(); ++v) {
    EXPECT_EQ(floats[3 * single.size() + v], static_cast<float>(single[v])) << v;
  }
}

TEST_F(Sequence, EndsAtABadFrameWhichIsNamedAndLeavesNoFile) {
  folder.write(frame(2), "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  for (const char* output : {"rows.npy", "rows.pvd"}) {
    const std::string said =
        refused({"solve", "body.obj", "--sequence", "f_%04d.obj", "-s", "17", "-o", output}, 1);
    EXPECT_NE(said.find("f_0002.obj: the frame has 3 vertices and 1 triangles, and the model "),
              std::string::npos)
        << said;
  }
}

TEST_F(Sequence, FilesThatWereThereStayWhatTheyWereUntilAllFramesAreWritten) {
  run({"solve", "body.obj", "--sequence", "f_%04d.obj", "-s", "17", "-o", "rows.pvd"});
  const std::string before = bytes_of(folder.path("rows_0000.vtp"));
  run({"solve", "body.obj", "--sequence", "f_%04d.obj", "-s", "300", "-o", "rows.pvd", "--json",
       "told.json"});
  const std::string other = bytes_of(folder.path("rows_0000.vtp"));
  EXPECT_TRUE(other != before);
  const auto files = [this] {
    return std::distance(std::filesystem::directory_iterator(folder.path(".")), {});
  };
  const auto count = files();
  folder.write(frame(2), "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  const ProgramRun failed =
      run_program(folder.path("."), {"solve", "body.obj", "--sequence", "f_%04d.obj", "-s", "17",
                                     "-o", "rows.pvd", "--json", "told.json"});
  EXPECT_EQ(failed.code, 1);
  EXPECT_TRUE(bytes_of(folder.path("rows_0000.vtp")) == other);
  EXPECT_EQ(files(), count) << "nothing is left beside them";
}

TEST_F(Sequence, SkipsBadFramesWhereAskedAndCountsThem) {
  folder.write(frame(0), "this is no mesh");
  ASSERT_EQ(::unlink(folder.path(frame(2)).c_str()), 0);
  const std::vector<std::string> arguments = {"solve",  "body.obj",  "--sequence", "f_%04d.obj",
                                              "-s",     "17",        "-o",         "rows.npy",
                                              "--json", "rows.json", "--skip-bad"};
  const ProgramRun done = run(arguments);
  EXPECT_NE(done.err.find("left out: f_0000.obj: "), std::string::npos) << done.err;
  EXPECT_NE(done.err.find("left out: f_0002.obj: no such file"), std::string::npos) << done.err;
  EXPECT_NE(done.out.find("4 of f_%04d.obj, 2 of them bad"), std::string::npos) << done.out;
  const auto solved = rows("rows.npy");
  for (std::size_t k = 0; k < kFrames; ++k) {
    const auto missing = std::ranges::count_if(solved[k], [](double d) { return std::isnan(d); });
    EXPECT_EQ(missing, k == 0 || k == 2 ? std::ssize(solved[k]) : 0) << k;
  }
  run({"solve", frame(3), "-s", "17", "-o", "one.npy"});
  EXPECT_LE(relative_difference(solved[3], npy_values<double>(bytes_of(folder.path("one.npy")))),
            kRoundOffOfFrames);
  const Json report = Json::parse(bytes_of(folder.path("rows.json")));
  EXPECT_EQ(report["frames"]["bad"], 2);
  ASSERT_EQ(report["frames"]["bad_frames"].size(), 2U);
  EXPECT_EQ(report["frames"]["bad_frames"][1]["frame"], 2);
  EXPECT_EQ(report["distance"]["unreached"], 0);
}

TEST_F(Sequence, ThatIsBadAllThroughIsAnError) {
  for (std::size_t k = 0; k < kFrames; ++k) folder.write(frame(k), "this is no mesh");
  const std::string said = refused(
      {"solve", "body.obj", "--sequence", "f_%04d.obj", "-s", "17", "-o", "rows.npy", "--skip-bad"},
      1);
  EXPECT_NE(said.find("none of 4 frames can be solved; the first says: f_0000.obj: "),
            std::string::npos)
      << said;
}

TEST_F(Sequence, IsACollectionOfFilesForParaView) {
  folder.write(frame(1), "this is no mesh");
  const ProgramRun done = run(
      {"solve", "body.obj", "--sequence", "f_%04d.obj", "-s", "17", "-o", "a&b.pvd", "--skip-bad"});
  EXPECT_NE(done.out.find("a .vtp file for each of 3 frames"), std::string::npos) << done.out;
  const std::string list = bytes_of(folder.path("a&b.pvd"));
  EXPECT_TRUE(list.starts_with("<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\""));
  EXPECT_TRUE(list.ends_with("</Collection>\n</VTKFile>\n"));
  const std::regex entry("<DataSet timestep=\"(\\d+)\" part=\"0\" file=\"([^\"]+)\"/>");
  std::vector<std::string> files;
  for (std::sregex_iterator at(list.begin(), list.end(), entry), end; at != end; ++at) {
    files.push_back((*at)[1].str() + ' ' + (*at)[2].str());
  }
  EXPECT_EQ(files, (std::vector<std::string>{"0 a&amp;b_0000.vtp", "2 a&amp;b_0002.vtp",
                                             "3 a&amp;b_0003.vtp"}));
  run({"solve", frame(2), "-s", "17", "-o", "one.vtp"});
  EXPECT_EQ(bytes_of(folder.path("a&b_0002.vtp")).size(), bytes_of(folder.path("one.vtp")).size());
}

TEST_F(Sequence, RefusesWhatDoesNotGoWithIt) {
  const std::vector<std::pair<std::vector<std::string>, std::string>> wrong = {
      {{"--each"}, "--each solves for each source by itself"},
      {{"--pairs"}, "--pairs is about the sources alone"},
      {{"--labels"}, "--labels is about one surface"},
      {{"--fields", "all"}, "--fields is about one surface"},
      {{"--domain", "polygons"}, "is read as polygons"},
      {{"--on-poor", "fail", "--skip-bad"}, "--on-poor fail ends the run and --skip-bad goes on"},
      {{"-o", "b.npy"}, "--sequence writes one output, and 2 were given"},
  };
  for (const auto& [words, what] : wrong) {
    std::vector<std::string> arguments = {"solve", "body.obj", "--sequence", "walk.npy",
                                          "-s",    "17",       "-o",         "a.npy"};
    arguments.insert(arguments.end(), words.begin(), words.end());
    const std::string said = refused(arguments, 2);
    EXPECT_NE(said.find(what), std::string::npos) << said;
  }
  EXPECT_NE(refused({"solve", "body.obj", "-s", "1", "--skip-bad"}, 2).find("--skip-bad is about"),
            std::string::npos);
  EXPECT_NE(refused({"solve", "body.obj", "--sequence", "walk.npy", "-s", "1", "-o", "walk.npy"}, 2)
                .find("walk.npy is the file of --sequence"),
            std::string::npos);
  std::string points;
  for (int i = 0; i < 25; ++i) {
    points += std::to_string(i % 5) + " " + std::to_string(i / 5) + " 0\n";
  }
  folder.write("points.xyz", points);
  const std::string of_points =
      refused({"solve", "points.xyz", "--sequence", "walk.npy", "-s", "1", "-o", "a.npy"}, 2);
  EXPECT_NE(of_points.find("is read as points; give a mesh\n"), std::string::npos) << of_points;
  EXPECT_NE(refused({"solve", "cube", "--sequence", "walk.npy", "-s", "1", "-o", "a.npy"}, 1)
                .find(" vertices, and the model 15002; all frames have the vertices"),
            std::string::npos);
}

TEST_F(Sequence, ThatIsInterruptedLeavesNothing) {
  constexpr int kMaxLooks = 20'000, kBetweenLooks = 1000;  // microseconds
  run({"generate", "bunny", "--faces", "20000", "-o", "big.ply"});
  run({"generate", "bunny", "--faces", "20000", "--frames", "40", "-o", "big.npy"});
  const auto before = folder.names();
  const RunningProgram program(folder.path("."), {"solve", "big.ply", "--sequence", "big.npy", "-s",
                                                  "17", "-o", "rows.pvd"});
  const auto begun = [&] {
    return std::ranges::count(folder.names(), std::string("rows_0002.vtp")) > 0;
  };
  for (int look = 0; look < kMaxLooks && !begun(); ++look) ::usleep(kBetweenLooks);
  ASSERT_TRUE(begun());
  program.signal(SIGINT);
  EXPECT_EQ(program.wait().code, 128 + SIGINT);
  EXPECT_EQ(folder.names(), before);
}

TEST(CancelledSequence, LeavesNothing) {
  const TemporaryDirectory folder;
  app::GenerateArguments frames;
  frames.name = "bunny";
  frames.faces = "1000";
  frames.frames = "4";
  frames.output = folder.path("walk.npy");
  ASSERT_TRUE(app::run_generate(frames));
  app::GenerateArguments body;
  body.name = "bunny";
  body.faces = "1000";
  body.output = folder.path("body.obj");
  ASSERT_TRUE(app::run_generate(body));
  for (const char* output : {"a.npy", "a.pvd"}) {
    app::SolveArguments arguments;
    arguments.model = body.output;
    arguments.sources.sources = {"17"};
    arguments.sequence.frames = frames.output;
    arguments.outputs = {folder.path(output)};
    bool reached = false;
    const auto result =
        app::run_solve(arguments, FakeDrawing(), [&](std::string_view stage, double) {
          reached = reached || stage.starts_with("frame 3 of 4 frames");
          return !reached;
        });
    ASSERT_FALSE(result);
    EXPECT_EQ(result.error().code, ErrorCode::kCancelled);
    EXPECT_TRUE(reached);
    EXPECT_EQ(folder.names(), (std::vector<std::string>{"body.obj", "walk.npy"}));
  }
}

TEST_F(Program, GeneratesFramesAsAnArrayAndAsMeshes) {
  run({"generate", "cube", "--faces", "600", "--frames", "3", "-o", "a.npy"});
  run({"generate", "cube", "--faces", "600", "--frames", "3", "-o", "f%d.ply"});
  const std::string bytes = bytes_of(folder.path("a.npy"));
  const auto values = npy_values<double>(bytes);
  for (std::size_t k = 0; k < 3; ++k) {
    const auto mesh = read_mesh(folder.path("f" + std::to_string(k) + ".ply"));
    ASSERT_TRUE(mesh);
    const auto positions = mesh->mesh.positions();
    ASSERT_EQ(values.size(), 9 * positions.size());
    for (std::size_t v = 0; v < positions.size(); ++v) {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        EXPECT_EQ(values[3 * (k * positions.size() + v) + axis],
                  positions[v][static_cast<Eigen::Index>(axis)]);
      }
    }
  }
  run({"generate", "cube", "--faces", "1200", "--frames", "3", "-o", "f%d.ply"});
  const auto finer = read_mesh(folder.path("f2.ply"));
  ASSERT_TRUE(finer);
  EXPECT_GT(3 * finer->mesh.vertex_count() * 3, static_cast<Index>(values.size()));
  const auto names = folder.names();
  EXPECT_EQ(names, (std::vector<std::string>{"a.npy", "f0.ply", "f1.ply", "f2.ply"}));
  for (const auto& [arguments, what] :
       std::vector<std::pair<std::vector<std::string>, std::string>>{
           {{"cube", "--frames", "0", "-o", "b.npy"}, "--frames: '0' is no number of frames"},
           {{"cube", "--frames", "3", "-o", "b.obj"}, "give -o FILE.npy or -o 'frame_%04d.obj'"},
           {{"box-tets", "--frames", "3", "-o", "b.npy"}, "--frames is of surfaces"}}) {
    std::vector<std::string> words = {"generate"};
    words.insert(words.end(), arguments.begin(), arguments.end());
    const ProgramRun failed = run_program(folder.path("."), words);
    EXPECT_EQ(failed.code, 2);
    EXPECT_NE(failed.err.find(what), std::string::npos) << failed.err;
  }
  EXPECT_EQ(folder.names(), names);
}

}  // namespace
}  // namespace geotherm::test
