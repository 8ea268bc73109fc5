// SPDX-License-Identifier: MIT
#include "solver/mesh/io/input_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <limits>
#include <new>
#include <stdexcept>
#include <system_error>
#include <utility>

#include "solver/core/memory.h"
#include "solver/core/text.h"
#include "solver/mesh/io/parallel.h"

namespace geotherm::io {

void fail_at_line(std::string_view text, const char* where, const std::string& cause, Hint hint) {
  const auto line = static_cast<std::size_t>(1 + std::count(text.data(), where, '\n'));
  throw ReadFailure{"line " + std::to_string(line) + ": " + cause, line, cause, std::move(hint)};
}

void fail_at_byte(std::string_view bytes, const char* where, const std::string& cause, Hint hint) {
  throw ReadFailure{
      "byte " + std::to_string(where - bytes.data()) + ": " + cause, 0, {}, std::move(hint)};
}

std::string quoted(std::string_view text, const char* where) {
  constexpr std::size_t kMax = 24;
  std::string word = "\"";
  for (const char* end = text.data() + text.size(); where < end; ++where) {
    const auto c = static_cast<unsigned char>(*where);
    if (c == ' ' || (c >= '\t' && c <= '\r')) break;
    if (word.size() > kMax) {
      word += "...";
      break;
    }
    word += c > ' ' && c < 0x7f ? *where : '?';
  }
  return word + "\"";
}

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

namespace {

LargeBuffer room_for(std::size_t bytes) {
  const auto free = free_memory();
  if (free && static_cast<std::int64_t>(bytes) > *free) throw std::bad_alloc();
  return LargeBuffer(bytes);
}

}  // namespace

FileBytes::FileBytes(const InputFile& file) : buffer_(room_for(file.size() + kPadding)) {
  constexpr std::size_t kPiece = std::size_t{4} << 20;
  char* const bytes = reinterpret_cast<char*>(buffer_.data());
  const std::size_t size = file.size();
  std::memset(bytes + size, 0, kPadding);
  for_each_parallel((size + kPiece - 1) / kPiece, [&](std::size_t i) {
    const std::size_t place = i * kPiece;
    file.read(bytes + place, std::min(kPiece, size - place), place);
  });
}

Result<FileBytes> FileBytes::read(const std::string& path) {
  const auto file = InputFile::open(path);
  if (!file) return file.error();
  try {
    FileBytes read(*file);
    if (auto same = file->check_unchanged(); !same) return same.error();
    return read;
  } catch (const ReadFailure& failure) {
    return Error{ErrorCode::kBadFile, printable(path) + ": " + failure.message, failure.hint};
  } catch (const std::bad_alloc&) {
    return Error{ErrorCode::kOutOfMemory, printable(path) + ": not enough memory to read it"};
  }
}

namespace {

constexpr std::size_t kStep = std::size_t{1} << 20;

/// Bytes that may be taken: while a buffer grows the old one is there as well.
std::size_t most_bytes() {
  const auto free = free_memory();
  if (!free) return std::numeric_limits<std::size_t>::max() / 4;
  return static_cast<std::size_t>(std::max<std::int64_t>(*free, 0)) / 2;
}

Error too_large(const std::string& name, std::size_t most) {
  return {ErrorCode::kOutOfMemory,
          name + ": a model from a stream may have at most " + std::to_string(most) +
              " bytes, half of the memory that is free",
          {"write it to a file and name that"}};
}

Error ended(const std::string& name, std::size_t size) {
  return {
      ErrorCode::kOutOfMemory,
      name + ": the memory ended after " + std::to_string(size) + " bytes of a model from a stream",
      {"write it to a file and name that"}};
}

}  // namespace

Result<StreamBytes> StreamBytes::read(int descriptor, const std::string& name) {
  StreamBytes out;
  try {
    const std::size_t most = most_bytes();
    for (;;) {
      if (out.buffer_.size() <= out.size_ + FileBytes::kPadding) {
        if (out.size_ >= most) return too_large(name, most);
        const std::size_t step = std::min(std::max(kStep, out.size_ / 2), most - out.size_);
        out.buffer_.resize(out.size_ + step + FileBytes::kPadding);
      }
      const std::size_t room = out.buffer_.size() - FileBytes::kPadding - out.size_;
      const ssize_t got = ::read(descriptor, out.buffer_.data() + out.size_, room);
      if (got < 0 && errno == EINTR) continue;
      if (got < 0) {
        return Error{ErrorCode::kBadFile,
                     name + ": cannot be read: " + std::generic_category().message(errno)};
      }
      if (got == 0) break;
      out.size_ += static_cast<std::size_t>(got);
    }
  } catch (const std::bad_alloc&) {
    return ended(name, out.size_);
  } catch (const std::length_error&) {
    return ended(name, out.size_);
  }
  if (out.size_ == 0) return Error{ErrorCode::kBadFile, name + ": there was nothing to read"};
  std::fill(out.buffer_.begin() + static_cast<std::ptrdiff_t>(out.size_), out.buffer_.end(), '\0');
  return out;
}

}  // namespace geotherm::io
