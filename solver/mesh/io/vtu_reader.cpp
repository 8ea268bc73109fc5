// SPDX-License-Identifier: MIT
// VTK's XML formats for unstructured grids and poly data ("VTK XML formats", Kitware): the tags are
// looked through once for the arrays of points and cells, whose numbers are read after that.
#include <string>
#include <utility>
#include <vector>

#include "solver/mesh/io/input_file.h"
#include "solver/mesh/io/raw_elements.h"
#include "solver/mesh/io/vtk_cells.h"
#include "solver/mesh/io/vtk_xml.h"

namespace geotherm::io {
namespace {

/// One list of cells of a piece: all those of an unstructured grid, one kind of those of poly data.
struct VtuCells {
  std::string_view tag;    ///< around the arrays
  std::string_view count;  ///< the attribute of the piece
  std::int64_t type = 0;   ///< of all cells; 0: the array types has them
  std::int64_t cells = 0;
  VtuArray connectivity = {}, offsets = {}, types = {};
};

struct VtuPiece {
  std::int64_t points = 0;
  VtuArray positions;
  std::vector<VtuCells> lists;
};

class VtuFile {
 public:
  /// `type`: what the file has to hold.
  VtuFile(std::string_view bytes, const char* type, Hint hint, std::vector<VtuCells> lists)
      : bytes_(bytes), type_(type), hint_(std::move(hint)), lists_(std::move(lists)) {}

  RawElements read() {
    read_tags();
    if (!is_vtu_) fail_at_line(bytes_, bytes_.data(), "there is no tag VTKFile");
    RawElements raw;
    for (const VtuPiece& piece : pieces_) add_piece(piece, raw);
    if (pieces_.size() > 1) {
      raw.notes.push_back("the file has " + std::to_string(pieces_.size()) +
                          " pieces; vertices of different pieces are not joined");
    }
    return raw;
  }

 private:
  void read_tags() {
    XmlTags tags(bytes_);
    std::string_view within;  // Points or a list of cells, whose arrays count
    while (const auto tag = tags.next()) {
      if (tag->name == "VTKFile") {
        is_vtu_ = true;
        encoding_ = read_vtk_file_tag(bytes_, *tag, type_, hint_);
      } else if (tag->name == "Piece") {
        pieces_.push_back({vtk_number(bytes_, *tag, "NumberOfPoints"), {}, lists_});
        for (VtuCells& list : pieces_.back().lists) {
          if (list.type != 0 && !attribute(*tag, list.count)) continue;  // none of that kind
          list.cells = vtk_number(bytes_, *tag, list.count);
        }
      } else if (tag->name == "DataArray" && !within.empty() && !pieces_.empty()) {
        read_array_tag(*tag, within);
      } else if (tag->name == "AppendedData") {
        read_vtk_appended_tag(bytes_, *tag, encoding_);
        return;
      } else if (!tag->name.starts_with('/') && tag->name != "DataArray") {
        within = tag->name;
      } else if (tag->name.substr(1) == within) {
        within = {};
      }
    }
  }

  void read_array_tag(const XmlTag& tag, std::string_view within) {
    VtuPiece& piece = pieces_.back();
    if (within == "Points") {
      piece.positions = read_vtk_array_tag(bytes_, tag);
      if (attribute(tag, "NumberOfComponents").value_or("3") != "3") {
        fail_at_tag(bytes_, tag, "the points are not in 3 dimensions");
      }
    }
    const std::string_view name = attribute(tag, "Name").value_or("");
    for (VtuCells& list : piece.lists) {
      VtuArray* const array = list.tag != within       ? nullptr
                              : name == "connectivity" ? &list.connectivity
                              : name == "offsets"      ? &list.offsets
                              : name == "types"        ? &list.types
                                                       : nullptr;
      if (array != nullptr) *array = read_vtk_array_tag(bytes_, tag);
    }
  }

  /// The numbers of an array, none where there are to be none.
  std::vector<std::int64_t> integers(const VtuArray& array, const char* name, std::int64_t count) {
    check_there(array, name);
    if (count == 0) return {};
    return read_vtu_integers(bytes_, encoding_, array, name, count);
  }

  static void check_there(const VtuArray& array, const char* name) {
    if (array.format != VtuArray::Format::kNone) return;
    throw ReadFailure{std::string("a piece has no array \"") + name + "\""};
  }

  void add_piece(const VtuPiece& piece, RawElements& raw) {
    const auto first = static_cast<std::int64_t>(raw.positions.size());
    if (piece.points > 0) {
      check_there(piece.positions, "Points");
      const std::vector<double> xyz =
          read_vtu_reals(bytes_, encoding_, piece.positions, "Points", 3 * piece.points);
      for (std::size_t i = 0; i < xyz.size(); i += 3) {
        raw.positions.emplace_back(xyz[i], xyz[i + 1], xyz[i + 2]);
      }
    }
    for (const VtuCells& list : piece.lists) {
      if (list.cells > 0) add_cells(list, first, raw);
    }
  }

  void add_cells(const VtuCells& list, std::int64_t first, RawElements& raw) {
    VtkCells cells;
    cells.offsets = integers(list.offsets, "offsets", list.cells);
    const std::int64_t corners = cells.offsets.back();
    if (corners < 0 || static_cast<std::uint64_t>(corners) > kMaxVtkNumbers * bytes_.size()) {
      throw ReadFailure{"the last offset of the cells is " + std::to_string(corners)};
    }
    cells.offsets.insert(cells.offsets.begin(), 0);
    cells.connectivity = integers(list.connectivity, "connectivity", corners);
    if (list.type == 0) {
      cells.types = integers(list.types, "types", list.cells);
    } else {
      cells.types.assign(static_cast<std::size_t>(list.cells), list.type);
    }
    add_vtk_cells(cells, first, raw);
  }

  std::string_view bytes_;
  const char* type_;
  Hint hint_;
  std::vector<VtuCells> lists_;  ///< of each piece, without their arrays
  bool is_vtu_ = false;
  VtuEncoding encoding_;
  std::vector<VtuPiece> pieces_;
};

}  // namespace

RawElements read_vtu(std::string_view bytes) {
  return VtuFile(bytes, "UnstructuredGrid", {"a volume of tetrahedra is an unstructured grid"},
                 {{"Cells", "NumberOfCells"}})
      .read();
}

RawElements read_vtp(std::string_view bytes) {
  constexpr std::int64_t kVertices = 2, kLines = 4;
  return VtuFile(bytes, "PolyData", {"a surface is PolyData"},
                 {{"Verts", "NumberOfVerts", kVertices},
                  {"Lines", "NumberOfLines", kLines},
                  {"Strips", "NumberOfStrips", kVtkStrip},
                  {"Polys", "NumberOfPolys", kVtkPolygon}})
      .read();
}

}  // namespace geotherm::io
