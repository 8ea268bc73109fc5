// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "geotherm/error.h"

namespace geotherm {

/// A file that is written piece by piece: beside its place until finish() renames it, so that it is
/// there whole or not at all. Without finish(), or where a signal ends the program
/// (remove_unfinished_files()), nothing is left; what a program that was killed has left of the
/// same file the next one removes. A link stays a link, and a device or a pipe is written to as it
/// is. "-" is standard output, through the C stream. For one thread at a time. Errors (kBadFile)
/// carry the path and the system's reason.
class GrowingFile {
 public:
  static Result<GrowingFile> open(const std::string& path);

  /// The same for work that can go on where it was cut off: the bytes are in FILE.part, which stays
  /// as it is where it is there already, and stays where finish() is not reached. Precondition:
  /// is_renamed(path). Errors: also kBadFile, another process has it open like this.
  static Result<GrowingFile> open_part(const std::string& path);

  GrowingFile(GrowingFile&&) noexcept;
  GrowingFile& operator=(GrowingFile&&) noexcept;
  GrowingFile(const GrowingFile&) = delete;
  GrowingFile& operator=(const GrowingFile&) = delete;
  ~GrowingFile();

  /// Cost: one system call; append much at once.
  Result<void> append(std::string_view bytes);

  /// Where the bytes are until then: its own path where nothing is renamed.
  const std::string& place() const;

  /// Makes it the file of its path. Nothing may follow.
  Result<void> finish();

 private:
  struct State;
  explicit GrowingFile(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

/// Where the links of a path lead, also to a file that is not there yet.
std::string end_of_links(const std::string& path);

/// Whether this is a file, or none yet, and neither standard output nor a device or a pipe.
bool is_renamed(const std::string& path);

/// Bytes that still fit where `path` is to be written; empty where no file grows there (standard
/// output, a device) or the system does not say.
std::optional<std::uint64_t> room_for(const std::string& path);

/// Writes `bytes` beside `path` and renames: `path` is there whole or not at all. "-" is standard
/// output. Errors (kBadFile) carry the path and the system's reason; the temporary is removed.
Result<void> write_file(const std::string& path, std::string_view bytes);

/// Whether `path` is "-" or has one of the extensions that `known` lists (".csv .npy"). `of`: " for
/// a grid", or empty. Errors: kNotAvailable, with the path and the list.
Result<void> check_written(const std::string& path, const std::string& known,
                           const std::string& of = {});

/// Makes the bytes and writes them. Errors: those of both, with the path, and kOutOfMemory.
Result<void> write_made(const std::string& path,
                        const std::function<Result<std::string>()>& make_bytes);

/// Files that are of use together alone. While this lives, remove_unfinished_files() removes them,
/// whole or not.
class FileGroup {
 public:
  FileGroup() = default;
  FileGroup(FileGroup&& other) noexcept : files_(std::exchange(other.files_, {})) {}
  FileGroup& operator=(FileGroup&& other) noexcept {
    std::swap(files_, other.files_);
    return *this;
  }
  ~FileGroup();

  /// Precondition: no such file is there yet; call it before it is written.
  void add(const std::string& path);

 private:
  struct File;
  friend void remove_unfinished_files() noexcept;
  std::vector<File*> files_;
};

/// Removes what GrowingFile and write_file() have begun beside their targets, on every thread, and
/// the files of groups, and lets it begin nothing more: for the handler of a signal that ends the
/// program.
/// Async-signal-safe; waits up to a second for a thread that opens a file at this moment.
void remove_unfinished_files() noexcept;

}  // namespace geotherm
