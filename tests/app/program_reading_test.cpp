// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/app/program.h"
#include "tests/mesh/mesh_files.h"

namespace geotherm::test {
namespace {

/// Two unit squares of two triangles each, side by side; the vertices 4 and 7 of the second lie a
/// thousandth beside 1 and 2 of the first.
constexpr const char* kCracked =
    "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 1.001 0 0\nv 2 0 0\nv 2 1 0\nv 1.001 1 0\n"
    "f 1 2 3\nf 1 3 4\nf 5 6 7\nf 5 7 8\n";

class Reading : public testing::Test {
 protected:
  Reading() { folder.write("cracked.obj", kCracked); }

  ProgramRun run(const std::vector<std::string>& words, const std::string& input = {}) {
    return run_program(folder.path(""), words, Stdout::kCaptured, 0, input);
  }
  nlohmann::json json(const std::vector<std::string>& words, const std::string& input = {}) {
    const ProgramRun result = run(words, input);
    EXPECT_EQ(result.code, 0) << result.err;
    return result.code == 0 ? nlohmann::json::parse(result.out) : nlohmann::json();
  }

  TemporaryDirectory folder;
};

TEST_F(Reading, AFileNamedLikeABundledModelIsSaidNotToBeIt) {
  folder.write("bunny", kCracked);
  const std::string warning =
      "warning: the bundled model bunny was taken, not the file of this name; write ./bunny for";
  EXPECT_NE(run({"solve", "bunny", "-s", "0"}).err.find(warning), std::string::npos);
  EXPECT_EQ(run({"solve", "./bunny", "--format", "obj", "-s", "0"}).err.find("bundled"),
            std::string::npos);
}

TEST_F(Reading, StandardInputIsAModelOfTheFormatThatIsNamed) {
  const auto words = [](const std::string& model) {
    return std::vector<std::string>{"solve", model, "--format", "obj", "-s", "0", "-o", "-"};
  };
  const ProgramRun piped = run(words("-"), folder.path("cracked.obj"));
  EXPECT_EQ(piped.code, 0) << piped.err;
  EXPECT_EQ(piped.out, run(words("cracked.obj")).out);
  const nlohmann::json info =
      json({"info", "-", "--format", "obj", "--json", "-"}, folder.path("cracked.obj"));
  EXPECT_EQ(info["model"]["name"], "standard input");
}

TEST_F(Reading, WeldingClosesACrackAndKeepsTheNumbers) {
  const nlohmann::json cracks = json({"info", "cracked.obj", "--json", "-"});
  EXPECT_EQ(cracks["cracks"]["vertices"], 2);
  const std::string distance = cracks["cracks"]["weld"].dump();
  EXPECT_NE(cracks["warnings"].dump().find("--weld " + distance), std::string::npos);

  EXPECT_EQ(json({"solve", "cracked.obj", "-s", "0", "--json", "-"})["distance"]["unreached"], 4);
  for (const char* method : {"heat", "exact"}) {
    const nlohmann::json solved =
        json({"solve", "cracked.obj", "-s", "7", "--weld", distance, "--method", method, "--refine",
              "1", "--json", "-", "-o", "d.csv"});
    EXPECT_EQ(solved["distance"]["unreached"], 0);
    EXPECT_EQ(solved["model"]["vertices"], 8);
    EXPECT_EQ(solved["options"]["refine"], 1);
    EXPECT_EQ(solved["sources"], nlohmann::json({2})) << "what stands for vertex 7";
    const std::string csv = bytes_of(folder.path("d.csv"));
    EXPECT_NE(csv.find("\n2,0\n"), std::string::npos) << csv;
    EXPECT_NE(csv.find("\n7,0\n"), std::string::npos) << csv;
  }
  EXPECT_TRUE(
      json({"info", "cracked.obj", "--weld", distance, "--json", "-"})["cracks"]["weld"].is_null());
}

TEST_F(Reading, EveryCommandWelds) {
  const std::vector<std::string> weld = {"--weld", "0.002", "--quiet"};
  for (std::vector<std::string> words : std::vector<std::vector<std::string>>{
           {"path", "cracked.obj", "--from", "0", "--to", "6", "-o", "p.csv"},
           {"isolines", "cracked.obj", "-s", "0", "--count", "3", "-o", "i.csv"},
           {"compare", "cracked.obj", "--queries", "1", "--csv", "c.csv", "--refine", "1"},
           {"study", "cracked.obj", "-s", "0", "--factors", "0.5:2:2", "--refine", "1"}}) {
    const std::string command = words.front();
    words.insert(words.end(), weld.begin(), weld.end());
    const ProgramRun result = run(words);
    EXPECT_EQ(result.code, 0) << command << ": " << result.err;
    EXPECT_EQ(result.err.find("no source"), std::string::npos);
  }
}

TEST_F(Reading, SaysWhatDoesNotGoWithTheModel) {
  struct Case {
    std::vector<std::string> words;
    int code;
    std::string says;
  };
  for (const Case& c : std::vector<Case>{
           {{"info", "-"}, 1, "nothing to read"},
           {{"info", "-", "--format", "blend"}, 2, "obj, ply, off, stl"},
           {{"info", "-", "--format", "obj"}, 1, "nothing to read"},
           {{"info", "bunny", "--format", "obj"}, 2, "bundled"},
           {{"view", "-", "--headless"}, 2, "standard input"},
           {{"info", "cracked.obj", "--weld", "-1"}, 2, "--weld: '-1'"},
           {{"info", "cracked.obj", "--weld", "nan"}, 2, "--weld: 'nan'"},
           {{"info", "cracked.obj", "--weld", "9"}, 2, "cracked.obj: every face collapses"},
           {{"solve", "cracked.obj", "-s", "0", "--refine", "7"}, 2, "0 to 6"}}) {
    const ProgramRun result = run(c.words);
    EXPECT_EQ(result.code, c.code) << result.err;
    EXPECT_EQ(result.out, "");
    EXPECT_NE(result.err.find(c.says), std::string::npos) << result.err;
    EXPECT_EQ(std::ranges::count(result.err, '\n'), 1) << result.err;
  }
}

}  // namespace
}  // namespace geotherm::test
