// SPDX-License-Identifier: MIT
#pragma once

#include <sys/stat.h>

#include <cstddef>
#include <string>

#include "solver/core/result.h"

namespace geotherm::io {

/// A regular file that is open for reading, by copies of its bytes: a mapping of a file that others
/// shorten would end the program with a signal.
class InputFile {
 public:
  /// Errors (kBadFile): no such file, no permission, a directory or another thing that is not a
  /// regular file, an empty file; each "PATH: cause".
  static Result<InputFile> open(const std::string& path);

  InputFile(InputFile&& other) noexcept;
  InputFile& operator=(InputFile&& other) noexcept;
  InputFile(const InputFile&) = delete;
  InputFile& operator=(const InputFile&) = delete;
  ~InputFile();

  std::size_t size() const { return static_cast<std::size_t>(before_.st_size); }

  /// Copies `count` bytes from `place` on; from any number of threads. Throws ReadFailure where the
  /// file ends before that or cannot be read.
  void read(char* to, std::size_t count, std::size_t place) const;

  /// Errors (kBadFile): size or time of the file are others than when it was opened.
  Result<void> check_unchanged() const;

 private:
  InputFile(std::string shown, int descriptor);

  std::string shown_;  ///< the path, for messages
  int descriptor_ = -1;
  struct stat before_ {};
};

}  // namespace geotherm::io
