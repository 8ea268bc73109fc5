// SPDX-License-Identifier: MIT
#include "solver/mesh/io/gzip.h"

#include <zlib.h>

#include <algorithm>
#include <cstring>
#include <new>
#include <string>

#include "solver/mesh/io/input_file.h"

namespace geotherm::io {
namespace {

constexpr std::size_t kMaxAtOnce = std::size_t{1} << 30;  // zlib counts in 32 bits
// Meshes as text are packed to a tenth, flat ones to a fiftieth. What is small may be anything.
constexpr std::size_t kMaxTimes = 100, kAlways = std::size_t{256} << 20;

class Inflation {
 public:
  explicit Inflation(std::string_view packed) : left_(packed) {
    constexpr int kGzip = 16 + MAX_WBITS;
    if (inflateInit2(&stream_, kGzip) != Z_OK) throw std::bad_alloc();
  }
  Inflation(const Inflation&) = delete;
  Inflation& operator=(const Inflation&) = delete;
  ~Inflation() { inflateEnd(&stream_); }

  /// Unpacks until the room is filled or the stream ends; returns how many bytes it made.
  std::size_t make(char* to, std::size_t room) {
    stream_.next_in =
        reinterpret_cast<Bytef*>(const_cast<char*>(left_.data()));  // zlib's own const
    stream_.avail_in = static_cast<uInt>(std::min(kMaxAtOnce, left_.size()));
    stream_.next_out = reinterpret_cast<Bytef*>(to);
    stream_.avail_out = static_cast<uInt>(std::min(kMaxAtOnce, room));
    const uInt in = stream_.avail_in, out = stream_.avail_out;
    code_ = inflate(&stream_, Z_NO_FLUSH);
    left_.remove_prefix(in - stream_.avail_in);
    if (code_ == Z_MEM_ERROR) throw std::bad_alloc();
    return out - stream_.avail_out;
  }

  bool has_ended() const { return code_ == Z_STREAM_END; }
  bool is_stuck() const { return code_ != Z_OK && !has_ended(); }
  std::string_view left() const { return left_; }
  bool begin_next() { return is_gzip(left_) && inflateReset(&stream_) == Z_OK; }

 private:
  z_stream stream_{};
  std::string_view left_;
  int code_ = Z_OK;
};

}  // namespace

Unpacked unpack_gzip_stream(std::string_view packed, char* to, std::size_t room) {
  Inflation stream(packed);
  std::size_t made = 0;
  while (made < room && !stream.has_ended() && !stream.is_stuck()) {
    made += stream.make(to + made, room - made);
  }
  return {made, stream.has_ended()};
}

RawVector<char> unpack_gzip(std::string_view packed, std::size_t most, std::size_t padding) {
  const std::string sizes = std::to_string(packed.size()) + " compressed bytes";
  const std::size_t usual = std::max(kAlways, kMaxTimes * packed.size());
  const std::size_t limit = std::min(most, usual);
  Inflation stream(packed);
  RawVector<char> out;
  std::size_t made = 0;
  for (;;) {
    if (made + padding >= out.size()) {
      // One byte more than there may be, so that what is too much is seen.
      const std::size_t step = std::max<std::size_t>(4 * packed.size(), made / 2) + 1;
      out.resize(std::min(made + step, limit + 1) + padding);
    }
    made += stream.make(out.data() + made, out.size() - padding - made);
    if (made > limit) {
      throw ReadFailure{"its " + sizes + " unpack to more than " + std::to_string(limit) +
                            (most < usual ? " bytes, half of the memory that is free"
                                          : " bytes, more than a model does"),
                        0,
                        {},
                        {"unpack it and name the file that it makes"}};
    }
    if (stream.has_ended() && !stream.begin_next()) break;
    if (stream.is_stuck()) {
      throw ReadFailure{stream.left().empty() ? "its " + sizes + " end in the middle, after " +
                                                    std::to_string(made) + " unpacked ones"
                                              : "its " + sizes + " are damaged after " +
                                                    std::to_string(made) + " unpacked ones"};
    }
  }
  if (stream.left().find_first_not_of('\0') != std::string_view::npos) {
    throw ReadFailure{std::to_string(stream.left().size()) + " of its " + sizes +
                      " stand behind the end and are no gzip"};
  }
  out.resize(made + padding);
  std::memset(out.data() + made, 0, padding);
  return out;
}

}  // namespace geotherm::io
