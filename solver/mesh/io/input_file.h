// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <new>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "geotherm/error.h"
#include "solver/core/memory.h"

struct stat;

namespace geotherm::io {

/// Thrown and caught inside the readers only; read_mesh() makes an Error of it, with the path.
struct ReadFailure {
  std::string message;   ///< "line N: cause", "byte N: cause", or the cause alone
  std::size_t line = 0;  ///< N where it is a line
  std::string cause = {};
  Hint hint = {};
};

/// Throws "line N: cause" for the place `where` inside `text`.
[[noreturn]] void fail_at_line(std::string_view text, const char* where, const std::string& cause,
                               Hint hint = {});

/// Throws "byte N: cause", N counted from 0.
[[noreturn]] void fail_at_byte(std::string_view bytes, const char* where, const std::string& cause,
                               Hint hint = {});

/// The word at `where` in quotes, shortened, only printable characters: fit for a message.
std::string quoted(std::string_view text, const char* where);

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

/// What `read` gives, a Result, or an error of what it throws. `name`: of the file, as printed;
/// `what`: "mesh"; `size`: bytes of the file.
template <class Read>
auto guarded_read(const std::string& name, const char* what, std::size_t size, const Read& read)
    -> decltype(read()) {
  try {
    return read();
  } catch (const ReadFailure& failure) {
    return Error{ErrorCode::kBadFile, name + ": " + failure.message, failure.hint};
  } catch (const std::bad_alloc&) {
  } catch (const std::length_error&) {
  }
  return Error{ErrorCode::kOutOfMemory, name + ": not enough memory for the " + what + " in its " +
                                            std::to_string(size) + " bytes"};
}

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
