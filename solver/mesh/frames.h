// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <utility>

#include "geotherm/error.h"
#include "geotherm/mesh.h"

// Sequences: where the vertices of one mesh are, frame after frame.
namespace geotherm {

/// A path with one `%d` or `%04d` in the name of the file, in place of which numbers stand.
class NumberedPath {
 public:
  /// Errors: kBadInput (no such place, several, one in a folder's name, another kind of it).
  static Result<NumberedPath> parse(const std::string& text);

  /// Precondition: number >= 0.
  std::string path(std::int64_t number) const;

  const std::string& text() const { return text_; }

  /// The least and the largest number of which there is a file. Errors: kBadFile (no folder, no
  /// file).
  struct Range {
    std::int64_t first, last;
  };
  Result<Range> find_files() const;

 private:
  std::string text_, before_, after_;
  int digits_ = 1;  ///< at least so many, zeros in front
};

/// Whether a path has a place for numbers.
bool is_numbered(const std::string& path);

/// Frames of a mesh, read one at a time, so that any number of them fit into the memory of one.
/// Copies share the open file; read() works on any number of threads.
class Frames {
 public:
  /// `path`: numbered meshes of any format of read_mesh() (`frame_%04d.obj`, from the least number
  /// to the largest that is there), or positions of all frames in one `.npy` (frames x vertices x
  /// 3, float32 or float64), `.pc2` or `.mdd`, or the first animation of a `.glb` or `.gltf`, 24
  /// frames a second, which lie in a temporary file. `mesh`: what moves. Errors: kBadInput (neither
  /// of these), kBadFile (no file, one that is damaged or of another number of vertices; both
  /// numbers are in it), kOutOfMemory.
  static Result<Frames> open(const std::string& path, std::shared_ptr<const TriangleMesh> mesh);

  std::int64_t count() const;

  /// What frame k is called in numbered outputs: the number in its file's name, or k itself.
  std::int64_t number(std::int64_t k) const;

  /// "frame_0007.obj", "walk.pc2: frame 7".
  std::string name(std::int64_t k) const;

  /// The mesh with its vertices as in frame k, 0 <= k < count(). Polygons may be cut into other
  /// triangles there; those of the mesh stay. Errors (kBadFile, with the frame's name): what
  /// read_mesh() finds, other vertices or faces, a coordinate that is not finite; kOutOfMemory.
  Result<TriangleMesh> read(std::int64_t k) const;

 private:
  struct Source;
  struct Files;
  struct Array;
  explicit Frames(std::shared_ptr<const Source> source) : source_(std::move(source)) {}
  std::shared_ptr<const Source> source_;
};

}  // namespace geotherm
