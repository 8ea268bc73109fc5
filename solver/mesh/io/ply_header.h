// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "solver/mesh/io/number_type.h"

namespace geotherm::io {

enum class PlyFormat { kAscii, kLittleEndian, kBigEndian };

struct PlyProperty {
  std::string name;
  NumberType type = NumberType::kFloat32;  ///< of the value, or of a list's items
  bool is_list = false;
  NumberType count_type = NumberType::kUint8;
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
