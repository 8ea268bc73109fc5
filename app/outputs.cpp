// SPDX-License-Identifier: MIT
#include "app/outputs.h"

#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <filesystem>
#include <system_error>

#include "app/text.h"

namespace geotherm::app {
namespace {

namespace fs = std::filesystem;

Error cannot_write(const std::string& path, const std::string& cause) {
  return {ErrorCode::kBadFile, one_line(path) + ": cannot be written: " + cause};
}

Result<void> check_place(const std::string& path) {
  std::error_code unknown;
  if (path.empty()) return Error{ErrorCode::kBadInput, "an output file has no name; give one"};
  if (fs::is_directory(path, unknown)) {
    return cannot_write(path, "it is a folder; give the name of a file in it");
  }
  if (fs::exists(path, unknown)) {
    if (::access(path.c_str(), W_OK) == 0) return {};
    return cannot_write(path, std::generic_category().message(errno) + "; choose another name");
  }
  const fs::path parent = fs::path(path).parent_path();
  const std::string folder = parent.empty() ? "." : parent.string();
  if (!fs::exists(folder, unknown)) {
    return cannot_write(path, "there is no folder " + one_line(folder) + "; make it first");
  }
  if (!fs::is_directory(folder, unknown)) {
    return cannot_write(path, one_line(folder) + " is no folder; choose another place");
  }
  if (::access(folder.c_str(), W_OK | X_OK) == 0) return {};
  return cannot_write(path, "folder " + one_line(folder) + ": " +
                                std::generic_category().message(errno) + "; choose another place");
}

bool same_file(const std::string& a, const std::string& b) {
  std::error_code unknown;
  if (fs::equivalent(a, b, unknown)) return true;
  const auto resolved = [&unknown](const std::string& path) {
    return fs::weakly_canonical(fs::absolute(path, unknown), unknown);
  };
  return resolved(a) == resolved(b);
}

}  // namespace

Result<void> Outputs::expect(const std::string& path, std::string_view option,
                             const std::string& model_path) {
  for (const File& other : files_) {
    if (path == "-" ? other.path != "-" : other.path == "-" || !same_file(path, other.path))
      continue;
    return Error{ErrorCode::kBadInput,
                 std::string(option) + ": " + (path == "-" ? "standard output" : one_line(path)) +
                     " is asked for twice; give each output a place of its own"};
  }
  if (path != "-") {
    if (auto place = check_place(path); !place) return place;
    if (!model_path.empty() && same_file(path, model_path)) {
      return Error{ErrorCode::kBadInput, std::string(option) + ": " + one_line(path) +
                                             " is the model itself; give another name"};
    }
  }
  std::error_code unknown;
  files_.push_back({path, path != "-" && !fs::exists(path, unknown)});
  return {};
}

bool Outputs::uses_stdout() const {
  for (const File& file : files_) {
    if (file.path == "-") return true;
  }
  return false;
}

Result<void> Outputs::write(const std::string& path, const std::function<Result<void>()>& write) {
  Result<void> done = write();
  for (File& file : files_) {
    if (done && file.path == path) file.written = true;
    if (!done && file.written && file.is_new) ::unlink(file.path.c_str());
  }
  return done;
}

}  // namespace geotherm::app
