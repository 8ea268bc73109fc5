// SPDX-License-Identifier: MIT
#include "tests/volume/tet_files.h"

#include <zlib.h>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstring>

#include "bench/models/volumes.h"

namespace geotherm::test {
namespace {

constexpr auto kLittle = std::endian::little, kBig = std::endian::big;

template <class T>
std::string raw(T value, std::endian order = kLittle) {
  std::string bytes(sizeof(T), '\0');
  std::memcpy(bytes.data(), &value, sizeof(T));
  if (order != std::endian::native) std::ranges::reverse(bytes);
  return bytes;
}

/// Numbers as words or as bytes: what is written either way is written once.
struct Out {
  bool binary = false;
  std::endian order = kLittle;
  std::string text;

  template <class T>
  Out& operator<<(T value) {
    if (binary) {
      text += raw(value, order);
    } else if constexpr (std::is_floating_point_v<T>) {
      std::string digits = std::to_string(value);
      text += digits + ' ';
    } else {
      text += std::to_string(value) + ' ';
    }
    return *this;
  }
  Out& words(const std::string& words) {
    text += words;
    return *this;
  }
  Out& line() {
    if (!binary) text += '\n';
    return *this;
  }
};

template <class Real>
void put_point(Out& out, const Vec3& p) {
  out << static_cast<Real>(p.x()) << static_cast<Real>(p.y()) << static_cast<Real>(p.z());
}

std::string medit_tets() {
  Out out;
  out.words("# a box\nMeshVersionFormatted 2\nDimension\n3\nVertices 8\n");
  for (const Vec3& p : small_box().positions()) {
    put_point<double>(out, p);
    out << 7;
    out.line();
  }
  out.words("Triangles\n2\n1 2 4 0\n1 2 6 0\nRidges 1\n1\nNormals 1\nnan 0 1e999\nTetrahedra 6\n");
  for (const Tet& tet : small_box().tets()) {
    for (const Index v : tet) out << v + 1;
    out << 3;
    out.line();
  }
  return out.words("RequiredVertices 1\n1\nEnd\n").text;
}

template <class Real, class Position, class Number>
std::string meshb(std::int32_t version, std::endian order) {
  Out out{true, order, {}};
  out << std::int32_t{1} << version << std::int32_t{3};
  const auto next = [&out](std::size_t bytes) {
    out << static_cast<Position>(out.text.size() + sizeof(Position) + bytes);
  };
  next(4);
  out << std::int32_t{3} << std::int32_t{4};
  next(sizeof(Number) + 8 * (3 * sizeof(Real) + sizeof(Number)));
  out << Number{8};
  for (const Vec3& p : small_box().positions()) {
    put_point<Real>(out, p);
    out << Number{1};
  }
  out << std::int32_t{6};  // triangles
  next(sizeof(Number) * 9);
  out << Number{2};
  for (const int value : {1, 2, 4, 0, 1, 2, 6, 0}) out << static_cast<Number>(value);
  out << std::int32_t{8};
  next(sizeof(Number) * 31);
  out << Number{6};
  for (const Tet& tet : small_box().tets()) {
    for (const Index v : tet) out << static_cast<Number>(v + 1);
    out << Number{0};
  }
  out << std::int32_t{54} << Position{0};
  return out.text;
}

std::string gmsh_head(const Out& out, const std::string& version) {
  std::string text = "$MeshFormat\n" + version + (out.binary ? " 1 8\n" : " 0 8\n");
  if (out.binary) text += raw(std::int32_t{1}, out.order) + '\n';
  return text + "$EndMeshFormat\n$PhysicalNames\n1\n3 1 \"box\"\n$EndPhysicalNames\n";
}

/// Node v has the tag v + 1, or a larger one that falls.
std::string gmsh_2(bool binary, std::endian order, bool sparse) {
  const auto tag = [sparse](Index v) { return std::int32_t{sparse ? 900 - 10 * v : v + 1}; };
  Out out{binary, order, {}};
  out.words(gmsh_head(out, "2.2") + "$Nodes\n8\n");
  for (Index v = 0; v < 8; ++v) {
    out << tag(v);
    put_point<double>(out, small_box().positions()[v]);
    out.line();
  }
  if (binary) out.words("\n");
  out.words("$EndNodes\n$Elements\n8\n");
  if (binary) out << std::int32_t{2} << std::int32_t{2} << std::int32_t{2};
  for (const std::int32_t number : {1, 2}) {
    out << number;
    if (!binary) out << 2 << 2;
    out << std::int32_t{1} << std::int32_t{5} << tag(0) << tag(1) << tag(3 * number);
    out.line();
  }
  if (binary) out << std::int32_t{4} << std::int32_t{6} << std::int32_t{0};
  for (Index t = 0; t < 6; ++t) {
    out << std::int32_t{t + 3};
    if (!binary) out << 4 << 0;
    for (const Index v : small_box().tets()[t]) out << tag(v);
    out.line();
  }
  if (binary) out.words("\n");
  return out.words("$EndElements\n").text;
}

std::string gmsh_4(bool binary, std::endian order) {
  using Count = std::uint64_t;
  Out out{binary, order, {}};
  out.words(gmsh_head(out, "4.1") + "$Nodes\n");
  out << Count{3} << Count{8} << Count{1} << Count{8};
  out.line();
  // Two blocks of nodes, the second with a parameter, and an empty one.
  for (const auto& [begin, end] : {std::pair(0, 5), std::pair(5, 8), std::pair(8, 8)}) {
    out << std::int32_t{1} << std::int32_t{1} << std::int32_t{begin == 5 ? 1 : 0}
        << Count(end - begin);
    out.line();
    for (int v = begin; v < end; ++v) (out << Count(v + 1)).line();
    for (int v = begin; v < end; ++v) {
      put_point<double>(out, small_box().positions()[v]);
      if (begin == 5) out << 0.5;
      out.line();
    }
  }
  if (binary) out.words("\n");
  out.words("$EndNodes\n$Elements\n");
  out << Count{2} << Count{8} << Count{1} << Count{8};
  out.line() << std::int32_t{2} << std::int32_t{1} << std::int32_t{2} << Count{2};
  out.line() << Count{1} << Count{1} << Count{2} << Count{4};
  out.line() << Count{2} << Count{1} << Count{2} << Count{6};
  out.line() << std::int32_t{3} << std::int32_t{1} << std::int32_t{4} << Count{6};
  out.line();
  for (Index t = 0; t < 6; ++t) {
    out << Count(t + 3);
    for (const Index v : small_box().tets()[t]) out << Count(v + 1);
    out.line();
  }
  if (binary) out.words("\n");
  return out.words("$EndElements\n").text;
}

std::vector<int> corners_of_cells() {
  std::vector<int> corners = {0, 1, 3, 0, 1, 5};
  for (const Tet& tet : small_box().tets()) corners.insert(corners.end(), tet.begin(), tet.end());
  return corners;
}

std::vector<int> ends_of_cells() { return {3, 6, 10, 14, 18, 22, 26, 30}; }
std::vector<int> types_of_cells() { return {5, 5, 10, 10, 10, 10, 10, 10}; }

template <class Real>
std::string vtk(bool binary, bool with_offsets) {
  Out out{binary, kBig, {}};
  out.words(std::string("# vtk DataFile Version ") + (with_offsets ? "5.1" : "3.0") + "\n\n" +
            (binary ? "BINARY" : "ASCII") + "\nDATASET UNSTRUCTURED_GRID\n");
  out.words("FIELD FieldData 1\nTIME 1 2 double\n") << 1.0 << 2.0;
  out.words(sizeof(Real) == 4 ? "\nPOINTS 8 float\n" : "\nPOINTS 8 double\n");
  for (const Vec3& p : small_box().positions()) put_point<Real>(out, p);
  out.words("\nMETADATA\nINFORMATION 0\n\n");
  const std::vector<int> corners = corners_of_cells();
  std::vector<int> ends = ends_of_cells();
  if (with_offsets) {
    out.words("CELLS 9 30\nOFFSETS vtktypeint64\n") << std::int64_t{0};
    for (const int end : ends) out << std::int64_t{end};
    out.words("\nCONNECTIVITY vtktypeint64\n");
    for (const int corner : corners) out << std::int64_t{corner};
  } else {
    out.words("CELLS 8 38\n");
    std::size_t at = 0;
    for (const int end : ends) {
      out << static_cast<std::int32_t>(static_cast<std::size_t>(end) - at);
      while (at < static_cast<std::size_t>(end)) out << std::int32_t{corners[at++]};
      out.line();
    }
  }
  out.words("\nCELL_TYPES 8\n");
  for (const int type : types_of_cells()) out << std::int32_t{type};
  return out.words("\nPOINT_DATA 8\nSCALARS a float\nwhatever follows").text;
}

enum class Storage { kText, kBase64, kRaw, kAppendedBase64, kPacked };

std::string packed(const std::string& bytes) {
  constexpr std::size_t kBlock = 64;
  const std::size_t blocks = (bytes.size() + kBlock - 1) / kBlock;
  std::string head = raw(static_cast<std::uint32_t>(blocks)) + raw(std::uint32_t{kBlock}) +
                     raw(static_cast<std::uint32_t>(bytes.size() % kBlock));
  std::string body;
  for (std::size_t at = 0; at < bytes.size(); at += kBlock) {
    const std::string block = bytes.substr(at, kBlock);
    uLongf size = ::compressBound(block.size());
    std::string small(size, '\0');
    ::compress(reinterpret_cast<Bytef*>(small.data()), &size,
               reinterpret_cast<const Bytef*>(block.data()), block.size());
    head += raw(static_cast<std::uint32_t>(size));
    body += small.substr(0, size);
  }
  return base64(head) + base64(body);
}

template <class T>
std::string vtu_values(const std::vector<double>& values, Storage storage, std::string& appended,
                       std::string& attributes) {
  std::string bytes, text;
  for (const double value : values) {
    bytes += raw(static_cast<T>(value));
    text += std::to_string(value).substr(0, std::is_integral_v<T> ? 0 : 8);
    if (std::is_integral_v<T>) text += std::to_string(static_cast<std::int64_t>(value));
    text += ' ';
  }
  const std::string with_length = raw(static_cast<std::uint32_t>(bytes.size())) + bytes;
  if (storage == Storage::kText) return text;
  if (storage == Storage::kBase64) return base64(with_length);
  if (storage == Storage::kPacked) return packed(bytes);
  attributes = " offset=\"" + std::to_string(appended.size()) + '"';
  appended += storage == Storage::kRaw ? with_length : base64(with_length);
  return {};
}

std::string vtu(Storage storage) {
  const bool is_appended = storage == Storage::kRaw || storage == Storage::kAppendedBase64;
  const std::string format = is_appended                 ? "appended"
                             : storage == Storage::kText ? "ascii"
                                                         : "binary";
  std::string appended;
  const auto array = [&]<class T>(T, const std::string& type, const std::string& name,
                                  const std::vector<double>& values) {
    std::string attributes;
    const std::string inside = vtu_values<T>(values, storage, appended, attributes);
    return "<DataArray type='" + type + "' Name=\"" + name + "\" format=\"" + format + '"' +
           attributes + (is_appended ? "/>\n" : ">\n" + inside + "\n</DataArray>\n");
  };
  const auto doubles = [](const std::vector<int>& list) {
    return std::vector<double>(list.begin(), list.end());
  };
  std::vector<double> xyz;
  for (const Vec3& p : small_box().positions()) xyz.insert(xyz.end(), p.begin(), p.end());
  std::string text =
      "<?xml version=\"1.0\"?>\n<!-- a box > --><VTKFile type=\"UnstructuredGrid\" version=\"0.1\"";
  if (storage == Storage::kPacked) text += " compressor=\"vtkZLibDataCompressor\"";
  text +=
      " byte_order=\"LittleEndian\">\n<UnstructuredGrid>\n<Piece NumberOfPoints=\"8\" "
      "NumberOfCells=\"8\">\n<PointData>\n";
  text += array(0.0, "Float64", "a", std::vector<double>(8, 1.5)) + "</PointData>\n<Points>\n";
  text += array(0.0F, "Float32", "Points", xyz) + "</Points>\n<Cells>\n";
  text += array(std::int32_t{}, "Int32", "connectivity", doubles(corners_of_cells()));
  text += array(std::int64_t{}, "Int64", "offsets", doubles(ends_of_cells()));
  text += array(std::uint8_t{}, "UInt8", "types", doubles(types_of_cells()));
  text += "</Cells>\n</Piece>\n</UnstructuredGrid>\n";
  if (is_appended) {
    text += std::string("<AppendedData encoding=\"") +
            (storage == Storage::kRaw ? "raw" : "base64") + "\">\n_" + appended +
            "\n</AppendedData>\n";
  }
  return text + "</VTKFile>\n";
}

}  // namespace

const TetMesh& small_box() {
  static const TetMesh kBox = make_box_tets(1, 1, 1, Vec3(2, 1.5, 1));
  return kBox;
}

std::string base64(const std::string& bytes) {
  static constexpr char kDigits[] =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t at = 0; at < bytes.size(); at += 3) {
    std::uint32_t value = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      value = value << 8 | (at + k < bytes.size() ? static_cast<unsigned char>(bytes[at + k]) : 0U);
    }
    for (std::size_t k = 0; k < 4; ++k) {
      text += at + k <= bytes.size() ? kDigits[value >> (18 - 6 * k) & 63U] : '=';
    }
  }
  return text;
}

std::string node_text(int first) {
  Out out;
  out.words("# nodes\n8 3 1 0\n");
  for (int v = 0; v < 8; ++v) {
    out << v + first;
    put_point<double>(out, small_box().positions()[v]);
    out << 0.25;
    out.line();
  }
  return out.text;
}

std::string ele_text(int first) {
  Out out;
  out.words("6 4 1\n");
  for (int t = 0; t < 6; ++t) {
    out << t + first;
    for (const Index v : small_box().tets()[t]) out << v + first;
    out << 1;
    out.line();
  }
  return out.words("# the end\n").text;
}

std::vector<TetSample> tet_samples() {
  return {{"Medit", "a.mesh", medit_tets()},
          {"MeditFloats", "a.meshb", meshb<float, std::int32_t, std::int32_t>(1, kLittle)},
          {"MeditDoubles", "a.meshb", meshb<double, std::int32_t, std::int32_t>(2, kLittle)},
          {"MeditBig", "a.meshb", meshb<double, std::int64_t, std::int32_t>(3, kBig)},
          {"MeditLarge", "a.meshb", meshb<double, std::int64_t, std::int64_t>(4, kLittle)},
          {"Gmsh2", "a.msh", gmsh_2(false, kLittle, false)},
          {"Gmsh2Sparse", "a.msh", gmsh_2(false, kLittle, true)},
          {"Gmsh2Binary", "a.msh", gmsh_2(true, kLittle, true)},
          {"Gmsh2Big", "a.msh", gmsh_2(true, kBig, false)},
          {"Gmsh4", "a.msh", gmsh_4(false, kLittle)},
          {"Gmsh4Binary", "a.msh", gmsh_4(true, kLittle)},
          {"Gmsh4Big", "a.msh", gmsh_4(true, kBig)},
          {"Vtk", "a.vtk", vtk<double>(false, false)},
          {"VtkBinary", "a.vtk", vtk<float>(true, false)},
          {"Vtk5", "a.VTK", vtk<float>(false, true)},
          {"Vtk5Binary", "a.vtk", vtk<double>(true, true)},
          {"VtuText", "a.vtu", vtu(Storage::kText)},
          {"VtuBase64", "a.vtu", vtu(Storage::kBase64)},
          {"VtuRaw", "a.vtu", vtu(Storage::kRaw)},
          {"VtuAppendedBase64", "a.vtu", vtu(Storage::kAppendedBase64)},
          {"VtuPacked", "a.vtu", vtu(Storage::kPacked)}};
}

}  // namespace geotherm::test
