// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cstdint>
#include <exception>
#include <string>
#include <vector>

#include "solver/mesh/io/obj_chunk.h"
#include "solver/mesh/io/parallel.h"
#include "solver/mesh/io/read_failure.h"
#include "solver/mesh/io/readers.h"

namespace geotherm::io {
namespace {

constexpr std::size_t kChunkBytes = std::size_t{1} << 20;

/// The first start of a line at or after `p` that does not continue the line before it.
const char* line_start(const char* p, const char* first, const char* end) {
  for (; p < end; ++p) {
    if (p[-1] != '\n') continue;
    const char* last = p - 2;  // the character before the line's end
    if (last >= first && *last == '\r') --last;
    if (last < first || *last != '\\') return p;
  }
  return end;
}

std::vector<ObjChunk> split(std::string_view text) {
  std::vector<ObjChunk> chunks;
  const char* const end = text.data() + text.size();
  const bool has_mark = text.starts_with("\xef\xbb\xbf");  // a byte order mark some editors write
  for (const char* p = text.data() + (has_mark ? 3 : 0); p < end;) {
    ObjChunk chunk;
    chunk.text = text;
    chunk.begin = p;
    const bool is_last = static_cast<std::size_t>(end - p) <= kChunkBytes + kChunkBytes / 2;
    chunk.end = is_last ? end : line_start(p + kChunkBytes, p, end);
    p = chunk.end;
    chunks.push_back(chunk);
  }
  if (!chunks.empty()) chunks.front().vertex_base = 0;
  return chunks;
}

/// Parses all chunks that `is_due`; of several failures the first in the file is thrown.
template <class Due>
void parse_all(std::vector<ObjChunk>& chunks, const Due& is_due) {
  std::vector<std::exception_ptr> failures(chunks.size());
  for_each_parallel(chunks.size(), [&](std::size_t i) {
    if (!is_due(chunks[i])) return;
    try {
      chunks[i].parse();
    } catch (...) {
      failures[i] = std::current_exception();
    }
  });
  for (const std::exception_ptr& failure : failures) {
    if (failure) std::rethrow_exception(failure);
  }
}

[[noreturn]] void fail_out_of_range(ObjChunk& chunk, std::size_t face, std::size_t vertex_count) {
  const Index corner = std::ranges::max(chunk.faces[face]);
  const char* const line = chunk.line_of_face(face);
  fail_at_line(chunk.text, line,
               "a face uses vertex " + std::to_string(std::int64_t{corner} + 1) +
                   ", but the file has " + std::to_string(vertex_count) + " vertices");
}

}  // namespace

RawMesh read_obj(std::string_view text) {
  std::vector<ObjChunk> chunks = split(text);
  parse_all(chunks, [](const ObjChunk&) { return true; });

  std::vector<std::size_t> vertex_starts;
  std::vector<std::size_t> face_starts;
  std::size_t vertex_count = 0;
  std::size_t face_count = 0;
  for (ObjChunk& chunk : chunks) {
    vertex_starts.push_back(vertex_count);
    face_starts.push_back(face_count);
    chunk.vertex_base = static_cast<std::int64_t>(vertex_count);
    vertex_count += chunk.positions.size();
    face_count += chunk.faces.size();
  }
  parse_all(chunks, [](const ObjChunk& chunk) { return chunk.needs_base; });

  RawMesh mesh;
  mesh.positions.resize(vertex_count);
  mesh.faces.resize(face_count);
  std::vector<std::size_t> bad_faces(chunks.size());
  for_each_parallel(chunks.size(), [&](std::size_t i) {
    ObjChunk& chunk = chunks[i];
    std::ranges::copy(chunk.positions,
                      mesh.positions.begin() + static_cast<std::ptrdiff_t>(vertex_starts[i]));
    Face* const target = mesh.faces.data() + face_starts[i];
    std::size_t& f = bad_faces[i];  // stays at the first corner out of range
    for (; f < chunk.faces.size(); ++f) {
      const Face& face = chunk.faces[f];
      target[f] = face;
      if (static_cast<std::size_t>(std::max({face[0], face[1], face[2]})) >= vertex_count) return;
    }
    chunk.positions = {};
    chunk.faces = {};
  });
  for (std::size_t i = 0; i < chunks.size(); ++i) {
    if (bad_faces[i] < chunks[i].faces.size()) {
      fail_out_of_range(chunks[i], bad_faces[i], vertex_count);
    }
    for (const Polygon& polygon : chunks[i].polygons) {
      mesh.polygons.push_back({face_starts[i] + polygon.first_face, polygon.face_count});
    }
  }
  return mesh;
}

}  // namespace geotherm::io
