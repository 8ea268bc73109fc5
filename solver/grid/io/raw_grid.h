// SPDX-License-Identifier: MIT
// One reader per format. Each takes the bytes of FileBytes (with its padding) and throws
// ReadFailure or std::bad_alloc. What a file announces is held against its size before memory is
// asked for.
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "geotherm/types.h"
#include "solver/mesh/io/number_type.h"

namespace geotherm::io {

/// What a reader hands over.
struct RawGrid {
  enum class Values { kBooleans, kWholes, kReals, kPixels };

  std::array<std::int64_t, 3> size = {1, 1, 1};
  std::array<double, 3> spacing = {1, 1, 1};
  Vec3 origin = Vec3::Zero();
  bool three_axes = false;  ///< as Grid has it
  Values type = Values::kReals;
  std::vector<double> values;  ///< x fastest
  std::string detail;          ///< of what the values mean, behind it: "of a palette ..."
  std::vector<std::string> notes;
};

/// The number of samples of a grid. Throws ReadFailure where an axis has none or there are more
/// than a billion in all.
std::size_t count_samples(const std::array<std::int64_t, 3>& size);

/// So many numbers of a type, which the bytes must hold.
std::vector<double> decode_samples(std::string_view bytes, std::size_t count, NumberType type,
                                   std::endian order);

/// Whether numbers of the type are whole.
RawGrid::Values values_of(NumberType type);

RawGrid read_npy(std::string_view bytes);
/// An array with one axis, or the rows of one with two, one after the other.
struct NpyTable {
  std::vector<double> values;
  std::size_t columns = 1;
};
NpyTable read_npy_table(std::string_view bytes);
RawGrid read_png(std::string_view bytes);
RawGrid read_vti(std::string_view bytes);

/// A header of NRRD, and where its samples are.
struct NrrdHeader {
  enum class Encoding { kRaw, kGzip, kText };

  RawGrid grid;  ///< without values
  NumberType type = NumberType::kUint8;
  std::endian order = std::endian::little;
  Encoding encoding = Encoding::kRaw;
  std::string data_file;        ///< beside the header; empty: in the same file
  std::size_t data_begins = 0;  ///< where the header ends
  std::int64_t line_skip = 0;   ///< lines in front of the samples
  std::int64_t byte_skip = 0;   ///< bytes after these; -1: the samples are the file's last bytes
};
NrrdHeader read_nrrd_header(std::string_view text);
/// `data`: what stands behind the header, or the file of the data.
RawGrid read_nrrd_data(const NrrdHeader& header, std::string_view data);

}  // namespace geotherm::io
