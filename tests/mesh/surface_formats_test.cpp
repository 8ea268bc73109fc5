// SPDX-License-Identifier: MIT
// Surfaces in formats that hold other elements, too, strips of triangles, and packed files.
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <thread>

#include "geotherm/domains.h"
#include "tests/mesh/mesh_files.h"

namespace geotherm::test {
namespace {

std::vector<Face> faces_in(const Result<MeshFile>& file) {
  if (!file) {
    ADD_FAILURE() << sentence(file.error());
    return {};
  }
  return {file->mesh.faces().begin(), file->mesh.faces().end()};
}

/// Two strips and one that turns by repeating a corner, as the scanner's program of Stanford.
const std::vector<std::int32_t> kStrips = {0, 1, 4, 2, -1, 2, 3, 4, 0, -1, 3, 2, 2, 1, 0};
/// Every other triangle of a strip turns the other way round: all of these have one orientation.
const std::vector<Face> kStripFaces = {{0, 1, 4}, {4, 1, 2}, {2, 3, 4}, {4, 3, 0}, {2, 1, 0}};

std::string strips_header(const std::string& format) {
  return "ply\nformat " + format +
         " 1.0\nelement vertex 5\nproperty float x\nproperty float y\nproperty float z\n"
         "element tristrips 1\nproperty list int int vertex_indices\nend_header\n";
}

TEST(PlyStrips, BecomeTrianglesOfOneOrientation) {
  std::string text = strips_header("ascii") + "0 0 0\n2 0 0\n2 2 0\n0 2 0\n1 1 1.5\n" +
                     std::to_string(kStrips.size());
  for (const std::int32_t corner : kStrips) text += ' ' + std::to_string(corner);
  EXPECT_EQ(faces_in(read_bytes("a.ply", text + '\n')), kStripFaces);
  // Strips beside faces, and a list that ends with a separator.
  const std::size_t behind = text.find("element tristrips");
  text.insert(behind, "element face 1\nproperty list uchar int vertex_indices\n");
  text.insert(text.rfind('\n') + 1, "3 0 2 1\n");
  const std::vector<Face> both = faces_in(read_bytes("a.ply", text + '\n'));
  ASSERT_EQ(both.size(), kStripFaces.size() + 1);
  EXPECT_EQ(both.front(), (Face{0, 2, 1}));
}

TEST(PlyStrips, AreReadFromBinaryFiles) {
  const auto put = [](std::string& bytes, auto value) {
    char raw[sizeof value];
    std::memcpy(raw, &value, sizeof value);
    if (std::endian::native != std::endian::big) std::reverse(raw, raw + sizeof value);
    bytes.append(raw, sizeof value);
  };
  std::string bytes = strips_header("binary_big_endian");
  for (const Vec3& p : pyramid_positions()) {
    for (int axis = 0; axis < 3; ++axis) put(bytes, static_cast<float>(p[axis]));
  }
  put(bytes, static_cast<std::int32_t>(kStrips.size() + 1));
  for (const std::int32_t corner : kStrips) put(bytes, corner);
  put(bytes, std::int32_t{-1});
  EXPECT_EQ(faces_in(read_bytes("a.ply", bytes)), kStripFaces);
}

TEST(VtkStrips, BecomeTrianglesOfOneOrientation) {
  const auto faces = faces_in(read_bytes(
      "a.vtk",
      "# vtk DataFile Version 3.0\nt\nASCII\nDATASET POLYDATA\nPOINTS 5 float\n"
      "0 0 0 2 0 0 2 2 0 0 2 0 1 1 1.5\nLINES 1 3\n2 0 1\nTRIANGLE_STRIPS 2 10\n4 0 1 4 2\n"
      "4 2 3 4 0\n"));
  EXPECT_EQ(faces, (std::vector<Face>(kStripFaces.begin(), kStripFaces.end() - 1)));
}

TEST(VtkPoints, MayBeWholeNumbers) {
  using namespace std::string_literals;  // NOLINT: for zero bytes inside strings
  const TemporaryDirectory directory;
  const auto file = [&](const std::string& kind, const std::string& points,
                        const std::string& faces) {
    return read_mesh(directory.write("a.vtk", "# vtk DataFile Version 3.0\nx\n" + kind +
                                                  "\nDATASET POLYDATA\nPOINTS 3 short\n" + points +
                                                  "\nPOLYGONS 1 4\n" + faces));
  };
  for (const auto& mesh : {file("ASCII", "0 0 0 1 0 0 0 -1 0", "3 0 1 2\n"),
                           file("BINARY", "\0\0\0\0\0\0\0\1\0\0\0\0\0\0\xff\xff\0\0"s,
                                "\0\0\0\3\0\0\0\0\0\0\0\1\0\0\0\2"s)}) {
    ASSERT_TRUE(mesh) << mesh.error().message;
    EXPECT_EQ(mesh->mesh.positions()[1], Vec3(1, 0, 0));
    EXPECT_EQ(mesh->mesh.positions()[2], Vec3(0, -1, 0));
  }
}

TEST(Vtp, AsItIsWrittenIsReadBack) {
  const TemporaryDirectory directory;
  const auto mesh = TriangleMesh::build(pyramid_positions(), pyramid_faces());
  const std::vector<double> distances(5, 0.25);
  const std::string path = directory.path("d.vtp");
  ASSERT_TRUE(write_distances(path, *mesh, distances));
  const auto file = read_mesh(path);
  EXPECT_EQ(faces_in(file), pyramid_faces());
  EXPECT_TRUE(std::ranges::equal(file->mesh.positions(), pyramid_positions()));
}

TEST(Elements, ThatAreNoFacesAreLeftOutAndSaid) {
  const std::string nodes =
      "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n4\n1 0 0 0\n2 1 0 0\n"
      "3 0 1 0\n4 0 0 1\n$EndNodes\n$Elements\n";
  const TemporaryDirectory directory;
  const std::string mixed = directory.write(
      "a.msh", nodes + "3\n1 1 2 0 1 1 2\n2 2 2 0 1 1 2 3\n3 4 2 0 1 1 2 3 4\n$EndElements\n");
  const auto surface = read_mesh(mixed);
  EXPECT_EQ(faces_in(surface), (std::vector<Face>{{0, 1, 2}}));
  ASSERT_EQ(surface->notes.size(), 1U);
  EXPECT_EQ(surface->notes[0], "left out, being no faces: edges (1), tetrahedra (1)");
  const auto volume = read_tets(mixed);
  ASSERT_TRUE(volume);
  EXPECT_EQ(volume->notes[0],
            "left out, being no tetrahedra with 4 corners: edges (1), triangles (1)");
  const std::string edges = directory.write("b.msh", nodes + "1\n1 1 2 0 1 1 2\n$EndElements\n");
  EXPECT_EQ(sentence(read_mesh(edges).error()),
            edges +
                ": the file has no triangles or polygons, but 4 vertices and edges (1); a "
                "surface needs faces");
  EXPECT_EQ(read_tets(edges).error().code, ErrorCode::kBadFile);
  const std::string triangle =
      directory.write("c.msh", nodes + "1\n1 2 2 0 1 1 2 3\n$EndElements\n");
  EXPECT_EQ(read_tets(triangle).error().code, ErrorCode::kNotAvailable) << "faces to read";
}

TEST(Elements, OfSecondOrderAreSaidToBeCurved) {
  const std::string says =
      ": the file has no tetrahedra with 4 corners and no faces, but 6 vertices and triangles with "
      "6 corners (1); save it with straight elements, those of first order";
  const TemporaryDirectory directory;
  const std::string gmsh = directory.write(
      "a.msh",
      "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n6\n1 0 0 0\n2 2 0 0\n3 0 2 0\n4 1 0 0\n"
      "5 1 1 0\n6 0 1 0\n$EndNodes\n$Elements\n1\n1 9 2 0 1 1 2 3 4 5 6\n$EndElements\n");
  EXPECT_EQ(sentence(read_tets(gmsh).error()), gmsh + says);
  const std::string vtk = directory.write(
      "a.vtk",
      "# vtk DataFile Version 3.0\nx\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 6 float\n"
      "0 0 0\n2 0 0\n0 2 0\n1 0 0\n1 1 0\n0 1 0\nCELLS 1 7\n6 0 1 2 3 4 5\nCELL_TYPES 1\n22\n");
  EXPECT_EQ(sentence(read_tets(vtk).error()), vtk + says);
  EXPECT_NE(sentence(read_mesh(vtk).error()).find("first order"), std::string::npos);
}

std::string packed_triangle() { return gzipped("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"); }

TEST(Packed, FilesOfSeveralPartsAreOne) {
  const std::string bytes = gzipped("v 0 0 0\nv 1 0 0\n") + gzipped("v 0 1 0\nf 1 2 3\n");
  EXPECT_EQ(faces_in(read_bytes("a.obj.gz", bytes)).size(), 1U);
}

TEST(Packed, FilesThatAreDamagedAreToldInOneLine) {
  const std::string whole = packed_triangle();
  const std::string sizes = "its " + std::to_string(whole.size()) + " compressed bytes";
  const TemporaryDirectory directory;
  const auto said = [&directory](const std::string& bytes) {
    const std::string path = directory.write("a.obj.gz", bytes);
    const auto file = read_mesh(path);
    return file ? "nothing" : sentence(file.error()).substr(path.size() + 2);
  };
  EXPECT_EQ(said(whole.substr(0, whole.size() - 3)),
            "its " + std::to_string(whole.size() - 3) +
                " compressed bytes end in the middle, after 32 unpacked ones");
  std::string other = whole;
  other[other.size() - 6] ^= 1;  // of the checksum
  EXPECT_EQ(said(other).substr(0, sizes.size() + 12), sizes + " are damaged");
  EXPECT_EQ(said(whole + "more"), "4 of its " + std::to_string(whole.size() + 4) +
                                      " compressed bytes stand behind the end and are no gzip");
  EXPECT_EQ(said(gzipped("")), "nothing is packed in it (0 bytes)");
}

TEST(Packed, BytesThatUnpackToMuchMoreThanModelsAreRefusedSlow) {
  constexpr std::size_t kStep = std::size_t{64} << 20, kSteps = 5;
  const std::string zeros(kStep, '\0');
  std::string bytes;
  for (std::size_t k = 0; k < kSteps; ++k) bytes += gzipped(zeros);
  const auto file = read_bytes("a.obj.gz", bytes);
  ASSERT_FALSE(file);
  EXPECT_NE(sentence(file.error())
                .find("its " + std::to_string(bytes.size()) +
                      " compressed bytes unpack to more than 268435456 bytes, more than a model"),
            std::string::npos)
      << sentence(file.error());
}

TEST(Packed, TetgensPairIsFound) {
  const TemporaryDirectory directory;
  const std::string node =
      directory.write("a.node.gz", gzipped("4 3 0 0\n0 0 0 0\n1 1 0 0\n2 0 1 0\n3 0 0 1\n"));
  directory.write("a.ele.gz", gzipped("1 4 0\n0 0 1 2 3\n"));
  const auto file = read_tets(node);
  ASSERT_TRUE(file) << sentence(file.error());
  EXPECT_EQ(file->mesh.tet_count(), 1);
}

TEST(NamedPipe, IsReadOnceAndToItsEnd) {
  const TemporaryDirectory directory;
  const std::string path = directory.path("model");
  ASSERT_EQ(::mkfifo(path.c_str(), 0666), 0);
  std::jthread writer([&] { std::ofstream(path) << packed_triangle(); });
  const auto input = ModelInput::open(path);
  ASSERT_TRUE(input) << sentence(input.error());
  EXPECT_EQ(input->format(), "obj") << "by its unpacked bytes";
  EXPECT_FALSE(holds_tets(*input));
  EXPECT_FALSE(holds_grid(*input));
  EXPECT_FALSE(*is_point_file(*input));
  EXPECT_EQ(faces_in(read_mesh(*input)), (std::vector<Face>{{0, 1, 2}}));
  EXPECT_EQ(faces_in(read_mesh(*input)).size(), 1U) << "it is held";
}

}  // namespace
}  // namespace geotherm::test
