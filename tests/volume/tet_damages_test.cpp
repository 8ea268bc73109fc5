// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <ostream>
#include <string>
#include <vector>

#include "geotherm/domains.h"
#include "tests/mesh/mesh_files.h"

namespace geotherm::test {
namespace {

struct TetDamage {
  std::string name;
  std::string file;
  std::string bytes;
  std::string message;  ///< all of it behind "PATH: "
};
std::ostream& operator<<(std::ostream& out, const TetDamage& d) { return out << d.name; }

const std::string kMesh = "MeshVersionFormatted 2\nDimension 3\n";
const std::string kMeshVertices = "Vertices 4\n0 0 0 0\n1 0 0 0\n0 1 0 0\n0 0 1 0\n";
const std::string kMsh2 = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n";
const std::string kMsh2Nodes = "$Nodes\n4\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n$EndNodes\n";
const std::string kMsh4 = "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n";
const std::string kVtk = "# vtk DataFile Version 3.0\nt\nASCII\nDATASET UNSTRUCTURED_GRID\n";
const std::string kVtkPoints = "POINTS 4 float\n0 0 0 1 0 0 0 1 0 0 0 1\n";
const std::string kVtu = "<VTKFile type=\"UnstructuredGrid\">\n";

/// A .vtu of one tet; `types` and `corners` as text.
std::string vtu_of(const std::string& corners, const std::string& types,
                   const std::string& points = "0 0 0 1 0 0 0 1 0 0 0 1") {
  return kVtu + "<Piece NumberOfPoints=\"4\" NumberOfCells=\"1\"><Points>" +
         "<DataArray type=\"Float32\" format=\"ascii\">" + points + "</DataArray></Points><Cells>" +
         "<DataArray type=\"Int32\" Name=\"connectivity\" format=\"ascii\">" + corners +
         "</DataArray><DataArray type=\"Int32\" Name=\"offsets\" format=\"ascii\">4</DataArray>" +
         "<DataArray type=\"UInt8\" Name=\"types\" format=\"ascii\">" + types +
         "</DataArray></Cells></Piece></VTKFile>\n";
}

std::vector<TetDamage> medit_damages() {
  return {
      {"medit_other", "a.mesh", "OFF\n",
       "line 1: a Medit file starts with the word MeshVersionFormatted in the header"},
      {"medit_plane", "a.mesh", "MeshVersionFormatted 1\nDimension 2\n",
       "line 2: the vertices are not in 3 dimensions in the list of keywords"},
      {"medit_many_vertices", "a.mesh", kMesh + "Vertices 999999999999\n0 0 0 0\n",
       "line 3: there are to be 999999999999 vertices, but only 9 bytes follow in the list of "
       "keywords"},
      {"medit_no_coordinate", "a.mesh", kMesh + "Vertices 1\n0 x 0 0\n",
       "line 4: \"x\" is not a number in vertex 1 of 1"},
      {"medit_infinite", "a.mesh", kMesh + "Vertices 1\n0 1e999 0 0\n",
       "line 4: the coordinate \"1e999\" is not finite in vertex 1 of 1"},
      {"medit_corner", "a.mesh", kMesh + kMeshVertices + "Tetrahedra 1\n1 2 3 5 0\n",
       "line 9: vertex 5 is used, but the file has 4 vertices, counted from 1, before it in "
       "tetrahedron 1 of 1"},
      {"medit_corner_zero", "a.mesh", kMesh + kMeshVertices + "Tetrahedra 1\n0 1 2 3 0\n",
       "line 9: vertex 0 is used, but the file has 4 vertices, counted from 1, before it in "
       "tetrahedron 1 of 1"},
      {"medit_no_tets", "a.mesh", kMesh + kMeshVertices + "Triangles 1\n1 2 3 0\nEnd\n",
       "the file has no tetrahedra with 4 corners, but 4 vertices and triangles (1); distances in "
       "a volume need tetrahedra"},
      {"medit_twice", "a.mesh", kMesh + kMeshVertices + kMeshVertices,
       "line 8: there is a second list Vertices in the list of keywords"},
      {"meshb_other", "a.meshb", "abcdefgh",
       "byte 0: a binary Medit file starts with the number 1"},
      {"meshb_short", "a.meshb", std::string("\1\0\0\0\2\0\0", 7), "byte 4: the file ends"},
      {"meshb_backwards", "a.meshb",
       std::string("\1\0\0\0\2\0\0\0\3\0\0\0\0\0\0\0\3\0\0\0\4\0\0\0\4\0\0\0\0\0\0\0", 32),
       "the file has no tetrahedra with 4 corners and no faces, but 0 vertices; distances need "
       "faces or tetrahedra"},
  };
}

std::vector<TetDamage> gmsh_damages() {
  return {
      {"gmsh_other", "a.msh", "(0 \"Fluent\")\n",
       "line 1: a file of Gmsh starts with the word $MeshFormat in the header"},
      {"gmsh_version_1", "a.msh", "$NOD\n",
       "line 1: version 1 is not supported in the header; save it as version 4.1"},
      {"gmsh_version_4_0", "a.msh", "$MeshFormat\n4.0 0 8\n",
       "line 2: version \"4.0\" is not supported in the header; save it as version 4.1 or 2.2"},
      {"gmsh_many_nodes", "a.msh", kMsh2 + "$Nodes\n99999\n1 0 0 0\n",
       "line 5: there are to be 99999 nodes, but only 9 bytes follow in the section $Nodes"},
      {"gmsh_node_twice", "a.msh", kMsh2 + "$Nodes\n2\n1 0 0 0\n1 1 0 0\n$EndNodes\n",
       "line 7: there is a second node 1 in node 2 of 2"},
      {"gmsh_no_such_node", "a.msh",
       kMsh2 + kMsh2Nodes + "$Elements\n1\n1 4 2 1 1 1 2 3 9\n$EndElements\n",
       "line 13: node 9 is used, but there is none before it among 4 nodes in element 1 of 1"},
      {"gmsh_more_elements", "a.msh",
       kMsh2 + kMsh2Nodes + "$Elements\n1\n1 4 0 1 2 3 4\n2 4 0 1 2 3 4\n$EndElements\n",
       "line 14: the section $Elements does not end with $EndElements where it should in the list "
       "of sections"},
      {"gmsh_no_end", "a.msh", kMsh2 + "$Comments\nhello\n",
       "line 4: the section \"$Comments\" has no end in the list of sections"},
      {"gmsh_block_of_nodes", "a.msh", kMsh4 + "$Nodes\n1 1 1 2\n3 1 0 2\n1\n2\n0 0 0\n1 0 0\n",
       "line 6: a block of 2 nodes in dimension 3 does not fit into 1 nodes in block of nodes 1 of "
       "1"},
      {"gmsh_only_triangles", "a.msh",
       kMsh2 + kMsh2Nodes + "$Elements\n1\n1 2 2 1 1 1 2 3\n$EndElements\n",
       "the file has no tetrahedra with 4 corners, but 4 vertices and triangles (1); distances in "
       "a volume need tetrahedra"},
      {"gmsh_binary_ends", "a.msh",
       "$MeshFormat\n2.2 1 8\n" + std::string("\1\0\0\0", 4) + "\n$EndMeshFormat\n$Nodes\n1\n" +
           std::string(30, '\0'),
       "line 7: the section $Nodes does not end with $EndNodes where it should in the list of "
       "sections"},
  };
}

std::vector<TetDamage> vtk_damages() {
  return {
      {"vtk_other", "a.vtk", "hello\n",
       "line 1: a file of VTK starts with \"# vtk DataFile Version\""},
      {"vtk_surface", "a.vtk", "# vtk DataFile Version 3.0\nt\nASCII\nDATASET FIELD\n",
       "line 4: the dataset \"field\" is no unstructured grid or poly data in the header; a "
       "surface "
       "is poly data, a volume of tetrahedra an unstructured grid"},
      {"vtk_no_points", "a.vtk", kVtk, "line 4: the grid has no POINTS in the header"},
      {"vtk_many_points", "a.vtk", kVtk + "POINTS 100 float\n0 0 0\n",
       "line 5: there are to be 100 points, but only 7 bytes follow in the list of keywords"},
      {"vtk_corner", "a.vtk", kVtk + kVtkPoints + "CELLS 1 5\n4 0 1 2 4\nCELL_TYPES 1\n10\n",
       "cell 0 of 1 (counted from 0) uses vertex 4, but there are 4 vertices"},
      {"vtk_three_corners", "a.vtk", kVtk + kVtkPoints + "CELLS 1 4\n3 0 1 2\nCELL_TYPES 1\n10\n",
       "cell 0 of 1 (counted from 0) is a tetrahedron with 3 corners instead of 4"},
      {"vtk_types", "a.vtk", kVtk + kVtkPoints + "CELLS 1 5\n4 0 1 2 3\nCELL_TYPES 2\n10 10\n",
       "there are the types of 2 cells, but 2 offsets"},
      {"vtu_other", "a.vtu", "hello\n", "line 1: there is no tag VTKFile"},
      {"vtu_surface", "a.vtu", "<VTKFile type=\"PolyData\">\n",
       "line 1: the file holds \"PolyData\", not UnstructuredGrid; a volume of tetrahedra "
       "is an unstructured grid"},
      {"vtu_compressor", "a.vtu",
       "<VTKFile type=\"UnstructuredGrid\" compressor=\"vtkLZ4DataCompressor\">\n",
       "line 1: the compressor \"vtkLZ4DataCompressor\" is not supported; save it compressed by "
       "ZLib or not at all"},
      {"vtu_count", "a.vtu", kVtu + "<Piece NumberOfPoints=\"-4\" NumberOfCells=\"1\">",
       "line 2: NumberOfPoints is \"-4\" in a file of 79 bytes"},
      {"vtu_huge", "a.vtu", kVtu + "<Piece NumberOfPoints=\"99999999\" NumberOfCells=\"1\">",
       "line 2: NumberOfPoints is \"99999999\" in a file of 85 bytes"},
      {"vtu_no_array", "a.vtu", kVtu + "<Piece NumberOfPoints=\"4\" NumberOfCells=\"1\">",
       "a piece has no array \"Points\""},
      {"vtu_corner", "a.vtu", vtu_of("0 1 2 7", "10"),
       "cell 0 of 1 (counted from 0) uses vertex 7, but there are 4 vertices"},
      {"vtu_few_corners", "a.vtu", vtu_of("0 1 2", "10"),
       "line 2: there are to be 4 numbers, but only 5 bytes follow in connectivity"},
      {"vtu_not_finite", "a.vtu", vtu_of("0 1 2 3", "10", "0 0 0 1 0 0 0 inf 0 0 0 1"),
       "line 2: the coordinate \"inf\" is not finite in Points"},
      {"vtu_hexahedron", "a.vtu", vtu_of("0 1 2 3", "12"),
       "the file has no tetrahedra with 4 corners and no faces, but 4 vertices and hexahedra (1); "
       "distances need faces or tetrahedra"},
      {"vtu_tag", "a.vtu", kVtu + "<Piece NumberOfPoints=\"4",
       "line 2: a tag does not end: the file ends in it"},
  };
}

std::vector<TetDamage> other_damages() {
  return {
      {"node_number", "a.node", "1 3 0 0\n5 0 0 0\n",
       "line 2: the vertex has the number 5; they count up from 0 or 1 in vertex 1 of 1"},
      {"node_many", "a.node", "100 3 0 0\n0 0 0 0\n",
       "line 1: there are to be 100 vertices, but only 15 bytes follow in the first line"},
      {"empty", "a.mesh", "", "the file is empty (0 bytes); write it again"},
      {"extension", "a.tet", "x",
       "unknown extension \".tet\" of tets; there are .vtk .vtu .msh .mesh .meshb "
       ".node .ele"},
  };
}

class TetDamages : public testing::TestWithParam<TetDamage> {};

TEST_P(TetDamages, AreToldInOneLineWithThePlace) {
  const TemporaryDirectory directory;
  const std::string path = directory.write(GetParam().file, GetParam().bytes);
  const Result<TetFile> file = read_tets(path);
  ASSERT_FALSE(file);
  EXPECT_EQ(sentence(file.error()), path + ": " + GetParam().message);
}

constexpr auto kDamageName = [](const auto& test) { return test.param.name; };
INSTANTIATE_TEST_SUITE_P(Medit, TetDamages, testing::ValuesIn(medit_damages()), kDamageName);
INSTANTIATE_TEST_SUITE_P(Gmsh, TetDamages, testing::ValuesIn(gmsh_damages()), kDamageName);
INSTANTIATE_TEST_SUITE_P(Vtk, TetDamages, testing::ValuesIn(vtk_damages()), kDamageName);
INSTANTIATE_TEST_SUITE_P(Other, TetDamages, testing::ValuesIn(other_damages()), kDamageName);

}  // namespace
}  // namespace geotherm::test
