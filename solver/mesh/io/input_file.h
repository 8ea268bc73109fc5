// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "geotherm/error.h"

struct stat;

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

  std::size_t size() const { return before_.size; }

  /// Copies `count` bytes from `place` on; from any number of threads. Throws ReadFailure where the
  /// file ends before that or cannot be read.
  void read(char* to, std::size_t count, std::size_t place) const;

  /// Errors (kBadFile): size or time of the file are others than when it was opened.
  Result<void> check_unchanged() const;

 private:
  /// What tells one state of a file from another.
  struct Version {
    std::size_t size = 0;
    std::int64_t seconds = 0, nanoseconds = 0;  ///< when it was changed
    bool operator==(const Version&) const = default;
  };

  InputFile(std::string shown, int descriptor);
  static Version version_in(const struct ::stat& status);

  std::string shown_;  ///< the path, for messages
  int descriptor_ = -1;
  Version before_;
};

}  // namespace geotherm::io
