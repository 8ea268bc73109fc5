// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace geotherm::io {

enum class PlyFormat { kAscii, kLittleEndian, kBigEndian };

enum class PlyType { kInt8, kUint8, kInt16, kUint16, kInt32, kUint32, kFloat32, kFloat64 };

/// Bytes of one value.
std::size_t size_of(PlyType type);

struct PlyProperty {
  std::string name;
  PlyType type = PlyType::kFloat32;  ///< of the value, or of a list's items
  bool is_list = false;
  PlyType count_type = PlyType::kUint8;
};

struct PlyElement {
  std::string name;
  std::int64_t count = 0;
  std::vector<PlyProperty> properties;

  /// The number of the scalar or list property with this name, or -1.
  int find(std::string_view property, bool is_list) const;
};

struct PlyHeader {
  PlyFormat format = PlyFormat::kAscii;
  std::vector<PlyElement> elements;
  const char* body = nullptr;  ///< the first byte behind the header

  const PlyElement* find(std::string_view element) const;
};

/// Reads the header alone, whether or not there is a body. `bytes` may end behind it. Throws
/// ReadFailure.
PlyHeader parse_ply_header(std::string_view bytes);

/// Reads the header. Throws ReadFailure; so it does when the body is too short for the counts.
PlyHeader read_ply_header(std::string_view bytes);

}  // namespace geotherm::io
