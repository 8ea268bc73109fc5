// SPDX-License-Identifier: MIT
// Positions of all frames one after the other in one file: .npy (frames x vertices x 3), .pc2
// (point cache 2) and .mdd (motion designer).
#pragma once

#include <bit>
#include <cstdint>
#include <string_view>
#include <vector>

#include "geotherm/types.h"
#include "solver/mesh/io/input_file.h"
#include "solver/mesh/io/raw_mesh.h"

namespace geotherm::io {

/// Where the numbers of a file lie: frames x vertices x 3, the last axis fastest.
struct FrameArray {
  std::int64_t frames = 0, vertices = 0;
  bool doubles = false;  ///< 64-bit numbers, else 32-bit ones
  std::endian order = std::endian::little;
  std::uint64_t begins = 0;  ///< byte

  std::uint64_t frame_bytes() const {
    return static_cast<std::uint64_t>(vertices) * 3 * (doubles ? sizeof(double) : sizeof(float));
  }
};

/// Whether files of this extension (".pc2") are read by the functions below.
bool is_frame_array(std::string_view extension);

/// Reads the header, whose frames the file must hold, no fewer and no more. Precondition:
/// is_frame_array(). Throws ReadFailure and std::bad_alloc.
FrameArray read_frame_array(const InputFile& file, std::string_view extension);

/// The positions of frame k, 0 <= k < frames. Throws ReadFailure and std::bad_alloc. Cost: the
/// bytes of one frame.
std::vector<Vec3> read_frame(const InputFile& file, const FrameArray& array, std::int64_t k);

/// A scene that moves: the mesh as it stands, and where its vertices are at each of kSceneFrameRate
/// frames a second of its first animation, in a file that is there for as long as it is open.
struct MovingScene {
  RawMesh mesh;
  InputFile file;
  FrameArray frames;
};

/// Whether files of this extension may be one.
inline bool is_moving_scene(std::string_view extension) {
  return extension == ".glb" || extension == ".gltf";
}

/// Precondition: is_moving_scene() of its extension. Throws ReadFailure and std::bad_alloc. Cost:
/// that of reading it and of placing its vertices in all frames.
MovingScene read_moving_scene(const InputFile& file);

}  // namespace geotherm::io
