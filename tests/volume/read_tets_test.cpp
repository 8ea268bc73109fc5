// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <random>

#include "geotherm/domains.h"
#include "tests/mesh/mesh_files.h"
#include "tests/volume/tet_files.h"

namespace geotherm::test {
namespace {

void expect_small_box(const TetMesh& mesh) {
  const TetMesh& box = small_box();
  ASSERT_EQ(mesh.vertex_count(), 8);
  ASSERT_EQ(mesh.tet_count(), 6);
  for (Index v = 0; v < 8; ++v) EXPECT_EQ(mesh.positions()[v], box.positions()[v]) << v;
  for (Index t = 0; t < 6; ++t) EXPECT_EQ(mesh.tets()[t], box.tets()[t]) << t;
}

class TetReader : public testing::TestWithParam<TetSample> {};

TEST_P(TetReader, GivesTheVolumeAndSaysWhatItLeftOut) {
  const TemporaryDirectory directory;
  const std::string path = directory.write(GetParam().file, GetParam().bytes);
  EXPECT_TRUE(holds_tets(*ModelInput::open(path)));
  const Result<TetFile> file = read_tets(path);
  ASSERT_TRUE(file) << sentence(file.error());
  expect_small_box(file->mesh);
  ASSERT_FALSE(file->notes.empty());
  EXPECT_EQ(file->notes[0].substr(0, 12),
            GetParam().name.find("Sparse") != std::string::npos || GetParam().name == "Gmsh2Binary"
                ? "vertices are"
                : "left out, be");
  EXPECT_EQ(file->notes.back(), "left out, being no tetrahedra with 4 corners: triangles (2)");
}

TEST_P(TetReader, TakesLinesThatEndAsInDos) {
  std::string bytes;
  if (GetParam().bytes.find('\0') != std::string::npos) return;
  if (GetParam().name == "VtuRaw") return;
  for (const char c : GetParam().bytes) bytes += c == '\n' ? "\r\n" : std::string(1, c);
  if (bytes.find("METADATA") != std::string::npos) return;  // ends at an empty line
  const TemporaryDirectory directory;
  const Result<TetFile> file = read_tets(directory.write(GetParam().file, bytes));
  ASSERT_TRUE(file) << sentence(file.error());
  expect_small_box(file->mesh);
}

TEST_P(TetReader, SaysOneLineWhereverTheFileEnds) {
  const TemporaryDirectory directory;
  const std::string& bytes = GetParam().bytes;
  const std::size_t step = std::max<std::size_t>(1, bytes.size() / 150);
  for (std::size_t size = 1; size < bytes.size(); size += step) {
    const std::string path = directory.write(GetParam().file, bytes.substr(0, size));
    const Result<TetFile> file = read_tets(path);
    if (file) {
      ASSERT_GT(file->mesh.tet_count(), 0);
    } else {
      const std::string said = sentence(file.error());
      ASSERT_TRUE(said.starts_with(path + ": ")) << said;
      ASSERT_EQ(said.find('\n'), said.npos) << said;
    }
  }
}

/// One small damage: bytes flipped, cut off, inserted, copied elsewhere, a number made extreme.
void damage_tets(std::string& bytes, std::mt19937_64& random) {
  constexpr std::string_view kWords[] = {"2147483647", "-1",   "nan", "1e999", "99999999999999999",
                                         "\n",         "\"/>", "$",   "#",     "0"};
  const auto below = [&random](std::size_t bound) { return random() % bound; };
  if (bytes.empty()) bytes.push_back('v');
  const std::size_t at = below(bytes.size());
  switch (below(7)) {
    case 0:
      bytes[at] = static_cast<char>(bytes[at] ^ (1 << below(8)));
      break;
    case 1:
      bytes[at] = static_cast<char>(random());
      break;
    case 2:
      bytes.resize(at);
      break;
    case 3:
      bytes.insert(at, kWords[below(std::size(kWords))]);
      break;
    case 4:
      bytes.erase(at, 1 + below(8));
      break;
    case 5:
      for (std::size_t k = at; k < std::min(bytes.size(), at + 8); ++k) bytes[k] = '\xff';
      break;
    default: {
      const std::string piece = bytes.substr(at, 1 + below(64));
      bytes.insert(below(bytes.size()), piece);
    }
  }
}

void expect_volume_or_line(const std::string& path) {
  const Result<TetFile> file = read_tets(path);
  if (file) {
    ASSERT_GT(file->mesh.tet_count(), 0);
    return;
  }
  const std::string said = sentence(file.error());
  ASSERT_LT(said.size(), path.size() + 300) << said;
  for (const char c : said) ASSERT_TRUE(c >= ' ' && c < 0x7f) << said;
}

TEST(TetFuzz, DamagedFilesGiveAVolumeOrOneLine) {
  constexpr int kInputs = 100;  // for each of 21 samples
  const TemporaryDirectory directory;
  std::mt19937_64 random(20261);
  for (const TetSample& sample : tet_samples()) {
    for (int i = 0; i < kInputs; ++i) {
      std::string bytes = sample.bytes;
      for (std::size_t k = 1 + random() % 4; k > 0; --k) damage_tets(bytes, random);
      expect_volume_or_line(directory.write(sample.file, bytes));
    }
  }
}

TEST(TetFuzz, DamagedPairsOfTetgenGiveAVolumeOrOneLine) {
  const TemporaryDirectory directory;
  std::mt19937_64 random(20262);
  for (int i = 0; i < 100; ++i) {
    std::string node = node_text(i % 2), ele = ele_text(i % 2);
    damage_tets(i % 3 == 0 ? ele : node, random);
    directory.write("a.node", node);
    expect_volume_or_line(directory.write("a.ele", ele));
  }
}

TEST(TetReaderTetgen, TakesEitherFileAndEitherFirstNumber) {
  for (const int first : {0, 1}) {
    const TemporaryDirectory directory;
    const std::string node = directory.write("a.1.node", node_text(first));
    const std::string ele = directory.write("a.1.ele", ele_text(first));
    for (const std::string& path : {node, ele}) {
      EXPECT_TRUE(holds_tets(*ModelInput::open(path)));
      const Result<TetFile> file = read_tets(path);
      ASSERT_TRUE(file) << sentence(file.error());
      expect_small_box(file->mesh);
    }
  }
}

TEST(TetReaderTetgen, NamesTheFileThatIsMissingOrWrong) {
  const TemporaryDirectory directory;
  const std::string node = directory.write("A.NODE", node_text(1));
  EXPECT_EQ(sentence(read_tets(node).error()),
            directory.path("A.ELE") + ": no such file; check the path");
  directory.write("A.ELE", ele_text(0));
  EXPECT_EQ(sentence(read_tets(node).error()),
            directory.path("A.ELE") +
                ": line 2: vertex 0 is used, but the .node file has 8 "
                "vertices (1 to 8) in tetrahedron 1 of 6");
}

TEST(TetSniffing, LooksAtTheBeginningWhereTheExtensionDoesNotTell) {
  const TemporaryDirectory directory;
  const auto holds = [&](const char* name, const std::string& bytes) {
    return holds_tets(*ModelInput::open(directory.write(name, bytes)));
  };
  EXPECT_FALSE(holds("a.msh", "(0 \"Fluent\")\n"));
  EXPECT_FALSE(holds("a.vtk", "# vtk DataFile Version 3.0\nt\nASCII\nDATASET STRUCTURED_POINTS\n"));
  EXPECT_FALSE(holds("a.vtu", "<VTKFile type=\"PolyData\">"));
  EXPECT_FALSE(holds("a.obj", "v 0 0 0\n"));
  EXPECT_TRUE(holds("a.mesh", "anything"));
}

INSTANTIATE_TEST_SUITE_P(Samples, TetReader, testing::ValuesIn(tet_samples()),
                         [](const auto& test) { return test.param.name; });

}  // namespace
}  // namespace geotherm::test
