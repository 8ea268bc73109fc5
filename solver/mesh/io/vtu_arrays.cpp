// SPDX-License-Identifier: MIT
#include "solver/mesh/io/vtu_arrays.h"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <new>
#include <type_traits>

#include "solver/mesh/io/byte_order.h"
#include "solver/mesh/io/input_file.h"
#include "solver/mesh/io/text_scanner.h"

namespace geotherm::io {
namespace {

/// The value of a character in base64; -1: none.
int base64_digit(char c) {
  if (c >= 'A' && c <= 'Z') return c - 'A';
  if (c >= 'a' && c <= 'z') return c - 'a' + 26;
  if (c >= '0' && c <= '9') return c - '0' + 52;
  if (c == '+') return 62;
  return c == '/' ? 63 : -1;
}

/// The bytes of an array, one after the other, as they are or out of base64. Groups that are padded
/// may stand anywhere: VTK encodes the lengths of compressed blocks by themselves.
class ArrayBytes {
 public:
  ArrayBytes(std::string_view bytes, std::size_t place, bool base64)
      : bytes_(bytes), p_(bytes.data() + std::min(place, bytes.size())), base64_(base64) {}

  void take(char* to, std::size_t count) {
    if (!base64_) {
      if (count > left()) fail("the file ends in the array");
      std::memcpy(to, p_, count);
      p_ += count;
      return;
    }
    while (count > 0) {
      if (used_ == filled_) next_group();
      const std::size_t here = std::min(count, filled_ - used_);
      std::copy_n(group_.begin() + static_cast<std::ptrdiff_t>(used_), here, to);
      used_ += here;
      to += here;
      count -= here;
    }
  }

  /// At most so many bytes are still to come.
  std::size_t left() const {
    const auto characters = static_cast<std::size_t>(bytes_.data() + bytes_.size() - p_);
    return base64_ ? characters / 4 * 3 + 3 : characters;
  }

  /// All that is still to come, where it is base64.
  std::vector<char> rest() {
    std::vector<char> out;
    const char* const end = bytes_.data() + bytes_.size();
    for (;;) {
      while (p_ != end && (*p_ == ' ' || *p_ == '\n' || *p_ == '\r' || *p_ == '\t')) ++p_;
      if (p_ == end) return out;
      next_group();
      out.insert(out.end(), group_.begin(), group_.begin() + static_cast<std::ptrdiff_t>(filled_));
      used_ = filled_;
    }
  }

  [[noreturn]] void fail(const std::string& cause) const { fail_at_byte(bytes_, p_, cause); }

 private:
  void next_group() {
    std::uint32_t value = 0;
    std::size_t digits = 0, padding = 0;
    while (digits + padding < 4) {
      if (p_ == bytes_.data() + bytes_.size()) fail("the file ends in the array");
      const char c = *p_;
      const int digit = base64_digit(c);
      if (digit >= 0 && padding == 0) {
        value = value << 6 | static_cast<std::uint32_t>(digit);
        ++digits;
      } else if (c == '=' && digits >= 2) {
        value <<= 6;
        ++padding;
      } else if (c != ' ' && c != '\n' && c != '\r' && c != '\t') {
        fail(quoted(bytes_, p_) + " in an array is not base64, or the array is too short");
      }
      ++p_;
    }
    group_ = {static_cast<char>(value >> 16), static_cast<char>(value >> 8),
              static_cast<char>(value)};
    used_ = 0;
    filled_ = 3 - padding;
  }

  std::string_view bytes_;
  const char* p_;
  bool base64_;
  std::array<char, 3> group_{};
  std::size_t used_ = 0, filled_ = 0;
};

class VtuDecoder {
 public:
  VtuDecoder(ArrayBytes source, const VtuEncoding& encoding, const char* name)
      : source_(source), encoding_(encoding), name_(name) {}

  /// So many bytes, as the file has to have announced them.
  std::vector<char> decode(std::uint64_t expected) {
    if (!encoding_.compressed) return plain(expected);
    return encoding_.size_of_length == 0 ? unpacked_stream(expected) : inflated(expected);
  }

  [[noreturn]] void fail(const std::string& cause) const {
    source_.fail(cause + " in the array \"" + name_ + "\"");
  }

 private:
  std::uint64_t length() {
    char raw[8];
    source_.take(raw, encoding_.size_of_length);
    return encoding_.size_of_length == 4 ? load<std::uint32_t>(raw, encoding_.order)
                                         : load<std::uint64_t>(raw, encoding_.order);
  }

  [[noreturn]] void fail_by_size(std::uint64_t announced, std::uint64_t expected) const {
    fail(std::to_string(announced) + " bytes are announced instead of " + std::to_string(expected));
  }

  std::vector<char> plain(std::uint64_t expected) {
    const std::uint64_t announced = encoding_.size_of_length == 0 ? expected : length();
    if (announced != expected) fail_by_size(announced, expected);
    if (expected > source_.left()) fail("the file ends");
    std::vector<char> out(static_cast<std::size_t>(expected));
    source_.take(out.data(), out.size());
    return out;
  }

  std::vector<char> unpacked_stream(std::uint64_t expected) {
    const std::vector<char> packed = source_.rest();
    if (expected / kMaxTimes > packed.size()) fail("the file ends");
    std::vector<char> out(static_cast<std::size_t>(expected));
    auto unpacked = static_cast<uLongf>(out.size());
    const int code = ::uncompress(reinterpret_cast<Bytef*>(out.data()), &unpacked,
                                  reinterpret_cast<const Bytef*>(packed.data()), packed.size());
    if (code == Z_MEM_ERROR) throw std::bad_alloc();
    if (code != Z_OK || unpacked != expected) fail("what is compressed is damaged");
    return out;
  }

  /// In front stand the number of blocks, the size of each, that of the last one (0: as the
  /// others), all uncompressed, and the sizes of the compressed blocks.
  std::vector<char> inflated(std::uint64_t expected) {
    const std::uint64_t blocks = length(), size = length(), last = length();
    const std::uint64_t most = source_.left();
    if (blocks == 0 || size == 0 || last > size || blocks > most / encoding_.size_of_length ||
        blocks - 1 > expected / size || (blocks - 1) * size + (last ? last : size) != expected) {
      fail(std::to_string(blocks) + " blocks of " + std::to_string(size) + " bytes, the last of " +
           std::to_string(last) + ", are announced instead of " + std::to_string(expected) +
           " bytes");
    }
    if (expected / kMaxTimes > most) fail("the file ends");
    std::vector<std::uint64_t> lengths(static_cast<std::size_t>(blocks));
    for (std::uint64_t& each : lengths) each = length();
    std::vector<char> out(static_cast<std::size_t>(expected)), packed;
    std::size_t done = 0;
    for (const std::uint64_t packed_length : lengths) {
      if (packed_length > source_.left()) fail("the file ends");
      packed.resize(static_cast<std::size_t>(packed_length));
      source_.take(packed.data(), packed.size());
      const std::size_t whole = std::min<std::size_t>(size, out.size() - done);
      auto unpacked = static_cast<uLongf>(whole);
      const int code = ::uncompress(reinterpret_cast<Bytef*>(out.data() + done), &unpacked,
                                    reinterpret_cast<const Bytef*>(packed.data()), packed.size());
      if (code == Z_MEM_ERROR) throw std::bad_alloc();
      if (code != Z_OK || unpacked != whole) fail("a compressed block is damaged");
      done += whole;
    }
    return out;
  }

  static constexpr std::uint64_t kMaxTimes = 1100;  ///< no block of deflate unpacks to more

  ArrayBytes source_;
  const VtuEncoding& encoding_;
  const char* name_;
};

/// Numbers up to the next tag.
template <class T>
std::vector<T> read_text_array(std::string_view bytes, std::size_t place, const char* name,
                               std::int64_t count, bool finite) {
  TextScanner scanner(bytes.substr(0, bytes.find('<', place)), '\0', place);
  scanner.now_reading(name);
  const auto fail = [&](const std::string& what) {
    scanner.word();  // which is where it is wrong
    scanner.fail("there are to be " + std::to_string(count) + " numbers, but " + what);
  };
  const std::size_t most = (scanner.bytes_left() + 1) / 2;
  if (static_cast<std::uint64_t>(count) > most) {
    fail("only " + std::to_string(scanner.bytes_left()) + " bytes follow");
  }
  std::vector<T> values(static_cast<std::size_t>(count));
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (scanner.at_end()) fail("only " + std::to_string(i) + " follow");
    if constexpr (std::is_floating_point_v<T>) {
      values[i] = finite ? scanner.coordinate() : scanner.number();
    } else {
      values[i] = scanner.integer();
    }
  }
  return values;
}

template <class T>
std::vector<T> read_vtu_array(std::string_view bytes, const VtuEncoding& encoding,
                              const VtuArray& array, const char* name, std::int64_t count,
                              bool finite) {
  std::vector<T> values;
  const auto size = static_cast<std::uint64_t>(count);
  if (array.format == VtuArray::Format::kText) {
    return read_text_array<T>(bytes, static_cast<std::size_t>(array.place), name, count, finite);
  }
  const bool appended = array.format == VtuArray::Format::kAppended;
  const std::size_t start = appended ? encoding.appended : 0;
  const bool beyond = array.place > bytes.size() - start;
  ArrayBytes source(bytes, beyond ? bytes.size() : start + static_cast<std::size_t>(array.place),
                    !appended || encoding.appended_base64);
  VtuDecoder decoder(source, encoding, name);
  if (appended && encoding.appended == 0) decoder.fail("no appended data follow");
  if (beyond) decoder.fail("the file ends");
  const std::vector<char> raw = decoder.decode(size * size_of(array.type));
  values.reserve(static_cast<std::size_t>(size));
  for_each_number({raw.data(), raw.size()}, size, array.type, encoding.order, [&](auto value) {
    if constexpr (std::is_floating_point_v<T>) {
      if (finite && !std::isfinite(static_cast<double>(value)))
        decoder.fail("a number is not finite");
    }
    values.push_back(static_cast<T>(value));
  });
  return values;
}

}  // namespace

std::vector<double> read_vtu_reals(std::string_view bytes, const VtuEncoding& encoding,
                                   const VtuArray& array, const char* name, std::int64_t count,
                                   bool finite) {
  return read_vtu_array<double>(bytes, encoding, array, name, count, finite);
}

std::vector<std::int64_t> read_vtu_integers(std::string_view bytes, const VtuEncoding& encoding,
                                            const VtuArray& array, const char* name,
                                            std::int64_t count) {
  if (!is_whole(array.type)) {
    throw ReadFailure{std::string("the array \"") + name + "\" has no whole numbers"};
  }
  return read_vtu_array<std::int64_t>(bytes, encoding, array, name, count, true);
}

}  // namespace geotherm::io
