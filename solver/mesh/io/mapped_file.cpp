// SPDX-License-Identifier: MIT
#include "solver/mesh/io/mapped_file.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>
#include <utility>

#include "solver/mesh/io/file_extension.h"

namespace geotherm::io {
namespace {

class Descriptor {
 public:
  explicit Descriptor(int number) : number_(number) {}
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  ~Descriptor() {
    if (number_ >= 0) ::close(number_);
  }
  int number() const { return number_; }

 private:
  int number_;
};

Error failure(const std::string& path, const std::string& cause) {
  return {ErrorCode::kBadFile, printable(path) + ": " + cause};
}

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

Result<MappedFile> MappedFile::open(const std::string& path) {
  // O_NONBLOCK: opening a pipe must not wait for its writer.
  const Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
  if (file.number() < 0) return failure(path, open_cause(errno));
  struct stat status {};
  if (::fstat(file.number(), &status) != 0) return failure(path, open_cause(errno));
  if (S_ISDIR(status.st_mode)) return failure(path, "is a directory; give a mesh file in it");
  if (!S_ISREG(status.st_mode)) return failure(path, "is not a regular file");
  if (status.st_size == 0) return failure(path, "the file is empty (0 bytes)");

  // Zero pages first, then the file over them: what is left behind it is the padding.
  const auto size = static_cast<std::size_t>(status.st_size);
  const auto page = static_cast<std::size_t>(::sysconf(_SC_PAGESIZE));
  const std::size_t mapped = (size + page - 1) / page * page + page;
  void* const base =
      ::mmap(nullptr, mapped, PROT_READ, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
  if (base == MAP_FAILED) {
    return Error{ErrorCode::kOutOfMemory,
                 printable(path) + ": no room to map its " + std::to_string(size) + " bytes"};
  }
  MappedFile result(static_cast<const char*>(base), size, mapped);
  if (::mmap(base, size, PROT_READ, MAP_PRIVATE | MAP_FIXED | MAP_POPULATE, file.number(), 0) ==
      MAP_FAILED) {
    return failure(path, "cannot be mapped: " + std::generic_category().message(errno));
  }
  return result;
}

MappedFile::MappedFile(MappedFile&& other) noexcept
    : base_(std::exchange(other.base_, nullptr)),
      size_(std::exchange(other.size_, 0)),
      mapped_(std::exchange(other.mapped_, 0)) {}

MappedFile& MappedFile::operator=(MappedFile&& other) noexcept {
  std::swap(base_, other.base_);
  std::swap(size_, other.size_);
  std::swap(mapped_, other.mapped_);
  return *this;
}

MappedFile::~MappedFile() {
  if (base_ != nullptr) ::munmap(const_cast<char*>(base_), mapped_);
}

}  // namespace geotherm::io
