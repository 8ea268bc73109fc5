// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "solver/core/result.h"

namespace geotherm::io {

/// A regular file mapped into memory, read-only.
///
/// Behind the last byte at least kPadding zero bytes can be read, so a scanner needs no end test
/// inside a number or a word. A file that is shortened by others while it is read is not survived:
/// the system ends the program then, as with every mapped file.
class MappedFile {
 public:
  static constexpr std::size_t kPadding = 64;

  /// Errors (kBadFile): no such file, no permission, a directory or another thing that is not a
  /// regular file, an empty file; each "PATH: cause".
  static Result<MappedFile> open(const std::string& path);

  MappedFile(MappedFile&& other) noexcept;
  MappedFile& operator=(MappedFile&& other) noexcept;
  MappedFile(const MappedFile&) = delete;
  MappedFile& operator=(const MappedFile&) = delete;
  ~MappedFile();

  std::string_view bytes() const { return {base_, size_}; }

 private:
  MappedFile(const char* base, std::size_t size, std::size_t mapped)
      : base_(base), size_(size), mapped_(mapped) {}

  const char* base_ = nullptr;
  std::size_t size_ = 0;    ///< of the file
  std::size_t mapped_ = 0;  ///< with the padding
};

}  // namespace geotherm::io
