// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstring>
#include <sstream>
#include <string>
#include <vector>

// What the program's files hold.
namespace geotherm::test {

/// The numbers behind the header of a .npy file.
template <class Number>
std::vector<Number> npy_values(const std::string& bytes) {
  if (bytes.size() < 10) return {};
  const std::size_t header = 10 + static_cast<unsigned char>(bytes[8]) +
                             256 * std::size_t{static_cast<unsigned char>(bytes[9])};
  std::vector<Number> values((bytes.size() - header) / sizeof(Number));
  std::memcpy(values.data(), bytes.data() + header, values.size() * sizeof(Number));
  return values;
}

/// Whether it is an array of rows x columns.
inline bool has_shape(const std::string& bytes, std::size_t rows, std::size_t columns) {
  return bytes.find("'shape': (" + std::to_string(rows) + ", " + std::to_string(columns) + "), ") !=
         std::string::npos;
}

inline std::vector<std::string> lines_of(const std::string& text) {
  std::istringstream stream(text);
  std::vector<std::string> lines;
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

}  // namespace geotherm::test
