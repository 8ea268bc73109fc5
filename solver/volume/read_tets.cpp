// SPDX-License-Identifier: MIT
#include <algorithm>
#include <new>
#include <string_view>
#include <utility>

#include "geotherm/domains.h"
#include "solver/core/text.h"
#include "solver/mesh/io/input_file.h"
#include "solver/volume/io/raw_tets.h"

namespace geotherm {
namespace {

struct TetFormat {
  std::string_view extension;
  io::RawTets (*read)(std::string_view bytes);  ///< null: TetGen's pair of files
  std::string_view begins;  ///< what a file with elements has near its start; empty: anything
};
constexpr TetFormat kTetFormats[] = {
    {".mesh", io::read_medit, {}},
    {".meshb", io::read_meshb, {}},
    {".msh", io::read_gmsh, "$meshformat"},
    {".vtk", io::read_vtk, "unstructured_grid"},
    {".vtu", io::read_vtu, "unstructuredgrid"},
    {".node", nullptr, {}},
    {".ele", nullptr, {}},
};

const TetFormat* tet_format_of(std::string_view extension) {
  const auto* const found = std::ranges::find(kTetFormats, extension, &TetFormat::extension);
  return found == std::end(kTetFormats) ? nullptr : found;
}

Result<TetFile> finish_tets(const std::string& name, io::RawTets raw) {
  const std::string others = text_of_others(raw);
  if (raw.tets.empty()) {
    return Error{ErrorCode::kBadFile,
                 name + ": the file has no tetrahedra with 4 corners, but " +
                     std::to_string(raw.positions.size()) + " vertices" +
                     (others.empty() ? "" : " and " + others),
                 {"distances in a volume need tetrahedra"}};
  }
  if (!others.empty()) {
    raw.notes.push_back("left out, being no tetrahedra with 4 corners: " + others);
  }
  Result<TetMesh> mesh = TetMesh::build(std::move(raw.positions), std::move(raw.tets));
  if (!mesh) {
    return Error{ErrorCode::kBadFile, name + ": " + mesh.error().message, mesh.error().hint};
  }
  return TetFile{*std::move(mesh), std::move(raw.notes)};
}

/// The bytes of a file are given to `read`; what they hold, or the file itself changed.
template <class Read>
auto read_bytes_of(const std::string& path, const Read& read)
    -> Result<decltype(read(std::string_view()))> {
  const auto file = io::InputFile::open(path);
  if (!file) return file.error();
  using Made = Result<decltype(read(std::string_view()))>;
  auto made = io::guarded_read(io::printable(path), "volume", file->size(),
                               [&]() -> Made { return read(io::FileBytes(*file).bytes()); });
  if (auto same = file->check_unchanged(); !same) return same.error();
  return made;
}

/// The same path with the extension that the partner has, in capitals where this one is.
std::string partner_of(const std::string& path, std::string_view extension) {
  const std::size_t point = path.rfind('.');
  std::string partner = path.substr(0, point) + std::string(extension);
  if (path[point + 1] >= 'A' && path[point + 1] <= 'Z') {
    for (std::size_t i = point; i < partner.size(); ++i) {
      if (partner[i] >= 'a' && partner[i] <= 'z') partner[i] = static_cast<char>(partner[i] - 32);
    }
  }
  return partner;
}

Result<TetFile> read_tetgen(const std::string& path, std::string_view extension) {
  const std::string node_path = extension == ".node" ? path : partner_of(path, ".node");
  const std::string ele_path = extension == ".ele" ? path : partner_of(path, ".ele");
  auto nodes = read_bytes_of(node_path, io::read_node);
  if (!nodes) return nodes.error();
  auto raw = read_bytes_of(
      ele_path, [&nodes](std::string_view text) { return io::read_ele(text, *std::move(nodes)); });
  if (!raw) return raw.error();
  return finish_tets(io::printable(ele_path), *std::move(raw));
}

}  // namespace

std::vector<std::string> tet_formats() {
  std::vector<std::string> names;
  for (const TetFormat& format : kTetFormats) names.emplace_back(format.extension.substr(1));
  return names;
}

Result<TetFile> read_tets(const std::string& path) {
  const std::string extension = io::file_extension(path);
  const TetFormat* const format = tet_format_of(extension);
  if (format == nullptr) {
    if (auto there = io::InputFile::open(path); !there) return there.error();
    return Error{
        ErrorCode::kNotAvailable,
        io::printable(path) + ": unknown extension \"" + io::printable(extension) + "\" of tets",
        {"there are .mesh .meshb .msh .vtk .vtu .node .ele"}};
  }
  if (format->read == nullptr) return read_tetgen(path, extension);
  auto raw = read_bytes_of(path, format->read);
  if (!raw) return raw.error();
  return finish_tets(io::printable(path), *std::move(raw));
}

bool holds_tets(const std::string& path) {
  constexpr std::size_t kLooked = 4096;
  const TetFormat* const format = tet_format_of(io::file_extension(path));
  if (format == nullptr) return false;
  const auto file = io::InputFile::open(path);
  if (!file) return false;
  if (format->begins.empty()) return true;
  try {
    std::string start(std::min(kLooked, file->size()), '\0');
    file->read(start.data(), start.size(), 0);
    for (char& c : start) {
      if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    }
    return start.find(format->begins) != start.npos;
  } catch (const io::ReadFailure&) {
  } catch (const std::bad_alloc&) {
  }
  return false;
}

}  // namespace geotherm
