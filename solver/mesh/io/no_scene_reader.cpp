// SPDX-License-Identifier: MIT
// In place of scene_reader.cpp where the library is built without Assimp.
#include "solver/mesh/io/frame_array.h"
#include "solver/mesh/io/input_file.h"
#include "solver/mesh/io/raw_mesh.h"

namespace geotherm::io {

RawMesh read_scene(std::string_view /*bytes*/, std::string_view format,
                   const std::string& /*folder*/) {
  throw ReadFailure{
      "." + std::string(format) + " is read by Assimp, without which this program was built",
      0,
      {},
      {"install libassimp-dev and build it again, or save the model as .obj or .ply"}};
}

RawMesh read_scene(const InputFile& file) { return read_scene({}, file.extension().substr(1), {}); }

MovingScene read_moving_scene(const InputFile& file) {
  read_scene(file);
  throw ReadFailure{"the scene has no animation"};  // not reached
}

}  // namespace geotherm::io
