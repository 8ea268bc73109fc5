// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include "geotherm/io.h"
#include "tests/mesh/mesh_files.h"

namespace geotherm::test {
namespace {

using namespace std::string_literals;  // NOLINT: for zero bytes inside strings

struct Damage {
  std::string name;
  std::string file;
  std::string bytes;
  std::string message;  ///< all of it behind "PATH: "
};

const std::string kTriangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
const std::string kOffBody = "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
const std::string kPlyHeader =
    "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
    "property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n";
const std::string kBinaryHeader =
    "ply\nformat binary_little_endian 1.0\nelement vertex 3\nproperty char x\nproperty char y\n"
    "property float z\nelement face 1\nproperty list char char vertex_indices\nend_header\n";
const std::string kBinaryVertices = "\0\0\0\0\0\0\1\0\0\0\0\0\0\1\0\0\0\0"s;
const std::string kFacet =
    "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\n"
    "endfacet\n";

std::string replaced(std::string text, std::string_view what, std::string_view by) {
  return text.replace(text.find(what), what.size(), by);
}

std::string at_byte(std::size_t byte) { return "byte " + std::to_string(byte) + ": "; }

std::vector<Damage> obj_damages() {
  return {
      {"obj_index_too_large", "a.obj", kTriangle + "f 1 2 3\nf 1 2 9\n",
       "line 5: a face uses vertex 9, but the file has 3 vertices"},
      {"obj_index_zero", "a.obj", kTriangle + "f 0 1 2\n",
       "line 4: a face uses vertex 0, but OBJ counts vertices from 1"},
      {"obj_index_before_the_first", "a.obj", kTriangle + "f 1 2 -4\nv 1 1 1\n",
       "line 4: a face uses vertex -4, but only 3 vertices stand before it"},
      {"obj_index_beyond_32_bits", "a.obj", kTriangle + "f 1 2 4294967297\n",
       "line 4: a face uses vertex 4294967297, but at most 2147483647 vertices are supported"},
      {"obj_index_beyond_64_bits", "a.obj", kTriangle + "f 1 2 18446744073709551617\n",
       "line 4: \"18446744073709551617\" is not a corner of a face (v, v/vt, v//vn, v/vt/vn)"},
      {"obj_index_not_a_number", "a.obj", kTriangle + "f 1 two 3\n",
       "line 4: \"two\" is not a corner of a face (v, v/vt, v//vn, v/vt/vn)"},
      {"obj_index_not_whole", "a.obj", kTriangle + "f 1 2.5 3\n",
       "line 4: \"2.5\" is not a corner of a face (v, v/vt, v//vn, v/vt/vn)"},
      {"obj_two_coordinates", "a.obj", "v 0 0\n" + kTriangle + "f 1 2 3\n",
       "line 1: a vertex has 2 coordinates instead of 3"},
      {"obj_cut_in_a_vertex", "a.obj", kTriangle + "f 1 2 3\nv 1 1",
       "line 5: a vertex has 2 coordinates instead of 3"},
      {"obj_no_coordinates", "a.obj", "v\n", "line 1: a vertex has 0 coordinates instead of 3"},
      {"obj_coordinate_unreadable", "a.obj", "v 0 1,5 0\n",
       "line 1: \"1,5\" is not a number (a vertex needs 3)"},
      {"obj_coordinate_nan", "a.obj", "\nv 0 nan 0\n",
       "line 2: the coordinate \"nan\" is not finite"},
      {"obj_coordinate_infinite", "a.obj", "v 0 0 -inf\n",
       "line 1: the coordinate \"-inf\" is not finite"},
      {"obj_coordinate_too_large", "a.obj", "v 0 1e999 0\n",
       "line 1: the coordinate \"1e999\" is not finite"},
      {"obj_zero_byte", "a.obj", kTriangle + "f 1 2 3\0 2\n"s,
       "line 4: \"?\" is not a corner of a face (v, v/vt, v//vn, v/vt/vn)"},
      {"obj_no_faces", "a.obj", kTriangle,
       "the mesh has no faces (3 vertices); distances need a surface of triangles"},
      {"obj_no_mesh_at_all", "a.obj", "hello\n",
       "the mesh has no faces (0 vertices); distances need a surface of triangles"},
  };
}

std::vector<Damage> off_damages() {
  return {
      {"off_not_off", "a.off", "solid\n",
       "line 1: an OFF file starts with the word OFF in the header"},
      {"off_binary_cut_in_the_header", "a.off", "OFF BINARY\n\0\0\0"s,
       "byte 11: the file ends in the header"},
      {"off_binary_many_vertices", "a.off", "OFF BINARY\n\x7f\0\0\3\0\0\0\1\0\0\0\0"s,
       "byte 11: the header announces 2130706435 vertices, but only 8 bytes follow in the header"},
      {"off_binary_index_too_large", "a.off",
       "OFF BINARY\n\0\0\0\1\0\0\0\1\0\0\0\0"s + std::string(12, '\0') + "\0\0\0\1\0\0\0\1"s +
           std::string(4, '\0'),
       "byte 39: vertex 1 is used, but the file has 1 vertices (0 to 0) in face 1 of 1"},
      {"off_four_dimensions", "a.off", "4OFF\n1 1 0\n",
       "line 1: the format 4OFF has points that are not in 3 dimensions in the header"},
      {"off_no_counts", "a.off", "OFF\n", "line 2: the file ends in the header"},
      {"off_many_vertices", "a.off", "OFF\n2147483647 1 0\n" + kOffBody,
       "line 2: the header announces 2147483647 vertices, but only 31 bytes follow in the header"},
      {"off_many_faces", "a.off", "OFF\n3 999999999999 0\n" + kOffBody,
       "line 2: the header announces 999999999999 faces, but only 29 bytes follow in the header"},
      {"off_negative_count", "a.off", "OFF\n-3 1 0\n" + kOffBody,
       "line 2: the header announces -3 vertices, but only 31 bytes follow in the header"},
      {"off_fewer_faces_than_announced", "a.off", "OFF\n3 2 0\n" + kOffBody,
       "line 7: the file ends in face 2 of 2"},
      {"off_cut_in_a_vertex", "a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1",
       "line 5: the file ends in vertex 3 of 3"},
      {"off_cut_in_a_face", "a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1",
       "line 6: the file ends in face 1 of 1"},
      {"off_index_too_large", "a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n",
       "line 6: vertex 3 is used, but the file has 3 vertices (0 to 2) in face 1 of 1"},
      {"off_index_negative", "a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 -1\n",
       "line 6: vertex -1 is used, but the file has 3 vertices (0 to 2) in face 1 of 1"},
      {"off_many_corners", "a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n2147483647 0 1 2\n",
       "line 6: a face cannot have 2147483647 corners in face 1 of 1"},
      {"off_coordinate_nan", "a.off", "OFF\n3 1 0\n0 0 0\n1 nan 0\n0 1 0\n3 0 1 2\n",
       "line 4: the coordinate \"nan\" is not finite in vertex 2 of 3"},
      {"off_coordinate_unreadable", "a.off", "OFF\n3 1 0\n0 0 x0\n1 0 0\n0 1 0\n3 0 1 2\n",
       "line 3: \"x0\" is not a number in vertex 1 of 3"},
      {"off_no_faces", "a.off", "OFF\n1 0 0\n0 0 0\n",
       "the mesh has no faces (1 vertex); distances need a surface of triangles"},
  };
}

std::vector<Damage> ply_damages() {
  const std::string header_size = std::to_string(kBinaryHeader.size());
  const std::size_t body = kBinaryHeader.size();
  return {
      {"ply_not_ply", "a.ply", "OFF\n", "line 1: a PLY file starts with the line \"ply\""},
      {"ply_no_format", "a.ply", "ply\nend_header\n", "line 2: the header has no line \"format\""},
      {"ply_unknown_format", "a.ply", "ply\nformat binary 1.0\nend_header\n",
       "line 2: unknown format; there are ascii, binary_little_endian, binary_big_endian"},
      {"ply_header_cut", "a.ply", "ply\nformat ascii 1.0\nelement vertex 3\n",
       "line 3: the file ends inside the header (no \"end_header\")"},
      {"ply_unknown_type", "a.ply", replaced(kPlyHeader, "float x", "quad x"),
       "line 4: unknown type \"quad\" of a property"},
      {"ply_unknown_word", "a.ply", replaced(kPlyHeader, "element face", "elephant face"),
       "line 7: unknown word \"elephant\" in the header"},
      {"ply_negative_count", "a.ply", replaced(kPlyHeader, "vertex 3", "vertex -3"),
       "line 3: the count -3 is negative"},
      {"ply_unreadable_count", "a.ply", replaced(kPlyHeader, "vertex 3", "vertex 3x"),
       "line 3: an element needs a name and a count"},
      {"ply_element_twice", "a.ply", replaced(kPlyHeader, "element face", "element vertex"),
       "line 7: an element is declared twice"},
      {"ply_property_twice", "a.ply", replaced(kPlyHeader, "float y", "float x") + kOffBody,
       "line 5: the property \"x\" is there twice in an element"},
      {"ply_property_first", "a.ply", "ply\nformat ascii 1.0\nproperty float x\n",
       "line 3: a property stands before the first element"},
      {"ply_no_z", "a.ply", replaced(kPlyHeader, "float z", "float w") + kOffBody,
       "line 9: the element \"vertex\" has no property \"z\""},
      {"ply_no_vertices", "a.ply",
       replaced(kPlyHeader, "element vertex", "element point") + kOffBody,
       "line 9: the header has no element \"vertex\""},
      {"ply_no_corners", "a.ply", replaced(kPlyHeader, "vertex_indices", "texcoord") + kOffBody,
       "line 9: the element \"face\" has no list \"vertex_indices\" or \"vertex_index\""},
      {"ply_point_cloud", "a.ply",
       replaced(kPlyHeader, "element face 1", "element edge 1") + kOffBody,
       "line 9: the file has no faces (no element \"face\"): a point cloud has no surface"},
      {"ply_triangle_strips", "a.ply",
       replaced(kPlyHeader, "element face 1", "element tristrips 1") + "0 0 0\n1 0 0\n0 1 0\n" +
           "4 0 1 -1 3\n",
       "line 13: vertex 3 is used, but the file has 3 vertices (0 to 2) in row 1 of 1"},
      {"ply_no_faces", "a.ply", replaced(kPlyHeader, "face 1", "face 0") + "0 0 0\n1 0 0\n0 1 0\n",
       "the mesh has no faces (3 vertices); distances need a surface of triangles"},
      {"ply_many_vertices", "a.ply",
       replaced(kPlyHeader, "vertex 3", "vertex 2147483647") + kOffBody,
       at_byte(kPlyHeader.size() + 9) +
           "the header announces 2147483647 of element \"vertex\" with at least 6 bytes each, but "
           "only 26 bytes follow"},
      {"ply_fewer_rows_than_announced", "a.ply", kPlyHeader + "0 0 0\n1 0 0\n0 1 0\n",
       "line 13: the file ends in face 1 of 1"},
      {"ply_index_too_large", "a.ply", kPlyHeader + "0 0 0\n1 0 0\n0 1 0\n3 0 1 5\n",
       "line 13: vertex 5 is used, but the file has 3 vertices (0 to 2) in face 1 of 1"},
      {"ply_coordinate_infinite", "a.ply", kPlyHeader + "0 0 0\n1 inf 0\n0 1 0\n3 0 1 2\n",
       "line 11: the coordinate \"inf\" is not finite in vertex 2 of 3"},
      {"ply_long_list", "a.ply", kPlyHeader + "0 0 0\n1 0 0\n0 1 0\n999999999999 0 1 2\n",
       "line 13: a list of 999999999999 items does not fit in face 1 of 1"},
      {"ply_binary_cut_in_the_vertices", "a.ply", kBinaryHeader + kBinaryVertices.substr(0, 14),
       at_byte(body) +
           "the header announces 3 of element \"vertex\" with at least 6 bytes each, but "
           "only 14 bytes follow"},
      {"ply_binary_cut_in_a_face", "a.ply",
       kBinaryHeader + kBinaryVertices + "\2\0\1"s.substr(0, 2),
       at_byte(body + 18) + "a list of 2 items does not fit in face 1 of 1"},
      {"ply_binary_cut_before_the_faces", "a.ply", kBinaryHeader + kBinaryVertices,
       at_byte(body + 18) + "the file ends in face 1 of 1"},
      {"ply_binary_index_too_large", "a.ply", kBinaryHeader + kBinaryVertices + "\3\0\1\3"s,
       at_byte(body + 21) +
           "vertex 3 is used, but the file has 3 vertices (0 to 2) in face 1 of 1"},
      {"ply_binary_negative_length", "a.ply", kBinaryHeader + kBinaryVertices + "\xff\0\1\2"s,
       at_byte(body + 18) + "a list of -1 items does not fit in face 1 of 1"},
      {"ply_binary_nan", "a.ply", kBinaryHeader + "\0\0\0\0\xc0\x7f"s + kBinaryVertices.substr(6),
       at_byte(body + 2) + "a coordinate is not finite in vertex 1 of 3"},
      {"ply_binary_index_not_whole", "a.ply",
       replaced(kBinaryHeader, "char char vertex", "char float vertex") + kBinaryVertices +
           "\1\0\0\0\x3f"s,
       at_byte(body + 20) + "an index is not whole in face 1 of 1"},
  };
}

std::vector<Damage> stl_damages() {
  const std::string header(80, ' ');
  const std::string nan = "\0\0\xc0\x7f"s;
  return {
      {"stl_neither_text_nor_binary", "a.stl", "hello",
       "byte 0: neither text (\"solid ...\") nor long enough for a binary STL: 5 bytes, its header "
       "alone has 84"},
      {"stl_binary_cut", "a.stl", header + "\2\0\0\0"s + std::string(50, '\0'),
       "byte 80: the header announces 2 triangles, that is 184 bytes, but the file has 134"},
      {"stl_binary_huge_count", "a.stl", header + "\xff\xff\xff\xff"s + std::string(50, '\0'),
       "byte 80: the header announces 4294967295 triangles, that is 214748364834 bytes, but the "
       "file has 134"},
      {"stl_binary_no_faces", "a.stl", header + "\0\0\0\0"s,
       "the mesh has no faces (0 vertices); distances need a surface of triangles"},
      {"stl_binary_nan", "a.stl",
       header + "\1\0\0\0"s + std::string(20, '\0') + nan + std::string(26, '\0'),
       "byte 104: a coordinate is not finite in triangle 1 of 1"},
      {"stl_text_cut_between_facets", "a.stl", "solid\n" + kFacet,
       "line 9: the file ends where \"facet\" should be in facet 2"},
      {"stl_text_cut_in_a_vertex", "a.stl", "solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0",
       "line 4: the file ends in facet 1"},
      {"stl_text_four_corners", "a.stl",
       "solid\n" + replaced(kFacet, "endloop", "vertex 1 1 1\nendloop"),
       "line 7: \"vertex\" stands where \"endloop\" should be in facet 1"},
      {"stl_text_nan", "a.stl", "solid\n" + replaced(kFacet, "vertex 1", "vertex nan"),
       "line 5: the coordinate \"nan\" is not finite in facet 1"},
      {"stl_text_unreadable", "a.stl", "solid\n" + replaced(kFacet, "vertex 1", "vertex 1e"),
       "line 5: \"1e\" is not a number in facet 1"},
      {"stl_text_no_faces", "a.stl", "solid\nendsolid\n",
       "the mesh has no faces (0 vertices); distances need a surface of triangles"},
  };
}

class DamagedFile : public testing::TestWithParam<Damage> {};

TEST_P(DamagedFile, is_refused_with_its_place_and_cause) {
  const TemporaryDirectory directory;
  const std::string path = directory.write(GetParam().file, GetParam().bytes);
  const Result<MeshFile> file = read_mesh(path);
  ASSERT_FALSE(file);
  EXPECT_EQ(file.error().code, ErrorCode::kBadFile);
  EXPECT_EQ(sentence(file.error()), path + ": " + GetParam().message);
}

const auto kName = [](const auto& test) { return test.param.name; };
INSTANTIATE_TEST_SUITE_P(Obj, DamagedFile, testing::ValuesIn(obj_damages()), kName);
INSTANTIATE_TEST_SUITE_P(Off, DamagedFile, testing::ValuesIn(off_damages()), kName);
INSTANTIATE_TEST_SUITE_P(Ply, DamagedFile, testing::ValuesIn(ply_damages()), kName);
INSTANTIATE_TEST_SUITE_P(Stl, DamagedFile, testing::ValuesIn(stl_damages()), kName);

TEST(DamagedObj, of_many_megabytes_names_the_right_line) {
  const TemporaryDirectory directory;
  std::string lines;
  for (int i = 0; i < 200000; ++i) lines += "v 0.25 0.5 0.75\n";
  const std::string path =
      directory.write("a.obj", lines + "f 1 2 3\nf 1 2 400001\n" + lines + "f 1 2 x\nf 1 2 y\n");
  EXPECT_EQ(sentence(read_mesh(path).error()),
            path + ": line 400003: \"x\" is not a corner of a face (v, v/vt, v//vn, v/vt/vn)");
  directory.write("a.obj", lines + "f 1 2 3\nf 1 2 400001\n" + lines);
  EXPECT_EQ(sentence(read_mesh(path).error()),
            path + ": line 200002: a face uses vertex 400001, but the file has 400000 vertices");
  directory.write("a.obj", lines + lines + "f -1 -2 -3\nf -1 -2 -400001\n");
  EXPECT_EQ(sentence(read_mesh(path).error()),
            path +
                ": line 400002: a face uses vertex -400001, but only 400000 vertices stand "
                "before it");
}

void expect_message(const std::string& path, const std::string& message) {
  const Result<MeshFile> file = read_mesh(path);
  ASSERT_FALSE(file);
  EXPECT_EQ(sentence(file.error()), path + ": " + message);
}

TEST(UnreadableFile, that_is_empty_is_called_empty) {
  const TemporaryDirectory directory;
  expect_message(directory.write("a.obj", ""), "the file is empty (0 bytes); write it again");
}

TEST(UnreadableFile, that_does_not_exist_is_called_missing) {
  const TemporaryDirectory directory;
  expect_message(directory.path("a.obj"), "no such file; check the path");
}

TEST(UnreadableFile, that_is_a_directory_is_called_one) {
  const TemporaryDirectory directory;
  ::mkdir(directory.path("a.obj").c_str(), 0777);
  expect_message(directory.path("a.obj"), "is a directory; give a file in it");
}

TEST(UnreadableFile, that_is_a_pipe_without_a_writer_does_not_block) {
  const TemporaryDirectory directory;
  ASSERT_EQ(::mkfifo(directory.path("a.obj").c_str(), 0666), 0);
  expect_message(directory.path("a.obj"), "there was nothing to read; check what writes to it");
}

TEST(UnreadableFile, that_is_a_device_says_so) {
  EXPECT_EQ(sentence(read_mesh("/dev/zero", "obj").error()),
            "/dev/zero: is neither a regular file nor a pipe; check the path");
}

TEST(UnreadableFile, without_permission_says_so) {
  if (::geteuid() == 0) GTEST_SKIP() << "root may read everything";
  const TemporaryDirectory directory;
  const std::string path = directory.write("a.obj", kTriangle);
  ASSERT_EQ(::chmod(path.c_str(), 0), 0);
  expect_message(
      path,
      "no permission to read the file; check the rights to it and to the folders that it "
      "is in");
}

TEST(UnreadableFile, of_an_unknown_extension_is_told_which_there_are) {
  const TemporaryDirectory directory;
  const std::string path = directory.write("a.blend", "BLENDER");
  expect_message(
      path,
      "unknown extension \".blend\"; there are .obj .ply .off .stl .gltf .glb .3mf .dae .vtp "
      ".vtk .vtu .msh .mesh .meshb .gii .fsurf");
  EXPECT_EQ(read_mesh(path).error().code, ErrorCode::kNotAvailable);
}

TEST(UnreadableFile, with_control_characters_in_its_name_has_a_message_of_one_line) {
  EXPECT_EQ(sentence(read_mesh("/no\nwhere.obj").error()),
            "/no?where.obj: no such file; check the path");
}

}  // namespace
}  // namespace geotherm::test
