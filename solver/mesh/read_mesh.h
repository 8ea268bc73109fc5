// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "solver/core/result.h"
#include "solver/mesh/triangle_mesh.h"

namespace geotherm {

/// A model as read from a file: the mesh and what the reader had to do to get it.
struct MeshFile {
  TriangleMesh mesh;
  Index polygons = 0;              ///< faces with more than three corners that were triangulated
  Index welded = 0;                ///< STL: corners that were merged into shared vertices
  std::vector<std::string> notes;  ///< one sentence each, for people
};

/// Reads `.obj`, `.ply` (ASCII, little and big endian), `.off`, `.stl` (ASCII, binary); the
/// extension decides, in any case. Vertex numbers are 0-based and in the order of the file;
/// an STL has none: equal corners are welded, numbered by first appearance.
/// Coordinates are the doubles nearest to what is written. A face of more than three corners
/// becomes a fan from its first corner, or, where that would fold over, triangles that cover it
/// once. Errors: one sentence, "PATH: line N: ..." or "PATH: byte N: ..." with the cause
/// (kBadFile); an unknown extension (kNotAvailable); kOutOfMemory. Never throws. What a file
/// announces is held against its size before memory is asked for. A file that others change while
/// it is read is an error (kBadFile). Independent of the locale. Cost: a copy of the file in
/// memory, and one pass over it; OBJ on all cores.
Result<MeshFile> read_mesh(const std::string& path);

/// The names of the formats: obj, ply, off, stl.
std::vector<std::string> mesh_formats();

/// Errors: kNotAvailable (no such format), with those that there are.
Result<void> check_mesh_format(std::string_view name);

/// The same in a format that is named, whatever the extension. Errors: those and those of
/// check_mesh_format().
Result<MeshFile> read_mesh(const std::string& path, std::string_view format);

/// From an open stream, such as standard input (0), to its end. `name`: in place of the path. The
/// bytes are held in memory while they are parsed: at most half of what is free. Errors: the same.
Result<MeshFile> read_mesh(int descriptor, std::string_view format, const std::string& name);

}  // namespace geotherm
