// SPDX-License-Identifier: MIT
#include "geotherm/io.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>
#include <utility>

#include "solver/core/text.h"
#include "solver/mesh/io/byte_order.h"
#include "solver/mesh/io/format_writers.h"
#include "solver/mesh/output_file.h"

namespace geotherm {
namespace {

std::size_t bytes_each(NpyType type) {
  return type == NpyType::kFloat64 ? sizeof(double) : sizeof(float);
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

std::string io::npy_rows_header(std::uint64_t rows, std::uint64_t columns, NpyType type) {
  const std::array<std::uint64_t, 2> shape = {rows, columns};
  return io::npy_header(type == NpyType::kFloat64 ? "<f8" : "<f4", shape);
}

Result<void> io::check_float_range(const std::string& path, std::span<const double> values) {
  if (fits_float(values)) return {};
  return Error{
      ErrorCode::kBadInput,
      io::printable(path) + ": the values lie beyond the range of float32 (1.2e-38 to 3.4e38)",
      {"write float64"}};
}

std::uint64_t npy_bytes_of(std::uint64_t rows, std::uint64_t columns, NpyType type) {
  return io::npy_rows_header(rows, columns, type).size() + rows * columns * bytes_each(type);
}

Result<void> io::npy_row(const std::string& path, std::span<const double> row, NpyType type,
                         std::string& bytes) {
  bytes.clear();
  bytes.reserve(row.size() * bytes_each(type));
  if (type == NpyType::kFloat64) {
    for (const double value : row) io::append_little(bytes, value);
    return {};
  }
  if (auto fits = check_float_range(path, row); !fits) return fits;
  for (const double value : row) io::append_little(bytes, static_cast<float>(value));
  return {};
}

struct NpyRows::State {
  GrowingFile file;
  std::string path;
  std::uint64_t missing;  ///< rows
  NpyType type;
  std::string bytes{};  ///< of a row
};

NpyRows::NpyRows(std::unique_ptr<State> state) : state_(std::move(state)) {}
NpyRows::NpyRows(NpyRows&&) noexcept = default;
NpyRows& NpyRows::operator=(NpyRows&&) noexcept = default;
NpyRows::~NpyRows() = default;

Result<NpyRows> NpyRows::open(const std::string& path, std::uint64_t rows, std::uint64_t columns,
                              NpyType type) {
  auto file = GrowingFile::open(path);
  if (!file) return file.error();
  if (auto written = file->append(io::npy_rows_header(rows, columns, type)); !written) {
    return written.error();
  }
  return NpyRows(std::make_unique<State>(State{*std::move(file), path, rows, type}));
}

Result<void> NpyRows::append(std::span<const double> row) {
  auto& [file, path, missing, type, bytes] = *state_;
  assert(missing > 0);
  if (auto made = io::npy_row(path, row, type, bytes); !made) return made;
  --missing;
  return file.append(bytes);
}

Result<void> NpyRows::finish() {
  assert(state_->missing == 0);
  return state_->file.finish();
}

}  // namespace geotherm
