// SPDX-License-Identifier: MIT
// Scenes that others draw, from the built program: glTF files and colours in PLY.
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <map>

#include "tests/app/program_fixture.h"

namespace geotherm::test {
namespace {

template <class Number>
Number number_at(const std::string& bytes, std::size_t at) {
  Number number{};
  if (at + sizeof(number) <= bytes.size()) std::memcpy(&number, bytes.data() + at, sizeof(number));
  return number;
}

/// A binary glTF file, taken apart as its specification says.
struct Glb {
  Json json;
  std::string binary;
  bool sound = false;

  explicit Glb(const std::string& bytes) {
    const auto word = [&](std::size_t at) { return number_at<std::uint32_t>(bytes, at); };
    const std::size_t length = word(12), begin = 20 + length;
    sound = bytes.starts_with("glTF") && word(4) == 2 && word(8) == bytes.size() &&
            word(16) == 0x4E4F534A && length % 4 == 0 && word(begin + 4) == 0x004E4942 &&
            begin + 8 + word(begin) == bytes.size();
    if (!sound) return;
    json = Json::parse(bytes.substr(20, length), nullptr, false);
    binary = bytes.substr(begin + 8);
    sound = !json.is_discarded() && json["buffers"][0]["byteLength"] == binary.size();
  }

  /// The numbers of an accessor, which must lie in the buffer.
  template <class Number>
  std::vector<Number> numbers(int accessor) const {
    const Json& of = json["accessors"][static_cast<std::size_t>(accessor)];
    const Json& view = json["bufferViews"][of["bufferView"].get<std::size_t>()];
    const std::map<std::string, std::size_t> parts = {{"SCALAR", 1}, {"VEC3", 3}, {"VEC4", 4}};
    const std::size_t count = of["count"].get<std::size_t>() * parts.at(of["type"]);
    const std::size_t start = view["byteOffset"];
    EXPECT_EQ(start % 4, 0U);
    EXPECT_EQ(view["byteLength"], count * sizeof(Number));
    EXPECT_LE(start + count * sizeof(Number), binary.size());
    std::vector<Number> out;
    for (std::size_t i = 0; i < count; ++i) {
      out.push_back(number_at<Number>(binary, start + i * sizeof(Number)));
    }
    return out;
  }

  const Json& primitive(std::size_t mesh = 0) const {
    return json["meshes"][mesh]["primitives"][0];
  }
};

class ProgramScene : public Program {
 protected:
  Glb glb(const std::vector<std::string>& more) {
    std::vector<std::string> arguments = {"render"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    arguments.insert(arguments.end(), {"-o", "a.glb"});
    run(arguments);
    Glb file(bytes_of(folder.path("a.glb")));
    EXPECT_TRUE(file.sound);
    return file;
  }
};

/// A square far from the origin, and a triangle that no source of the square reaches.
constexpr const char* kFarSquare =
    "v 1e7 0 0\nv 10000000.25 0 0\nv 10000000.25 0.25 0\nv 1e7 0.25 0\n"
    "v 1e7 0 1\nv 10000000.5 0 1\nv 1e7 0.5 1\nf 1 2 3\nf 1 3 4\nf 5 6 7\n";

TEST_F(ProgramScene, GltfHoldsTheSurfaceItsColoursAndDistances) {
  const Glb file = glb({"bunny", "-s", "17"});
  const double largest = json({"solve", "bunny", "-s", "17", "--json", "-"})["distance"]["max"];
  const Json& attributes = file.primitive()["attributes"];
  const auto positions = file.numbers<float>(attributes["POSITION"]);
  const auto normals = file.numbers<float>(attributes["NORMAL"]);
  const auto colours = file.numbers<std::uint16_t>(attributes["COLOR_0"]);
  const auto distances = file.numbers<float>(attributes["_DISTANCE"]);
  const auto corners = file.numbers<std::uint32_t>(file.primitive()["indices"]);
  ASSERT_EQ(positions.size(), normals.size());
  ASSERT_EQ(colours.size(), 4 * distances.size());
  for (const std::uint32_t corner : corners) ASSERT_LT(corner, distances.size());
  for (const float d : distances) ASSERT_TRUE(std::isfinite(d) && d >= 0);
  EXPECT_NEAR(*std::ranges::max_element(distances), largest, 1e-5 * largest);
  for (std::size_t i = 0; i < normals.size(); i += 3) {
    EXPECT_NEAR(std::hypot(normals[i], normals[i + 1], normals[i + 2]), 1, 1e-4);
  }
  const Json& bounds = file.json["accessors"][attributes["POSITION"].get<std::size_t>()];
  for (std::size_t k = 0; k < 3; ++k) {
    float least = positions[k], most = positions[k];
    for (std::size_t i = k; i < positions.size(); i += 3) {
      least = std::min(least, positions[i]);
      most = std::max(most, positions[i]);
    }
    EXPECT_EQ(bounds["min"][k], least);
    EXPECT_EQ(bounds["max"][k], most);
  }
  const auto near =
      static_cast<std::size_t>(std::ranges::min_element(distances) - distances.begin());
  EXPECT_GT(colours[4 * near], colours[4 * near + 2]) << "red where distance is 0";
  const std::string extras = file.json["asset"]["extras"].dump();
  EXPECT_NE(extras.find("render bunny"), std::string::npos) << extras;
}

TEST_F(ProgramScene, GltfLosesNothingFarFromTheOriginAndHasNoInfinity) {
  folder.write("far.obj", kFarSquare);
  const Glb file = glb({"far.obj", "-s", "0"});
  const Json& attributes = file.primitive()["attributes"];
  const auto positions = file.numbers<float>(attributes["POSITION"]);
  const double shift = file.json["nodes"][0]["translation"][0];
  std::vector<double> xs;
  for (std::size_t i = 0; i < positions.size(); i += 3) xs.push_back(shift + positions[i]);
  EXPECT_NEAR(*std::ranges::min_element(xs), 1e7, 1e-6);
  EXPECT_NEAR(*std::ranges::max_element(xs), 1e7 + 0.5, 1e-6);
  const auto distances = file.numbers<float>(attributes["_DISTANCE"]);
  EXPECT_EQ(std::ranges::count(distances, -1.0F), 3) << "those that no source reaches";
  EXPECT_EQ(file.json["meshes"][0]["extras"]["unreached"], -1);
}

TEST_F(ProgramScene, GltfOfOtherViewsAndPaths) {
  EXPECT_FALSE(glb({"bunny", "--view", "flat"}).primitive()["attributes"].contains("NORMAL"));
  const Glb quality = glb({"bunny", "--view", "triangle-quality"});
  EXPECT_EQ(quality.numbers<float>(quality.primitive()["attributes"]["POSITION"]).size() / 9,
            quality.numbers<std::uint32_t>(quality.primitive()["indices"]).size() / 3)
      << "each face has a colour of its own";
  const Glb path = glb({"bunny", "-s", "0", "--path", "1500", "--light", "none"});
  EXPECT_EQ(path.primitive(1)["mode"], 3);
  EXPECT_EQ(path.json["materials"][0]["extensions"].count("KHR_materials_unlit"), 1U);
}

TEST_F(ProgramScene, GltfStandsUprightAndReadsBack) {
  const auto bounds = [](const Glb& file) {
    const int positions = file.primitive()["attributes"]["POSITION"];
    const Json& of = file.json["accessors"][static_cast<std::size_t>(positions)];
    return Json({of["min"], of["max"]});
  };
  const Glb plain = glb({"bunny", "--view", "smooth"});
  EXPECT_EQ(plain.json["nodes"].size(), 1U);
  const Glb turned = glb({"bunny", "--view", "smooth", "--up", "z"});
  EXPECT_EQ(bounds(turned), bounds(plain));
  ASSERT_EQ(turned.json["scenes"][0]["nodes"], Json::array({1}));
  const Json& root = turned.json["nodes"][1];
  EXPECT_EQ(root["children"], Json::array({0}));
  const double half = std::sqrt(0.5);  // a quarter turn about x takes z to y
  EXPECT_NEAR(root["rotation"][0].get<double>(), -half, 1e-12);
  EXPECT_NEAR(root["rotation"][3].get<double>(), half, 1e-12);
  if (run_program(folder.path("."), {"info", "a.glb"}).code != 0) {
    GTEST_SKIP() << "this build reads no glTF";
  }
  std::filesystem::rename(folder.path("a.glb"), folder.path("b.glb"));
  const Glb again = glb({"b.glb", "--view", "smooth"});
  for (std::size_t end = 0; end < 2; ++end) {
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_NEAR(bounds(again)[end][k].get<double>(), bounds(plain)[end][k].get<double>(), 1e-6);
    }
  }
  EXPECT_EQ(again.json["nodes"], turned.json["nodes"]);
}

TEST_F(ProgramScene, GltfColoursAreThoseOfTheScale) {
  const std::vector<std::string> scene = {"bunny", "-s", "17", "--range", "0.05:2"};
  std::vector<std::string> log = scene;
  log.insert(log.end(), {"--colour-scale", "log"});
  const auto blue_of = [](const Glb& file) {  // of the vertex whose distance is next to 0.5
    const Json& attributes = file.primitive()["attributes"];
    const auto distances = file.numbers<float>(attributes["_DISTANCE"]);
    const auto next = std::ranges::min_element(
        distances, {}, [](float distance) { return std::abs(distance - 0.5F); });
    const auto at = static_cast<std::size_t>(next - distances.begin());
    return file.numbers<std::uint16_t>(attributes["COLOR_0"])[4 * at + 2];
  };
  EXPECT_GT(blue_of(glb(log)), blue_of(glb(scene))) << "0.62 of the way instead of 0.23";
}

TEST_F(ProgramScene, GltfIsValidForKhronos) {
  const char* const folder_of = std::getenv("GEOTHERM_GLTF_VALIDATOR");
  if (folder_of == nullptr) {
    GTEST_SKIP() << "GEOTHERM_GLTF_VALIDATOR names no folder with node_modules/gltf-validator";
  }
  folder.write("far.obj", kFarSquare);
  folder.write("check.js",
               "const v = require(process.argv[2] + '/node_modules/gltf-validator');\n"
               "v.validateBytes(new Uint8Array(require('fs').readFileSync(process.argv[3])))\n"
               "  .then((r) => { const i = r.issues; console.log(JSON.stringify(i));\n"
               "    process.exit(i.numErrors + i.numWarnings); });\n");
  const std::vector<std::vector<std::string>> scenes = {
      {"bunny", "-s", "17"},
      {"far.obj", "-s", "0"},
      {"bunny", "--view", "flat"},
      {"bunny", "-s", "0", "--path", "1500", "--light", "none"},
      {"cube", "-s", "0", "-s", "900", "--view", "regions", "--slice", "x"},
      {"bunny", "-s", "0", "--view", "eikonal-error"}};
  for (const auto& scene : scenes) {
    glb(scene);
    const std::string command = "node " + folder.path("check.js") + " " + folder_of + " " +
                                folder.path("a.glb") + " > " + folder.path("said.txt") + " 2>&1";
    EXPECT_EQ(std::system(command.c_str()), 0) << bytes_of(folder.path("said.txt"));
  }
}

TEST_F(ProgramScene, ScenesSayWhatTheyHaveNoPlaceFor) {
  const ProgramRun glb =
      run({"render", "bunny", "-s", "0", "--azimuth", "5", "--no-bar", "-o", "a.glb"});
  EXPECT_NE(glb.err.find("no place for"), std::string::npos) << glb.err;
  EXPECT_NE(glb.err.find("azimuth"), std::string::npos) << glb.err;
  const ProgramRun paths = run({"render", "bunny", "-s", "0", "--path", "9", "--path-kind", "all",
                                "--colour-scale", "log", "--bands", "4", "-o", "a.glb"});
  EXPECT_NE(paths.err.find("no place for bands\n"), std::string::npos) << paths.err;
  EXPECT_EQ(paths.out.find("bands"), std::string::npos) << paths.out;
  EXPECT_NE(run({"render", "bunny", "--view", "wireframe", "-o", "a.glb"}).err.find("the edges"),
            std::string::npos);
  const ProgramRun page =
      run({"render", "bunny", "-s", "0", "--azimuth", "5", "--samples", "1", "-o", "a.html"});
  EXPECT_NE(page.err.find("samples"), std::string::npos) << page.err;
  EXPECT_EQ(page.err.find("azimuth"), std::string::npos) << page.err;
  expect_refused({"render", "bunny", "-s", "0", "--turntable", "4", "-o", "a.html"},
                 "turned by whoever looks at it");
}

TEST_F(ProgramScene, PlyTakesColoursOfTheDistances) {
  run({"solve", "bunny", "-s", "17", "--bake-colours", "-o", "a.ply", "-o", "a.csv"});
  const std::string bytes = bytes_of(folder.path("a.ply"));
  EXPECT_NE(bytes.find("property uchar red\nproperty uchar green\nproperty uchar blue\n"),
            std::string::npos);
  const std::size_t body = bytes.find("end_header\n") + 11;
  constexpr std::size_t kVertex = 3 * 8 + 8 + 4 + 3;
  const auto colour_at = [&](std::size_t v, std::size_t k) {
    return number_at<std::uint8_t>(bytes, body + v * kVertex + 36 + k);
  };
  EXPECT_GT(colour_at(17, 0), colour_at(17, 2)) << "near is red";
  EXPECT_EQ(bytes_of(folder.path("a.csv")).find("red"), std::string::npos);
  run({"solve", "bunny", "-s", "17", "--bake-colours=viridis", "-o", "b.ply"});
  EXPECT_NE(bytes_of(folder.path("b.ply")), bytes);
  expect_refused({"solve", "bunny", "-s", "17", "--bake-colours=sunset", "-o", "b.ply"}, "viridis");
  expect_refused({"solve", "bunny", "-s", "17", "--bake-colours", "-o", "b.csv"}, "FILE.ply");
}

}  // namespace
}  // namespace geotherm::test
