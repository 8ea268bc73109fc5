// SPDX-License-Identifier: MIT
// The pyramid in the formats that hold elements of any kind, and packed.
#include <zlib.h>

#include "tests/mesh/mesh_files.h"

namespace geotherm::test {
namespace {

constexpr const char* kPoints = "0 0 0\n2 0 0\n2 2 0\n0 2 0\n1 1 1.5\n";
constexpr const char* kConnectivity = "0 1 4 1 2 4 2 3 4 3 0 4 3 2 1 0";
constexpr const char* kOffsets = "3 6 9 12 16";

std::string vtk_header(const std::string& version, const std::string& dataset) {
  return "# vtk DataFile Version " + version + "\na pyramid\nASCII\nDATASET " + dataset +
         "\nPOINTS 5 double\n" + kPoints;
}

std::string vtk_xml(const std::string& type, const std::string& counts, const std::string& arrays) {
  const auto array = [](const std::string& attributes, const std::string& numbers) {
    return "<DataArray " + attributes + " format=\"ascii\">\n" + numbers + "\n</DataArray>\n";
  };
  return "<?xml version=\"1.0\"?>\n<VTKFile type=\"" + type +
         "\" version=\"0.1\" byte_order=\"LittleEndian\">\n<" + type +
         ">\n<Piece NumberOfPoints=\"5\" " + counts + ">\n<Points>\n" +
         array("type=\"Float64\" Name=\"Points\" NumberOfComponents=\"3\"", kPoints) +
         "</Points>\n" + arrays + array("type=\"Int64\" Name=\"connectivity\"", kConnectivity) +
         array("type=\"Int64\" Name=\"offsets\"", kOffsets) +
         (type == "PolyData" ? "</Polys>\n"
                             : array("type=\"UInt8\" Name=\"types\"", "5 5 5 5 9") + "</Cells>\n") +
         "</Piece>\n</" + type + ">\n</VTKFile>\n";
}

std::string gmsh_2() {
  return "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n5\n1 0 0 0\n2 2 0 0\n3 2 2 0\n4 0 2 0\n"
         "5 1 1 1.5\n$EndNodes\n$Elements\n5\n1 2 2 0 1 1 2 5\n2 2 2 0 1 2 3 5\n3 2 2 0 1 3 4 5\n"
         "4 2 2 0 1 4 1 5\n5 3 2 0 1 4 3 2 1\n$EndElements\n";
}

std::string gmsh_4() {
  return "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Nodes\n1 5 1 5\n2 1 0 5\n1\n2\n3\n4\n5\n" +
         std::string(kPoints) +
         "$EndNodes\n$Elements\n2 5 1 5\n2 1 2 4\n1 1 2 5\n2 2 3 5\n3 3 4 5\n4 4 1 5\n2 1 3 1\n"
         "5 4 3 2 1\n$EndElements\n";
}

std::string medit() {
  return "MeshVersionFormatted 2\nDimension 3\nVertices\n5\n0 0 0 0\n2 0 0 0\n2 2 0 0\n0 2 0 0\n"
         "1 1 1.5 0\nTriangles\n4\n1 2 5 1\n2 3 5 1\n3 4 5 1\n4 1 5 1\nQuadrilaterals\n1\n"
         "4 3 2 1 1\nEnd\n";
}

}  // namespace

std::string gzipped(const std::string& bytes) {
  constexpr int kGzip = 16 + MAX_WBITS, kMemory = 8;
  z_stream stream{};
  deflateInit2(&stream, Z_BEST_COMPRESSION, Z_DEFLATED, kGzip, kMemory, Z_DEFAULT_STRATEGY);
  std::string packed(deflateBound(&stream, bytes.size()), '\0');
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
  stream.avail_in = static_cast<uInt>(bytes.size());
  stream.next_out = reinterpret_cast<Bytef*>(packed.data());
  stream.avail_out = static_cast<uInt>(packed.size());
  deflate(&stream, Z_FINISH);
  packed.resize(stream.total_out);
  deflateEnd(&stream);
  return packed;
}

std::vector<Sample> surface_samples() {
  const std::string faces = "3 0 1 4\n3 1 2 4\n3 2 3 4\n3 3 0 4\n4 3 2 1 0\n";
  const std::string vtk = vtk_header("3.0", "POLYDATA") + "POLYGONS 5 21\n" + faces;
  return {
      {"vtk_poly_data", "a.vtk", vtk},
      {"vtk_poly_data_with_offsets", "a.vtk",
       vtk_header("5.1", "POLYDATA") + "POLYGONS 6 16\nOFFSETS vtktypeint64\n0 " + kOffsets +
           "\nCONNECTIVITY vtktypeint64\n" + kConnectivity + "\n"},
      {"vtk_grid", "a.vtk",
       vtk_header("3.0", "UNSTRUCTURED_GRID") + "CELLS 5 21\n" + faces +
           "CELL_TYPES 5\n5\n5\n5\n5\n7\nPOINT_DATA 5\n"},
      {"vtu", "a.vtu", vtk_xml("UnstructuredGrid", "NumberOfCells=\"5\"", "<Cells>\n")},
      {"vtp", "a.vtp", vtk_xml("PolyData", "NumberOfVerts=\"0\" NumberOfPolys=\"5\"", "<Polys>\n")},
      {"gmsh_2", "a.msh", gmsh_2()},
      {"gmsh_2_behind_comments", "a.msh", "$Comments\nby hand $ Nodes\n$EndComments\n" + gmsh_2()},
      {"gmsh_4", "a.msh", gmsh_4()},
      {"medit", "a.mesh", medit()},
      {"vtk_packed", "a.vtk.gz", gzipped(vtk)},
      {"medit_packed_without_saying_so", "a.mesh", gzipped(medit())},
  };
}

}  // namespace geotherm::test
