// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cstdint>
#include <exception>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "solver/core/memory.h"
#include "solver/core/parallel.h"
#include "solver/mesh/io/input_file.h"
#include "solver/mesh/io/obj_chunk.h"
#include "solver/mesh/io/raw_mesh.h"

namespace geotherm::io {
namespace {

constexpr std::size_t kPiece = std::size_t{1} << 18;

/// The first start of a line at or after `p` that does not continue the line before it. Up to three
/// bytes before `p` are looked at, none before `first`.
const char* line_start(const char* p, const char* first, const char* end) {
  for (; p < end; ++p) {
    if (p == first || p[-1] != '\n') continue;
    const char* last = p - 2;  // the character before the line's end
    if (last >= first && *last == '\r') --last;
    if (last < first || *last != '\\') return p;
  }
  return end;
}

/// A text in memory or in a file, taken by pieces of some size. From a file it goes through small
/// buffers that stay in the processor's cache: a copy of all of it would cost a third of the time.
class ObjSource {
 public:
  explicit ObjSource(std::string_view text) : text_(text), size_(text.size()) {}
  explicit ObjSource(const InputFile& file) : file_(&file), size_(file.size()) {}

  std::size_t pieces() const { return (size_ + kPiece - 1) / kPiece; }

  /// Calls use(lines) with the lines that begin in piece i, as they are in the source.
  template <class Use>
  void with_lines(std::size_t i, const Use& use) {
    RawVector<char> buffer = take_buffer();
    use(lines(i, buffer));
    const std::lock_guard lock(mutex_);
    buffers_.push_back(std::move(buffer));
  }

  /// Ends of lines before those of piece i.
  std::size_t lines_before(std::size_t i) {
    std::size_t count = 0;
    for (std::size_t k = 0; k < i; ++k) {
      with_lines(k, [&](std::string_view lines) {
        count += static_cast<std::size_t>(std::ranges::count(lines, '\n'));
      });
    }
    return count;
  }

 private:
  static constexpr std::size_t kBefore = 3;  ///< bytes that line_start() looks back

  std::string_view lines(std::size_t i, RawVector<char>& buffer) const {
    const std::size_t place = i * kPiece, limit = std::min(place + kPiece, size_);
    const std::size_t from = place - std::min(place, kBefore);
    for (std::size_t tail = std::size_t{1} << 12;; tail *= 8) {
      const std::size_t to = std::min(limit + tail, size_);
      const char* const window = bytes(from, to, buffer);
      const char* const last = window + (to - from);
      const char* const begin =
          i == 0 ? window : line_start(window + (place - from), window, window + (limit - from));
      if (begin == window + (limit - from)) return {};
      const char* const end =
          limit == size_ ? last : line_start(window + (limit - from), window, last);
      if (end < last || to == size_) return {begin, end};
    }
  }

  /// The bytes from place to place, with padding behind the last one of the source.
  const char* bytes(std::size_t from, std::size_t to, RawVector<char>& buffer) const {
    if (file_ == nullptr) return text_.data() + from;
    buffer.resize(to - from + FileBytes::kPadding);
    file_->read(buffer.data(), to - from, from);
    std::fill(buffer.end() - FileBytes::kPadding, buffer.end(), '\0');
    return buffer.data();
  }

  RawVector<char> take_buffer() {
    const std::lock_guard lock(mutex_);
    if (buffers_.empty()) return {};
    RawVector<char> buffer = std::move(buffers_.back());
    buffers_.pop_back();
    return buffer;
  }

  std::string_view text_;
  const InputFile* file_ = nullptr;
  std::size_t size_;
  std::mutex mutex_;
  std::vector<RawVector<char>> buffers_;  ///< not in use
};

[[noreturn]] void fail_in_piece(ObjSource& source, std::size_t i, const ReadFailure& failure) {
  if (failure.line == 0) throw failure;
  const std::size_t line = source.lines_before(i) + failure.line;
  throw ReadFailure{"line " + std::to_string(line) + ": " + failure.cause, 0, {}, failure.hint};
}

/// Calls work(i) for every i below `count` on all cores. It must not throw.
template <class Work>
void for_each_chunk(std::size_t count, const Work& work) {
  run_calls(thread_count(0), static_cast<int>(count),
            [&work](int i) { work(static_cast<std::size_t>(i)); });
}

/// Parses all chunks that `is_due`; of several failures the first in the file is thrown.
template <class Due>
void parse_all(ObjSource& source, std::vector<ObjChunk>& chunks, const Due& is_due) {
  std::vector<std::exception_ptr> failures(chunks.size());
  for_each_chunk(chunks.size(), [&](std::size_t i) {
    if (!is_due(chunks[i])) return;
    try {
      source.with_lines(i, [&](std::string_view lines) {
        chunks[i].text = lines;
        chunks[i].parse();
      });
    } catch (...) {
      failures[i] = std::current_exception();
    }
  });
  for (std::size_t i = 0; i < failures.size(); ++i) {
    if (!failures[i]) continue;
    try {
      std::rethrow_exception(failures[i]);
    } catch (const ReadFailure& failure) {
      fail_in_piece(source, i, failure);
    }
  }
}

/// Parses again what holds relative indices, now that the vertices before them are counted.
void parse_relative(ObjSource& source, std::vector<ObjChunk>& chunks) {
  const auto sizes = [](const ObjChunk& c) {
    return std::pair(c.positions.size(), c.faces.size());
  };
  std::vector<std::pair<std::size_t, std::size_t>> before;
  for (const ObjChunk& chunk : chunks) before.push_back(sizes(chunk));
  parse_all(source, chunks, [](const ObjChunk& chunk) { return chunk.needs_base; });
  for (std::size_t i = 0; i < chunks.size(); ++i) {
    if (sizes(chunks[i]) != before[i]) throw ReadFailure{"the file changed while it was read"};
  }
}

[[noreturn]] void fail_out_of_range(ObjSource& source, std::size_t i, ObjChunk& chunk,
                                    std::size_t face, std::size_t vertex_count) {
  const Index corner = std::ranges::max(chunk.faces[face]);
  std::size_t line = 1;
  source.with_lines(i, [&](std::string_view lines) {
    chunk.text = lines;
    const char* const where = chunk.line_of_face(face);
    line += static_cast<std::size_t>(std::count(lines.data(), where, '\n'));
  });
  fail_in_piece(source, i,
                {"", line,
                 "a face uses vertex " + std::to_string(std::int64_t{corner} + 1) +
                     ", but the file has " + std::to_string(vertex_count) + " vertices"});
}

RawMesh read_pieces(ObjSource& source) {
  std::vector<ObjChunk> chunks(source.pieces());
  if (!chunks.empty()) chunks.front().vertex_base = 0;
  parse_all(source, chunks, [](const ObjChunk&) { return true; });

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
  parse_relative(source, chunks);

  RawMesh mesh;
  mesh.positions.resize(vertex_count);
  mesh.faces.resize(face_count);
  std::vector<std::size_t> bad_faces(chunks.size());
  std::size_t left_out = 0;
  for_each_chunk(chunks.size(), [&](std::size_t i) {
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
      fail_out_of_range(source, i, chunks[i], bad_faces[i], vertex_count);
    }
    for (const Polygon& polygon : chunks[i].polygons) {
      mesh.polygons.push_back({face_starts[i] + polygon.first_face, polygon.face_count});
    }
    left_out += chunks[i].left_out;
  }
  note_left_out(left_out, mesh.notes);
  return mesh;
}

}  // namespace

RawMesh read_obj(std::string_view text) {
  ObjSource source(text);
  return read_pieces(source);
}

RawMesh read_obj(const InputFile& file) {
  ObjSource source(file);
  return read_pieces(source);
}

}  // namespace geotherm::io
