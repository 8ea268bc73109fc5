// SPDX-License-Identifier: MIT
// VTK's XML format for unstructured grids ("VTK XML formats", Kitware): the tags are looked through
// once for the arrays of points and cells, whose numbers are read after that.
#include <algorithm>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "solver/mesh/io/input_file.h"
#include "solver/mesh/io/text_scanner.h"
#include "solver/volume/io/raw_tets.h"
#include "solver/volume/io/vtu_arrays.h"

namespace geotherm::io {
namespace {

struct XmlTag {
  std::string_view name;        ///< "/NAME" for one that closes
  std::string_view attributes;  ///< what stands behind the name
  std::size_t behind = 0;       ///< the byte behind >
};

constexpr std::string_view kXmlSpace = " \t\r\n";

/// The tags of a file, one after the other; comments and declarations are passed over.
class XmlTags {
 public:
  explicit XmlTags(std::string_view text) : text_(text) {}

  std::optional<XmlTag> next() {
    for (;;) {
      const std::size_t open = text_.find('<', at_);
      if (open == text_.npos) return {};
      if (text_.substr(open).starts_with("<!--")) {
        pass(open, "-->");
      } else if (text_.substr(open).starts_with("<?") || text_.substr(open).starts_with("<!")) {
        pass(open, ">");
      } else {
        return tag_at(open);
      }
    }
  }

 private:
  void pass(std::size_t open, std::string_view end) {
    const std::size_t close = text_.find(end, open);
    if (close == text_.npos) fail_at_line(text_, text_.data() + open, "a comment does not end");
    at_ = close + end.size();
  }

  XmlTag tag_at(std::size_t open) {
    std::size_t close = open + 1;
    for (char quote = '\0'; close < text_.size() && (quote != '\0' || text_[close] != '>');
         ++close) {
      const char c = text_[close];
      if (quote != '\0') {
        if (c == quote) quote = '\0';
      } else if (c == '"' || c == '\'') {
        quote = c;
      }
    }
    if (close == text_.size()) {
      fail_at_line(text_, text_.data() + open, "a tag does not end: the file ends in it");
    }
    const std::string_view inside = text_.substr(open + 1, close - open - 1);
    const std::size_t length = std::min(inside.find_first_of(kXmlSpace), inside.size());
    at_ = close + 1;
    std::string_view name = inside.substr(0, length);
    if (name.ends_with('/')) name.remove_suffix(1);
    return {name, inside.substr(length), at_};
  }

  std::string_view text_;
  std::size_t at_ = 0;
};

std::optional<std::string_view> attribute(const XmlTag& tag, std::string_view name) {
  std::string_view rest = tag.attributes;
  for (;;) {
    rest.remove_prefix(std::min(rest.find_first_not_of(kXmlSpace), rest.size()));
    const std::size_t equal = rest.find('=');
    if (equal == rest.npos) return {};
    const std::string_view key = rest.substr(0, std::min(equal, rest.find_first_of(kXmlSpace)));
    const std::size_t quote = rest.find_first_of("\"'", equal);
    if (quote == rest.npos) return {};
    const std::size_t end = rest.find(rest[quote], quote + 1);
    if (end == rest.npos) return {};
    if (key == name) return rest.substr(quote + 1, end - quote - 1);
    rest.remove_prefix(end + 1);
  }
}

constexpr struct {
  std::string_view name;
  VtkType type;
} kXmlTypes[] = {{"Int8", VtkType::kInt8},       {"UInt8", VtkType::kUint8},
                 {"Int16", VtkType::kInt16},     {"UInt16", VtkType::kUint16},
                 {"Int32", VtkType::kInt32},     {"UInt32", VtkType::kUint32},
                 {"Int64", VtkType::kInt64},     {"UInt64", VtkType::kUint64},
                 {"Float32", VtkType::kFloat32}, {"Float64", VtkType::kFloat64}};

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
  [[noreturn]] void fail(const XmlTag& tag, const std::string& cause, Hint hint = {}) const {
    fail_at_line(bytes_, tag.name.data(), cause, std::move(hint));
  }

  void read_tags() {
    XmlTags tags(bytes_);
    std::string_view within;  // Points or Cells, whose arrays count
    while (const auto tag = tags.next()) {
      if (tag->name == "VTKFile") {
        read_file_tag(*tag);
      } else if (tag->name == "Piece") {
        pieces_.push_back(
            {number(*tag, "NumberOfPoints"), number(*tag, "NumberOfCells"), {}, {}, {}, {}});
      } else if (tag->name == "Points" || tag->name == "Cells") {
        within = tag->name;
      } else if (tag->name == "/Points" || tag->name == "/Cells") {
        within = {};
      } else if (tag->name == "DataArray" && !within.empty() && !pieces_.empty()) {
        read_array_tag(*tag, within == "Points");
      } else if (tag->name == "AppendedData") {
        const std::size_t mark = bytes_.find('_', tag->behind);
        if (mark == bytes_.npos) fail(*tag, "the appended data have no mark _");
        encoding_.appended = mark + 1;
        encoding_.appended_base64 = attribute(*tag, "encoding").value_or("base64") == "base64";
        return;
      }
    }
  }

  void read_file_tag(const XmlTag& tag) {
    is_vtu_ = true;
    const std::string_view type = attribute(tag, "type").value_or("");
    if (type != "UnstructuredGrid") {
      fail(tag, "the file holds " + quoted(type, type.data()) + " instead of an UnstructuredGrid",
           {"a volume of tetrahedra is an unstructured grid"});
    }
    if (attribute(tag, "byte_order") == "BigEndian") encoding_.order = std::endian::big;
    if (attribute(tag, "header_type") == "UInt64") encoding_.size_of_length = 8;
    const auto compressor = attribute(tag, "compressor");
    encoding_.compressed = compressor && !compressor->empty();
    if (encoding_.compressed && *compressor != "vtkZLibDataCompressor") {
      fail(tag, "the compressor " + quoted(*compressor, compressor->data()) + " is not supported",
           {"save it compressed by ZLib or not at all"});
    }
  }

  std::int64_t number(const XmlTag& tag, std::string_view name) const {
    const auto text = attribute(tag, name);
    std::int64_t value = -1;
    if (text && parse_integer(text->data(), value) == text->data() + text->size() && value >= 0 &&
        static_cast<std::uint64_t>(value) <= kMostTimes * bytes_.size()) {
      return value;
    }
    fail(tag, std::string(name) + (text ? " is " + quoted(*text, text->data()) : " is missing") +
                  " in a file of " + std::to_string(bytes_.size()) + " bytes");
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
    const std::string_view type = attribute(tag, "type").value_or("");
    const auto* const known = std::find_if(std::begin(kXmlTypes), std::end(kXmlTypes),
                                           [type](const auto& each) { return each.name == type; });
    if (known == std::end(kXmlTypes)) {
      fail(tag, "the type of numbers " + quoted(type, type.data()) + " is unknown");
    }
    array->type = known->type;
    const std::string_view format = attribute(tag, "format").value_or("ascii");
    if (format == "appended") {
      array->format = VtuArray::Format::kAppended;
      array->place = static_cast<std::uint64_t>(number(tag, "offset"));
    } else {
      array->format = format == "ascii" ? VtuArray::Format::kText : VtuArray::Format::kBase64;
      array->place = tag.behind;
    }
    if (of_points && attribute(tag, "NumberOfComponents").value_or("3") != "3") {
      fail(tag, "the points are not in 3 dimensions");
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
    if (corners < 0 || static_cast<std::uint64_t>(corners) > kMostTimes * bytes_.size()) {
      throw ReadFailure{"the last offset of the cells is " + std::to_string(corners)};
    }
    cells.offsets.insert(cells.offsets.begin(), 0);
    cells.connectivity = integers(piece.connectivity, "connectivity", corners);
    cells.types = integers(piece.types, "types", piece.cells);
    add_vtk_tets(cells, first, raw);
  }

  static constexpr std::uint64_t kMostTimes = 1100;  ///< numbers a byte, as compressed as can be

  std::string_view bytes_;
  bool is_vtu_ = false;
  VtuEncoding encoding_;
  std::vector<VtuPiece> pieces_;
};

}  // namespace

RawTets read_vtu(std::string_view bytes) { return VtuFile(bytes).read(); }

}  // namespace geotherm::io
