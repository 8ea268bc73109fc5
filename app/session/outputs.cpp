// SPDX-License-Identifier: MIT
#include "app/session/outputs.h"

#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <filesystem>
#include <system_error>
#include <utility>

#include "app/session/wording.h"
#include "app/text/text.h"
#include "solver/core/text.h"
#include "solver/mesh/frames.h"

namespace geotherm::app {
namespace {

namespace fs = std::filesystem;

Error cannot_write(const std::string& path, const std::string& cause, const std::string& hint) {
  return {ErrorCode::kBadFile, one_line(path) + ": cannot be written: " + cause, {hint}};
}

Result<void> check_place(const std::string& path) {
  std::error_code unknown;
  if (path.empty()) return Error{ErrorCode::kBadInput, "an output file has no name", {"give one"}};
  if (fs::is_directory(path, unknown)) {
    return cannot_write(path, "it is a folder", "give the name of a file in it");
  }
  if (fs::exists(path, unknown)) {
    if (::access(path.c_str(), W_OK) == 0) return {};
    return cannot_write(path, std::generic_category().message(errno), "choose another name");
  }
  const fs::path parent = fs::path(path).parent_path();
  const std::string folder = parent.empty() ? "." : parent.string();
  if (!fs::exists(folder, unknown)) {
    return cannot_write(path, "there is no folder " + one_line(folder), "make it first");
  }
  if (!fs::is_directory(folder, unknown)) {
    return cannot_write(path, one_line(folder) + " is no folder", "choose another place");
  }
  if (::access(folder.c_str(), W_OK | X_OK) == 0) return {};
  return cannot_write(path,
                      "folder " + one_line(folder) + ": " + std::generic_category().message(errno),
                      "choose another place");
}

std::string resolved_path(const std::string& path) {
  std::error_code unknown;
  return end_of_links(fs::absolute(path, unknown).string());
}

/// Nothing where there is no file, or a folder, a device or a pipe.
std::optional<FileId> id_of(const std::string& path) {
  struct stat found {};
  if (::stat(path.c_str(), &found) != 0 || !S_ISREG(found.st_mode)) return std::nullopt;
  return FileId{found.st_dev, found.st_ino};
}

std::vector<InputFile>& files_of_process() {
  static std::vector<InputFile> files;
  return files;
}

/// `resolved`: of both. Hard links are the same file, too.
bool same_file(const std::string& a, const std::string& resolved_a, const std::string& b,
               const std::string& resolved_b) {
  std::error_code unknown;
  return resolved_a == resolved_b || fs::equivalent(a, b, unknown);
}

}  // namespace

std::vector<FileId> files_named(const std::string& text) {
  std::vector<FileId> found;
  const auto add = [&found](const std::string& path) {
    if (const auto id = id_of(path)) found.push_back(*id);
  };
  add(text);
  const auto numbered = NumberedPath::parse(text);
  if (!numbered) return found;
  const fs::path form(text), folder = form.has_parent_path() ? form.parent_path() : ".";
  const std::size_t place = form.filename().string().find('%');
  std::error_code failed;
  for (fs::directory_iterator entry(folder, failed), none; !failed && entry != none;
       entry.increment(failed)) {
    const std::string name = entry->path().filename().string();
    std::int64_t number = -1;
    std::from_chars(name.data() + std::min(place, name.size()), name.data() + name.size(), number);
    if (number < 0 || fs::path(numbered->path(number)).filename() != name) continue;
    add(entry->path().string());
  }
  return found;
}

void remember_files(std::vector<InputFile> named) { files_of_process() = std::move(named); }

void Outputs::protect(const std::string& text, std::string_view called) {
  for (const FileId& id : files_named(text)) inputs_.push_back({id, std::string(called)});
}

std::string Outputs::called_input(const std::string& path, std::string_view option) const {
  const std::optional<FileId> id = id_of(path);
  if (!id) return {};
  for (const InputFile& input : inputs_) {
    if (input.id == *id) return input.called;
  }
  if (!option.starts_with("--")) return {};
  for (const InputFile& named : files_of_process()) {
    if (named.id == *id && named.option != option) return named.called;
  }
  return {};
}

Result<void> Outputs::expect(const std::string& path, std::string_view option) {
  std::error_code unknown;
  const bool is_new = path != "-" && !fs::exists(path, unknown);
  const std::string resolved = path == "-" ? path : resolved_path(path);
  const auto is_this = [&](const File& other) {
    // What does not exist yet has no second name, and asking the system about each pair of a
    // thousand frames takes its time.
    if (is_new || other.is_new) return resolved == other.resolved;
    return path == "-" || other.path == "-" ? path == other.path
                                            : same_file(path, resolved, other.path, other.resolved);
  };
  for (const File& other : files_) {
    if (!is_this(other)) continue;
    return Error{ErrorCode::kBadInput,
                 std::string(option) + ": " + (path == "-" ? "standard output" : one_line(path)) +
                     " is asked for twice",
                 {"give each output a place of its own"}};
  }
  if (path != "-") {
    if (auto place = check_place(fs::is_symlink(path, unknown) ? resolved : path); !place) {
      return place;
    }
    if (const std::string called = called_input(path, option); !called.empty()) {
      return Error{ErrorCode::kBadInput,
                   std::string(option) + ": " + one_line(path) + " is " + called,
                   {"give another name"}};
    }
  }
  files_.push_back({path, resolved, is_new});
  return {};
}

bool Outputs::uses_stdout() const {
  for (const File& file : files_) {
    if (file.path == "-") return true;
  }
  return false;
}

Result<void> Outputs::write(const std::string& path, const std::function<Result<void>()>& write) {
  const auto file = std::ranges::find(files_, path, &File::path);
  const std::string place = place_of(path);
  if (group_ && file != files_.end() && path != "-") group_->add(place);
  Result<void> done = write();
  if (!done) {
    remove_written();
    return with_hint(done.error(), {"make room there, or choose another place"});
  }
  if (file != files_.end()) file->written = true;
  if (file != files_.end()) file->waits = place != path;
  return done;
}

std::string Outputs::place_of(const std::string& path) const {
  const auto file = std::ranges::find(files_, path, &File::path);
  if (!group_ || path == "-" || file == files_.end() || file->is_new) return path;
  std::error_code unknown;
  if (!fs::is_regular_file(path, unknown)) return path;  // a device stays what it is
  // A link stays a link; the ending says what is written.
  const fs::path target(file->resolved);
  const std::string name = target.stem().string() + ".tmp-" + std::to_string(::getpid());
  return (target.parent_path() / (name + target.extension().string())).string();
}

Result<void> Outputs::replace_all() {
  for (File& file : files_) {
    if (!file.waits) continue;
    std::error_code failed;
    fs::rename(place_of(file.path), file.resolved, failed);
    if (failed) {
      Error error = cannot_write(file.path, failed.message(), "choose another place");
      remove_written();
      return error;
    }
    file.waits = false;
  }
  return {};
}

Result<void> Outputs::write_text(const std::string& path, std::string text,
                                 std::string& standard_output) {
  return write(path, [&]() -> Result<void> {
    if (path != "-") return write_file(place_of(path), text);
    standard_output = std::move(text);
    return {};
  });
}

std::vector<std::string> Outputs::made() const {
  std::vector<std::string> paths;
  for (const File& file : files_) {
    if (file.written && file.is_new && file.path != "-") {
      std::error_code unknown;
      const bool is_link = fs::is_symlink(file.path, unknown);
      paths.push_back(is_link ? file.resolved : file.path);
    }
  }
  return paths;
}

void Outputs::remove_written() {
  for (const std::string& path : made()) ::unlink(path.c_str());
  for (File& file : files_) {
    if (std::exchange(file.waits, false)) ::unlink(place_of(file.path).c_str());
  }
}

bool holds_mesh(const std::string& path) {
  const std::string extension = io::file_extension(path);
  return extension == ".ply" || extension == ".vtp";
}

}  // namespace geotherm::app
