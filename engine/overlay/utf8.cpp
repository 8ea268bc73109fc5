// SPDX-License-Identifier: MIT
#include "engine/overlay/utf8.h"

#include <cstddef>

namespace geotherm::engine {

char32_t take_letter(std::string_view& text) {
  const auto byte = [&](std::size_t i) -> char32_t { return static_cast<unsigned char>(text[i]); };
  const char32_t lead = byte(0);
  const std::size_t length = lead < 0x80           ? 1
                             : (lead >> 5) == 0x6  ? 2
                             : (lead >> 4) == 0xE  ? 3
                             : (lead >> 3) == 0x1E ? 4
                                                   : 0;
  char32_t letter = length <= 1 ? lead : lead & (0x7FU >> length);
  std::size_t used = 1;
  for (; used < length && used < text.size() && (byte(used) >> 6) == 0x2; ++used) {
    letter = (letter << 6) | (byte(used) & 0x3F);
  }
  text.remove_prefix(used);
  constexpr char32_t kSmallest[] = {0, 0, 0x80, 0x800, 0x10000};
  const bool surrogate = letter >= 0xD800 && letter < 0xE000;
  const bool good = used == length && letter >= kSmallest[length] && letter <= 0x10FFFF;
  return good && !surrogate ? letter : kMalformed;
}

}  // namespace geotherm::engine
