// SPDX-License-Identifier: MIT
// Grids in arrays of NumPy.
#include <algorithm>
#include <iterator>

#include "solver/core/text.h"
#include "solver/grid/io/raw_grid.h"
#include "solver/mesh/io/input_file.h"
#include "solver/mesh/io/npy_header.h"

namespace geotherm::io {
namespace {

NumberType type_of(std::string_view bytes, const NpyHeader& header) {
  if (const auto type = number_type_of(header)) return *type;
  const char* const at = bytes.data() + header.type_place;
  fail_at_byte(bytes, at, "the type of numbers " + quoted(bytes, at) + " cannot be read",
               {"save booleans, whole numbers, float32 or float64"});
}

/// What stands behind the header. Throws where it is more, or less.
std::vector<double> numbers_behind(std::string_view bytes, const NpyHeader& header,
                                   std::size_t count) {
  const NumberType type = type_of(bytes, header);
  const std::size_t each = size_of(type), wanted = count * each;
  const std::size_t there = bytes.size() - header.begins;
  if (there > wanted) {
    throw ReadFailure{"there are to be " + std::to_string(count) + " samples of " +
                      counted_text(each, "byte", "bytes") + ", but " + std::to_string(there) +
                      " bytes follow, " + std::to_string(there - wanted) + " too many"};
  }
  return decode_samples(bytes.substr(header.begins), count, type, header.order);
}

/// Reorders values whose first axis runs fastest so that the last axis, which is x, does.
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
  const auto& type = type_of(bytes, header);
  const std::size_t axes = header.shape.size();
  if (axes != 2 && axes != 3) {
    fail_at_byte(bytes, bytes.data() + header.shape_place,
                 "the array has " + std::to_string(axes) +
                     (axes == 1 ? " dimension" : " dimensions") + "; a grid has 2 or 3");
  }
  RawGrid grid;
  std::copy(header.shape.rbegin(), header.shape.rend(), grid.size.begin());
  grid.three_axes = header.shape.size() == 3;
  grid.values = numbers_behind(bytes, header, count_samples(grid.size));
  if (header.fortran) grid.values = in_c_order(grid.values, grid.size);
  grid.type = header.type == "b1" ? RawGrid::Values::kBooleans : values_of(type);
  return grid;
}

NpyTable read_npy_table(std::string_view bytes) {
  const NpyHeader header = read_npy_header(bytes);
  const std::size_t axes = header.shape.size();
  if (axes != 1 && axes != 2) {
    fail_at_byte(bytes, bytes.data() + header.shape_place,
                 "the array has " + std::to_string(axes) +
                     " dimensions; values of vertices have 1, vectors 2");
  }
  const std::array<std::int64_t, 3> size = {axes == 2 ? header.shape[1] : 1, header.shape[0], 1};
  NpyTable out{numbers_behind(bytes, header, count_samples(size)),
               static_cast<std::size_t>(size[0])};
  if (header.fortran && axes == 2) out.values = in_c_order(out.values, size);
  return out;
}

}  // namespace geotherm::io
