// SPDX-License-Identifier: MIT
// Geomview's OFF, text and binary (big endian; http://www.geomview.org/docs/html/OFF.html).
#include <bit>
#include <cstdint>
#include <string>

#include "solver/mesh/io/mixed_scanner.h"
#include "solver/mesh/io/raw_mesh.h"

namespace geotherm::io {
namespace {

/// Takes the first word; returns how many numbers stand behind the position of a vertex: colours,
/// normals and texture coordinates (C, N, ST). Without the word the counts come first.
std::int64_t read_keyword(MixedScanner& scanner) {
  TextScanner& words = scanner.words();
  const std::string_view word = words.peek();
  if (!word.empty() && (word.find_first_not_of("+-0123456789") == word.npos)) return 0;
  words.word();
  if (word == "4OFF" || word == "nOFF" || word == "4nOFF") {
    words.fail("the format " + std::string(word) + " has points that are not in 3 dimensions");
  }
  if (word != "OFF" && word != "COFF" && word != "NOFF" && word != "CNOFF" && word != "NCOFF" &&
      word != "STOFF" && word != "STCOFF" && word != "STNOFF" && word != "STCNOFF") {
    words.fail("an OFF file starts with the word OFF");
  }
  if (words.peek() == "BINARY") {
    scanner.be_binary(std::endian::big);
    scanner.begin_values();
  }
  const auto has = [word](const char* what) { return word.find(what) != word.npos; };
  return (has("C") ? 4 : 0) + (has("N") ? 3 : 0) + (has("ST") ? 2 : 0);
}

std::size_t read_count(MixedScanner& scanner, const char* things, std::size_t bytes_each) {
  const std::int64_t count = scanner.integer<std::int32_t>();
  return checked_count(scanner, count, things, (scanner.bytes_left() + 1) / bytes_each,
                       "the header announces ");
}

/// Behind what is read of a line; in binary there are so many numbers of 4 bytes.
void skip_rest(MixedScanner& scanner, std::int64_t numbers) {
  if (scanner.is_binary()) return scanner.skip<float>(numbers);
  scanner.words().skip_line();
}

}  // namespace

RawMesh read_off(std::string_view text) {
  MixedScanner scanner(text, '#');
  scanner.now_reading("the header");
  const std::int64_t beside = read_keyword(scanner);
  const bool binary = scanner.is_binary();
  const std::size_t vertex_count = read_count(scanner, "vertices", binary ? 12 : 6);  // "0 0 0\n"
  const std::size_t face_count = read_count(scanner, "faces", binary ? 8 : 2);        // "0\n"
  skip_rest(scanner, 1);  // the number of edges

  RawMesh mesh;
  mesh.positions.resize(vertex_count);
  mesh.faces.reserve(face_count);
  for (std::size_t v = 0; v < vertex_count; ++v) {
    scanner.now_reading("vertex", static_cast<std::int64_t>(v) + 1,
                        static_cast<std::int64_t>(vertex_count));
    for (int axis = 0; axis < 3; ++axis) mesh.positions[v][axis] = scanner.coordinate<float>();
    skip_rest(scanner, beside);
  }
  FanBuilder fan(mesh.faces);
  for (std::size_t f = 0; f < face_count; ++f) {
    scanner.now_reading("face", static_cast<std::int64_t>(f) + 1,
                        static_cast<std::int64_t>(face_count));
    const std::int64_t corner_count = scanner.integer<std::int32_t>();
    if (corner_count < 0 || static_cast<std::uint64_t>(corner_count) > scanner.bytes_left()) {
      scanner.fail("a face cannot have " + std::to_string(corner_count) + " corners");
    }
    for (std::int64_t k = 0; k < corner_count; ++k) {
      const std::int64_t corner = scanner.integer<std::int32_t>();
      if (corner < 0 || static_cast<std::uint64_t>(corner) >= vertex_count) {
        scanner.fail("vertex " + std::to_string(corner) + " is used, but the file has " +
                     std::to_string(vertex_count) + " vertices (0 to " +
                     std::to_string(static_cast<std::int64_t>(vertex_count) - 1) + ")");
      }
      fan.add(static_cast<Index>(corner));
    }
    fan.end(mesh.polygons);
    skip_rest(scanner, binary ? scanner.integer<std::int32_t>() : 0);  // a colour
  }
  note_left_out(fan.left_out(), mesh.notes);
  if (binary ? scanner.bytes_left() > 0 : !scanner.words().at_end()) {
    mesh.notes.emplace_back("what follows the last face in the file was ignored");
  }
  return mesh;
}

}  // namespace geotherm::io
