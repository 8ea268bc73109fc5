// SPDX-License-Identifier: MIT
#include "solver/mesh/io/input_file.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <limits>
#include <new>
#include <system_error>
#include <utility>

#include "solver/core/memory.h"
#include "solver/core/parallel.h"
#include "solver/core/text.h"
#include "solver/mesh/io/formats.h"
#include "solver/mesh/io/gzip.h"

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

/// `shown`: the file's name, for messages.
Error file_error(const std::string& shown, const std::string& cause, const std::string& hint) {
  return {ErrorCode::kBadFile, shown + ": " + cause, {hint}};
}

/// Why a file does not open, by the system's number of the error.
Error open_error(const std::string& shown, int code) {
  switch (code) {
    case ENOENT:
    case ENOTDIR:
      return file_error(shown, "no such file", "check the path");
    case EACCES:
    case EPERM:
      return file_error(shown, "no permission to read the file",
                        "check the rights to it and to the folders that it is in");
    default:
      return file_error(shown, "cannot be opened: " + std::generic_category().message(code),
                        "check the path");
  }
}

/// Bytes that may be held: while a buffer grows the old one is there as well.
std::size_t most_bytes() {
  const auto free = free_memory();
  if (!free) return std::numeric_limits<std::size_t>::max() / 4;
  return static_cast<std::size_t>(std::max<std::int64_t>(*free, 0)) / 2;
}

/// Waits until a pipe, which was opened without waiting, can be read or has had a writer, but no
/// longer than a person would who has forgotten to start one.
void wait_for_writer(int descriptor) {
  constexpr int kMaxMs = 2000;
  pollfd pipe{descriptor, POLLIN, 0};
  ::poll(&pipe, 1, kMaxMs);
  ::fcntl(descriptor, F_SETFL, ::fcntl(descriptor, F_GETFL) & ~O_NONBLOCK);
}

bool is_text(std::string_view bytes) {
  return std::ranges::all_of(bytes, [](char c) {
    return (c >= '\t' && c <= '\r') || static_cast<unsigned char>(c) >= ' ';
  });
}

/// Whether it is text whose lines end with a CR alone, as those of old Macintosh programs do.
bool ends_lines_with_cr(std::string_view text) {
  const std::size_t first = text.find('\r');
  return first != text.npos && first + 1 < text.size() && text.find('\n') == text.npos &&
         is_text(text);
}

}  // namespace

InputFile::InputFile(std::string path, std::string shown, int descriptor)
    : path_(std::move(path)), shown_(std::move(shown)), descriptor_(descriptor) {}

InputFile::Version InputFile::version_in(const struct stat& status) {
  return {static_cast<std::size_t>(status.st_size), status.st_mtim.tv_sec, status.st_mtim.tv_nsec};
}

InputFile::InputFile(InputFile&& other) noexcept
    : path_(std::move(other.path_)),
      shown_(std::move(other.shown_)),
      extension_(std::move(other.extension_)),
      descriptor_(std::exchange(other.descriptor_, -1)),
      begins_(other.begins_),
      before_(other.before_),
      held_(std::move(other.held_)) {}

InputFile& InputFile::operator=(InputFile&& other) noexcept {
  std::swap(path_, other.path_);
  std::swap(shown_, other.shown_);
  std::swap(extension_, other.extension_);
  std::swap(descriptor_, other.descriptor_);
  std::swap(begins_, other.begins_);
  std::swap(before_, other.before_);
  std::swap(held_, other.held_);
  return *this;
}

InputFile::~InputFile() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

Result<InputFile> InputFile::open_as_is(const std::string& path) {
  const std::string shown = printable(path);
  // O_NONBLOCK: opening a pipe must not wait for its writer.
  InputFile file(path, shown, ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
  struct stat status {};
  if (file.descriptor_ < 0 || ::fstat(file.descriptor_, &status) != 0) {
    return open_error(shown, errno);
  }
  if (S_ISDIR(status.st_mode)) return file_error(shown, "is a directory", "give a file in it");
  if (S_ISFIFO(status.st_mode) || S_ISSOCK(status.st_mode)) {
    wait_for_writer(file.descriptor_);
    if (auto held = file.hold_stream(); !held) return held.error();
    return file;
  }
  if (!S_ISREG(status.st_mode)) {
    return file_error(shown, "is neither a regular file nor a pipe", "check the path");
  }
  if (status.st_size == 0)
    return file_error(shown, "the file is empty (0 bytes)", "write it again");
  file.before_ = version_in(status);
  return file;
}

Result<InputFile> InputFile::open(const std::string& path, std::string_view format) {
  auto file = open_as_is(path);
  if (!file) return file;
  if (auto ready = file->prepare(format); !ready) return ready.error();
  return file;
}

Result<InputFile> InputFile::of_stream(int descriptor, const std::string& name,
                                       std::string_view format) {
  InputFile file({}, name, ::dup(descriptor));
  if (auto held = file.hold_stream(); !held) return held.error();
  if (auto ready = file.prepare(format); !ready) return ready.error();
  return file;
}

Result<void> InputFile::prepare(std::string_view format) {
  return guarded_read(shown_, "model", size(), [&]() -> Result<void> {
    if (is_gzip(start(2))) {
      held_ = std::make_shared<const RawVector<char>>(
          unpack_gzip(FileBytes(*this).bytes(), most_bytes(), kPadding));
      if (size() == 0) throw ReadFailure{"nothing is packed in it (0 bytes)"};
    }
    constexpr std::string_view kMark = "\xef\xbb\xbf";
    constexpr std::size_t kLooked = 4096;
    const std::string first = start(kLooked);
    if (first.starts_with(kMark) && is_text(first)) begins_ = kMark.size();
    if (ends_lines_with_cr(first)) {
      const FileBytes whole(*this);
      if (ends_lines_with_cr(whole.bytes())) {
        RawVector<char> lines(size() + kPadding);
        std::ranges::replace_copy(whole.bytes(), lines.begin(), '\r', '\n');
        std::fill(lines.end() - kPadding, lines.end(), '\0');
        held_ = std::make_shared<const RawVector<char>>(std::move(lines));
        begins_ = 0;
      }
    }
    extension_ = format.empty() ? model_extension(path_) : "." + std::string(format);
    // FreeSurfer names its surfaces lh.white, rh.pial and the like.
    const std::string_view found = format_by_content(start(kLooked), size());
    const bool by_content = extension_.empty() || (format.empty() && found == "fsurf");
    if (by_content && !found.empty()) extension_ = "." + std::string(found);
    if (extension_ != ".las" && extension_ != ".laz") return {};
    return Error{ErrorCode::kNotAvailable,
                 shown_ + ": points in LAS files are not read",
                 {"convert them, as by pdal translate scan" + extension_ + " scan.ply"}};
  });
}

Result<void> InputFile::hold_stream() {
  constexpr std::size_t kStep = std::size_t{1} << 20;
  std::size_t size = 0;
  const auto fail = [&](ErrorCode code, const std::string& cause, Hint hint) {
    return Error{code, shown_ + ": " + cause, std::move(hint)};
  };
  try {
    const std::size_t most = most_bytes();
    RawVector<char> bytes;
    for (;;) {
      if (bytes.size() <= size + kPadding) {
        if (size >= most) {
          return fail(ErrorCode::kOutOfMemory,
                      "a model from a stream may have at most " + std::to_string(most) +
                          " bytes, half of the memory that is free",
                      {"write it to a file and name that"});
        }
        bytes.resize(size + std::min(std::max(kStep, size / 2), most - size) + kPadding);
      }
      const ssize_t got = ::read(descriptor_, bytes.data() + size, bytes.size() - kPadding - size);
      if (got < 0 && errno == EINTR) continue;
      if (got < 0) {
        return fail(ErrorCode::kBadFile,
                    "cannot be read: " + std::generic_category().message(errno),
                    {"write it to a file and name that"});
      }
      if (got == 0) break;
      size += static_cast<std::size_t>(got);
    }
    if (size == 0) {
      return fail(ErrorCode::kBadFile, "there was nothing to read", {"check what writes to it"});
    }
    bytes.resize(size + kPadding);
    std::memset(bytes.data() + size, 0, kPadding);
    held_ = std::make_shared<const RawVector<char>>(std::move(bytes));
  } catch (const std::bad_alloc&) {
    return fail(
        ErrorCode::kOutOfMemory,
        "the memory ended after " + std::to_string(size) + " bytes of a model from a stream",
        {"write it to a file and name that"});
  }
  ::close(std::exchange(descriptor_, -1));
  return {};
}

std::string InputFile::start(std::size_t most) const {
  std::string bytes(std::min(most, size()), '\0');
  read(bytes.data(), bytes.size(), 0);
  return bytes;
}

void InputFile::read(char* to, std::size_t count, std::size_t place) const {
  if (held_) {
    if (place > size() || count > size() - place) throw ReadFailure{"the file ends"};
    std::memcpy(to, held_->data() + begins_ + place, count);
    return;
  }
  while (count > 0) {
    const ssize_t got = ::pread(descriptor_, to, count, static_cast<off_t>(begins_ + place));
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
  if (descriptor_ < 0) return {};  // of a stream all is held
  if (::fstat(descriptor_, &now) == 0 && version_in(now) == before_) return {};
  return Error{ErrorCode::kBadFile,
               shown_ + ": was changed while it was read (it had " + std::to_string(before_.size) +
                   " bytes and now has " + std::to_string(now.st_size) + ")",
               {"read it again once it is complete"}};
}

Error unknown_model(const InputFile& file, const std::string& of, unsigned holds) {
  const std::string& extension = file.extension();
  return {ErrorCode::kNotAvailable,
          file.shown() + ": " +
              (extension.empty() ? "neither its name nor its first bytes say what it is"
                                 : "unknown extension \"" + printable(extension) + "\"" + of),
          {"there are " + extensions_holding(holds)}};
}

namespace {

LargeBuffer room_for(std::size_t bytes) {
  const auto free = free_memory();
  if (free && static_cast<std::int64_t>(bytes) > *free) throw std::bad_alloc();
  return LargeBuffer(bytes);
}

}  // namespace

FileBytes::FileBytes(const InputFile& file)
    : held_(file.held_),
      begins_(file.begins_),
      buffer_(held_ ? LargeBuffer() : room_for(file.size() + kPadding)) {
  if (held_) return;
  constexpr std::int64_t kPiece = std::int64_t{4} << 20;
  char* const bytes = reinterpret_cast<char*>(buffer_.data());
  const std::size_t size = file.size();
  std::memset(bytes + size, 0, kPadding);
  parallel_for(thread_count(0), static_cast<std::int64_t>(size), kPiece,
               [&](std::int64_t begin, std::int64_t end) {
                 file.read(bytes + begin, static_cast<std::size_t>(end - begin),
                           static_cast<std::size_t>(begin));
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

}  // namespace geotherm::io
