// SPDX-License-Identifier: MIT
// Surfaces and masks of the brain, in files that nibabel wrote (tests/fuzz/corpus), and masks.
#include <gtest/gtest.h>

#include <filesystem>

#include "geotherm/io.h"
#include "tests/mesh/mesh_files.h"

namespace geotherm::test {
namespace {

namespace fs = std::filesystem;

std::string corpus(const std::string& name) {
  return (fs::path(__FILE__).parent_path().parent_path() / "fuzz" / "corpus" / name).string();
}

/// A pyramid without its base: its faces meet in vertex 4.
TriangleMesh pyramid() {
  auto mesh = TriangleMesh::build({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.5, 0.5, 1}},
                                  {{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}});
  return *std::move(mesh);
}

std::vector<char> vertices_out(const std::string& text) {
  const auto mask = read_mask(text, pyramid());
  EXPECT_TRUE(mask) << mask.error().message;
  return mask ? mask->vertices : std::vector<char>();
}

std::string refusal(const std::string& text) {
  const auto mask = read_mask(text, pyramid());
  EXPECT_FALSE(mask);
  return mask ? std::string() : mask.error().message;
}

TEST(BrainSurfaces, AreWhatWasWritten) {
  for (const char* const name :
       {"gii/gzip.surf.gii", "gii/base64.surf.gii", "gii/ascii.surf.gii", "fsurf/lh.white"}) {
    const auto file = read_mesh(corpus(name));
    ASSERT_TRUE(file) << name << ": " << file.error().message;
    const TriangleMesh expected = pyramid();
    EXPECT_TRUE(std::ranges::equal(file->mesh.positions(), expected.positions())) << name;
    EXPECT_TRUE(std::ranges::equal(file->mesh.faces(), expected.faces())) << name;
  }
}

TEST(BrainSurfaces, ThatAreNoneAreRefusedInOneSentence) {
  const TemporaryDirectory folder;
  const std::string whole = bytes_of(corpus("gii/gzip.surf.gii"));
  const std::pair<std::string, std::string> kFiles[] = {
      {"cut.gii", whole.substr(0, whole.find("eJxj") + 10)},
      {"empty.gii", "<GIFTI></GIFTI>"},
      {"other.gii", "<html></html>"},
      {"cut.fsurf", bytes_of(corpus("fsurf/lh.white")).substr(0, 60)},
      {"other.fsurf", "solid of nothing"}};
  for (const auto& [name, bytes] : kFiles) {
    folder.write(name, bytes);
    const auto file = read_mesh(folder.path(name));
    ASSERT_FALSE(file) << name;
    EXPECT_EQ(file.error().code, ErrorCode::kBadFile) << name;
    EXPECT_EQ(std::ranges::count(file.error().message, '\n'), 0) << name;
  }
  const auto mask = read_mesh(corpus("gii/roi.shape.gii"));
  ASSERT_FALSE(mask);
  EXPECT_NE(mask.error().message.find("no array POINTSET"), std::string::npos);
}

TEST(Masks, AreReadFromEveryFormat) {
  EXPECT_EQ(vertices_out(corpus("mask/flags.txt")), (std::vector<char>{0, 0, 1, 0, 1}));
  EXPECT_EQ(vertices_out(corpus("mask/ids.txt")), (std::vector<char>{0, 0, 0, 1, 1}));
  EXPECT_EQ(vertices_out(corpus("mask/flags.npy")), (std::vector<char>{0, 1, 0, 0, 1}));
  EXPECT_EQ(vertices_out(corpus("mask/lh.wall.label")), (std::vector<char>{1, 0, 0, 1, 0}));
  EXPECT_EQ(vertices_out(corpus("mask/ply.ply") + ":wall"), (std::vector<char>{0, 1, 0, 0, 0}));
  EXPECT_EQ(vertices_out(corpus("gii/roi.shape.gii")), (std::vector<char>{1, 1, 0, 1, 1}));
  EXPECT_EQ(vertices_out("keep:" + corpus("gii/roi.shape.gii")),
            (std::vector<char>{0, 0, 1, 0, 0}));
  const TemporaryDirectory folder;
  folder.write("faces.txt", "0 1 0 0\n");
  folder.write("marked.txt",
               "\xef\xbb\xbf"
               "0\r1\r0\r0\r0");
  EXPECT_EQ(vertices_out(folder.path("marked.txt")), (std::vector<char>{0, 1, 0, 0, 0}));
  const auto faces = read_mask(folder.path("faces.txt"), pyramid());
  ASSERT_TRUE(faces);
  EXPECT_EQ(faces->faces, (std::vector<char>{0, 1, 0, 0}));
  const auto ids = read_mask("keep:faces:" + corpus("mask/ids.txt"), pyramid());
  EXPECT_FALSE(ids) << "there is no face 4";
}

TEST(Masks, OfAnotherMeshAreRefused) {
  const TemporaryDirectory folder;
  folder.write("far.txt", "3 5\n");
  EXPECT_NE(refusal(folder.path("far.txt")).find("number 2 of the mask is 5"), std::string::npos);
  folder.write("half.txt", "0 1.5\n");
  EXPECT_NE(refusal(folder.path("half.txt")).find("is 1.5"), std::string::npos);
  EXPECT_EQ(sentence(read_mask("keep:", pyramid()).error()),
            "the mask 'keep:' names no file; write FILE, keep:FILE or faces:FILE");
  folder.write("comma.txt", "5,6\n");
  EXPECT_EQ(sentence(read_mask(folder.path("comma.txt"), pyramid()).error()),
            folder.path("comma.txt") +
                ": line 1: \"5,6\" is not a number in number 1; write numbers with blanks or ends "
                "of lines between them");
  EXPECT_NE(refusal(corpus("mask/ply.ply")).find("not named"), std::string::npos);
  EXPECT_NE(refusal(corpus("mask/ply.ply") + ":roof").find("no property roof"), std::string::npos);
  const auto two = TriangleMesh::build({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}});
  ASSERT_TRUE(two);
  EXPECT_FALSE(read_mask(corpus("gii/roi.shape.gii"), *two));
}

/// Flags of another mesh, or labels of parcels, would be taken for ids of the first vertices.
TEST(Masks, ThatAreNoListOfIdsAreNotTakenForOne) {
  const TemporaryDirectory folder;
  folder.write("short.txt", "0 1 1\n");
  const std::string both = "has 3 numbers, and the mesh 5 vertices and 4 faces";
  EXPECT_NE(refusal(folder.path("short.txt")).find(both), std::string::npos);
  EXPECT_NE(refusal("faces:" + folder.path("short.txt")).find(both), std::string::npos);
  folder.write("parcels.txt", "0 2 3 3 2\n");
  EXPECT_NE(
      refusal(folder.path("parcels.txt")).find("number 4 of the 5 of the mask names vertex 3"),
      std::string::npos);
  folder.write("ids.txt", "1 0\n");
  EXPECT_EQ(vertices_out(folder.path("ids.txt")), (std::vector<char>{1, 1, 0, 0, 0}));
}

TEST(Masks, LeaveNumbersAsTheyAre) {
  const TriangleMesh mesh = pyramid();
  const auto left = masked(mesh, {.vertices = {1, 0, 0, 0, 0}, .faces = {}});
  ASSERT_TRUE(left);
  EXPECT_EQ(left->vertex_count(), 5);
  EXPECT_EQ(left->faces()[1], (Face{1, 2, 4}));
  EXPECT_EQ(left->faces()[0], (Face{0, 0, 0}));
  EXPECT_EQ(left->faces()[3], (Face{3, 3, 3}));
  EXPECT_FALSE(masked(mesh, {.vertices = {0, 0, 0, 0, 1}, .faces = {}})) << "nothing is left";
  EXPECT_FALSE(masked(mesh, {.vertices = {1, 0}, .faces = {}})) << "of another mesh";
}

}  // namespace
}  // namespace geotherm::test
