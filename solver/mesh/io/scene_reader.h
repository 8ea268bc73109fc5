// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "solver/mesh/io/raw_mesh.h"

namespace geotherm::io {

/// Where the frames of a scene that moves are written: one after the other, the positions of the
/// vertices of its RawMesh as doubles.
struct SceneFrames {
  int descriptor = -1;
  std::int64_t count = 0;  ///< that were written
};

/// The name of the root of a glTF scene that turns a model to y up, before the model's own axis,
/// such as "z"; the reader takes the turn back.
inline constexpr std::string_view kTurnedRoot = "up is ";

/// What Assimp reads, in this process. `folder`: with its slash, where files that the model names
/// are; empty: nowhere. `frames`: null: none are wanted. Throws ReadFailure and std::bad_alloc;
/// what is damaged may end the process.
RawMesh read_scene_here(std::string_view bytes, std::string_view format, const std::string& folder,
                        SceneFrames* frames = nullptr);

/// Whether all of it was written to a file or a pipe; errno says why not.
bool write_all(int descriptor, const void* data, std::size_t size);

/// Frames of a scene are so many a second.
inline constexpr int kSceneFrameRate = 24;

}  // namespace geotherm::io
