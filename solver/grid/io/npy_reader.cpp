// SPDX-License-Identifier: MIT
// NumPy's format, versions 1 to 3 (NEP 1): a dictionary in text, then the numbers.
#include <algorithm>
#include <optional>
#include <utility>

#include "solver/core/text.h"
#include "solver/grid/io/raw_grid.h"
#include "solver/mesh/io/byte_order.h"
#include "solver/mesh/io/input_file.h"
#include "solver/mesh/io/text_scanner.h"

namespace geotherm::io {
namespace {

struct NpyHeader {
  VtkType type = VtkType::kUint8;
  bool boolean = false;
  std::endian order = std::endian::little;
  bool fortran = false;
  std::vector<std::int64_t> shape;
  std::size_t begins = 0;  ///< the numbers
};

constexpr struct {
  std::string_view name;
  VtkType type;
} kNpyTypes[] = {{"b1", VtkType::kUint8},   {"u1", VtkType::kUint8},  {"i1", VtkType::kInt8},
                 {"u2", VtkType::kUint16},  {"i2", VtkType::kInt16},  {"u4", VtkType::kUint32},
                 {"i4", VtkType::kInt32},   {"u8", VtkType::kUint64}, {"i8", VtkType::kInt64},
                 {"f4", VtkType::kFloat32}, {"f8", VtkType::kFloat64}};

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
  std::string_view descr = end == value.npos ? std::string_view() : value.substr(1, end - 1);
  if (descr.starts_with('>')) header.order = std::endian::big;
  const std::string_view name = descr.empty() ? descr : descr.substr(1);
  const auto* const known = std::find_if(std::begin(kNpyTypes), std::end(kNpyTypes),
                                         [name](const auto& each) { return each.name == name; });
  if (known == std::end(kNpyTypes) || std::string_view("<>|=").find(descr.front()) == descr.npos) {
    fail_at_byte(bytes, value.data(),
                 "the type of numbers " + quoted(bytes, value.data()) + " is none of a grid",
                 {"save booleans, whole numbers, float32 or float64"});
  }
  header.type = known->type;
  header.boolean = name == "b1";
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
  if (header.shape.size() == 2 || header.shape.size() == 3) return;
  fail_at_byte(bytes, value.data(),
               "the array has " + std::to_string(header.shape.size()) +
                   (header.shape.size() == 1 ? " dimension" : " dimensions") +
                   "; a grid has 2 or 3");
}

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

/// From the first axis fastest to the last axis fastest, which is x.
std::vector<double> in_c_order(const std::vector<double>& values,
                               const std::array<std::int64_t, 3>& size) {
  std::vector<double> out(values.size());
  std::size_t at = 0;
  for (std::int64_t z = 0; z < size[2]; ++z) {
    for (std::int64_t y = 0; y < size[1]; ++y) {
      for (std::int64_t x = 0; x < size[0]; ++x) {
        out[at++] = values[static_cast<std::size_t>(z + size[2] * (y + size[1] * x))];
      }
    }
  }
  return out;
}

}  // namespace

RawGrid read_npy(std::string_view bytes) {
  const NpyHeader header = read_npy_header(bytes);
  RawGrid grid;
  std::copy(header.shape.rbegin(), header.shape.rend(), grid.size.begin());
  grid.three_axes = header.shape.size() == 3;
  const std::size_t count = count_samples(grid.size);
  const std::size_t wanted = count * size_of(header.type), there = bytes.size() - header.begins;
  if (there > wanted) {
    throw ReadFailure{"there are to be " + std::to_string(count) + " samples of " +
                      counted_text(size_of(header.type), "byte", "bytes") + ", but " +
                      std::to_string(there) + " bytes follow, " + std::to_string(there - wanted) +
                      " too many"};
  }
  grid.values = decode_samples(bytes.substr(header.begins), count, header.type, header.order);
  if (header.fortran) grid.values = in_c_order(grid.values, grid.size);
  grid.type = header.boolean ? RawGrid::Values::kBooleans : values_of(header.type);
  return grid;
}

}  // namespace geotherm::io
