// SPDX-License-Identifier: MIT
#include "solver/mesh/io/ply_header.h"

#include <algorithm>
#include <string>
#include <unordered_set>
#include <utility>

#include "solver/mesh/io/header_lines.h"
#include "solver/mesh/io/text_scanner.h"

namespace geotherm::io {
namespace {

struct PlyType {
  std::string_view name, old_name;
  NumberType type;
};
constexpr PlyType kPlyTypes[] = {
    {"int8", "char", NumberType::kInt8},        {"uint8", "uchar", NumberType::kUint8},
    {"int16", "short", NumberType::kInt16},     {"uint16", "ushort", NumberType::kUint16},
    {"int32", "int", NumberType::kInt32},       {"uint32", "uint", NumberType::kUint32},
    {"float32", "float", NumberType::kFloat32}, {"float64", "double", NumberType::kFloat64}};

/// The header, line by line and word by word.
class HeaderReader : private HeaderLines {
 public:
  explicit HeaderReader(std::string_view bytes) : HeaderLines(bytes) {}

  PlyHeader read() {
    if (!next_line() || word() != "ply") fail("a PLY file starts with the line \"ply\"");
    bool has_format = false;
    while (next_line()) {
      const std::string_view keyword = word();
      if (keyword == "format") {
        read_format();
        has_format = true;
      } else if (keyword == "element") {
        read_element();
      } else if (keyword == "property") {
        read_property();
      } else if (keyword == "end_header") {
        if (!has_format) fail("the header has no line \"format\"");
        header_.body = next();
        return std::move(header_);
      } else if (!keyword.empty() && keyword != "comment" && keyword != "obj_info") {
        fail("unknown word " + quoted(bytes(), keyword.data()) + " in the header");
      }
    }
    fail("the file ends inside the header (no \"end_header\")");
  }

 private:
  void read_format() {
    const std::string_view name = word();
    if (name == "ascii") {
      header_.format = PlyFormat::kAscii;
    } else if (name == "binary_little_endian") {
      header_.format = PlyFormat::kLittleEndian;
    } else if (name == "binary_big_endian") {
      header_.format = PlyFormat::kBigEndian;
    } else {
      fail("unknown format", {"there are ascii, binary_little_endian, binary_big_endian"});
    }
  }

  void read_element() {
    PlyElement element;
    element.name = word();
    const std::string_view count = word();
    if (count.empty() || parse_integer(count.data(), element.count) != count.end()) {
      fail("an element needs a name and a count");
    }
    if (element.count < 0) fail("the count " + std::to_string(element.count) + " is negative");
    if (!names_.insert(element.name).second) fail("an element is declared twice");
    property_names_.clear();
    header_.elements.push_back(std::move(element));
  }

  void read_property() {
    if (header_.elements.empty()) fail("a property stands before the first element");
    PlyProperty property;
    std::string_view type = word();
    if (type == "list") {
      property.is_list = true;
      property.count_type = read_type(word());
      type = word();
    }
    property.type = read_type(type);
    property.name = word();
    if (property.name.empty()) fail("a property has no name");
    if (!property_names_.insert(property.name).second) {
      fail("the property " + quoted(property.name, property.name.data()) +
           " is there twice in an element");
    }
    header_.elements.back().properties.push_back(std::move(property));
  }

  NumberType read_type(std::string_view name) {
    for (const PlyType& each : kPlyTypes) {
      if (name == each.name || name == each.old_name) return each.type;
    }
    fail("unknown type " + quoted(name, name.data()) + " of a property");
  }

  PlyHeader header_;
  std::unordered_set<std::string> names_;           ///< of the elements
  std::unordered_set<std::string> property_names_;  ///< of the last element
};

/// The least number of bytes one row takes in the body.
std::uint64_t least_row_bytes(const PlyElement& element, PlyFormat format) {
  std::uint64_t bytes = 0;
  for (const PlyProperty& property : element.properties) {
    if (format == PlyFormat::kAscii) {
      bytes += 2;  // one digit, one separator
    } else {
      bytes += size_of(property.is_list ? property.count_type : property.type);
    }
  }
  return bytes;
}

}  // namespace

int PlyElement::find(std::string_view property, bool is_list) const {
  const auto found = std::ranges::find_if(
      properties, [&](const PlyProperty& p) { return p.name == property && p.is_list == is_list; });
  return found == properties.end() ? -1 : static_cast<int>(found - properties.begin());
}

const PlyElement* PlyHeader::find(std::string_view element) const {
  const auto found = std::ranges::find(elements, element, &PlyElement::name);
  return found == elements.end() ? nullptr : &*found;
}

PlyHeader parse_ply_header(std::string_view bytes) { return HeaderReader(bytes).read(); }

PlyHeader read_ply_header(std::string_view bytes) {
  PlyHeader header = parse_ply_header(bytes);
  const auto left = static_cast<std::uint64_t>(bytes.data() + bytes.size() - header.body);
  for (const PlyElement& element : header.elements) {
    const std::uint64_t row = least_row_bytes(element, header.format);
    if (row > 0 && static_cast<std::uint64_t>(element.count) > (left + 1) / row) {
      fail_at_byte(bytes, header.body,
                   "the header announces " + std::to_string(element.count) + " of element " +
                       quoted(element.name, element.name.data()) + " with at least " +
                       std::to_string(row) + " bytes each, but only " + std::to_string(left) +
                       " bytes follow");
    }
  }
  return header;
}

}  // namespace geotherm::io
