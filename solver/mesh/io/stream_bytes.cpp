// SPDX-License-Identifier: MIT
#include "solver/mesh/io/stream_bytes.h"

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <limits>
#include <new>
#include <stdexcept>
#include <system_error>

#include "solver/core/free_memory.h"
#include "solver/mesh/io/file_bytes.h"

namespace geotherm::io {
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
