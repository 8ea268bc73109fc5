// SPDX-License-Identifier: MIT
#include <algorithm>
#include <bit>

#include "solver/core/text.h"
#include "solver/distributed/mesh_part.h"
#include "solver/mesh/io/input_file.h"
#include "solver/mesh/io/ply_body.h"
#include "solver/mesh/io/ply_header.h"

namespace geotherm {
namespace {

using io::PlyElement;
using io::PlyFormat;
using io::PlyHeader;
using io::PlyProperty;
using io::ReadFailure;

/// Bytes of a header, with its comments, at most.
constexpr std::size_t kMaxPlyHeader = 1 << 16;
/// Rows that are read at once.
constexpr std::int64_t kRowsAtOnce = 1 << 18;

/// Bytes of a row whose lists have three items; 0: it has no one size.
std::int64_t row_bytes(const PlyElement& element) {
  std::int64_t bytes = 0;
  for (const PlyProperty& property : element.properties) {
    const auto one = static_cast<std::int64_t>(io::size_of(property.type));
    const bool corners = property.name == "vertex_indices" || property.name == "vertex_index";
    if (property.is_list && (element.name != "face" || !corners)) return 0;
    bytes += property.is_list
                 ? static_cast<std::int64_t>(io::size_of(property.count_type)) + 3 * one
                 : one;
  }
  return bytes;
}

/// Whether the faces have a list of whole numbers that are their corners.
bool has_corners(const PlyElement& face) {
  int list = face.find("vertex_indices", true);
  if (list < 0) list = face.find("vertex_index", true);
  if (list < 0) return false;
  const PlyProperty& corners = face.properties[static_cast<std::size_t>(list)];
  return io::is_whole(corners.type) && io::is_whole(corners.count_type);
}

class SliceReader {
 public:
  SliceReader(const io::InputFile& file, PlyHeader header, std::int64_t body, int part, int parts)
      : file_(file), header_(std::move(header)), body_(body), part_(part), parts_(parts) {}

  /// Throws ReadFailure.
  MeshSlice read() {
    std::int64_t at = body_;
    for (const PlyElement& element : header_.elements) {
      if (slice_.faces > 0) break;  // behind what is needed
      if (element.count == 0) continue;
      const std::int64_t bytes = row_bytes(element);
      if (bytes == 0) {
        throw ReadFailure{std::string("a ") + io::row_name(element) +
                              " has lists of its own, and ranks read rows of one size",
                          0,
                          {},
                          {"write vertices and triangles alone"}};
      }
      const std::int64_t left = static_cast<std::int64_t>(file_.size()) - at;
      if (element.count > left / bytes) {
        throw ReadFailure{"the file ends: " + std::to_string(element.count) + " of element " +
                              io::quoted(element.name, element.name.data()) + " take " +
                              std::to_string(bytes) + " bytes each, and " + std::to_string(left) +
                              " bytes follow",
                          0,
                          {},
                          {"was it cut short? Faces must be triangles"}};
      }
      if (element.name == "vertex" || element.name == "face") {
        if (header_.format == PlyFormat::kLittleEndian) {
          read_rows<std::endian::little>(element, at, bytes);
        } else {
          read_rows<std::endian::big>(element, at, bytes);
        }
      }
      at += bytes * element.count;
    }
    return std::move(slice_);
  }

 private:
  template <std::endian Order>
  void read_rows(const PlyElement& element, std::int64_t at, std::int64_t bytes) {
    const std::int64_t first = share_begin(element.count, part_, parts_);
    const std::int64_t end = share_begin(element.count, part_ + 1, parts_);
    const bool faces = element.name == "face";
    (faces ? slice_.faces : slice_.vertices) = element.count;
    if (faces) {
      slice_.corners.reserve(static_cast<std::size_t>(end - first));
    } else {
      slice_.first_vertex = first;
      slice_.positions.reserve(static_cast<std::size_t>(end - first));
    }
    std::string rows;
    PlyHeader header = header_;
    for (std::int64_t row = first; row < end;) {
      const std::int64_t next = std::min(end, row + kRowsAtOnce);
      rows.resize(static_cast<std::size_t>((next - row) * bytes));
      file_.read(rows.data(), rows.size(), static_cast<std::size_t>(at + row * bytes));
      header.body = rows.data();
      io::BinaryBody<Order> body(rows, header);
      for (; row < next; ++row) {
        body.now_reading(element, row);
        if (faces) {
          take_face(body, element, row);
        } else {
          take_vertex(body, element, row);
        }
      }
    }
  }

  template <class Body>
  void take_vertex(Body& body, const PlyElement& element, std::int64_t row) {
    Vec3 position = Vec3::Zero();
    for (const PlyProperty& property : element.properties) {
      const double value = body.number(property.type);
      const auto axis = std::string_view("xyz").find(property.name);
      if (property.name.size() == 1 && axis < 3) position[static_cast<Eigen::Index>(axis)] = value;
    }
    if (!position.allFinite()) {
      throw ReadFailure{"a coordinate is not finite in vertex " + std::to_string(row + 1) + " of " +
                        std::to_string(element.count)};
    }
    slice_.positions.push_back(position);
  }

  template <class Body>
  void take_face(Body& body, const PlyElement& element, std::int64_t row) {
    const auto where = [&] {
      return " in face " + std::to_string(row + 1) + " of " + std::to_string(element.count);
    };
    for (const PlyProperty& property : element.properties) {
      if (!property.is_list) {
        body.number(property.type);
        continue;
      }
      const auto count = static_cast<std::int64_t>(body.number(property.count_type));
      if (count != 3) {
        throw ReadFailure{std::to_string(count) + " corners" + where() +
                              ", and ranks read triangles, which have rows of one size",
                          0,
                          {},
                          {"triangulate the mesh"}};
      }
      auto& face = slice_.corners.emplace_back();
      for (GlobalIndex& corner : face) {
        const double number = body.number(property.type);
        if (!(number >= 0 && number < static_cast<double>(slice_.vertices))) {
          throw ReadFailure{"vertex " + std::to_string(static_cast<std::int64_t>(number)) +
                            " is used, but the file has " + std::to_string(slice_.vertices) +
                            " vertices (0 to " + std::to_string(slice_.vertices - 1) + ")" +
                            where()};
        }
        corner = static_cast<GlobalIndex>(number);
      }
    }
  }

  const io::InputFile& file_;
  PlyHeader header_;
  std::int64_t body_;
  int part_, parts_;
  MeshSlice slice_;
};

/// `start`: what the file begins with, which the header points into.
Result<PlyHeader> header_of(const io::InputFile& file, const std::string& start) {
  PlyHeader header = io::parse_ply_header(start);
  if (header.format == PlyFormat::kAscii) {
    return Error{ErrorCode::kBadInput,
                 file.shown() + " is an ASCII .ply, and ranks read binary ones",
                 {"write it as binary"}};
  }
  const PlyElement *vertex = header.find("vertex"), *face = header.find("face");
  const bool complete = vertex != nullptr && face != nullptr && vertex < face &&
                        vertex->find("x", false) >= 0 && vertex->find("y", false) >= 0 &&
                        vertex->find("z", false) >= 0 && face->count > 0 && has_corners(*face);
  if (complete) return header;
  return Error{ErrorCode::kBadFile,
               file.shown() +
                   ": the file has no vertices with x, y and z before faces with a list "
                   "\"vertex_indices\" of whole numbers"};
}

}  // namespace

Result<MeshCounts> count_ply(const std::string& path) {
  auto file = io::InputFile::open_as_is(path);
  if (!file) return file.error();
  return io::read_unchanged(*file, file->shown(), "mesh", [&]() -> Result<MeshCounts> {
    const std::string start = file->start(kMaxPlyHeader);
    const auto header = header_of(*file, start);
    if (!header) return header.error();
    return MeshCounts{header->find("vertex")->count, header->find("face")->count};
  });
}

Result<MeshSlice> read_ply_slice(const std::string& path, int part, int parts) {
  auto file = io::InputFile::open_as_is(path);
  if (!file) return file.error();
  return io::read_unchanged(*file, file->shown(), "mesh", [&]() -> Result<MeshSlice> {
    const std::string start = file->start(kMaxPlyHeader);
    auto header = header_of(*file, start);
    if (!header) return header.error();
    const auto body = static_cast<std::int64_t>(header->body - start.data());
    return SliceReader(*file, *std::move(header), body, part, parts).read();
  });
}

}  // namespace geotherm
