// SPDX-License-Identifier: MIT
#include <string>

#include "solver/mesh/io/input_file.h"
#include "solver/mesh/io/raw_mesh.h"
#include "solver/mesh/io/text_scanner.h"

namespace geotherm::io {
namespace {

/// Takes the first word. Colours, normals and texture coordinates (C, N, ST) stand behind the
/// position in a vertex's line and are skipped with the rest of it; without the word the counts
/// come first.
void read_keyword(TextScanner& scanner) {
  const std::string_view word = scanner.peek();
  if (!word.empty() && (word.find_first_not_of("+-0123456789") == word.npos)) return;
  scanner.word();
  if (word == "4OFF" || word == "nOFF" || word == "4nOFF") {
    scanner.fail("the format " + std::string(word) + " has points that are not in 3 dimensions");
  }
  if (word != "OFF" && word != "COFF" && word != "NOFF" && word != "CNOFF" && word != "NCOFF" &&
      word != "STOFF" && word != "STCOFF" && word != "STNOFF" && word != "STCNOFF") {
    scanner.fail("an OFF file starts with the word OFF");
  }
  if (scanner.peek() == "BINARY") scanner.fail("binary OFF is not supported", {"save it as text"});
}

std::size_t read_count(TextScanner& scanner, const char* things, std::size_t bytes_each) {
  const std::int64_t count = scanner.integer();
  return checked_count(scanner, count, things, (scanner.bytes_left() + 1) / bytes_each,
                       "the header announces ");
}

}  // namespace

RawMesh read_off(std::string_view text) {
  TextScanner scanner(text, '#');
  scanner.now_reading("the header");
  read_keyword(scanner);
  const std::size_t vertex_count = read_count(scanner, "vertices", 6);  // "0 0 0\n"
  const std::size_t face_count = read_count(scanner, "faces", 2);       // "0\n"
  scanner.skip_line();                                                  // the number of edges

  RawMesh mesh;
  mesh.positions.resize(vertex_count);
  mesh.faces.reserve(face_count);
  for (std::size_t v = 0; v < vertex_count; ++v) {
    scanner.now_reading("vertex", static_cast<std::int64_t>(v) + 1,
                        static_cast<std::int64_t>(vertex_count));
    for (int axis = 0; axis < 3; ++axis) mesh.positions[v][axis] = scanner.coordinate();
    scanner.skip_line();
  }
  FanBuilder fan(mesh.faces);
  for (std::size_t f = 0; f < face_count; ++f) {
    scanner.now_reading("face", static_cast<std::int64_t>(f) + 1,
                        static_cast<std::int64_t>(face_count));
    const std::int64_t corner_count = scanner.integer();
    if (corner_count < 0 || static_cast<std::uint64_t>(corner_count) > scanner.bytes_left()) {
      scanner.fail("a face cannot have " + std::to_string(corner_count) + " corners");
    }
    for (std::int64_t k = 0; k < corner_count; ++k) {
      const std::int64_t corner = scanner.integer();
      if (corner < 0 || static_cast<std::uint64_t>(corner) >= vertex_count) {
        scanner.fail("vertex " + std::to_string(corner) + " is used, but the file has " +
                     std::to_string(vertex_count) + " vertices (0 to " +
                     std::to_string(static_cast<std::int64_t>(vertex_count) - 1) + ")");
      }
      fan.add(static_cast<Index>(corner));
    }
    fan.end(mesh.polygons);
    scanner.skip_line();  // a colour
  }
  note_left_out(fan.left_out(), mesh.notes);
  if (!scanner.at_end()) {
    mesh.notes.emplace_back("what follows the last face in the file was ignored");
  }
  return mesh;
}

}  // namespace geotherm::io
