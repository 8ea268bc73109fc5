// SPDX-License-Identifier: MIT
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "solver/mesh/io/number_type.h"

namespace geotherm::io {

/// Where the numbers of one array of a .vtu file are.
struct VtuArray {
  enum class Format { kNone, kText, kBase64, kAppended };

  Format format = Format::kNone;  ///< kNone: there is no such array
  NumberType type = NumberType::kFloat64;
  std::uint64_t place = 0;  ///< of the first byte between its tags; kAppended: from the mark on
};

/// How a .vtu file stores all of its arrays.
struct VtuEncoding {
  std::endian order = std::endian::little;
  std::size_t size_of_length = 4;  ///< bytes of the numbers in front of an array: 4, 8, or 0: none
  bool compressed = false;         ///< by zlib, in blocks; without lengths in one stream
  std::size_t appended = 0;        ///< the byte behind the mark _; 0: no array is appended
  bool appended_base64 = false;
};

/// The `count` numbers of an array, which must have as many. `name`: for messages. Throws
/// ReadFailure, so also where numbers are to be finite and one is not; what the array
/// announces is held against the bytes that are there before memory is asked for.
std::vector<double> read_vtu_reals(std::string_view bytes, const VtuEncoding& encoding,
                                   const VtuArray& array, const char* name, std::int64_t count,
                                   bool finite = true);
std::vector<std::int64_t> read_vtu_integers(std::string_view bytes, const VtuEncoding& encoding,
                                            const VtuArray& array, const char* name,
                                            std::int64_t count);

}  // namespace geotherm::io
