// SPDX-License-Identifier: MIT
#include "solver/mesh/io/input_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>
#include <utility>

#include "solver/mesh/io/file_extension.h"
#include "solver/mesh/io/read_failure.h"

namespace geotherm::io {
namespace {

std::string open_cause(int code) {
  switch (code) {
    case ENOENT:
    case ENOTDIR:
      return "no such file";
    case EACCES:
    case EPERM:
      return "no permission to read the file";
    default:
      return "cannot be opened: " + std::generic_category().message(code);
  }
}

}  // namespace

InputFile::InputFile(std::string shown, int descriptor)
    : shown_(std::move(shown)), descriptor_(descriptor) {}

InputFile::Version InputFile::version_in(const struct stat& status) {
  return {static_cast<std::size_t>(status.st_size), status.st_mtim.tv_sec, status.st_mtim.tv_nsec};
}

InputFile::InputFile(InputFile&& other) noexcept
    : shown_(std::move(other.shown_)),
      descriptor_(std::exchange(other.descriptor_, -1)),
      before_(other.before_) {}

InputFile& InputFile::operator=(InputFile&& other) noexcept {
  std::swap(shown_, other.shown_);
  std::swap(descriptor_, other.descriptor_);
  std::swap(before_, other.before_);
  return *this;
}

InputFile::~InputFile() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

Result<InputFile> InputFile::open(const std::string& path) {
  const std::string shown = printable(path);
  const auto failure = [&shown](const std::string& cause, Hint hint = {}) {
    return Error{ErrorCode::kBadFile, shown + ": " + cause, std::move(hint)};
  };
  // O_NONBLOCK: opening a pipe must not wait for its writer.
  InputFile file(shown, ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
  struct stat status {};
  if (file.descriptor_ < 0 || ::fstat(file.descriptor_, &status) != 0) {
    return failure(open_cause(errno));
  }
  if (S_ISDIR(status.st_mode)) return failure("is a directory", {"give a mesh file in it"});
  if (!S_ISREG(status.st_mode)) return failure("is not a regular file");
  if (status.st_size == 0) return failure("the file is empty (0 bytes)");
  file.before_ = version_in(status);
  return file;
}

void InputFile::read(char* to, std::size_t count, std::size_t place) const {
  while (count > 0) {
    const ssize_t got = ::pread(descriptor_, to, count, static_cast<off_t>(place));
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) {
      throw ReadFailure{"cannot be read: " + std::generic_category().message(errno)};
    }
    if (got == 0) {
      throw ReadFailure{"the file ends after " + std::to_string(place) + " of " +
                        std::to_string(size()) + " bytes: it was shortened while it was read"};
    }
    to += got;
    place += static_cast<std::size_t>(got);
    count -= static_cast<std::size_t>(got);
  }
}

Result<void> InputFile::check_unchanged() const {
  struct stat now {};
  if (::fstat(descriptor_, &now) == 0 && version_in(now) == before_) return {};
  return Error{ErrorCode::kBadFile,
               shown_ + ": was changed while it was read (it had " + std::to_string(size()) +
                   " bytes and now has " + std::to_string(now.st_size) + ")",
               {"read it again once it is complete"}};
}

}  // namespace geotherm::io
