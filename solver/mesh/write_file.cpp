// SPDX-License-Identifier: MIT
#include "solver/mesh/write_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <system_error>

#include "solver/mesh/io/file_extension.h"

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

/// Creates a file of a new name beside `path`; the descriptor, or -1 with errno.
int create_beside(const std::string& path, std::string& temporary) {
  const std::string stem = path + ".tmp-" + std::to_string(::getpid()) + '-';
  for (int attempt = 0; attempt < 1000; ++attempt) {
    temporary = stem + std::to_string(attempt);
    const int file = ::open(temporary.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (file >= 0 || errno != EEXIST) return file;
  }
  return -1;
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
  const std::string& target = unresolved ? path : resolved;
  std::string temporary;
  const int file = create_beside(target, temporary);
  if (file < 0) return failure(path, errno);
  if (exists) ::fchmod(file, status.st_mode & 07777);
  int code = write_and_close(file, bytes);
  if (code == 0 && ::rename(temporary.c_str(), target.c_str()) != 0) code = errno;
  if (code == 0) return {};
  ::unlink(temporary.c_str());
  return failure(path, code);
}

}  // namespace geotherm
