// SPDX-License-Identifier: MIT
// VTK's XML format for unstructured grids ("VTK XML formats", Kitware): the tags are looked through
// once for the arrays of points and cells, whose numbers are read after that.
#include <string>
#include <utility>
#include <vector>

#include "solver/mesh/io/input_file.h"
#include "solver/volume/io/raw_tets.h"
#include "solver/volume/io/vtk_xml.h"

namespace geotherm::io {
namespace {

struct VtuPiece {
  std::int64_t points = 0, cells = 0;
  VtuArray positions, connectivity, offsets, types;
};

class VtuFile {
 public:
  explicit VtuFile(std::string_view bytes) : bytes_(bytes) {}

  RawTets read() {
    read_tags();
    if (!is_vtu_) fail_at_line(bytes_, bytes_.data(), "there is no tag VTKFile");
    RawTets raw;
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
    std::string_view within;  // Points or Cells, whose arrays count
    while (const auto tag = tags.next()) {
      if (tag->name == "VTKFile") {
        is_vtu_ = true;
        encoding_ = read_vtk_file_tag(bytes_, *tag, "UnstructuredGrid",
                                      {"a volume of tetrahedra is an unstructured grid"});
      } else if (tag->name == "Piece") {
        pieces_.push_back({vtk_number(bytes_, *tag, "NumberOfPoints"),
                           vtk_number(bytes_, *tag, "NumberOfCells"),
                           {},
                           {},
                           {},
                           {}});
      } else if (tag->name == "Points" || tag->name == "Cells") {
        within = tag->name;
      } else if (tag->name == "/Points" || tag->name == "/Cells") {
        within = {};
      } else if (tag->name == "DataArray" && !within.empty() && !pieces_.empty()) {
        read_array_tag(*tag, within == "Points");
      } else if (tag->name == "AppendedData") {
        read_vtk_appended_tag(bytes_, *tag, encoding_);
        return;
      }
    }
  }

  void read_array_tag(const XmlTag& tag, bool of_points) {
    VtuPiece& piece = pieces_.back();
    const std::string_view name = attribute(tag, "Name").value_or("");
    VtuArray* const array = of_points                ? &piece.positions
                            : name == "connectivity" ? &piece.connectivity
                            : name == "offsets"      ? &piece.offsets
                            : name == "types"        ? &piece.types
                                                     : nullptr;
    if (array == nullptr) return;
    *array = read_vtk_array_tag(bytes_, tag);
    if (of_points && attribute(tag, "NumberOfComponents").value_or("3") != "3") {
      fail_at_tag(bytes_, tag, "the points are not in 3 dimensions");
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

  void add_piece(const VtuPiece& piece, RawTets& raw) {
    const auto first = static_cast<std::int64_t>(raw.positions.size());
    if (piece.points > 0) {
      check_there(piece.positions, "Points");
      const std::vector<double> xyz =
          read_vtu_reals(bytes_, encoding_, piece.positions, "Points", 3 * piece.points);
      for (std::size_t i = 0; i < xyz.size(); i += 3) {
        raw.positions.emplace_back(xyz[i], xyz[i + 1], xyz[i + 2]);
      }
    }
    if (piece.cells == 0) return;
    VtkCells cells;
    cells.offsets = integers(piece.offsets, "offsets", piece.cells);
    const std::int64_t corners = cells.offsets.back();
    if (corners < 0 || static_cast<std::uint64_t>(corners) > kMostVtkNumbers * bytes_.size()) {
      throw ReadFailure{"the last offset of the cells is " + std::to_string(corners)};
    }
    cells.offsets.insert(cells.offsets.begin(), 0);
    cells.connectivity = integers(piece.connectivity, "connectivity", corners);
    cells.types = integers(piece.types, "types", piece.cells);
    add_vtk_tets(cells, first, raw);
  }

  std::string_view bytes_;
  bool is_vtu_ = false;
  VtuEncoding encoding_;
  std::vector<VtuPiece> pieces_;
};

}  // namespace

RawTets read_vtu(std::string_view bytes) { return VtuFile(bytes).read(); }

}  // namespace geotherm::io
