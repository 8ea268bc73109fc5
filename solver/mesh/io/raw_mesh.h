// SPDX-License-Identifier: MIT
// One reader per format. Each takes the bytes of FileBytes (with its padding) and throws
// ReadFailure or std::bad_alloc.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "geotherm/error.h"
#include "geotherm/types.h"
#include "solver/core/text.h"

namespace geotherm::io {

/// A face with more than three corners, kept as a fan: its triangles are (c0, c1, c2),
/// (c0, c2, c3), ... so that the corners can be read off them once all positions are known.
struct Polygon {
  std::size_t first_face;
  std::size_t face_count;  ///< corners - 2
};

/// What a reader hands over; every corner is in range, every coordinate finite.
struct RawMesh {
  std::vector<Vec3> positions;
  std::vector<Face> faces;
  std::vector<Polygon> polygons;
  std::size_t welded = 0;
  std::optional<int> up_axis = {};  ///< 0 to 2, where the format says which axis is up
  std::vector<std::string> notes;
};

/// Gathers the corners of one face into a fan of triangles.
class FanBuilder {
 public:
  explicit FanBuilder(std::vector<Face>& faces) : faces_(faces) {}

  void add(Index corner) {
    if (count_ == 0) {
      first_ = corner;
    } else if (count_ >= 2) {
      faces_.push_back({first_, last_, corner});
    }
    last_ = corner;
    ++count_;
  }

  /// Ends the face; one of more than three corners is noted as a polygon, one of fewer left out.
  void end(std::vector<Polygon>& polygons) {
    if (count_ > 3) polygons.push_back({faces_.size() - (count_ - 2), count_ - 2});
    if (count_ < 3) ++left_out_;
    count_ = 0;
  }

  std::size_t left_out() const { return left_out_; }

 private:
  std::vector<Face>& faces_;
  Index first_ = kNoIndex;
  Index last_ = kNoIndex;
  std::size_t count_ = 0, left_out_ = 0;
};

/// Says how many faces a FanBuilder left out; of none nothing.
inline void note_left_out(std::size_t faces, std::vector<std::string>& notes) {
  if (faces == 0) return;
  notes.push_back(counted_text(faces, "face", "faces") + " with fewer than 3 corners " +
                  (faces == 1 ? "was" : "were") + " left out");
}

/// The triangles of a strip, every other one of which turns the other way round. Those that repeat
/// a corner only join parts of it and are left out.
inline void add_strip(std::span<const Index> corners, std::vector<Face>& faces) {
  for (std::size_t k = 2; k < corners.size(); ++k) {
    Face face = {corners[k - 2], corners[k - 1], corners[k]};
    if (face[0] == face[1] || face[1] == face[2] || face[2] == face[0]) continue;
    if (k % 2 == 1) std::swap(face[0], face[1]);
    faces.push_back(face);
  }
}

/// Replaces fans of polygons by other triangles where the fan folds over itself: ears are cut off,
/// in the plane of the polygon. A convex polygon keeps its fan, and so does one that crosses
/// itself. Cost: O(n) for a good fan, else O(n log n) for polygons that do not wind back and forth
/// in all of their box; what others may take is limited for all polygons of a file together.
class PolygonCutter {
 public:
  /// `triangles`: those of all polygons of the file.
  explicit PolygonCutter(std::size_t triangles)
      : most_tests_(kTestsAtLeast + kTestsEach * static_cast<std::int64_t>(triangles)) {}

  std::int64_t most_tests() const { return most_tests_; }

  /// False: the limit is reached, and the fan is folded still.
  bool triangulate(std::span<const Vec3> positions, std::span<Face> fan);

 private:
  // About two nanoseconds each; polygons of CAD and outlines of letters take some ten for each
  // corner.
  static constexpr std::int64_t kTestsAtLeast = 50'000'000, kTestsEach = 40;

  std::int64_t most_tests_;
  std::int64_t tests_ = most_tests_;  ///< points that may still be tested
};

class InputFile;

RawMesh read_obj(std::string_view text);
/// Reads an OBJ file, faster than by way of FileBytes.
RawMesh read_obj(const InputFile& file);
RawMesh read_off(std::string_view text);
RawMesh read_ply(std::string_view bytes);
RawMesh read_stl(std::string_view bytes);

/// What Assimp reads: glTF, 3MF, Collada. Files that a .gltf names are read from its folder alone.
RawMesh read_scene(const InputFile& file);
/// Reads a scene from bytes; `folder` as of read_scene_here(), `format`: "glb", ...
RawMesh read_scene(std::string_view bytes, std::string_view format, const std::string& folder);

/// A file by its format, with its polygons as fans. Errors: those of read_mesh(), which throws
/// nothing either.
Result<RawMesh> read_raw_mesh(const std::string& path);

}  // namespace geotherm::io
