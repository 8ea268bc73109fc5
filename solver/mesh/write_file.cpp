// SPDX-License-Identifier: MIT
#include "solver/mesh/write_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <optional>
#include <system_error>

#include "solver/mesh/io/file_extension.h"
#include "solver/mesh/unfinished_files.h"

namespace geotherm {
namespace {

Error failure(const std::string& path, int code) {
  return {ErrorCode::kBadFile,
          io::printable(path) + ": cannot be written: " + std::generic_category().message(code)};
}

/// 0, or the system's error code.
int write_all(int file, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(file, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return errno;
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
  return 0;
}

int write_and_close(int file, std::string_view bytes) {
  const int code = write_all(file, bytes);
  return ::close(file) != 0 && code == 0 ? errno : code;
}

Result<void> write_to_stdout(std::string_view bytes) {
  // Through the C stream: what the program wrote before must come before.
  if (std::fwrite(bytes.data(), 1, bytes.size(), stdout) == bytes.size() &&
      std::fflush(stdout) == 0) {
    return {};
  }
  return failure("standard output", errno);
}

/// Writes into a file of a new name beside `path` and renames it; 0, or the system's error code.
int write_beside(const std::string& path, std::string_view bytes, std::optional<mode_t> mode) {
  constexpr int kMostAttempts = 1000;
  const std::string stem = path + ".tmp-" + std::to_string(::getpid()) + '-';
  for (int attempt = 0; attempt < kMostAttempts; ++attempt) {
    const std::string temporary = stem + std::to_string(attempt);
    const UnfinishedFile file(temporary);
    if (file.descriptor() < 0 && errno == EEXIST) continue;
    if (file.descriptor() < 0) return errno;
    if (mode) ::fchmod(file.descriptor(), *mode & 07777);
    int code = write_and_close(file.descriptor(), bytes);
    if (code == 0 && ::rename(temporary.c_str(), path.c_str()) != 0) code = errno;
    if (code != 0) ::unlink(temporary.c_str());
    return code;
  }
  return EEXIST;
}

}  // namespace

Result<void> write_file(const std::string& path, std::string_view bytes) {
  if (path == "-") return write_to_stdout(bytes);
  struct stat status {};
  const bool exists = ::stat(path.c_str(), &status) == 0;
  if (exists && S_ISDIR(status.st_mode)) return failure(path, EISDIR);
  if (exists && !S_ISREG(status.st_mode)) {  // a device or a pipe must stay what it is
    const int file = ::open(path.c_str(), O_WRONLY | O_CLOEXEC);
    const int code = file < 0 ? errno : write_and_close(file, bytes);
    return code == 0 ? Result<void>() : failure(path, code);
  }
  if (exists && ::access(path.c_str(), W_OK) != 0) return failure(path, errno);

  // A link stays a link: what it points to is replaced.
  std::error_code unresolved;
  const std::string resolved = std::filesystem::weakly_canonical(path, unresolved).string();
  const int code = write_beside(unresolved ? path : resolved, bytes,
                                exists ? std::optional(status.st_mode) : std::nullopt);
  return code == 0 ? Result<void>() : failure(path, code);
}

}  // namespace geotherm
