// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <new>
#include <stdexcept>
#include <string>
#include <string_view>

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

/// A file or a stream that is open for reading, by copies of its bytes: a mapping of a file that
/// others shorten would end the program with a signal. Pipes are read to their end, and what gzip
/// packed is unpacked, when they are opened; either is held in memory then.
class InputFile {
 public:
  /// `format`: what it is read as, whatever its name; empty: what the name says. Errors (kBadFile):
  /// no such file, no permission, a directory or another thing that is neither a regular file nor a
  /// pipe, an empty file, damaged gzip; kOutOfMemory (a pipe holds more than half of the memory
  /// that is free, for the mesh needs as much again); each "PATH: cause" with a hint.
  static Result<InputFile> open(const std::string& path, std::string_view format = {});

  /// The bytes of a file as they are, packed or not. Errors: the same.
  static Result<InputFile> open_as_is(const std::string& path);

  /// Reads an open descriptor, which stays open. `name`: what messages call it. Errors: the same.
  static Result<InputFile> of_stream(int descriptor, const std::string& name,
                                     std::string_view format = {});

  InputFile(InputFile&& other) noexcept;
  InputFile& operator=(InputFile&& other) noexcept;
  InputFile(const InputFile&) = delete;
  InputFile& operator=(const InputFile&) = delete;
  ~InputFile();

  std::size_t size() const { return (held_ ? held_->size() - kPadding : before_.size) - begins_; }
  bool is_stream() const { return descriptor_ < 0; }
  const std::string& path() const { return path_; }    ///< empty for a stream
  const std::string& shown() const { return shown_; }  ///< the path or the name, for messages
  /// ".ply": of the named format; without one that of the path, less .gz; where that has none, what
  /// the bytes begin like. Empty: nothing that is known.
  const std::string& extension() const { return extension_; }

  /// Copies `count` bytes from `place` on; from any number of threads. Throws ReadFailure where the
  /// file ends before that or cannot be read.
  void read(char* to, std::size_t count, std::size_t place) const;

  /// The first bytes, at most so many. Throws as read() does.
  std::string start(std::size_t most) const;

  /// Errors (kBadFile): size or time of the file are others than when it was opened.
  Result<void> check_unchanged() const;

  /// Zero bytes that can be read behind those of FileBytes.
  static constexpr std::size_t kPadding = 64;

 private:
  friend class FileBytes;

  /// What tells one state of a file from another.
  struct Version {
    std::size_t size = 0;
    std::int64_t seconds = 0, nanoseconds = 0;  ///< when it was changed
    bool operator==(const Version&) const = default;
  };

  InputFile(std::string path, std::string shown, int descriptor);
  static Version version_in(const struct ::stat& status);
  /// Holds what the stream gives, and closes it. Errors: those of open().
  Result<void> hold_stream();
  /// Unpacks what is packed, passes over the mark of UTF-8 that some editors write in front of a
  /// text, makes line ends of CR alone those of today, and finds the extension. Errors: those of
  /// open().
  Result<void> prepare(std::string_view format);

  std::string path_, shown_, extension_;
  int descriptor_ = -1;     ///< of a regular file; of a stream -1
  std::size_t begins_ = 0;  ///< where its bytes do, in the file or in what is held
  Version before_;
  std::shared_ptr<const RawVector<char>> held_;  ///< with the padding; null: the file has the bytes
};

/// A file as a whole in memory.
///
/// Behind the last byte at least kPadding zero bytes can be read, so a scanner needs no end test
/// inside a number or a word.
class FileBytes {
 public:
  static constexpr std::size_t kPadding = InputFile::kPadding;

  /// A copy, made by all cores; shared with a file that holds its bytes. Throws ReadFailure and
  /// std::bad_alloc, the latter also where the file is larger than what is free.
  explicit FileBytes(const InputFile& file);

  /// The same of a small file that is opened for it. Errors: those of InputFile, kOutOfMemory.
  static Result<FileBytes> read(const std::string& path);

  std::string_view bytes() const {
    if (held_) return {held_->data() + begins_, held_->size() - kPadding - begins_};
    return {reinterpret_cast<const char*>(buffer_.data()), buffer_.size() - kPadding};
  }

 private:
  std::shared_ptr<const RawVector<char>> held_;
  std::size_t begins_ = 0;  ///< in what is held
  LargeBuffer buffer_;      ///< with the padding
};

/// That the extension of a file is none of those that hold what is asked for. `of`: " of tets", or
/// empty; `holds`: of Holding.
Error unknown_model(const InputFile& file, const std::string& of, unsigned holds);

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

/// The same of a file, or the error that it changed meanwhile: that comes before what was wrong in
/// it, which may have been half of what it is to be.
template <class Read>
auto read_unchanged(const InputFile& file, const std::string& name, const char* what,
                    const Read& read) -> decltype(read()) {
  auto made = guarded_read(name, what, file.size(), read);
  if (auto same = file.check_unchanged(); !same) return same.error();
  return made;
}

}  // namespace geotherm::io
