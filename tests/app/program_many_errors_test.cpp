// SPDX-License-Identifier: MIT
// What many sources and samples refuse: one line, nothing left.
#include <unistd.h>

#include <algorithm>

#include "tests/app/program_fixture.h"

namespace geotherm::test {
namespace {

/// A command line that must fail, in a folder with a triangle and a fourth vertex without a face.
struct Refusal {
  const char* name;
  std::vector<std::string> arguments;
  int code;
  std::vector<std::string> says;  ///< all of it in the one line on standard error
};

void PrintTo(const Refusal& refusal, std::ostream* stream) { *stream << refusal.name; }

const std::vector<Refusal>& refusals() {
  static const std::vector<Refusal> kRefusals = {
      {"EachWithoutOutput", {"solve", "bunny", "-s", "1", "--each"}, 2, {"0 outputs", "FILE.npy"}},
      {"EachTwice",
       {"solve", "bunny", "-s", "1", "--each", "-o", "a.npy", "-o", "b.npy"},
       2,
       {"2 outputs"}},
      {"EachAsText", {"solve", "bunny", "-s", "1", "--each", "-o", "a.csv"}, 2, {"a.csv", ".npy"}},
      {"EachAndPairs", {"solve", "bunny", "-s", "1,2", "--each", "--pairs"}, 2, {"both given"}},
      {"EachChecked",
       {"solve", "bunny", "-s", "1", "--each", "--check", "-o", "a.npy"},
       2,
       {"--check", "leave one of them out"}},
      {"EachLabelled",
       {"solve", "bunny", "-s", "1", "--each", "--labels", "-o", "a.npy"},
       2,
       {"--labels"}},
      {"EachType",
       {"solve", "bunny", "-s", "1", "--each", "-o", "a.npy", "--dtype", "int8"},
       2,
       {"--dtype", "'int8'", "float64, float32"}},
      {"EachTypes",
       {"solve", "bunny", "-s", "1", "--each", "-o", "a.npy", "--dtype", "float64", "--float32"},
       2,
       {"disagree"}},
      {"EachSymmetric",
       {"solve", "bunny", "-s", "1", "--each", "-o", "a.npy", "--symmetric"},
       2,
       {"--symmetric is about --pairs"}},
      {"TypeOfOneSet",
       {"solve", "bunny", "-s", "1", "--float32"},
       2,
       {"--each, --pairs and --sequence"}},
      // What is wrong with the options is said before the model is read.
      {"PairsOfTargets",
       {"solve", "gone.ply", "-s", "1,2", "--pairs", "--target", "3"},
       2,
       {"the targets of --pairs are its sources", "take --each"}},
      {"EachNoSource", {"solve", "bunny", "--each", "-o", "a.npy"}, 2, {"no source"}},
      {"EachNoVertex", {"solve", "bunny", "-s", "1,99999", "--each", "-o", "a.npy"}, 2, {"99999"}},
      {"EachLooseVertex",
       {"solve", "triangle.obj", "-s", "3", "--each", "-o", "a.npy"},
       2,
       {"vertex 3", "no face"}},
      {"EachNoFolder",
       {"solve", "bunny", "-s", "1", "--each", "-o", "no/a.npy"},
       1,
       {"no/a.npy", "no folder"}},
      {"EachLate",
       {"solve", "bunny", "-s", "1", "--each", "-o", "/proc/a.npy"},
       1,
       {"/proc/a.npy", "; "}},
      {"EachOnAFullDevice",
       {"solve", "bunny", "-s", "random:20", "--each", "-o", "full.npy"},
       1,
       {"full.npy: cannot be written: No space left", "; make room"}},
      {"EachIsTheModel",
       {"solve", "triangle.npy", "--format", "obj", "-s", "1", "--each", "-o", "triangle.npy"},
       2,
       {"is the model itself"}},
      {"GenerateVolumesAreNamed", {"generate", "dragon", "-o", "d.ply"}, 2, {"ball-tets"}},
      {"MaskMissing",
       {"solve", "bunny", "-s", "1", "--mask", "none.npy"},
       1,
       {"none.npy: no such file; check the path"}},
      {"PairsMissing",
       {"path", "bunny", "--pairs", "none.txt"},
       1,
       {"--pairs: none.txt: no such file; check the path"}},
      {"VectorsMissing",
       {"transport", "bunny", "--vectors", "none.txt"},
       1,
       {"--vectors: none.txt: no such file; check the path"}},
      {"CurvesMissing",
       {"signed", "bunny", "--curves", "none.csv"},
       1,
       {"--curves: none.csv: no such file; check the path"}},
      {"CompareSaysOfWhichModel",
       {"compare", "triangle.obj", "-s", "4000"},
       2,
       {"triangle: --source 4000: there is no vertex 4000"}},
      {"PictureOfFramesWithoutNumber",
       {"render", "bunny", "--sequence", "none.npy", "-s", "1", "-o", "a.png"},
       2,
       {"a.png: has no place for a number; give -o 'frame_%04d.png'"}},
      {"PairsOfOne", {"solve", "bunny", "-s", "1", "--pairs"}, 2, {"one vertex makes no pair"}},
      {"PairsOfPoints",
       {"solve", "bunny", "-s", "1", "-s", "face:3:0.2:0.3:0.5", "--pairs"},
       2,
       {"source 2 is no vertex", "; distances are between"}},
      {"PairsWithOffsets", {"solve", "bunny", "-s", "1@2", "-s", "2", "--pairs"}, 2, {"offset"}},
      {"PairsAsMesh",
       {"solve", "bunny", "-s", "1,2", "--pairs", "-o", "a.ply"},
       2,
       {".npy or .csv"}},
      {"PairsTypeOfText",
       {"solve", "bunny", "-s", "1,2", "--pairs", "-o", "a.csv", "--float32"},
       2,
       {".npy"}},
      {"SampleNothing", {"sample", "bunny"}, 2, {"--count"}},
      {"SampleNone", {"sample", "bunny", "-n", "0"}, 2, {"--count", "'0'"}},
      {"SampleText", {"sample", "bunny", "-n", "many"}, 2, {"--count", "'many'"}},
      {"SampleTooMany",
       {"sample", "triangle.obj", "-n", "4"},
       2,
       {"4 samples were asked for", "3 vertices", "; ask for"}},
      {"SampleTooManyOfNothing",
       {"sample", "flat.obj", "-n", "9"},
       1,
       {"flat: the mesh has no face with area (1 face, ", "; check how it was exported"}},
      {"SampleFirst", {"sample", "bunny", "-n", "2", "--first", "99999"}, 2, {"99999"}},
      {"SampleLooseFirst",
       {"sample", "triangle.obj", "-n", "2", "--first", "3"},
       2,
       {"vertex 3 belongs to no face"}},
      {"SampleObj", {"sample", "bunny", "-n", "2", "-o", "a.obj"}, 2, {"no value per vertex"}},
      {"SampleList",
       {"sample", "bunny", "-n", "2", "--samples", "a.ply"},
       2,
       {".csv, .npy or .txt"}},
      {"SampleNoFolder", {"sample", "bunny", "-n", "2", "-o", "no/a.csv"}, 1, {"no folder"}},
      {"SampleLate",
       {"sample", "bunny", "-n", "2", "-o", "a.csv", "--samples", "/proc/a.csv"},
       1,
       {"/proc/a.csv"}},
  };
  return kRefusals;
}

class ProgramRefusals : public testing::TestWithParam<Refusal> {};

TEST_P(ProgramRefusals, AreOneLineWithTheCureAndLeaveNothing) {
  const TemporaryDirectory folder;
  const std::string triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 9 9 9\nf 1 2 3\n";
  folder.write("triangle.obj", triangle);
  folder.write("triangle.npy", triangle);
  folder.write("flat.obj", "v 1 1 1\nv 1 1 1\nv 1 1 1\nf 1 2 3\n");
  ASSERT_EQ(::symlink("/dev/full", folder.path("full.npy").c_str()), 0);
  const std::vector<std::string> before = folder.names();
  const ProgramRun run = run_program(folder.path("."), GetParam().arguments);
  EXPECT_EQ(run.code, GetParam().code);
  EXPECT_EQ(run.out, "");
  EXPECT_TRUE(run.err.starts_with("geotherm: error: ")) << run.err;
  EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
  for (const std::string& part : GetParam().says) {
    EXPECT_NE(run.err.find(part), std::string::npos) << "no \"" << part << "\" in " << run.err;
  }
  EXPECT_EQ(folder.names(), before);
}

INSTANTIATE_TEST_SUITE_P(Of, ProgramRefusals, testing::ValuesIn(refusals()),
                         [](const auto& test) { return std::string(test.param.name); });

}  // namespace
}  // namespace geotherm::test
