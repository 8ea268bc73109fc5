// SPDX-License-Identifier: MIT
#include "solver/mesh/io/frame_array.h"

#include <algorithm>
#include <string>

#include "solver/mesh/io/byte_order.h"
#include "solver/mesh/io/npy_header.h"

namespace geotherm::io {
namespace {

/// The first bytes of a file, at most `most`, with the padding that scanners need.
class FileStart {
 public:
  FileStart(const InputFile& file, std::size_t most) : size_(std::min(most, file.size())) {
    buffer_.resize(size_ + FileBytes::kPadding);
    file.read(buffer_.data(), size_, 0);
  }

  std::string_view bytes() const { return std::string_view(buffer_).substr(0, size_); }

 private:
  std::size_t size_;
  std::string buffer_;
};

std::string shape_in_words(const std::vector<std::int64_t>& shape) {
  constexpr std::size_t kShown = 4;
  if (shape.empty() || shape.size() > kShown) {
    return "of " + std::to_string(shape.size()) + " dimensions";
  }
  std::string text;
  for (const std::int64_t length : shape) {
    text += (text.empty() ? "" : " x ") + std::to_string(length);
  }
  return text;
}

FrameArray npy_frames(const InputFile& file) {
  constexpr std::size_t kMaxHeader = std::size_t{1} << 20;
  const FileStart start(file, kMaxHeader);
  const std::string_view bytes = start.bytes();
  const NpyHeader header = read_npy_header(bytes);
  if (header.type != "f4" && header.type != "f8") {
    const char* const at = bytes.data() + header.type_place;
    fail_at_byte(bytes, at, "positions are float32 or float64 numbers, not " + quoted(bytes, at),
                 {"save them with astype('f4') or astype('f8')"});
  }
  if (header.shape.size() != 3 || header.shape[2] != 3) {
    fail_at_byte(bytes, bytes.data() + header.shape_place,
                 "the array is " + shape_in_words(header.shape) +
                     ", and positions are frames x vertices x 3");
  }
  if (header.fortran) {
    throw ReadFailure{"the first axis runs fastest (fortran_order), and frames are to lie together",
                      0,
                      {},
                      {"save it with numpy.ascontiguousarray"}};
  }
  return {header.shape[0], header.shape[1], header.type == "f8", header.order, header.begins};
}

FrameArray pc2_frames(const InputFile& file) {
  constexpr std::string_view kMagic("POINTCACHE2\0", 12);
  constexpr std::size_t kHeader = 32;
  constexpr std::int32_t kVersion = 1;
  const FileStart start(file, kHeader);
  const std::string_view bytes = start.bytes();
  if (!bytes.starts_with(kMagic)) {
    fail_at_byte(bytes, bytes.data(), "a point cache starts with the word POINTCACHE2");
  }
  if (bytes.size() < kHeader) throw ReadFailure{"the file ends in its header of 32 bytes"};
  const auto number = [&](std::size_t at) {
    return load<std::int32_t>(bytes.data() + at, std::endian::little);
  };
  if (number(12) != kVersion) {
    fail_at_byte(bytes, bytes.data() + 12,
                 "version " + std::to_string(number(12)) + " is unknown; there is 1");
  }
  return {number(28), number(16), false, std::endian::little, kHeader};
}

FrameArray mdd_frames(const InputFile& file) {
  constexpr std::size_t kCounts = 8;
  const FileStart start(file, kCounts);
  const std::string_view bytes = start.bytes();
  if (bytes.size() < kCounts) throw ReadFailure{"the file ends in its header of 8 bytes"};
  const auto number = [&](std::size_t at) {
    return std::int64_t{load<std::int32_t>(bytes.data() + at, std::endian::big)};
  };
  // A time stands there for each frame before the positions.
  const std::int64_t frames = number(0);
  return {frames, number(4), false, std::endian::big,
          kCounts + static_cast<std::uint64_t>(std::max<std::int64_t>(frames, 0)) * sizeof(float)};
}

template <class Number>
std::vector<Vec3> decoded(const std::string& bytes, std::size_t count, std::endian order) {
  std::vector<Vec3> positions;
  positions.reserve(count);
  const char* p = bytes.data();
  const auto next = [&] {
    const auto value = static_cast<double>(load<Number>(p, order));
    p += sizeof(Number);
    return value;
  };
  for (std::size_t v = 0; v < count; ++v) {
    const double x = next(), y = next(), z = next();
    positions.emplace_back(x, y, z);
  }
  return positions;
}

}  // namespace

bool is_frame_array(std::string_view extension) {
  return extension == ".npy" || extension == ".pc2" || extension == ".mdd";
}

FrameArray read_frame_array(const InputFile& file, std::string_view extension) {
  const FrameArray array = extension == ".npy"   ? npy_frames(file)
                           : extension == ".pc2" ? pc2_frames(file)
                                                 : mdd_frames(file);
  if (array.frames <= 0 || array.vertices <= 0) {
    throw ReadFailure{"the header announces " + std::to_string(array.frames) + " frames of " +
                      std::to_string(array.vertices) + " vertices"};
  }
  // 2^58 vertices are more than any file holds, and their bytes can still be counted.
  const bool countable = array.vertices < std::int64_t{1} << 58;
  const std::uint64_t room = file.size() - std::min<std::uint64_t>(file.size(), array.begins);
  const std::uint64_t whole = countable ? room / array.frame_bytes() : 0;
  const auto wanted = static_cast<std::uint64_t>(array.frames);
  if (whole == wanted && room % array.frame_bytes() == 0) return array;
  const std::string announced = "the header announces " + std::to_string(array.frames) +
                                " frames of " + std::to_string(array.vertices) + " vertices, and " +
                                std::to_string(room) + " bytes follow, ";
  if (whole < wanted) {
    throw ReadFailure{
        announced + "which are " + std::to_string(whole) + " whole frames: the file was cut short",
        0,
        {},
        {"export it again"}};
  }
  throw ReadFailure{
      announced + "which are more: the header does not fit the file", 0, {}, {"export it again"}};
}

std::vector<Vec3> read_frame(const InputFile& file, const FrameArray& array, std::int64_t k) {
  const auto frame_bytes = static_cast<std::size_t>(array.frame_bytes());
  std::string bytes(frame_bytes, '\0');
  file.read(bytes.data(), frame_bytes,
            static_cast<std::size_t>(array.begins) + static_cast<std::size_t>(k) * frame_bytes);
  const auto count = static_cast<std::size_t>(array.vertices);
  return array.doubles ? decoded<double>(bytes, count, array.order)
                       : decoded<float>(bytes, count, array.order);
}

}  // namespace geotherm::io
