// SPDX-License-Identifier: MIT
// VTK's legacy format: unstructured grids and poly data, text and binary (big endian), versions up
// to 5.1, whose cells are stored as offsets and connectivity ("VTK file formats", Kitware).
#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "solver/core/text.h"
#include "solver/mesh/io/mixed_scanner.h"
#include "solver/mesh/io/number_type.h"
#include "solver/mesh/io/raw_elements.h"
#include "solver/mesh/io/vtk_cells.h"

namespace geotherm::io {
namespace {

struct LegacyType {
  std::string_view name;
  NumberType type;
};
constexpr std::int64_t kVtkVertices = 2, kVtkLines = 4;
constexpr LegacyType kLegacyTypes[] = {
    {"char", NumberType::kInt8},
    {"signed_char", NumberType::kInt8},
    {"unsigned_char", NumberType::kUint8},
    {"short", NumberType::kInt16},
    {"unsigned_short", NumberType::kUint16},
    {"int", NumberType::kInt32},
    {"unsigned_int", NumberType::kUint32},
    {"vtkidtype", NumberType::kInt32},
    {"long", NumberType::kInt64},
    {"unsigned_long", NumberType::kUint64},
    {"vtktypeint64", NumberType::kInt64},
    {"vtktypeuint64", NumberType::kUint64},
    {"float", NumberType::kFloat32},
    {"double", NumberType::kFloat64},
};

class LegacyVtk {
 public:
  LegacyVtk(std::string_view bytes, std::size_t behind_title, bool has_offsets)
      : scanner_(bytes, '\0', behind_title), has_offsets_(has_offsets) {}

  RawElements read() {
    read_header();
    bool data = false;
    while (!data && !scanner_.words().at_end()) {
      scanner_.now_reading("the list of keywords");
      const std::string keyword = lower_case(scanner_.words().word());
      if (keyword == "points") {
        read_points();
      } else if (keyword == "cells" && !is_poly_data_) {
        be_first(has_cells_, "CELLS");
        read_cells(cells_);
      } else if (keyword == "cell_types") {
        read_types();
      } else if (is_poly_data_ && (keyword == "polygons" || keyword == "triangle_strips")) {
        read_poly_data(keyword == "polygons" ? kVtkPolygon : kVtkStrip);
      } else if (is_poly_data_ && (keyword == "lines" || keyword == "vertices")) {
        read_poly_data(keyword == "lines" ? kVtkLines : kVtkVertices);
      } else if (keyword == "field") {
        pass_field();
      } else if (keyword == "metadata") {
        scanner_.pass("\n\n");  // behind the last one nothing need follow
      } else if (keyword == "point_data" || keyword == "cell_data") {
        data = true;
      } else {
        scanner_.fail(quoted(keyword, keyword.data()) +
                      " stands where a keyword (POINTS, CELLS, ...) should be");
      }
    }
    if (!has_points_) scanner_.fail("the grid has no POINTS");
    if (!is_poly_data_) {
      if (!has_cells_ || !has_types_) scanner_.fail("the grid has no CELLS with CELL_TYPES");
      parts_.push_back(std::move(cells_));
    }
    for (const VtkCells& part : parts_) add_vtk_cells(part, 0, raw_);
    return std::move(raw_);
  }

 private:
  void read_header() {
    scanner_.now_reading("the header");
    TextScanner& words = scanner_.words();
    const std::string kind = lower_case(words.word());
    if (kind != "ascii" && kind != "binary") {
      words.fail("the third line is " + quoted(kind, kind.data()) + " instead of ASCII or BINARY");
    }
    if (kind == "binary") scanner_.be_binary(std::endian::big);
    if (lower_case(words.word()) != "dataset") words.fail("the word DATASET does not follow");
    const std::string data = lower_case(words.word());
    is_poly_data_ = data == "polydata";
    if (!is_poly_data_ && data != "unstructured_grid") {
      words.fail(
          "the dataset " + quoted(data, data.data()) + " is no unstructured grid or poly data",
          {"a surface is poly data, a volume of tetrahedra an unstructured grid"});
    }
  }

  NumberType type() {
    const std::string name = lower_case(scanner_.words().word());
    const auto* const found = std::ranges::find(kLegacyTypes, name, &LegacyType::name);
    if (found == std::end(kLegacyTypes)) {
      scanner_.fail("the type of numbers " + quoted(name, name.data()) + " is unknown");
    }
    return found->type;
  }

  std::int64_t integer(NumberType type) {
    if (type == NumberType::kInt64) return scanner_.integer<std::int64_t>();
    if (type == NumberType::kInt32) return scanner_.integer<std::int32_t>();
    scanner_.fail("numbers of cells are neither int nor vtktypeint64");
  }

  /// A count of values, each of which has at least a digit and a space.
  std::size_t values(std::int64_t count, const char* things, std::size_t bytes) {
    return scanner_.checked_count(count, things, scanner_.is_binary() ? bytes : 2);
  }

  void be_first(bool& seen, const char* keyword) {
    if (seen) scanner_.fail(std::string("there is a second list ") + keyword);
    seen = true;
  }

  void read_points() {
    be_first(has_points_, "POINTS");
    const std::int64_t count = scanner_.words().integer();
    const NumberType type = this->type();
    values(count, "points", 3 * size_of(type));
    scanner_.begin_values();
    raw_.positions.resize(values(count, "points", 3 * size_of(type)));
    with_number_type(type, [&](auto zero) {
      for (std::size_t v = 0; v < raw_.positions.size(); ++v) {
        scanner_.now_reading("point", static_cast<std::int64_t>(v) + 1, count);
        for (double& x : raw_.positions[v]) x = scanner_.coordinate<decltype(zero)>();
      }
    });
    scanner_.end_values();
  }

  /// Lists of one kind of cells, which have no list of types.
  void read_poly_data(std::int64_t type) {
    VtkCells& part = parts_.emplace_back();
    read_cells(part);
    part.types.assign(std::max<std::size_t>(part.offsets.size(), 1) - 1, type);
    if (part.offsets.empty()) part.offsets.push_back(0);
  }

  void read_cells(VtkCells& cells) {
    const std::int64_t first = scanner_.words().integer();
    const std::int64_t second = scanner_.words().integer();
    if (has_offsets_) return read_offset_cells(first, second, cells);
    scanner_.begin_values();
    values(second, "numbers of cells", 4);
    const std::size_t count = values(first, "cells", 4);
    cells.offsets.reserve(count + 1);
    cells.offsets.push_back(0);
    for (std::size_t c = 0; c < count; ++c) {
      scanner_.now_reading("cell", static_cast<std::int64_t>(c) + 1, first);
      const std::size_t corners = values(scanner_.integer<std::int32_t>(), "corners", 4);
      for (std::size_t k = 0; k < corners; ++k) {
        cells.connectivity.push_back(scanner_.integer<std::int32_t>());
      }
      cells.offsets.push_back(static_cast<std::int64_t>(cells.connectivity.size()));
    }
    scanner_.end_values();
  }

  void read_offset_cells(std::int64_t offsets, std::int64_t corners, VtkCells& cells) {
    read_list(offsets, "offsets", cells.offsets);
    read_list(corners, "connectivity", cells.connectivity);
  }

  void read_list(std::int64_t count, const char* name, std::vector<std::int64_t>& list) {
    scanner_.now_reading("the cells");
    if (lower_case(scanner_.words().word()) != name) {
      scanner_.fail(std::string("the word ") + name + " does not follow");
    }
    const NumberType type = this->type();
    values(count, name, size_of(type));
    scanner_.begin_values();
    list.resize(values(count, name, size_of(type)));
    scanner_.now_reading(name);
    for (std::int64_t& value : list) value = integer(type);
    scanner_.end_values();
  }

  void read_types() {
    be_first(has_types_, "CELL_TYPES");
    const std::int64_t count = scanner_.words().integer();
    values(count, "types of cells", 4);
    scanner_.begin_values();
    cells_.types.resize(values(count, "types of cells", 4));
    scanner_.now_reading("the types of cells");
    for (std::int64_t& type : cells_.types) type = scanner_.integer<std::int32_t>();
    scanner_.end_values();
  }

  /// Arrays of the grid as a whole, such as a time.
  void pass_field() {
    scanner_.now_reading("a field");
    scanner_.words().word();  // its name
    const std::int64_t arrays = scanner_.words().integer();
    for (std::int64_t a = 0; a < arrays; ++a) {
      if (lower_case(scanner_.words().word()) == "metadata") {
        scanner_.pass("\n\n");
        scanner_.words().word();
      }
      const auto components =
          static_cast<std::int64_t>(values(scanner_.words().integer(), "components", 1));
      const auto tuples =
          static_cast<std::int64_t>(values(scanner_.words().integer(), "tuples", 1));
      const std::string name = lower_case(scanner_.words().peek());
      if (name == "string" && scanner_.is_binary()) {
        scanner_.words().word();
        scanner_.fail("texts in a binary file are not supported");
      }
      std::size_t bytes = 1;
      if (name == "string") {
        scanner_.words().word();
      } else {
        bytes = size_of(type());
      }
      if (tuples > 0 && components > static_cast<std::int64_t>(scanner_.bytes_left()) / tuples) {
        scanner_.fail("the file ends");
      }
      scanner_.begin_values();
      scanner_.skip<char>(components * tuples *
                          (scanner_.is_binary() ? static_cast<std::int64_t>(bytes) : 1));
      scanner_.end_values();
    }
  }

  MixedScanner scanner_;
  bool has_offsets_;
  bool is_poly_data_ = false;
  bool has_points_ = false, has_cells_ = false, has_types_ = false;
  VtkCells cells_;               ///< of an unstructured grid
  std::vector<VtkCells> parts_;  ///< that are added once all points are known
  RawElements raw_;
};

}  // namespace

RawElements read_vtk(std::string_view bytes) {
  if (!lower_case(bytes.substr(0, 14)).starts_with("# vtk datafile")) {
    fail_at_line(bytes, bytes.data(), "a file of VTK starts with \"# vtk DataFile Version\"");
  }
  const std::size_t first = std::min(bytes.find('\n'), bytes.size() - 1);
  const std::size_t title = std::min(bytes.find('\n', first + 1), bytes.size() - 1);
  // Cells have been stored as offsets and connectivity since version 5.
  const std::size_t digit = bytes.substr(0, first).find_first_of("0123456789");
  const bool has_offsets = digit != bytes.npos && bytes[digit] >= '5';
  return LegacyVtk(bytes, title + 1, has_offsets).read();
}

}  // namespace geotherm::io
