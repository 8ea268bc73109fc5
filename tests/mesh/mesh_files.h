// SPDX-License-Identifier: MIT
#pragma once

#include <random>
#include <string>
#include <string_view>
#include <vector>

#include "geotherm/io.h"

namespace geotherm::test {

/// A new directory, removed with all that is in it.
class TemporaryDirectory {
 public:
  TemporaryDirectory();
  TemporaryDirectory(const TemporaryDirectory&) = delete;
  TemporaryDirectory& operator=(const TemporaryDirectory&) = delete;
  ~TemporaryDirectory();

  std::string path(std::string_view name) const { return path_ + '/' + std::string(name); }

  /// Writes a file here and returns its path.
  std::string write(std::string_view name, std::string_view bytes) const;

  /// The names of the files here, sorted.
  std::vector<std::string> names() const;

 private:
  std::string path_;
};

std::string bytes_of(const std::string& path);

/// Writes `bytes` into a file of this name and reads it as a mesh.
Result<MeshFile> read_bytes(std::string_view name, std::string_view bytes);

/// One small damage: bytes flipped, cut off, inserted, copied elsewhere, a number made extreme.
void damage(std::string& bytes, std::mt19937_64& random);

/// A pyramid over a square: 5 vertices, 4 triangles and a quad, in every format.
struct Sample {
  std::string name;  ///< of the test
  std::string file;  ///< with its extension
  std::string bytes;
};
std::vector<Sample> pyramid_samples();

/// Those of them in formats that hold other elements, too, or that are packed.
std::vector<Sample> surface_samples();

/// As gzip packs it.
std::string gzipped(const std::string& bytes);

/// Its vertices, and its faces with the quad as two triangles.
std::vector<Vec3> pyramid_positions();
std::vector<Face> pyramid_faces();

}  // namespace geotherm::test
