// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "geotherm/error.h"
#include "solver/mesh/output_file.h"

namespace geotherm::app {

/// What the system knows a file by, whatever it is called: its device and its number there.
using FileId = std::pair<std::uint64_t, std::uint64_t>;

/// A file that a command reads.
struct InputFile {
  FileId id;
  std::string called;       ///< "the model itself"
  std::string option = {};  ///< what it was given to, "--mask"; empty: none
};

/// The files that `text` names: a path, or all files that there are of a name such as
/// frame_%04d.obj. None where nothing is called so.
std::vector<FileId> files_named(const std::string& text);

/// What the command line names, in any of its options: expect() refuses it to every other option.
/// Set once, before there are other threads.
void remember_files(std::vector<InputFile> named);

/// The output files of one command: checked before the work, written after it, and when one of them
/// fails, those that the command made are removed again.
class Outputs {
 public:
  /// Files that are read, as files_named() finds them: expect() then refuses them.
  void protect(const std::string& text, std::string_view called);

  /// `option`: how the command line calls it, "--output", or what else wants the file, for
  /// messages.
  /// "-" is standard output.
  /// Errors: kBadInput (the same path twice, standard output twice, a protected file, and of an
  /// option one that another option names), kBadFile (no such folder, a directory, no permission).
  Result<void> expect(const std::string& path, std::string_view option);

  /// True when an output goes to standard output, which is then for nothing else.
  bool uses_stdout() const;

  /// Runs `write`, which writes place_of(path).
  Result<void> write(const std::string& path, const std::function<Result<void>()>& write);

  /// The same for `text` as a whole; where `path` is "-" it ends up in `standard_output`.
  Result<void> write_text(const std::string& path, std::string text, std::string& standard_output);

  /// From here on files are of use together alone. New ones: until this object goes, a signal that
  /// ends the program removes them. Those that were there before are replaced by replace_all(),
  /// when all are written, and until then they are what they were.
  void keep_together() { group_.emplace(); }

  /// Where the bytes of `path` go: there, or beside it where replace_all() is to move them.
  std::string place_of(const std::string& path) const;

  /// Errors: kBadFile, with nothing removed of what is in its place.
  Result<void> replace_all();

  /// The files that were written and were not there before.
  std::vector<std::string> made() const;

  /// Removes the files that were made so far, for a command whose work failed between two of them.
  void remove_written();

 private:
  struct File {
    std::string path;
    std::string resolved;  ///< the same for all names of a file, but for hard links
    bool is_new;
    bool written = false;
    bool waits = false;  ///< beside its place
  };
  /// What a file that is read is called; empty: this one is not.
  std::string called_input(const std::string& path, std::string_view option) const;

  std::vector<File> files_;
  std::vector<InputFile> inputs_;
  std::optional<FileGroup> group_;
};

/// Whether a file of distances holds the mesh as well, so that a property can be added to it
/// without harm: .ply and .vtp.
bool holds_mesh(const std::string& path);

/// What a command that has done its work hands to whoever called it; nothing has been printed.
struct CommandOutput {
  std::string text;  ///< for standard output
  std::vector<Warning> warnings;
  std::vector<std::string> made;  ///< new files, to be removed when the text cannot be printed
  std::string note = {};          ///< a line for standard error that is no warning; empty: none
  /// Why the work counts as failed although there is something to print.
  std::optional<Error> failure = {};
};

}  // namespace geotherm::app
