// SPDX-License-Identifier: MIT
#include <array>
#include <bit>
#include <cstdint>
#include <string>
#include <vector>

#include "solver/core/text.h"
#include "solver/mesh/io/byte_order.h"
#include "solver/mesh/io/input_file.h"
#include "solver/mesh/io/text_scanner.h"
#include "solver/points/io/pcd_header.h"
#include "solver/points/io/raw_points.h"

namespace geotherm::io {
namespace {

/// The fields that are read: a place, and a normal where there is one.
struct PointFields {
  std::array<const PcdField*, 6> of{};
  std::size_t count = 3;
};

PointFields fields_of(std::string_view bytes, const PcdHeader& header) {
  constexpr std::array<std::string_view, 6> kNames = {"x",        "y",        "z",
                                                      "normal_x", "normal_y", "normal_z"};
  PointFields out;
  for (std::size_t k = 0; k < kNames.size(); ++k) out.of[k] = header.find(kNames[k]);
  for (std::size_t k = 0; k < 3; ++k) {
    if (out.of[k] != nullptr) continue;
    fail_at_line(bytes, header.body - 1, "there is no field \"" + std::string(kNames[k]) + "\"");
  }
  if (out.of[3] != nullptr && out.of[4] != nullptr && out.of[5] != nullptr) out.count = 6;
  return out;
}

/// Adds the points that have a place.
class PointAdder {
 public:
  PointAdder(const PointFields& fields, std::size_t points) : has_normals_(fields.count == 6) {
    out_.positions.reserve(points);
    if (has_normals_) out_.normals.reserve(points);
  }

  void add(const std::array<double, 6>& values) {
    const Vec3 position(values[0], values[1], values[2]);
    if (!position.allFinite()) {
      ++left_out_;
      return;
    }
    out_.positions.push_back(position);
    if (has_normals_) out_.normals.emplace_back(values[3], values[4], values[5]);
  }

  RawPoints take() {
    if (left_out_ > 0) {
      out_.notes.push_back(counted_text(left_out_, "point", "points") +
                           " without finite coordinates " + (left_out_ == 1 ? "was" : "were") +
                           " left out, and " + (left_out_ == 1 ? "has" : "have") + " no number");
    }
    return std::move(out_);
  }

 private:
  bool has_normals_;
  std::size_t left_out_ = 0;
  RawPoints out_;
};

double value_at(const char* p, const PcdField& field) {
  constexpr std::endian kOrder = std::endian::little;
  const auto number = [p]<class T>(T) { return static_cast<double>(load<T>(p, kOrder)); };
  if (field.type == 'F') return field.size == 4 ? number(float{}) : number(double{});
  const bool is_signed = field.type == 'I';
  switch (field.size) {
    case 1:
      return is_signed ? number(std::int8_t{}) : number(std::uint8_t{});
    case 2:
      return is_signed ? number(std::int16_t{}) : number(std::uint16_t{});
    case 4:
      return is_signed ? number(std::int32_t{}) : number(std::uint32_t{});
    default:
      return is_signed ? number(std::int64_t{}) : number(std::uint64_t{});
  }
}

RawPoints read_ascii(std::string_view bytes, const PcdHeader& header, const PointFields& fields) {
  TextScanner scanner(bytes, '#', static_cast<std::size_t>(header.body - bytes.data()));
  PointAdder adder(fields, static_cast<std::size_t>(header.points));
  std::vector<double> row(static_cast<std::size_t>(header.values));
  for (std::uint64_t i = 0; i < header.points; ++i) {
    scanner.now_reading("point", static_cast<std::int64_t>(i) + 1,
                        static_cast<std::int64_t>(header.points));
    for (double& value : row) value = scanner.number();
    std::array<double, 6> values{};
    for (std::size_t k = 0; k < fields.count; ++k) {
      values[k] = row[static_cast<std::size_t>(fields.of[k]->first)];
    }
    adder.add(values);
  }
  return adder.take();
}

/// `start`, `step`: byte of a field's value at the first point, and from one point to the next.
template <class Start, class Step>
RawPoints read_binary(const char* data, const PcdHeader& header, const PointFields& fields,
                      const Start& start, const Step& step) {
  PointAdder adder(fields, static_cast<std::size_t>(header.points));
  for (std::uint64_t i = 0; i < header.points; ++i) {
    std::array<double, 6> values{};
    for (std::size_t k = 0; k < fields.count; ++k) {
      const PcdField& field = *fields.of[k];
      values[k] = value_at(data + start(field) + i * step(field), field);
    }
    adder.add(values);
  }
  return adder.take();
}

/// The most bytes that LZF can make of one.
constexpr std::size_t kMaxByLzf = 88;

/// Unpacks bytes that LZF packed (Lehmann's LibLZF, the compression of .pcd): a control byte below
/// 32 is followed by so many bytes and one more as they are; any other holds the length and, with
/// the byte behind it, the distance of what is repeated. `size`: that of the answer, with `padding`
/// zero bytes behind it. Returns nothing where the bytes are damaged or make another size. Throws
/// std::bad_alloc. Cost: O(size).
std::vector<char> unpack_lzf(std::string_view packed, std::size_t size, std::size_t padding) {
  std::vector<char> out(size + padding, '\0');
  std::size_t from = 0, to = 0;
  const auto byte = [&](std::size_t at) { return static_cast<unsigned char>(packed[at]); };
  while (from < packed.size()) {
    const std::size_t control = byte(from++);
    if (control < 32) {
      const std::size_t length = control + 1;
      if (length > packed.size() - from || length > size - to) return {};
      packed.copy(out.data() + to, length, from);
      from += length;
      to += length;
      continue;
    }
    constexpr std::size_t kLong = 7, kMin = 2;
    std::size_t length = control >> 5;
    if (length == kLong) {
      if (from == packed.size()) return {};
      length += byte(from++);
    }
    length += kMin;
    if (from == packed.size()) return {};
    const std::size_t distance = ((control & 31) << 8) + byte(from++) + 1;
    if (distance > to || length > size - to) return {};
    // One by one: what is repeated may reach into what is written.
    for (std::size_t k = 0; k < length; ++k, ++to) out[to] = out[to - distance];
  }
  if (to != size) return {};
  return out;
}

/// All values of a field stand together, packed by LZF as a whole.
RawPoints read_packed(std::string_view bytes, const PcdHeader& header, const PointFields& fields) {
  const auto fail = [&](const std::string& cause) { fail_at_byte(bytes, header.body, cause); };
  constexpr std::size_t kSizes = 8;
  const std::string_view body = bytes.substr(static_cast<std::size_t>(header.body - bytes.data()));
  if (body.size() < kSizes) fail("the file ends before the sizes of what is packed");
  const std::uint64_t packed = load<std::uint32_t>(body.data(), std::endian::little);
  const std::uint64_t size = load<std::uint32_t>(body.data() + 4, std::endian::little);
  if (packed > body.size() - kSizes) {
    fail(std::to_string(packed) + " packed bytes are announced, but only " +
         std::to_string(body.size() - kSizes) + " follow");
  }
  if (header.points > size / header.bytes || header.points * header.bytes != size) {
    fail(std::to_string(size) + " unpacked bytes are announced for " +
         std::to_string(header.points) + " points with " + std::to_string(header.bytes) +
         " bytes each");
  }
  if (size > packed * kMaxByLzf) {
    fail(std::to_string(packed) + " packed bytes cannot hold " + std::to_string(size));
  }
  const std::vector<char> data = unpack_lzf(body.substr(kSizes, packed), size, kSizes);
  if (data.empty()) fail("the packed bytes are damaged");
  return read_binary(
      data.data(), header, fields,
      [&](const PcdField& field) { return field.start * header.points; },
      [](const PcdField& field) { return field.size; });
}

}  // namespace

RawPoints read_pcd_points(std::string_view bytes) {
  const PcdHeader header = read_pcd_header(bytes);
  const PointFields fields = fields_of(bytes, header);
  switch (header.data) {
    case PcdData::kAscii:
      return read_ascii(bytes, header, fields);
    case PcdData::kBinary:
      return read_binary(
          header.body, header, fields, [](const PcdField& field) { return field.start; },
          [&](const PcdField&) { return header.bytes; });
    case PcdData::kCompressed:
      break;
  }
  return read_packed(bytes, header, fields);
}

}  // namespace geotherm::io
