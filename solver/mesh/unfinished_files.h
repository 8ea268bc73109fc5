// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace geotherm {

/// Removes what write_file() has begun beside its targets, on every thread, and lets it begin
/// nothing more: for the handler of a signal that ends the program. Async-signal-safe; waits up to
/// a second for a thread that opens a file at this moment.
void remove_unfinished_files() noexcept;

/// A name that is removed by remove_unfinished_files() while this lives. For several threads. Where
/// more than 32 live at once, those above are left behind.
class UnfinishedFile {
 public:
  /// Creates the file, which must not exist: descriptor(), or -1 with errno. From the first moment
  /// on it is known; the calling thread takes no signal in between.
  explicit UnfinishedFile(const std::string& path);
  ~UnfinishedFile();
  UnfinishedFile(const UnfinishedFile&) = delete;
  UnfinishedFile& operator=(const UnfinishedFile&) = delete;

  int descriptor() const { return descriptor_; }

 private:
  int slot_ = -1;
  int descriptor_ = -1;
};

}  // namespace geotherm
