// SPDX-License-Identifier: MIT
#include "solver/mesh/io/formats.h"

#include <algorithm>
#include <bit>
#include <cstdint>

#include "geotherm/io.h"
#include "solver/core/text.h"
#include "solver/mesh/io/byte_order.h"

namespace geotherm::io {
namespace {

constexpr std::string_view kBlanks = " \t\r\n";

struct FileBeginning {
  std::string_view bytes, name;
};
constexpr FileBeginning kBeginnings[] = {
    {"ply\n", "ply"},      {"ply\r", "ply"},          {"glTF", "glb"},
    {"PK\x03\x04", "3mf"}, {"# vtk DataFile", "vtk"}, {"$MeshFormat", "msh"},
    {"$Comments", "msh"},  {"$NOD", "msh"},           {"MeshVersionFormatted", "mesh"},
    {"\x93NUMPY", "npy"},  {"\x89PNG", "png"},        {"NRRD000", "nrrd"},
    {"# .PCD", "pcd"},     {"LASF", "las"},           {"OFF", "off"},
    {"COFF", "off"},       {"NOFF", "off"},           {"CNOFF", "off"},
    {"STOFF", "off"},      {"solid", "stl"},          {"\xff\xff\xfe", "fsurf"},
};

bool is_binary_stl(std::string_view start, std::size_t size) {
  constexpr std::size_t kHeader = 84, kFacet = 50;
  if (start.size() < kHeader || size < kHeader) return false;
  const std::size_t facets = load<std::uint32_t>(start.data() + kHeader - 4, std::endian::little);
  return facets > 0 && size == kHeader + kFacet * facets;
}

bool is_meshb(std::string_view start) {
  if (start.size() < 8) return false;
  for (const auto order : {std::endian::little, std::endian::big}) {
    const auto version = load<std::int32_t>(start.data() + 4, order);
    if (load<std::int32_t>(start.data(), order) == 1 && version >= 1 && version <= 4) return true;
  }
  return false;
}

std::string_view format_of_xml(std::string_view start) {
  if (start.find("<COLLADA") != start.npos) return "dae";
  if (start.find("<GIFTI") != start.npos) return "gii";
  if (start.find("<VTKFile") == start.npos) return {};
  if (start.find("PolyData") != start.npos) return "vtp";
  return start.find("ImageData") != start.npos ? "vti" : "vtu";
}

/// Whether a text is OBJ, by its first word.
bool is_obj(std::string_view text) {
  constexpr std::string_view kWords[] = {"v", "vn", "vt",     "f",      "o",
                                         "g", "s",  "mtllib", "usemtl", "vp"};
  const std::string_view word = text.substr(0, text.find_first_of(kBlanks));
  return word.size() < text.size() && std::ranges::find(kWords, word) != std::end(kWords);
}

std::string_view format_beginning_as(std::string_view text) {
  for (const FileBeginning& beginning : kBeginnings) {
    if (text.starts_with(beginning.bytes)) return beginning.name;
  }
  return {};
}

/// What is behind blank lines and comments.
std::string_view without_comments(std::string_view text) {
  for (;;) {
    text.remove_prefix(std::min(text.find_first_not_of(kBlanks), text.size()));
    if (!text.starts_with('#')) return text;
    text.remove_prefix(std::min(text.find('\n'), text.size()));
  }
}

}  // namespace

std::vector<std::string> formats_holding(unsigned what) {
  std::vector<std::string> names;
  for (const ModelFormat& format : kModelFormats) {
    if ((format.holds & what) != 0) names.emplace_back(format.name);
  }
  return names;
}

std::string extensions_holding(unsigned what) {
  std::string text;
  for (const std::string& name : formats_holding(what)) text += (text.empty() ? "." : " .") + name;
  return text;
}

std::string_view format_by_content(std::string_view start, std::size_t size) {
  if (is_binary_stl(start, size)) return "stl";
  const std::string_view exact = format_beginning_as(start);
  if (!exact.empty()) return exact;
  if (is_meshb(start)) return "meshb";
  start = without_comments(start);
  if (start.empty()) return {};
  if (start.front() == '<') return format_of_xml(start);
  if (start.front() == '{') return "gltf";
  return is_obj(start) ? "obj" : format_beginning_as(start);
}

std::string model_extension(std::string_view path) {
  constexpr std::string_view kPacked = ".gz";
  const std::string extension = file_extension(path);
  if (extension != kPacked) return extension;
  return file_extension(path.substr(0, path.size() - kPacked.size()));
}

}  // namespace geotherm::io

namespace geotherm {

std::vector<std::string> model_formats() { return io::formats_holding(~0U); }
std::vector<std::string> mesh_formats() { return io::formats_holding(io::kFaces); }

}  // namespace geotherm
