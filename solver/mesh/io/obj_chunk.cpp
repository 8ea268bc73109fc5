// SPDX-License-Identifier: MIT
#include "solver/mesh/io/obj_chunk.h"

#include <cmath>
#include <cstring>
#include <string>

#include "solver/mesh/io/input_file.h"
#include "solver/mesh/io/text_scanner.h"

namespace geotherm::io {
namespace {

bool is_blank(char c) { return c == ' ' || c == '\t'; }

/// Blanks, and a backslash that continues the line.
const char* skip_blanks(const char* p) {
  for (;;) {
    while (is_blank(*p)) ++p;
    if (*p != '\\') [[likely]]
      return p;
    const char* const next = p + (p[1] == '\r' ? 2 : 1);
    if (*next != '\n') return p;
    p = next + 1;
  }
}

/// The start of the next line, or `end`.
const char* next_line(const char* p, const char* end) {
  const void* const found = std::memchr(p, '\n', static_cast<std::size_t>(end - p));
  return found == nullptr ? end : static_cast<const char*>(found) + 1;
}

/// May follow a number: white space, the end, a comment, a line that goes on.
bool ends_word(char c) { return static_cast<unsigned char>(c) <= ' ' || c == '#' || c == '\\'; }

bool ends_line(char c) { return c == '\n' || c == '\r' || c == '#'; }

/// Over "/texture/normal" behind a corner, which must be whole numbers or absent.
const char* skip_attributes(const char* p) {
  while (*p == '/') {
    ++p;
    if (*p == '-') ++p;
    int count;
    do {
      count = read_digits(p).count;
      p += count;
    } while (count == 8);
  }
  return p;
}

}  // namespace

const char* ObjChunk::parse_until(std::size_t face) {
  positions.clear();
  faces.clear();
  polygons.clear();
  left_out = 0;
  // A guess at the numbers of lines: most files need no more, and pages not used cost nothing.
  positions.reserve(text.size() / 24 + 1);
  faces.reserve(text.size() / 18 + 1);
  const char* p = text.data();
  while (p < end()) {
    while (is_blank(*p)) ++p;
    if (*p == 'v' && ends_word(p[1])) {
      p = parse_vertex(p + 1);
    } else if (*p == 'f' && ends_word(p[1])) {
      const char* const line = p;
      p = parse_face(p + 1);
      if (faces.size() > face) return line;
    }
    if (*p != '\n') [[unlikely]] {
      p = next_line(p, end());
    } else {
      ++p;
    }
  }
  return end();
}

const char* ObjChunk::parse_vertex(const char* p) {
  Vec3 position;
  for (int axis = 0; axis < 3; ++axis) {
    const char* const start = skip_blanks(p);
    p = parse_double(start, position[axis]);
    if (p == nullptr || !ends_word(*p)) [[unlikely]] {
      fail_at_line(text, start,
                   ends_line(*start) || start == end()
                       ? "a vertex has " + std::to_string(axis) + " coordinates instead of 3"
                       : quoted(text, start) + " is not a number (a vertex needs 3)");
    }
    if (!std::isfinite(position[axis])) [[unlikely]] {
      fail_at_line(text, start, "the coordinate " + quoted(text, start) + " is not finite");
    }
  }
  positions.push_back(position);
  return p;  // a weight or colours may follow
}

const char* ObjChunk::parse_face(const char* p) {
  FanBuilder fan(faces);
  for (p = skip_blanks(p); !ends_line(*p) && p < end(); p = skip_blanks(p)) {
    // The usual case here, in registers: a positive number of at most 7 digits.
    const Digits digits = read_digits(p);
    const char* after = p + digits.count;
    if (*after == '/') after = skip_attributes(after);
    if (digits.count < 8 && digits.value > 0 && ends_word(*after)) [[likely]] {
      fan.add(static_cast<Index>(digits.value - 1));
      p = after;
    } else {
      fan.add(parse_corner(p));
    }
  }
  fan.end(polygons);
  left_out += fan.left_out();
  return p;
}

Index ObjChunk::parse_corner(const char*& p) {
  const char* const start = p;
  std::int64_t written = 0;
  p = parse_integer(p, written);
  if (p != nullptr && *p == '/') p = skip_attributes(p);
  if (p == nullptr || !ends_word(*p)) [[unlikely]] {
    fail_at_line(text, start,
                 quoted(text, start) + " is not a corner of a face (v, v/vt, v//vn, v/vt/vn)");
  }
  if (written == 0) {
    fail_at_line(text, start, "a face uses vertex 0, but OBJ counts vertices from 1");
  }
  constexpr std::int64_t kMax = std::numeric_limits<Index>::max();
  if (written > kMax || written < -kMax) [[unlikely]] {
    fail_at_line(text, start,
                 "a face uses vertex " + std::to_string(written) + ", but at most " +
                     std::to_string(kMax) + " vertices are supported");
  }
  if (written < 0) return relative_corner(start, written);
  return static_cast<Index>(written - 1);
}

Index ObjChunk::relative_corner(const char* where, std::int64_t written) {
  if (vertex_base == kUnknown) {
    needs_base = true;
    return 0;
  }
  const std::int64_t seen = vertex_base + static_cast<std::int64_t>(positions.size());
  if (seen + written < 0) {
    fail_at_line(text, where,
                 "a face uses vertex " + std::to_string(written) + ", but only " +
                     std::to_string(seen) + " vertices stand before it");
  }
  return static_cast<Index>(seen + written);
}

}  // namespace geotherm::io
