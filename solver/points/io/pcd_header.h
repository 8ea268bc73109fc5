// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace geotherm::io {

enum class PcdData { kAscii, kBinary, kCompressed };

struct PcdField {
  std::string name;
  char type = 'F';          ///< I: signed, U: unsigned, F: floating point
  std::uint64_t size = 4;   ///< bytes of a value: 1, 2, 4 or 8
  std::uint64_t count = 1;  ///< values a point
  std::uint64_t first = 0;  ///< values of a point before this field
  std::uint64_t start = 0;  ///< bytes of a point before this field
};

struct PcdHeader {
  std::vector<PcdField> fields;
  std::uint64_t points = 0;
  std::uint64_t values = 0;  ///< of a point
  std::uint64_t bytes = 0;   ///< of a point
  PcdData data = PcdData::kAscii;
  const char* body = nullptr;  ///< the first byte behind the header

  /// The field of this name with one value; null where there is none.
  const PcdField* find(std::string_view name) const;
};

/// Reads the header of a PCD file (Point Cloud Library, version 0.7). Throws ReadFailure; so it
/// does when the body is too short for the number of points.
PcdHeader read_pcd_header(std::string_view bytes);

}  // namespace geotherm::io
