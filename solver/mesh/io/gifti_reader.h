// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>
#include <vector>

#include "solver/mesh/io/raw_mesh.h"

// GIFTI, the files of surfaces of the brain (NIfTI's Geometry format, version 1.0).
namespace geotherm::io {

/// A surface: the arrays POINTSET and TRIANGLE. Places are as they are stored: a transformation
/// beside them is not applied. Throws ReadFailure.
RawMesh read_gifti(std::string_view bytes);

/// The numbers of the first array that is no part of a surface: one for each vertex. Throws
/// ReadFailure.
std::vector<double> read_gifti_numbers(std::string_view bytes);

/// A surface of FreeSurfer (lh.white): triangles in binary. Throws ReadFailure.
RawMesh read_freesurfer(std::string_view bytes);

}  // namespace geotherm::io
