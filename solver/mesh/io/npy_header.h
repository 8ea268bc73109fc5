// SPDX-License-Identifier: MIT
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "solver/mesh/io/number_type.h"

namespace geotherm::io {

/// What a .npy file says about its numbers (versions 1 to 3 of the format, NEP 1).
struct NpyHeader {
  std::string type;  ///< "f8", "u1", ...: kind and bytes of a number
  std::endian order = std::endian::little;
  bool fortran = false;  ///< the first axis runs fastest
  std::vector<std::int64_t> shape;
  std::size_t begins = 0;      ///< the numbers
  std::size_t type_place = 0;  ///< byte of the header, for messages; so is the next one
  std::size_t shape_place = 0;
};

/// `bytes`: the file, or enough of its beginning. Throws ReadFailure with the byte.
NpyHeader read_npy_header(std::string_view bytes);

/// How the numbers are stored; nothing where they are none that are read. Booleans are kUint8.
std::optional<NumberType> number_type_of(const NpyHeader& header);

}  // namespace geotherm::io
