// SPDX-License-Identifier: MIT
// Arrays of the caller, of any type and with any strides.
#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <optional>

#include "app/c/handles.h"
#include "app/text/text.h"
#include "solver/core/text.h"
#include "solver/mesh/io/format_writers.h"

namespace geotherm::c {
namespace {

using app::grouped;

std::int64_t size_of(geotherm_type type) {
  return type == GEOTHERM_FLOAT64 || type == GEOTHERM_INT64 ? 8 : 4;
}

bool is_type(geotherm_type type) { return type >= GEOTHERM_FLOAT64 && type <= GEOTHERM_INT32; }

/// Where the element of a row and a column is.
char* at(const geotherm_array& array, std::int64_t row, std::int64_t column) {
  const bool packed = array.row_stride == 0 && array.column_stride == 0;
  const std::int64_t size = size_of(array.type);
  const std::int64_t by_column = packed ? size : array.column_stride;
  const std::int64_t by_row = packed ? size * array.columns : array.row_stride;
  return static_cast<char*>(array.data) + row * by_row + column * by_column;
}

template <class T>
T load(const char* from) {
  T value;
  std::memcpy(&value, from, sizeof value);
  return value;
}

Error wrong(const std::string& name, const std::string& what, const std::string& hint = {}) {
  return bad_argument(name + " " + what, hint.empty() ? Hint{} : Hint{hint});
}

/// No array of a process is larger.
constexpr std::int64_t kMaxNumbers = std::int64_t{1} << 46;

Result<void> check(const geotherm_array& array, std::int64_t columns, const std::string& name) {
  if (!is_type(array.type)) {
    return wrong(
        name, "has the type " + std::to_string(static_cast<int>(array.type)) + ", which is none");
  }
  if (array.rows < 0 || array.columns < 0 || array.columns > kMaxNumbers ||
      array.rows > kMaxNumbers / std::max<std::int64_t>(array.columns, 1)) {
    return wrong(name, "has the size " + std::to_string(array.rows) + " x " +
                           std::to_string(array.columns) + ", which is none");
  }
  if (array.rows > 0 && array.columns != columns) {
    return wrong(name, "has " + std::to_string(array.columns) +
                           (array.columns == 1 ? " column" : " columns") + ", where " +
                           std::to_string(columns) + (columns == 1 ? " is" : " are") + " expected");
  }
  if (array.rows > 0 && array.data == nullptr) return wrong(name, "has rows and no data");
  return {};
}

/// Calls take(number) for all elements, rows first.
template <class Take>
void for_each(const geotherm_array& array, const Take& take) {
  const auto each = [&]<class T>(T) {
    for (std::int64_t row = 0; row < array.rows; ++row) {
      for (std::int64_t column = 0; column < array.columns; ++column) {
        take(load<T>(at(array, row, column)));
      }
    }
  };
  switch (array.type) {
    case GEOTHERM_FLOAT64:
      return each(double{});
    case GEOTHERM_FLOAT32:
      return each(float{});
    case GEOTHERM_INT64:
      return each(std::int64_t{});
    case GEOTHERM_INT32:
      return each(std::int32_t{});
  }
}

}  // namespace

Result<std::vector<double>> numbers_in(const geotherm_array& array, std::int64_t columns,
                                       const std::string& name) {
  if (auto fits = check(array, columns, name); !fits) return fits.error();
  std::vector<double> values;
  values.reserve(static_cast<std::size_t>(array.rows * columns));
  for_each(array, [&](auto value) { values.push_back(static_cast<double>(value)); });
  return values;
}

Result<std::vector<Vec3>> places_in(const geotherm_array& array, const std::string& name) {
  if (auto fits = check(array, 3, name); !fits) return fits.error();
  std::vector<Vec3> places(static_cast<std::size_t>(array.rows));
  std::size_t n = 0;
  for_each(array, [&](auto value) {
    places[n / 3][static_cast<Eigen::Index>(n % 3)] = static_cast<double>(value);
    ++n;
  });
  return places;
}

Result<std::vector<Index>> indices_in(const geotherm_array& array, std::int64_t columns,
                                      const std::string& name) {
  if (auto fits = check(array, columns, name); !fits) return fits.error();
  std::vector<Index> values;
  values.reserve(static_cast<std::size_t>(array.rows * columns));
  std::optional<std::string> bad;
  for_each(array, [&](auto value) {
    const auto number = static_cast<double>(value);
    constexpr double kMax = std::numeric_limits<Index>::max();
    if (number >= -kMax && number <= kMax && number == std::floor(number)) {
      values.push_back(static_cast<Index>(value));
    } else if (!bad) {
      const auto n = static_cast<std::int64_t>(values.size());
      bad = "row " + std::to_string(n / columns) + " holds " + number_text(number);
    }
    if (bad) values.push_back(0);
  });
  if (bad) return wrong(name, "is of whole numbers below 2^31, and " + *bad);
  return values;
}

Result<void> check_output(const geotherm_array& array, std::int64_t rows, std::int64_t columns,
                          const std::string& name) {
  if (!is_type(array.type) || array.type > GEOTHERM_FLOAT32) {
    return wrong(name, "must be of float64 or float32");
  }
  if (array.rows != rows || array.columns != columns) {
    return wrong(name, "has the size " + grouped(array.rows) + " x " + grouped(array.columns) +
                           ", where " + grouped(rows) + " x " + grouped(columns) +
                           " numbers are written");
  }
  if (rows > 0 && columns > 0 && array.data == nullptr) return wrong(name, "has no data");
  return {};
}

Result<void> write_row(const geotherm_array& array, std::int64_t row,
                       std::span<const double> values) {
  const bool packed = array.row_stride == 0 && array.column_stride == 0;
  const std::int64_t step = packed ? size_of(array.type) : array.column_stride;
  char* to = at(array, row, 0);
  if (array.type == GEOTHERM_FLOAT64) {
    if (step == 8) {
      std::memcpy(to, values.data(), values.size_bytes());
      return {};
    }
    for (const double value : values) {
      std::memcpy(to, &value, sizeof value);
      to += step;
    }
    return {};
  }
  if (auto fits = io::check_float_range("out", values); !fits) return fits;
  for (const double value : values) {
    const auto rounded = static_cast<float>(value);
    std::memcpy(to, &rounded, sizeof rounded);
    to += step;
  }
  return {};
}

}  // namespace geotherm::c
