// SPDX-License-Identifier: MIT
#include <algorithm>
#include <new>
#include <string_view>
#include <utility>

#include "geotherm/domains.h"
#include "solver/core/text.h"
#include "solver/mesh/io/formats.h"
#include "solver/mesh/io/input_file.h"
#include "solver/volume/io/tetgen_reader.h"

namespace geotherm {
namespace {

struct TetFormat {
  std::string_view extension;
  io::RawElements (*read)(std::string_view bytes);  ///< null: TetGen's pair of files
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
static_assert(io::reads_all(kTetFormats, io::kTets));

Result<TetFile> finish_tets(const std::string& name, io::RawElements raw) {
  const std::string others = text_of_others(raw);
  if (raw.tets.empty()) {
    // Where there are faces, it is a surface.
    return Error{
        raw.faces.empty() ? ErrorCode::kBadFile : ErrorCode::kNotAvailable,
        name + ": the file has no tetrahedra with 4 corners" +
            (raw.faces.empty() ? " and no faces, but " : ", but ") +
            std::to_string(raw.positions.size()) + " vertices" +
            (others.empty() ? "" : " and " + others),
        io::cure_of_others(others, raw.faces.empty() ? "distances need faces or tetrahedra"
                                                     : "distances in a volume need tetrahedra")};
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

/// What `read` makes of the bytes of a file.
template <class Read>
auto read_bytes_of(const io::InputFile& file, const Read& read) {
  using Made = Result<decltype(read(std::string_view()))>;
  return io::read_unchanged(file, file.shown(), "volume",
                            [&]() -> Made { return read(io::FileBytes(file).bytes()); });
}

/// The same path with the extension that the partner has, in capitals where this one is, and as
/// much packed.
std::string partner_of(const std::string& path, std::string_view extension) {
  const std::string own = io::model_extension(path);
  const std::size_t behind = path.size() - (io::file_extension(path) == own ? 0 : 3);
  const std::size_t point = behind - own.size();
  std::string partner(extension);
  if (path[point + 1] >= 'A' && path[point + 1] <= 'Z') {
    for (char& c : partner) {
      if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');
    }
  }
  return path.substr(0, point) + partner + path.substr(behind);
}

Result<TetFile> read_tetgen(const io::InputFile& file) {
  const bool of_nodes = file.extension() == ".node";
  if (io::model_extension(file.path()) != file.extension()) {
    return Error{ErrorCode::kBadFile,
                 file.shown() +
                     ": one of TetGen's two files is read with the other beside it, "
                     "named .node and .ele"};
  }
  const auto beside = [&] {
    return io::InputFile::open(partner_of(file.path(), of_nodes ? ".ele" : ".node"));
  };
  const auto read_nodes = [&]() -> Result<io::TetgenNodes> {
    if (of_nodes) return read_bytes_of(file, io::read_node);
    const auto node_file = beside();
    return node_file ? read_bytes_of(*node_file, io::read_node) : node_file.error();
  };
  const auto read_elements = [](const io::InputFile& elements,
                                io::TetgenNodes nodes) -> Result<TetFile> {
    auto raw = read_bytes_of(
        elements, [&nodes](std::string_view text) { return io::read_ele(text, std::move(nodes)); });
    return raw ? finish_tets(elements.shown(), *std::move(raw)) : raw.error();
  };
  auto nodes = read_nodes();
  if (!nodes) return nodes.error();
  if (!of_nodes) return read_elements(file, *std::move(nodes));
  const auto ele_file = beside();
  return ele_file ? read_elements(*ele_file, *std::move(nodes)) : ele_file.error();
}

}  // namespace

std::vector<std::string> tet_formats() { return io::formats_holding(io::kTets); }

Result<TetFile> read_tets(const ModelInput& input) {
  const io::InputFile& file = input.file();
  const TetFormat* const format = io::format_of(kTetFormats, file.extension());
  if (format == nullptr) return io::unknown_model(file, " of tets", io::kTets);
  if (format->read == nullptr) return read_tetgen(file);
  auto raw = read_bytes_of(file, format->read);
  if (!raw) return raw.error();
  return finish_tets(file.shown(), *std::move(raw));
}

Result<TetFile> read_tets(const std::string& path) {
  const auto input = ModelInput::open(path);
  return input ? read_tets(*input) : input.error();
}

bool holds_tets(const ModelInput& input) {
  constexpr std::size_t kLooked = 4096;
  const io::InputFile& file = input.file();
  const TetFormat* const format = io::format_of(kTetFormats, file.extension());
  if (format == nullptr || format->begins.empty()) return format != nullptr;
  try {
    const std::string start = lower_case(file.start(kLooked));
    return start.find(format->begins) != start.npos;
  } catch (const io::ReadFailure&) {
  } catch (const std::bad_alloc&) {
  }
  return false;
}

}  // namespace geotherm
