// SPDX-License-Identifier: MIT
// Medit's .mesh (text) and .meshb (binary): keywords, each with a count and rows (Frey 2001).
#include <bit>
#include <cmath>
#include <string>

#include "solver/mesh/io/byte_order.h"
#include "solver/mesh/io/input_file.h"
#include "solver/mesh/io/raw_elements.h"
#include "solver/mesh/io/text_scanner.h"

namespace geotherm::io {
namespace {

/// Elements that are no tets, by their keyword in text and their number in binary.
struct MeditKind {
  std::string_view keyword;
  std::int32_t code;
  const char* name;
  std::size_t face_corners = 0;  ///< of faces
};
constexpr MeditKind kMeditKinds[] = {
    {"Edges", 5, "edges"},
    {"Triangles", 6, "triangles", 3},
    {"Quadrilaterals", 7, "quads", 4},
    {"TetrahedraP2", 30, "tetrahedra with 10 corners"},
    {"Prisms", 9, "prisms"},
    {"Hexahedra", 10, "hexahedra"},
    {"Pyramids", 49, "pyramids"},
};

bool starts_keyword(std::string_view word) {
  if (word.empty()) return false;
  const char c = word.front();
  return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z');
}

/// The numbers of a .mesh file, each of which takes two bytes at least.
struct MeditScanner : TextScanner {
  using TextScanner::TextScanner;

  std::int64_t count(const char* things, std::size_t numbers_each) {
    const std::int64_t count = integer();
    checked_count(*this, count, things, (bytes_left() + 1) / (2 * numbers_each));
    return count;
  }
  void skip_region() { number(); }
};

// What follows reads by a MeditScanner or a MeshbScanner. Behind the numbers of each vertex and of
// each element stands that of its region.

template <class Scanner>
void read_medit_vertices(Scanner& scanner, RawElements& raw) {
  const std::int64_t count = scanner.count("vertices", 4);
  raw.positions.resize(static_cast<std::size_t>(count));
  for (std::int64_t v = 0; v < count; ++v) {
    scanner.now_reading("vertex", v + 1, count);
    for (int axis = 0; axis < 3; ++axis) {
      raw.positions[static_cast<std::size_t>(v)][axis] = scanner.coordinate();
    }
    scanner.skip_region();
  }
}

template <class Scanner>
Index medit_corner(Scanner& scanner, const RawElements& raw) {
  const std::int64_t number = scanner.integer();
  if (number < 1 || static_cast<std::uint64_t>(number) > raw.positions.size()) {
    scanner.fail("vertex " + std::to_string(number) + " is used, but the file has " +
                 std::to_string(raw.positions.size()) + " vertices, counted from 1, before it");
  }
  return static_cast<Index>(number - 1);
}

template <class Scanner>
void read_medit_tets(Scanner& scanner, RawElements& raw) {
  const std::int64_t count = scanner.count("tetrahedra", 5);
  raw.tets.reserve(static_cast<std::size_t>(count));
  for (std::int64_t t = 0; t < count; ++t) {
    scanner.now_reading("tetrahedron", t + 1, count);
    auto& tet = raw.tets.emplace_back();
    for (Index& corner : tet) corner = medit_corner(scanner, raw);
    scanner.skip_region();
  }
}

template <class Scanner>
void read_medit_faces(Scanner& scanner, const MeditKind& kind, RawElements& raw) {
  const std::int64_t count = scanner.count(kind.name, kind.face_corners + 1);
  raw.others[kind.name] += count;
  FanBuilder fan(raw.faces);
  for (std::int64_t f = 0; f < count; ++f) {
    scanner.now_reading("face", f + 1, count);
    for (std::size_t k = 0; k < kind.face_corners; ++k) fan.add(medit_corner(scanner, raw));
    fan.end(raw.polygons);
    scanner.skip_region();
  }
}

/// Vertices and tets once each: the numbers of the corners count one list alone.
void check_once(bool empty, const char* keyword, TextScanner& scanner) {
  if (!empty) scanner.fail(std::string("there is a second list ") + keyword);
}

}  // namespace

RawElements read_medit(std::string_view text) {
  MeditScanner scanner(text, '#');
  scanner.now_reading("the header");
  if (scanner.word() != "MeshVersionFormatted") {
    scanner.fail("a Medit file starts with the word MeshVersionFormatted");
  }
  scanner.integer();
  RawElements raw;
  while (!scanner.at_end()) {
    scanner.now_reading("the list of keywords");
    const std::string keyword(scanner.word());
    if (!starts_keyword(keyword)) {
      scanner.fail(quoted(keyword, keyword.data()) + " stands where a keyword should be");
    }
    if (keyword == "End") break;
    if (keyword == "Dimension") {
      if (scanner.integer() != 3) scanner.fail("the vertices are not in 3 dimensions");
    } else if (keyword == "Vertices") {
      check_once(raw.positions.empty(), "Vertices", scanner);
      read_medit_vertices(scanner, raw);
    } else if (keyword == "Tetrahedra") {
      check_once(raw.tets.empty(), "Tetrahedra", scanner);
      read_medit_tets(scanner, raw);
    } else {
      for (const MeditKind& kind : kMeditKinds) {
        if (keyword != kind.keyword) continue;
        if (kind.face_corners > 0) {
          read_medit_faces(scanner, kind, raw);
        } else {
          raw.others[kind.name] += scanner.count(kind.name, 1);
        }
      }
      while (!scanner.at_end() && !starts_keyword(scanner.peek())) scanner.word();
    }
  }
  return raw;
}

namespace {

/// The numbers of a .meshb file. Version 1 has floats, 2 doubles, 3 large positions of keywords, 4
/// large numbers of vertices as well.
class MeshbScanner {
 public:
  explicit MeshbScanner(std::string_view bytes) : bytes_(bytes), p_(bytes.data()), last_(p_) {
    const auto code = take<std::int32_t>();
    if (code == std::int32_t{16777216}) {  // 1 with its bytes turned round
      order_ = std::endian::native == std::endian::little ? std::endian::big : std::endian::little;
    } else if (code != 1) {
      fail("a binary Medit file starts with the number 1");
    }
    version_ = take<std::int32_t>();
    if (version_ < 1 || version_ > 4) {
      fail("the version " + std::to_string(version_) + " is not one of 1 to 4");
    }
  }

  std::int32_t keyword() { return take<std::int32_t>(); }
  std::int64_t position() { return version_ < 3 ? take<std::int32_t>() : take<std::int64_t>(); }
  std::int64_t integer() { return version_ < 4 ? take<std::int32_t>() : take<std::int64_t>(); }

  void skip_region() { integer(); }
  void now_reading(const char* /*thing*/, std::int64_t /*number*/, std::int64_t /*count*/) {}

  double coordinate() {
    const double value = version_ == 1 ? double{take<float>()} : take<double>();
    if (!std::isfinite(value)) fail("a coordinate is not finite");
    return value;
  }

  std::int64_t count(const char* things, std::size_t numbers_each) {
    const std::int64_t count = integer();
    checked_count(*this, count, things, bytes_left() / (4 * numbers_each));
    return count;
  }

  /// Goes on reading at the byte at which the next keyword stands.
  void go_to(std::int64_t position) {
    if (position < p_ - bytes_.data() || static_cast<std::uint64_t>(position) > bytes_.size()) {
      fail("the next keyword is to stand at byte " + std::to_string(position));
    }
    p_ = bytes_.data() + position;
  }

  std::size_t bytes_left() const {
    return static_cast<std::size_t>(bytes_.data() + bytes_.size() - p_);
  }

  [[noreturn]] void fail(const std::string& cause) const { fail_at_byte(bytes_, last_, cause); }

 private:
  template <class T>
  T take() {
    last_ = p_;
    if (bytes_left() < sizeof(T)) fail("the file ends");
    p_ += sizeof(T);
    return load<T>(last_, order_);
  }

  std::string_view bytes_;
  const char* p_;
  const char* last_;
  std::endian order_ = std::endian::native;
  std::int32_t version_ = 1;
};

}  // namespace

RawElements read_meshb(std::string_view bytes) {
  constexpr std::int32_t kDimension = 3, kVertices = 4, kTetrahedra = 8, kEnd = 54;
  MeshbScanner scanner(bytes);
  RawElements raw;
  while (scanner.bytes_left() > 0) {
    const std::int32_t keyword = scanner.keyword();
    if (keyword == kEnd) break;
    const std::int64_t next = scanner.position();
    if (keyword == kDimension) {
      if (scanner.keyword() != 3) scanner.fail("the vertices are not in 3 dimensions");
    } else if (keyword == kVertices || keyword == kTetrahedra) {
      if (!(keyword == kVertices ? raw.positions.empty() : raw.tets.empty())) {
        scanner.fail("there is a second list of the same kind");
      }
      keyword == kVertices ? read_medit_vertices(scanner, raw) : read_medit_tets(scanner, raw);
    } else {
      for (const MeditKind& kind : kMeditKinds) {
        if (keyword != kind.code) continue;
        if (kind.face_corners > 0) {
          read_medit_faces(scanner, kind, raw);
        } else {
          raw.others[kind.name] += scanner.count(kind.name, 2);
        }
      }
    }
    if (next == 0) break;  // the last one
    scanner.go_to(next);
  }
  return raw;
}

}  // namespace geotherm::io
