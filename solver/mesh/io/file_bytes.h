// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "geotherm/error.h"
#include "solver/core/large_buffer.h"

namespace geotherm::io {

class InputFile;

/// A file as a whole in memory.
///
/// Behind the last byte at least kPadding zero bytes can be read, so a scanner needs no end test
/// inside a number or a word.
class FileBytes {
 public:
  static constexpr std::size_t kPadding = 64;

  /// A copy, made by all cores. Throws ReadFailure and std::bad_alloc, the latter also where the
  /// file is larger than what is free.
  explicit FileBytes(const InputFile& file);

  /// The same of a small file that is opened for it. Errors: those of InputFile, kOutOfMemory.
  static Result<FileBytes> read(const std::string& path);

  std::string_view bytes() const {
    return {reinterpret_cast<const char*>(buffer_.data()), buffer_.size() - kPadding};
  }

 private:
  LargeBuffer buffer_;  ///< with the padding
};

}  // namespace geotherm::io
