// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "geotherm/error.h"

namespace geotherm::io {

/// All that a stream (a pipe, a terminal, a file) held, with the padding that FileBytes has.
class StreamBytes {
 public:
  /// Reads the open descriptor to its end; it stays open. `name`: of the stream, in messages.
  /// Errors: kBadFile (it cannot be read, it holds nothing), kOutOfMemory (it holds more than half
  /// of the memory that is free, for the mesh needs as much again), each "NAME: cause".
  static Result<StreamBytes> read(int descriptor, const std::string& name);

  std::string_view bytes() const { return {buffer_.data(), size_}; }

 private:
  std::vector<char> buffer_;  ///< with the padding
  std::size_t size_ = 0;
};

}  // namespace geotherm::io
