// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include "solver/core/result.h"
#include "solver/mesh/growing_file.h"

namespace geotherm {

/// The numbers of a .npy array, little endian.
enum class NpyType { kFloat64, kFloat32 };

/// float64 | float32
std::string to_text(NpyType type);

/// Inverse of to_text(). Errors: kNotAvailable, with the names there are.
Result<NpyType> parse_npy_type(std::string_view text);

/// Bytes of a file of rows x columns numbers, header included.
std::uint64_t npy_bytes_of(std::uint64_t rows, std::uint64_t columns, NpyType type);

/// A .npy array of two dimensions that is written row by row, so that no more than one row need be
/// in memory; as a GrowingFile: whole or not at all, "-" is standard output. kFloat32 rounds to
/// nearest; infinity stays what it is.
class NpyRows {
 public:
  /// Errors: those of GrowingFile::open().
  static Result<NpyRows> open(const std::string& path, std::uint64_t rows, std::uint64_t columns,
                              NpyType type);

  /// Precondition: as many values as columns; at most `rows` calls. Errors: kBadFile; kBadInput
  /// where the values do not fit into kFloat32: one above 3.4e38, or all below 1.2e-38.
  Result<void> append(std::span<const double> row);

  /// Precondition: every row was appended.
  Result<void> finish();

 private:
  NpyRows(GrowingFile file, std::string path, std::uint64_t rows, NpyType type)
      : file_(std::move(file)), path_(std::move(path)), missing_(rows), type_(type) {}

  GrowingFile file_;
  std::string path_;
  std::uint64_t missing_;
  NpyType type_;
  std::string bytes_;  ///< of a row
};

}  // namespace geotherm
