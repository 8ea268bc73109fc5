// SPDX-License-Identifier: MIT
#include "engine/overlay/text_fit.h"

#include <algorithm>

#include "engine/overlay/utf8.h"

namespace geotherm::engine {
namespace {

std::string_view trimmed(std::string_view text) {
  const std::size_t begin = std::min(text.find_first_not_of(' '), text.size());
  text.remove_prefix(begin);
  return text.substr(0, text.find_last_not_of(' ') + 1);
}

}  // namespace

std::string cut_to_width(const GlyphAtlas& atlas, std::string_view text, float width) {
  text = trimmed(text);
  const float room = width - atlas.width_of(kEllipsis);
  float used = 0;
  std::size_t kept = 0;  // bytes of the letters that leave room for the ellipsis
  for (std::string_view rest = text; !rest.empty();) {
    used += atlas.glyph(take_letter(rest)).advance;
    if (used <= room) kept = text.size() - rest.size();
  }
  if (used <= width) return std::string(text);
  if (room < 0) return {};
  return std::string(trimmed(text.substr(0, kept))) + std::string(kEllipsis);
}

std::vector<std::string> wrapped_lines(const GlyphAtlas& atlas, std::string_view text, float width,
                                       std::size_t most) {
  std::vector<std::string> lines;
  std::string_view rest = trimmed(text);
  while (!rest.empty() && lines.size() < most) {
    std::size_t end = rest.size();
    while (lines.size() + 1 < most && atlas.width_of(rest.substr(0, end)) > width) {
      const std::size_t blank = trimmed(rest.substr(0, end)).find_last_of(' ');
      if (blank == std::string_view::npos) break;
      end = blank;
    }
    lines.push_back(cut_to_width(atlas, rest.substr(0, end), width));
    rest = trimmed(rest.substr(end));
  }
  return lines;
}

}  // namespace geotherm::engine
