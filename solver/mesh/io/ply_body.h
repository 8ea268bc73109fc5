// SPDX-License-Identifier: MIT
// The values of a PLY file behind its header, one after the other, for all who read some of them.
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>
#include <string>
#include <string_view>
#include <type_traits>

#include "solver/mesh/io/byte_order.h"
#include "solver/mesh/io/input_file.h"
#include "solver/mesh/io/ply_header.h"
#include "solver/mesh/io/text_scanner.h"

namespace geotherm::io {

/// What messages call a row; the name in the file may hold anything.
inline const char* row_name(const PlyElement& element) {
  if (element.name == "vertex") return "vertex";
  return element.name == "face" ? "face" : "row";
}

/// The values of an ASCII body, as words.
class AsciiBody {
 public:
  AsciiBody(std::string_view bytes, const PlyHeader& header)
      : scanner_(bytes, '\0', static_cast<std::size_t>(header.body - bytes.data())) {}

  void now_reading(const PlyElement& element, std::int64_t row) {
    scanner_.now_reading(row_name(element), row + 1, element.count);
  }
  double number(NumberType) { return scanner_.number(); }
  double coordinate(NumberType) { return scanner_.coordinate(); }
  std::int64_t integer(NumberType) { return scanner_.integer(); }
  [[noreturn]] void fail(const std::string& cause) const { scanner_.fail(cause); }
  std::size_t bytes_left() { return scanner_.at_end() ? 0 : scanner_.bytes_left(); }

 private:
  TextScanner scanner_;
};

/// The values of a binary body, as bytes in the given order.
template <std::endian Order>
class BinaryBody {
 public:
  BinaryBody(std::string_view bytes, const PlyHeader& header)
      : bytes_(bytes), p_(header.body), end_(bytes.data() + bytes.size()) {}

  void now_reading(const PlyElement& element, std::int64_t row) {
    element_ = &element;
    row_ = row;
  }

  double number(NumberType type) {
    return take(type, [](auto value) { return static_cast<double>(value); });
  }

  double coordinate(NumberType type) {
    const double value = number(type);
    if (!std::isfinite(value)) fail("a coordinate is not finite");
    return value;
  }

  std::int64_t integer(NumberType type) {
    return take(type, [this](auto value) {
      if constexpr (std::is_floating_point_v<decltype(value)>) {
        if (!(std::abs(value) < 1e9 && value == std::floor(value))) fail("an index is not whole");
      }
      return static_cast<std::int64_t>(value);
    });
  }

  [[noreturn]] void fail(const std::string& cause) const {
    fail_at_byte(bytes_, last_,
                 cause + " in " + row_name(*element_) + ' ' + std::to_string(row_ + 1) + " of " +
                     std::to_string(element_->count));
  }

  std::size_t bytes_left() const { return static_cast<std::size_t>(end_ - p_); }

 private:
  template <class Use>
  auto take(NumberType type, const Use& use) {
    return with_number_type(type, [&](auto zero) { return use(take<decltype(zero)>()); });
  }

  template <class T>
  T take() {
    last_ = p_;
    if (bytes_left() < sizeof(T)) fail("the file ends");
    p_ += sizeof(T);
    return load<T>(last_, Order);
  }

  std::string_view bytes_;
  const char* p_;
  const char* end_;
  const char* last_ = p_;  ///< start of the last value
  const PlyElement* element_ = nullptr;
  std::int64_t row_ = 0;
};

/// Takes the length of a list, which the rest of the file must have room for.
template <class Body>
std::int64_t list_length(Body& body, const PlyProperty& property) {
  const std::int64_t length = body.integer(property.count_type);
  if (length < 0 || static_cast<std::uint64_t>(length) > body.bytes_left()) {
    body.fail("a list of " + std::to_string(length) + " items does not fit");
  }
  return length;
}

/// Goes past one property of a row.
template <class Body>
void skip(Body& body, const PlyProperty& property) {
  const std::int64_t count = property.is_list ? list_length(body, property) : 1;
  for (std::int64_t k = 0; k < count; ++k) body.number(property.type);
}

/// Calls take(row, k) where property k of a row of an element is next, which it reads or skips.
template <class Body, class Take>
void read_rows(Body& body, const PlyElement& element, const Take& take) {
  if (element.properties.empty()) return;
  for (std::int64_t row = 0; row < element.count; ++row) {
    body.now_reading(element, row);
    for (std::size_t k = 0; k < element.properties.size(); ++k) take(row, k);
  }
}

/// Goes past an element.
template <class Body>
void skip_rows(Body& body, const PlyElement& element) {
  read_rows(body, element, [&](std::int64_t, std::size_t k) { skip(body, element.properties[k]); });
}

/// Calls read(body) with the body that the format has, and returns what it returns.
template <class Read>
auto with_ply_body(std::string_view bytes, const PlyHeader& header, const Read& read) {
  switch (header.format) {
    case PlyFormat::kAscii:
      return read(AsciiBody(bytes, header));
    case PlyFormat::kLittleEndian:
      return read(BinaryBody<std::endian::little>(bytes, header));
    case PlyFormat::kBigEndian:
      break;
  }
  return read(BinaryBody<std::endian::big>(bytes, header));
}

}  // namespace geotherm::io
