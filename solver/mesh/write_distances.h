// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string>

#include "solver/core/result.h"
#include "solver/mesh/data_field.h"
#include "solver/mesh/triangle_mesh.h"

namespace geotherm {

/// True when write_distances() knows the extension of `path`; otherwise the error says which
/// extensions there are (and for .obj that the format holds no values).
Result<void> check_distance_path(const std::string& path);

/// Writes one distance per vertex, in the order of the file, model units, `inf` where unreached.
/// The format is the extension's: `.csv` (`vertex,distance`, the fewest
/// digits that read back equal), `.npy` (float64, shape V),
/// `.ply` (binary little endian mesh with the vertex property `double distance`), `.vtp` (ParaView
/// PolyData, point data `distance`). With `nearest`, a number per vertex (DistanceResult::
/// nearest_source), they have a third column `nearest_source`, shape V x 2, a property
/// `int nearest_source` and point data of that name. The file is written beside its place and
/// renamed: it is there whole or not at all. `path` "-" writes CSV to standard output.
/// `fields` follow under their names: as columns (.csv, those of vertices), properties `double` or
/// `uchar` of vertices and faces (.ply), point and cell data (.vtp).
/// Precondition: distances.size() == mesh.vertex_count(), and nearest.size() unless it is empty;
/// every field has as many values as its place has elements. Errors: those of check_field() and of
/// writing.
Result<void> write_distances(const std::string& path, const TriangleMesh& mesh,
                             std::span<const double> distances, std::span<const Index> nearest = {},
                             std::span<const DataField> fields = {});

/// Whether the file of this path holds the field beside the distances. Errors: kNotAvailable, with
/// the extensions that do.
Result<void> check_field(const std::string& path, const DataField& field);

/// The same for write_mesh().
Result<void> check_mesh_path(const std::string& path);

/// Writes the mesh alone: `.obj`, `.ply` (binary), `.off` or `.stl` (binary), by extension.
/// Positions read back exactly, except from .stl: 32-bit numbers, no vertex without a face, and
/// vertices numbered by first use. `path` "-" writes OBJ to standard output.
Result<void> write_mesh(const std::string& path, const TriangleMesh& mesh);

}  // namespace geotherm
