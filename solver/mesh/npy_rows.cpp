// SPDX-License-Identifier: MIT
#include "solver/mesh/npy_rows.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>
#include <utility>

#include "solver/core/number_text.h"
#include "solver/mesh/io/byte_order.h"
#include "solver/mesh/io/file_extension.h"
#include "solver/mesh/io/format_writers.h"

namespace geotherm {
namespace {

std::size_t size_of(NpyType type) {
  return type == NpyType::kFloat64 ? sizeof(double) : sizeof(float);
}

std::string header_of(std::uint64_t rows, std::uint64_t columns, NpyType type) {
  const std::array<std::uint64_t, 2> shape = {rows, columns};
  return io::npy_header(type == NpyType::kFloat64 ? "<f8" : "<f4", shape);
}

/// A distance that became infinite would read as unreached, and a row that became 0 as a point.
bool fits_float(std::span<const double> row) {
  double most = 0;
  for (const double value : row) {
    if (std::isfinite(value)) most = std::max(most, std::abs(value));
  }
  return most == 0 || (std::isfinite(static_cast<float>(most)) &&
                       most >= static_cast<double>(std::numeric_limits<float>::min()));
}

}  // namespace

std::string to_text(NpyType type) { return type == NpyType::kFloat64 ? "float64" : "float32"; }

Result<NpyType> parse_npy_type(std::string_view text) {
  for (const NpyType type : {NpyType::kFloat64, NpyType::kFloat32}) {
    if (to_text(type) == text) return type;
  }
  return Error{ErrorCode::kNotAvailable,
               "there is no type of numbers '" + io::printable(std::string(text)) + "'",
               {"there are float64, float32"}};
}

std::uint64_t npy_bytes_of(std::uint64_t rows, std::uint64_t columns, NpyType type) {
  return header_of(rows, columns, type).size() + rows * columns * size_of(type);
}

Result<NpyRows> NpyRows::open(const std::string& path, std::uint64_t rows, std::uint64_t columns,
                              NpyType type) {
  auto file = GrowingFile::open(path);
  if (!file) return file.error();
  NpyRows array(*std::move(file), path, rows, type);
  if (auto written = array.file_.append(header_of(rows, columns, type)); !written) {
    return written.error();
  }
  return array;
}

Result<void> NpyRows::append(std::span<const double> row) {
  assert(missing_ > 0);
  bytes_.clear();
  bytes_.reserve(row.size() * size_of(type_));
  if (type_ == NpyType::kFloat64) {
    for (const double value : row) io::append_little(bytes_, value);
  } else {
    if (!fits_float(row)) {
      return Error{
          ErrorCode::kBadInput,
          io::printable(path_) + ": the values lie beyond the range of float32 (1.2e-38 to 3.4e38)",
          {"write float64"}};
    }
    for (const double value : row) io::append_little(bytes_, static_cast<float>(value));
  }
  --missing_;
  return file_.append(bytes_);
}

Result<void> NpyRows::finish() {
  assert(missing_ == 0);
  return file_.finish();
}

}  // namespace geotherm
