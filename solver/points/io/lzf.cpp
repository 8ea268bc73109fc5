// SPDX-License-Identifier: MIT
#include "solver/points/io/lzf.h"

namespace geotherm::io {

std::vector<char> unpack_lzf(std::string_view packed, std::size_t size, std::size_t padding) {
  std::vector<char> out(size + padding, '\0');
  std::size_t from = 0, to = 0;
  const auto byte = [&](std::size_t at) { return static_cast<unsigned char>(packed[at]); };
  while (from < packed.size()) {
    const std::size_t control = byte(from++);
    if (control < 32) {
      const std::size_t length = control + 1;
      if (length > packed.size() - from || length > size - to) return {};
      packed.copy(out.data() + to, length, from);
      from += length;
      to += length;
      continue;
    }
    constexpr std::size_t kLong = 7, kMin = 2;
    std::size_t length = control >> 5;
    if (length == kLong) {
      if (from == packed.size()) return {};
      length += byte(from++);
    }
    length += kMin;
    if (from == packed.size()) return {};
    const std::size_t distance = ((control & 31) << 8) + byte(from++) + 1;
    if (distance > to || length > size - to) return {};
    // One by one: what is repeated may reach into what is written.
    for (std::size_t k = 0; k < length; ++k, ++to) out[to] = out[to - distance];
  }
  if (to != size) return {};
  return out;
}

}  // namespace geotherm::io
