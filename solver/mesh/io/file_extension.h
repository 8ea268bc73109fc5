// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>

#include "solver/core/printable.h"

namespace geotherm::io {

/// The extension in lower case with its point (".obj"), or nothing; of the last part of the path.
inline std::string file_extension(std::string_view path) {
  const std::size_t slash = path.rfind('/');
  if (slash != path.npos) path.remove_prefix(slash + 1);
  const std::size_t point = path.rfind('.');
  std::string extension(point == path.npos ? "" : path.substr(point));
  for (char& c : extension) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return extension;
}

/// The path fit for a message of one line.
using geotherm::printable;

}  // namespace geotherm::io
