// SPDX-License-Identifier: MIT
#include "solver/points/io/pcd_header.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "solver/core/text.h"
#include "solver/mesh/io/header_lines.h"
#include "solver/mesh/io/text_scanner.h"

namespace geotherm::io {
namespace {

/// Values a point, and bytes: more are no point.
constexpr std::uint64_t kMaxOfPoint = 1 << 20;

/// The header, line by line.
class PcdHeaderReader : private HeaderLines {
 public:
  explicit PcdHeaderReader(std::string_view bytes) : HeaderLines(bytes) {}

  PcdHeader read() {
    while (next_line()) {
      const std::string_view keyword = word();
      if (keyword.empty() || keyword.starts_with('#')) continue;
      if (keyword == "FIELDS") {
        read_fields();
      } else if (keyword == "SIZE") {
        for_each_field("SIZE", [&](PcdField& field) { field.size = read_size(); });
      } else if (keyword == "TYPE") {
        for_each_field("TYPE", [&](PcdField& field) { field.type = read_type(); });
      } else if (keyword == "COUNT") {
        for_each_field("COUNT", [&](PcdField& field) { field.count = whole(kMaxOfPoint); });
      } else if (keyword == "WIDTH") {
        width_ = whole(kMaxPoints);
      } else if (keyword == "HEIGHT") {
        height_ = whole(kMaxPoints);
      } else if (keyword == "POINTS") {
        points_ = whole(kMaxPoints);
      } else if (keyword == "DATA") {
        return read_data();
      } else if (keyword != "VERSION" && keyword != "VIEWPOINT") {
        fail("unknown word " + quoted(bytes(), keyword.data()) + " in the header");
      }
    }
    fail("the file ends inside the header (no \"DATA\")");
  }

 private:
  static constexpr std::uint64_t kMaxPoints = 999'999'999'999;

  std::uint64_t whole(std::uint64_t most) {
    const std::string_view text = word();
    std::int64_t value = 0;
    if (text.empty() || parse_integer(text.data(), value) != text.data() + text.size()) {
      fail(text.empty() ? "a number is missing" : quoted(text, text.data()) + " is not a number");
    }
    if (value < 0 || static_cast<std::uint64_t>(value) > most) {
      fail("the number " + std::to_string(value) + " is out of range (0 to " +
           std::to_string(most) + ")");
    }
    return static_cast<std::uint64_t>(value);
  }

  void read_fields() {
    if (!header_.fields.empty()) fail("the fields are named twice");
    for (std::string_view name = word(); !name.empty(); name = word()) {
      header_.fields.push_back({std::string(name)});
      if (header_.fields.size() > kMaxOfPoint) fail("a point has too many fields");
    }
    if (header_.fields.empty()) fail("no field is named");
  }

  template <class Read>
  void for_each_field(const std::string& what, const Read& read) {
    if (header_.fields.empty()) fail(what + " stands before FIELDS");
    for (PcdField& field : header_.fields) read(field);
    if (!word().empty()) {
      fail("there are more values of " + what + " than the " +
           counted_text(header_.fields.size(), "field", "fields"));
    }
  }

  std::uint64_t read_size() {
    const std::uint64_t size = whole(8);
    if (size == 0 || (size & (size - 1)) != 0) {
      fail("a value cannot have " + std::to_string(size) + " bytes (1, 2, 4 or 8)");
    }
    return size;
  }

  char read_type() {
    const std::string_view type = word();
    if (type != "I" && type != "U" && type != "F") {
      fail("a type is missing or unknown", {"there are I, U, F"});
    }
    return type[0];
  }

  PcdHeader read_data() {
    const std::string_view data = word();
    if (data == "ascii") {
      header_.data = PcdData::kAscii;
    } else if (data == "binary") {
      header_.data = PcdData::kBinary;
    } else if (data == "binary_compressed") {
      header_.data = PcdData::kCompressed;
    } else {
      fail("unknown kind of data", {"there are ascii, binary, binary_compressed"});
    }
    header_.body = next();
    if (header_.fields.empty()) fail("the header has no line \"FIELDS\"");
    if (!points_ && !width_) fail("the header has neither \"POINTS\" nor \"WIDTH\"");
    lay_out();
    set_points();
    return std::move(header_);
  }

  void lay_out() {
    for (PcdField& field : header_.fields) {
      if (field.type == 'F' && field.size < 4) {
        fail("a floating point number cannot have " + std::to_string(field.size) +
             " bytes (4 or 8)");
      }
      field.first = header_.values;
      field.start = header_.bytes;
      header_.values += field.count;
      header_.bytes += field.count * field.size;
      if (header_.bytes > kMaxOfPoint) fail("a point has more than 1048576 bytes");
    }
  }

  void set_points() {
    constexpr std::uint64_t kOnlyRow = 1;
    const std::uint64_t rows = height_.value_or(kOnlyRow);
    if (width_ && rows > 0 && *width_ > kMaxPoints / rows) fail("there are too many points");
    header_.points = points_ ? *points_ : *width_ * rows;
    if (width_ && *width_ * rows != header_.points) {
      fail("the header announces " + std::to_string(header_.points) + " points, but its grid has " +
           std::to_string(*width_) + " x " + std::to_string(rows));
    }
    const auto left = static_cast<std::uint64_t>(bytes().data() + bytes().size() - header_.body);
    // In text a digit and what separates it; packed ones are looked at when they are unpacked.
    const std::uint64_t least = header_.data == PcdData::kAscii    ? 2 * header_.values
                                : header_.data == PcdData::kBinary ? header_.bytes
                                                                   : 0;
    const std::uint64_t room = header_.data == PcdData::kAscii ? left + 1 : left;
    if (least > 0 && header_.points > room / least) {
      fail_at_byte(bytes(), header_.body,
                   "the header announces " + std::to_string(header_.points) +
                       " points with at least " + std::to_string(least) + " bytes each, but only " +
                       std::to_string(left) + " bytes follow");
    }
  }

  PcdHeader header_;
  std::optional<std::uint64_t> width_, height_, points_;
};

}  // namespace

const PcdField* PcdHeader::find(std::string_view name) const {
  const auto found = std::ranges::find_if(
      fields, [&](const PcdField& field) { return field.name == name && field.count == 1; });
  return found == fields.end() ? nullptr : &*found;
}

PcdHeader read_pcd_header(std::string_view bytes) { return PcdHeaderReader(bytes).read(); }

}  // namespace geotherm::io
