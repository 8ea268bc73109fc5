// SPDX-License-Identifier: MIT
#include "solver/mesh/io/npy_header.h"

#include <algorithm>
#include <utility>

#include "solver/mesh/io/byte_order.h"
#include "solver/mesh/io/input_file.h"
#include "solver/mesh/io/text_scanner.h"

namespace geotherm::io {
namespace {

constexpr std::pair<std::string_view, NumberType> kNpyTypes[] = {
    {"b1", NumberType::kUint8},   {"u1", NumberType::kUint8},  {"i1", NumberType::kInt8},
    {"u2", NumberType::kUint16},  {"i2", NumberType::kInt16},  {"u4", NumberType::kUint32},
    {"i4", NumberType::kInt32},   {"u8", NumberType::kUint64}, {"i8", NumberType::kInt64},
    {"f4", NumberType::kFloat32}, {"f8", NumberType::kFloat64}};

/// What stands behind a key of the dictionary, without blanks in front.
std::string_view behind_key(std::string_view bytes, std::string_view dictionary,
                            std::string_view key) {
  const std::size_t at = dictionary.find(key);
  const std::size_t colon = at == dictionary.npos ? at : dictionary.find(':', at + key.size());
  if (colon == dictionary.npos) {
    fail_at_byte(bytes, dictionary.data(), "the header has no " + std::string(key));
  }
  std::string_view rest = dictionary.substr(colon + 1);
  rest.remove_prefix(std::min(rest.find_first_not_of(' '), rest.size()));
  return rest;
}

void read_npy_type(std::string_view bytes, std::string_view value, NpyHeader& header) {
  const std::size_t end = value.empty() ? value.npos : value.find(value.front(), 1);
  const std::string_view descr = end == value.npos ? std::string_view() : value.substr(1, end - 1);
  if (descr.empty() || std::string_view("<>|=").find(descr.front()) == descr.npos) {
    fail_at_byte(bytes, value.data(),
                 "the type of numbers " + quoted(bytes, value.data()) + " cannot be read",
                 {"save booleans, whole numbers, float32 or float64"});
  }
  if (descr.starts_with('>')) header.order = std::endian::big;
  header.type = descr.substr(1);
  header.type_place = static_cast<std::size_t>(value.data() - bytes.data());
}

void read_npy_shape(std::string_view bytes, std::string_view value, NpyHeader& header) {
  const auto fail = [&] { fail_at_byte(bytes, value.data(), "the shape cannot be read"); };
  if (!value.starts_with('(')) fail();
  const char* p = value.data() + 1;
  const char* const end = value.data() + value.size();
  for (;;) {
    while (p < end && (*p == ' ' || *p == ',')) ++p;
    if (p >= end) fail();
    if (*p == ')') break;
    std::int64_t length = 0;
    const char* const behind = parse_integer(p, length);
    if (behind == nullptr || behind >= end) fail();
    header.shape.push_back(length);
    p = behind;
  }
  header.shape_place = static_cast<std::size_t>(value.data() - bytes.data());
}

}  // namespace

NpyHeader read_npy_header(std::string_view bytes) {
  constexpr std::string_view kMagic("\x93NUMPY", 6);
  if (!bytes.starts_with(kMagic) || bytes.size() < 10) {
    fail_at_byte(bytes, bytes.data(), "an array of NumPy starts with the word NUMPY");
  }
  const char major = bytes[6];
  if (major < 1 || major > 3) {
    fail_at_byte(bytes, bytes.data() + 6, "version " + std::to_string(major) + " is unknown");
  }
  const std::size_t preamble = major == 1 ? 10 : 12;
  if (bytes.size() < preamble) {
    fail_at_byte(bytes, bytes.data() + 8, "the file ends in its header");
  }
  const std::size_t length = major == 1
                                 ? load<std::uint16_t>(bytes.data() + 8, std::endian::little)
                                 : load<std::uint32_t>(bytes.data() + 8, std::endian::little);
  if (length > bytes.size() - preamble) {
    fail_at_byte(bytes, bytes.data() + 8,
                 "the header is to have " + std::to_string(length) + " bytes: the file ends in it");
  }
  const std::string_view dictionary = bytes.substr(preamble, length);
  NpyHeader header;
  header.begins = preamble + length;
  read_npy_type(bytes, behind_key(bytes, dictionary, "'descr'"), header);
  header.fortran = behind_key(bytes, dictionary, "'fortran_order'").starts_with("True");
  read_npy_shape(bytes, behind_key(bytes, dictionary, "'shape'"), header);
  return header;
}

std::optional<NumberType> number_type_of(const NpyHeader& header) {
  for (const auto& [name, type] : kNpyTypes) {
    if (name == header.type) return type;
  }
  return std::nullopt;
}

}  // namespace geotherm::io
