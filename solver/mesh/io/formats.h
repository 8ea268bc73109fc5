// SPDX-License-Identifier: MIT
// The formats that models are read from, whatever they hold: the one list that readers, messages,
// help and dialogs share.
#pragma once

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace geotherm::io {

/// What a file of a format may hold.
enum Holding : unsigned { kFaces = 1, kPoints = 2, kTets = 4, kGrid = 8 };

struct ModelFormat {
  std::string_view name;  ///< the extension without its point
  unsigned holds;         ///< of Holding
};

std::span<const ModelFormat> model_format_table();

/// The formats that may hold `what` (Holding), in the order of the table.
std::vector<std::string> formats_holding(unsigned what);

/// ".obj .ply", for messages.
std::string extensions_holding(unsigned what);

/// The name of the format that a file begins like, or nothing. `size`: bytes of the whole file, of
/// which `start` has the first. Cost: a pass over `start`.
std::string_view format_by_content(std::string_view start, std::size_t size);

/// ".ply" of "a.ply" and of "a.ply.gz".
std::string model_extension(std::string_view path);

/// The entry of a table that has this `extension`, or null.
template <class Format, std::size_t N>
const Format* format_of(const Format (&table)[N], std::string_view extension) {
  const Format* const found = std::ranges::find(table, extension, &Format::extension);
  return found == std::end(table) ? nullptr : found;
}

}  // namespace geotherm::io
