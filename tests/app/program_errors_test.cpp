// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/app/program.h"
#include "tests/mesh/mesh_files.h"

namespace geotherm::test {
namespace {

/// A command line that must fail. It is run in a folder with the files that write_files() makes.
struct Failure {
  const char* name;
  std::vector<std::string> arguments;
  int code;
  std::vector<std::string> says;  ///< all of it in the one line on standard error
};

void PrintTo(const Failure& failure, std::ostream* stream) { *stream << failure.name; }

void write_files(const TemporaryDirectory& folder) {
  folder.write("triangle.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 9 9 9\nf 1 2 3\n");
  folder.write("broken.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 7\n");
  folder.write("flat.obj", "v 1 1 1\nv 1 1 1\nv 1 1 1\nf 1 2 3\n");
  folder.write("empty.obj", "");
  folder.write("mesh.abc", "1 2 3\n");
  folder.write("plain.txt", "x\n");
  folder.write("bad_sources.txt", "0\n\n# a comment\nseven\n");
  folder.write("far_sources.txt", "0\n99999\n");
  folder.write("points.txt", "0\nface:0:1:0:0\n");
  folder.write("two.obj",
               "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 5 0 0\nv 6 0 0\nv 5 1 0\nf 1 2 3\nf 4 5 6\n");
  folder.write("apart.txt", "0\n4\n");
  folder.write("apart.png", "0\n4\n");
  folder.write("repeats.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 1 1\n");
  folder.write("mask.csv", "1\n1\n1\n1\n");
  folder.write("pairs.csv", "0 2\n");
  folder.write("weights.csv", "1,2\n");
  folder.write("lengths.npy", "x");
  folder.write("f_0001.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 9 9 9\nf 1 2 3\n");
  folder.write("given.txt", "2 1\n99 1\n");
  folder.write("no_vertex.geotherm", "source set 99\n");
  folder.write("nothing.txt", "# only a comment\n");
}

const std::vector<Failure>& failures() {
  static const std::vector<Failure> kFailures = {
      // The command line.
      {"NeitherCommandNorModel",
       {"rabbit"},
       2,
       {"no command and no model 'rabbit'", "view, solve"}},
      {"ViewOfNothing", {"view", "--headless"}, 2, {"nothing to do without a window", "--script"}},
      {"ViewSessionAndReplay", {"view", "a.geotherm", "--replay", "b"}, 2, {"one of them"}},
      {"ViewSessionWithSources", {"view", "a.geotherm", "-s", "3"}, 2, {"sources of its own"}},
      {"ViewMissingSession",
       {"view", "none.geotherm"},
       1,
       {"none.geotherm: no such file; check the path"}},
      {"ViewScriptAndReplay", {"view", "--script", "a", "--replay", "b"}, 2, {"one of them"}},
      {"ViewTurntable", {"view", "bunny", "--turntable", "3"}, 2, {"geotherm render"}},
      {"ViewScale", {"view", "bunny", "--scale", "9"}, 2, {"--scale", "0.5 to 4"}},
      {"ViewOutput", {"view", "bunny", "-o", "a.jpg"}, 2, {".png"}},
      {"ViewMissingScript",
       {"view", "--replay", "none.log"},
       1,
       {"none.log: no such file; check the path"}},
      {"UnknownCommand", {"frobnicate"}, 2, {"'frobnicate'", "there are view, solve"}},
      {"UnknownFlag", {"--frob"}, 2, {"--frob", "--help"}},
      {"UnknownOption", {"solve", "bunny", "--frob"}, 2, {"--frob", "geotherm solve --help"}},
      {"NoModel", {"solve", "-s", "1"}, 2, {"MODEL"}},
      {"TwoModels", {"solve", "-s", "1", "bunny", "cube"}, 2, {"cube"}},
      {"TwoCommands", {"backends", "models"}, 2, {"models"}},
      {"NoValue", {"solve", "bunny", "-s"}, 2, {"--source"}},
      {"NoSource", {"solve", "bunny"}, 2, {"no source", "-s 17"}},
      // Empty values.
      {"EmptyJson", {"solve", "bunny", "-s", "1", "--json", ""}, 2, {"--json: was given an empty"}},
      {"EmptyOutput", {"solve", "bunny", "-s", "1", "-o", ""}, 2, {"--output: was given an empty"}},
      {"FieldAndSources",
       {"render", "bunny", "--field", "f.npy", "-s", "1", "-o", "a.png"},
       2,
       {"--field", "not those of sources"}},
      {"FieldOfNoFile",
       {"render", "bunny", "--field", "f.npy", "-o", "a.png"},
       1,
       {"--field: f.npy: no such file"}},
      {"PageOfSolve", {"solve", "bunny", "-s", "1", "-o", "a.html"}, 2, {"render", "-o a.html"}},
      {"PictureOfSolve", {"solve", "bunny", "-s", "1", "-o", "a.png"}, 2, {"render", "-o a.png"}},
      {"EmptyCsv", {"compare", "bunny", "--csv", ""}, 2, {"--csv: was given", "leave it out"}},
      {"EmptyHtml", {"compare", "bunny", "--html", ""}, 2, {"--html: was given an empty value; "}},
      {"EmptyReference", {"compare", "bunny", "--reference", ""}, 2, {"--reference: was given"}},
      {"EmptySourceFile", {"solve", "bunny", "-s", "1", "--source-file", ""}, 2, {"--source-file"}},
      {"EmptyBackend", {"solve", "bunny", "-s", "1", "--backend", ""}, 2, {"--backend: was given"}},
      {"EmptyThreads", {"solve", "bunny", "-s", "1", "--threads", ""}, 2, {"--threads: was given"}},
      {"EmptyFactor", {"solve", "bunny", "-s", "1", "-m", ""}, 2, {"--time-factor: was given"}},
      {"EmptyFit", {"render", "bunny", "-o", "a.png", "--fit", ""}, 2, {"--fit: was given"}},
      {"EmptyDevice", {"render", "bunny", "-o", "a.png", "--device", ""}, 2, {"--device: was"}},
      {"EmptyRange", {"render", "bunny", "-o", "a.png", "--range", ""}, 2, {"--range: was given"}},
      {"EmptyModel", {"solve", "", "-s", "1"}, 2, {"MODEL: was given an empty value; give one"}},
      {"EmptyList", {"backends", "--json", ""}, 2, {"--json: was given an empty value"}},
      // Values of options.
      {"SourceText", {"solve", "bunny", "-s", "foo"}, 2, {"'foo'", "random:K"}},
      {"SourceNegative", {"solve", "bunny", "-s", "-1"}, 2, {"'-1'"}},
      {"SourceTooLarge", {"solve", "bunny", "-s", "99999"}, 2, {"99999", "vertices are 0 to"}},
      {"SourceInNoFace", {"solve", "triangle.obj", "-s", "3"}, 2, {"vertex 3", "no face"}},
      {"SourceNoBoundary", {"solve", "bunny", "-s", "boundary"}, 2, {"no boundary"}},
      {"SourceFace", {"solve", "bunny", "-s", "face:99999:1:0:0"}, 2, {"face 99999"}},
      {"SourceWeights", {"solve", "bunny", "-s", "face:1:1:1:1"}, 2, {"sum to 3"}},
      {"SourceRandom", {"solve", "bunny", "-s", "random:99999"}, 2, {"99,999"}},
      {"SourceRandomText", {"solve", "bunny", "-s", "random:x"}, 2, {"'random:x'", "; write"}},
      {"SourceNumber", {"solve", "bunny", "-s", "xyz:1:2:z"}, 2, {"'z'", "; write one"}},
      {"PenaltyText", {"solve", "bunny", "-s", "1", "--constraint", "penalty:x"}, 2, {"; write"}},
      {"TimeStepText", {"solve", "bunny", "-s", "1", "--time-step", "absolute:x"}, 2, {"; write"}},
      {"SourceXyz", {"solve", "bunny", "-s", "xyz:1:2"}, 2, {"xyz:x:y:z"}},
      {"CurveAlone", {"solve", "bunny", "-s", "1", "--curve"}, 2, {"--source-file"}},
      {"Backend", {"solve", "bunny", "-s", "1", "--backend", "magic"}, 2, {"'magic'", "cg"}},
      {"Method", {"solve", "bunny", "-s", "1", "--method", "magic"}, 2, {"'magic'", "heat"}},
      {"TimeStep", {"solve", "bunny", "-s", "1", "--time-step", "big"}, 2, {"mean-edge"}},
      {"TimeStepZero", {"solve", "bunny", "-s", "1", "--time-step", "absolute:0"}, 2, {"positive"}},
      {"TimeFactor", {"solve", "bunny", "-s", "1", "-m", "0"}, 2, {"--time-factor", "positive"}},
      {"TimeFactorNan", {"solve", "bunny", "-s", "1", "-m", "nan"}, 2, {"--time-factor"}},
      {"Constraint", {"solve", "bunny", "-s", "1", "--constraint", "glue"}, 2, {"pin-sources"}},
      {"Pin", {"solve", "bunny", "-s", "1", "--constraint", "pin-vertex:99999"}, 2, {"99999"}},
      {"Heat", {"solve", "bunny", "-s", "1", "--heat", "warm"}, 2, {"unit, diffuse, hold"}},
      {"Boundary", {"solve", "bunny", "-s", "1", "--boundary", "open"}, 2, {"neumann"}},
      {"Laplacian", {"solve", "bunny", "-s", "1", "--laplacian", "odd"}, 2, {"cotan"}},
      {"Variant", {"solve", "bunny", "-s", "1", "--variant", "odd"}, 2, {"corrected"}},
      {"Precision", {"solve", "bunny", "-s", "1", "--precision", "half"}, 2, {"refined"}},
      {"MemoryLimit",
       {"solve", "bunny", "-s", "1", "--memory-limit", "4T"},
       2,
       {"--memory-limit: '4T' is no size", "4G"}},
      {"MemoryOfFactors",
       {"solve", "bunny", "-s", "1", "--memory-limit", "100K", "--strict"},
       1,
       {"MB for 2 factors", "the limit is 0.0977 MB; raise --memory-limit"}},
      {"Threads", {"solve", "bunny", "-s", "1", "--threads", "-1"}, 2, {"--threads", "1 to"}},
      {"ThreadsText", {"solve", "bunny", "-s", "1", "--threads", "two"}, 2, {"--threads"}},
      {"Backends", {"compare", "bunny", "--backends", "magic"}, 2, {"'magic'", "cg"}},
      {"Reference", {"compare", "bunny", "--reference", "magic"}, 2, {"--reference", "'magic'"}},
      {"Queries", {"compare", "bunny", "--queries", "0"}, 2, {"--queries"}},
      {"GenerateName", {"generate", "dragon", "-o", "d.ply"}, 2, {"dragon", "terrain"}},
      {"GenerateFaces", {"generate", "bunny", "--faces", "3", "-o", "d.ply"}, 2, {"'3'", "500 to"}},
      {"GenerateNowhere", {"generate", "bunny"}, 2, {"--output"}},
      {"GenerateFormat", {"generate", "bunny", "-o", "d.xyz"}, 2, {".xyz", ".ply"}},
      // Output files, known to be wrong before the work.
      {"OutputObj", {"solve", "bunny", "-s", "1", "-o", "d.obj"}, 2, {"no value per vertex"}},
      {"OutputFormat", {"solve", "bunny", "-s", "1", "-o", "d.xyz"}, 2, {".xyz", ".csv"}},
      {"OutputTwice", {"solve", "bunny", "-s", "1", "-o", "d.csv", "-o", "./d.csv"}, 2, {"twice"}},
      {"StdoutTwice", {"solve", "bunny", "-s", "1", "-o", "-", "--json", "-"}, 2, {"twice"}},
      {"OutputIsModel",
       {"solve", "triangle.obj", "-s", "1", "--json", "triangle.obj"},
       2,
       {"model"}},
      {"OutputIsSourceFile",
       {"solve", "bunny", "--source-file", "apart.txt", "--json", "./apart.txt"},
       2,
       {"--json", "apart.txt is the file of --source-file; give another name"}},
      {"PictureIsSourceFile",
       {"render", "bunny", "--source-file", "apart.png", "-o", "apart.png"},
       2,
       {"--output", "is the file of --source-file"}},
      {"TableIsSourceFile",
       {"compare", "bunny", "--source-file", "apart.txt", "--csv", "apart.txt"},
       2,
       {"--csv", "is the file of --source-file"}},
      {"PageIsSecondModel",
       {"compare", "bunny", "triangle.obj", "--html", "triangle.obj"},
       2,
       {"--html", "is the model itself"}},
      {"OutputIsMask",
       {"solve", "triangle.obj", "-s", "1", "--mask", "keep:mask.csv", "-o", "mask.csv"},
       2,
       {"--output: mask.csv is the file of --mask; give another name"}},
      {"LengthsArePairs",
       {"path", "triangle.obj", "--pairs", "pairs.csv", "--lengths", "./pairs.csv"},
       2,
       {"--lengths: ./pairs.csv is the file of --pairs"}},
      {"LinesArePairs",
       {"path", "triangle.obj", "--pairs", "pairs.csv", "-o", "pairs.csv"},
       2,
       {"--output: pairs.csv is the file of --pairs"}},
      {"LinesAreWeights",
       {"centre", "triangle.obj", "--of", "0,1", "--weights", "weights.csv", "-o", "weights.csv"},
       2,
       {"--output: weights.csv is the file of --weights"}},
      {"ReportIsField",
       {"render", "bunny", "--field", "lengths.npy", "--json", "lengths.npy", "-o", "a.png"},
       2,
       {"--json: lengths.npy is the file of --field"}},
      {"ReportIsAFrame",
       {"solve", "triangle.obj", "--sequence", "f_%04d.obj", "-s", "1", "-o", "a.npy", "--json",
        "f_0001.obj"},
       2,
       {"--json: f_0001.obj is the file of --sequence"}},
      {"NoFolder", {"solve", "bunny", "-s", "1", "-o", "no/d.csv"}, 1, {"no/d.csv", "no folder"}},
      {"FolderIsFile", {"solve", "bunny", "-s", "1", "-o", "plain.txt/d.csv"}, 1, {"no folder"}},
      {"OutputIsFolder", {"solve", "bunny", "-s", "1", "--json", "."}, 1, {"folder"}},
      {"InfoNoFolder", {"info", "bunny", "--json", "no/d.json"}, 1, {"no/d.json"}},
      {"CompareNoFolder", {"compare", "bunny", "--html", "no/d.html"}, 1, {"no/d.html"}},
      {"GenerateNoFolder", {"generate", "bunny", "-o", "no/d.ply"}, 1, {"no/d.ply"}},
      {"SecondOutput", {"solve", "bunny", "-s", "1", "-o", "d.csv", "-o", "no/d.csv"}, 1, {"no/d"}},
      // Output files that turn out to be wrong when they are written.
      {"LateOutput", {"solve", "bunny", "-s", "1", "-o", "/proc/d.csv"}, 1, {"/proc/d.csv"}},
      {"LateSecondOutput",
       {"solve", "bunny", "-s", "1", "-o", "d.csv", "--json", "/proc/d.json"},
       1,
       {"/proc/d.json"}},
      {"LateGenerate", {"generate", "bunny", "-o", "/proc/d.ply"}, 1, {"/proc/d.ply"}},
      // Files that cannot be used.
      {"NoFile",
       {"solve", "missing.obj", "-s", "1"},
       1,
       {"missing.obj", "no such file; check the path"}},
      {"NoBundled", {"solve", "bunnny", "-s", "1"}, 1, {"bunnny", "terrain"}},
      {"BrokenFile",
       {"info", "broken.obj"},
       1,
       {"broken.obj", "line 4", "7", "; choose another file"}},
      {"EmptyFile", {"info", "empty.obj"}, 1, {"empty.obj", "empty (0 bytes); "}},
      {"UnknownFormat", {"info", "mesh.abc"}, 1, {".abc", "obj ply", "xyz", "vtu"}},
      {"ModelIsFolder", {"info", "."}, 1, {"directory"}},
      {"NoArea", {"solve", "flat.obj", "-s", "0"}, 1, {"flat", "no face with area"}},
      {"CompareNoFile", {"compare", "bunny", "missing.obj"}, 1, {"missing.obj"}},
      {"SourceFileMissing",
       {"solve", "bunny", "--source-file", "none.txt"},
       1,
       {"none.txt", "; check"}},
      {"SourceFileEmpty", {"solve", "bunny", "--source-file", "nothing.txt"}, 1, {"no source"}},
      {"SourceFileFolder", {"solve", "bunny", "--source-file", "."}, 1, {"folder"}},
      {"SourceFileLine", {"solve", "bunny", "--source-file", "bad_sources.txt"}, 1, {"line 4"}},
      {"SourceFileRange", {"solve", "bunny", "--source-file", "far_sources.txt"}, 1, {"line 2"}},
      {"CurvePoint", {"solve", "bunny", "--source-file", "points.txt", "--curve"}, 1, {"line 2"}},
      {"CurveApart",
       {"solve", "two.obj", "--source-file", "apart.txt", "--curve"},
       1,
       {"line 2", "different components"}},
      // What does not go with the model is the command line's; what is not in it, the work's.
      {"ValueOfNoVertex",
       {"extend", "triangle.obj", "--value", "99:1"},
       2,
       {"--value 99:1: there is no vertex 99; vertices are 0 to 3"}},
      {"VectorOfNoVertex",
       {"transport", "triangle.obj", "--vector", "99:1:0"},
       2,
       {"--vector 99:1:0: there is no vertex 99"}},
      {"ValueOfNoFace",
       {"extend", "triangle.obj", "--value", "3:1"},
       2,
       {"--value 3:1: vertex 3 belongs to no face, and no distance is there"}},
      {"ValuesOfNoVertex",
       {"extend", "triangle.obj", "--values", "given.txt"},
       1,
       {"given.txt: line 2: there is no vertex 99"}},
      {"OffsetOfHeat",
       {"solve", "triangle.obj", "-s", "0@0.5"},
       2,
       {"takes no offsets", "use --method wavefront"}},
      {"GridOfTriangles", {"solve", "triangle.obj", "-s", "0", "--grid", "mask"}, 2, {"--grid"}},
      {"WeightBelow",
       {"centre", "triangle.obj", "--of", "0,1", "--weights", "1,-1"},
       2,
       {"--weights: '-1' is no weight; give numbers from 0"}},
      {"WeightsOfNone",
       {"centre", "triangle.obj", "--of", "0,1", "--weights", "0,0"},
       2,
       {"--weights: none is above 0"}},
      {"WeightMissing",
       {"centre", "triangle.obj", "--of", "0,1", "--weights", "1"},
       2,
       {"--weights: 1 weight for 2 points; give one for each"}},
      {"CurveOfOnePoint",
       {"signed", "triangle.obj", "--through", "0"},
       2,
       {"--through: a curve has two points or more; give it once for each point"}},
      {"ValuesThatAreNone",
       {"extend", "triangle.obj", "--values", "points.txt"},
       1,
       {"points.txt: line ", "is no value at a vertex"}},
      {"PairsThatAreNone",
       {"path", "triangle.obj", "--pairs", "given.txt"},
       1,
       {"given.txt: line 2", "there is no vertex 99"}},
      {"PointThatIsNone",
       {"path", "triangle.obj", "--from", "boundary", "--to", "x"},
       2,
       {"--from: 'boundary' is not one point; write a vertex id, face:ID:b0:b1:b2 or xyz:x:y:z"}},
      {"MethodAsBackend",
       {"solve", "triangle.obj", "-s", "0", "--backend", "wavefront"},
       2,
       {"there is no backend 'wavefront'", "wavefront is a method: use --method wavefront"}},
      {"HeatAsBackend",
       {"compare", "triangle.obj", "--backends", "heat"},
       2,
       {"heat runs on a backend: name one of native"}},
      {"ScriptOfNoVertex",
       {"view", "triangle.obj", "--headless", "--script", "no_vertex.geotherm"},
       2,
       {"no_vertex.geotherm: line 1: ", "there is no vertex 99"}},
      {"CurveOfOnePlace",
       {"signed", "triangle.obj", "--through", "0", "--through", "0"},
       2,
       {"--through: the points are in one place"}},
      {"PathApart",
       {"path", "two.obj", "--from", "0", "--to", "4"},
       1,
       {"two: --to 4: no edges lead", "different components"}},
      {"SignedApart",
       {"signed", "two.obj", "--through", "0", "--through", "4"},
       1,
       {"two: --through: no edges lead", "different components"}},
      {"TargetOfNoVertex",
       {"solve", "triangle.obj", "-s", "0", "--target", "99"},
       2,
       {"error: --target 99: there is no vertex 99"}},
      {"TargetOfNoFace",
       {"solve", "triangle.obj", "-s", "0", "--target", "3"},
       2,
       {"error: --target 3: vertex 3 belongs to no face, and no distance is there"}},
      {"LengthBelow",
       {"trace", "triangle.obj", "--from", "0", "--length", "-1"},
       2,
       {"--length: -1 is below 0; give a length"}},
      {"SourceOfRepeats",
       {"solve", "repeats.obj", "-s", "0"},
       2,
       {"vertex 0 belongs to no face (those that repeat a corner"}},
  };
  return kFailures;
}

class ProgramFailures : public testing::TestWithParam<Failure> {};

TEST_P(ProgramFailures, AreOneLineWithTheCureAndLeaveNothing) {
  const TemporaryDirectory folder;
  write_files(folder);
  const std::vector<std::string> before = folder.names();
  const ProgramRun run = run_program(folder.path("."), GetParam().arguments);
  EXPECT_EQ(run.code, GetParam().code);
  EXPECT_EQ(run.out, "");
  EXPECT_TRUE(run.err.starts_with("geotherm: error: ")) << run.err;
  EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
  EXPECT_TRUE(run.err.ends_with('\n'));
  for (const std::string& part : GetParam().says) {
    EXPECT_NE(run.err.find(part), std::string::npos) << "no \"" << part << "\" in " << run.err;
  }
  EXPECT_EQ(folder.names(), before);
}

INSTANTIATE_TEST_SUITE_P(Of, ProgramFailures, testing::ValuesIn(failures()),
                         [](const auto& test) { return std::string(test.param.name); });

TEST(ProgramStreams, AFullStandardOutputIsAnError) {
  const TemporaryDirectory folder;
  for (const std::vector<std::string>& arguments :
       {std::vector<std::string>{"models"}, {"solve", "bunny", "-s", "1", "-o", "-"}}) {
    const ProgramRun run = run_program(folder.path("."), arguments, Stdout::kFull);
    EXPECT_EQ(run.code, 1);
    EXPECT_NE(run.err.find("standard output: cannot be written"), std::string::npos) << run.err;
  }
}

TEST(ProgramStreams, AFullStandardOutputLeavesNoFile) {
  const TemporaryDirectory folder;
  for (const std::vector<std::string>& arguments :
       {std::vector<std::string>{"solve", "bunny", "-s", "1", "-o", "a.csv", "--json", "-"},
        {"solve", "bunny", "-s", "1", "-o", "a.csv"},
        {"compare", "bunny", "--queries", "1", "--csv", "a.csv"},
        {"generate", "bunny", "-o", "a.ply"},
        {"info", "bunny", "--json", "a.json"},
        {"models", "--json", "a.json"}}) {
    EXPECT_EQ(run_program(folder.path("."), arguments, Stdout::kFull).code, 1);
    EXPECT_EQ(folder.names(), std::vector<std::string>{}) << arguments.front();
  }
}

TEST(ProgramStreams, AClosedStandardOutputIsAnErrorAndGetsIntoNoFile) {
  const TemporaryDirectory folder;
  folder.write("d.csv", "old");
  const ProgramRun run =
      run_program(folder.path("."), {"solve", "bunny", "-s", "1", "-o", "d.csv"}, Stdout::kClosed);
  EXPECT_EQ(run.code, 1);
  EXPECT_NE(run.err.find("standard output: cannot be written"), std::string::npos) << run.err;
  EXPECT_EQ(bytes_of(folder.path("d.csv")).substr(0, 16), "vertex,distance\n");
}

TEST(ProgramStreams, APipeWithoutReaderEndsTheProgramSilently) {
  constexpr int kBrokenPipe = 128 + 13;
  const TemporaryDirectory folder;
  const ProgramRun run =
      run_program(folder.path("."), {"solve", "bunny", "-s", "1", "-o", "-", "--quiet"},
                  Stdout::kPipeWithoutReader);
  EXPECT_EQ(run.code, kBrokenPipe);
  EXPECT_EQ(run.err, "");
}

}  // namespace
}  // namespace geotherm::test
