// SPDX-License-Identifier: MIT
// The formats that models are read from, whatever they hold: the list that messages, help and
// dialogs share, and that the tables of readers are held against.
#pragma once

#include <algorithm>
#include <cstddef>
#include <iterator>
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

inline constexpr ModelFormat kModelFormats[] = {
    {"obj", kFaces},          {"ply", kFaces | kPoints},
    {"off", kFaces},          {"stl", kFaces},
    {"gltf", kFaces},         {"glb", kFaces},
    {"3mf", kFaces},          {"dae", kFaces},
    {"vtp", kFaces},          {"vtk", kFaces | kTets},
    {"vtu", kFaces | kTets},  {"msh", kFaces | kTets},
    {"mesh", kFaces | kTets}, {"meshb", kFaces | kTets},
    {"gii", kFaces},          {"fsurf", kFaces},
    {"node", kTets},          {"ele", kTets},
    {"xyz", kPoints},         {"pts", kPoints},
    {"pcd", kPoints},         {"png", kGrid},
    {"npy", kGrid},           {"vti", kGrid},
    {"nrrd", kGrid},          {"nhdr", kGrid},
};

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

/// Whether a table of readers has each format that may hold `what` (Holding), and no other one.
template <class Format, std::size_t N>
constexpr bool reads_all(const Format (&table)[N], unsigned what) {
  std::size_t count = 0;
  for (const ModelFormat& format : kModelFormats) {
    if ((format.holds & what) == 0) continue;
    ++count;
    const auto reads = [&](const Format& each) { return each.extension.substr(1) == format.name; };
    if (std::ranges::none_of(table, reads)) return false;
  }
  return count == N;
}

}  // namespace geotherm::io
