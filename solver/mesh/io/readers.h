// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>

#include "solver/mesh/io/raw_mesh.h"

// One reader per format. Each takes the bytes of FileBytes (with its padding) and throws
// ReadFailure or std::bad_alloc.
namespace geotherm::io {

class InputFile;

RawMesh read_obj(std::string_view text);
/// The same, and faster than by way of FileBytes.
RawMesh read_obj(const InputFile& file);
RawMesh read_off(std::string_view text);
RawMesh read_ply(std::string_view bytes);
RawMesh read_stl(std::string_view bytes);

}  // namespace geotherm::io
