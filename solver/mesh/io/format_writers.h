// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "geotherm/error.h"
#include "geotherm/io.h"
#include "geotherm/mesh.h"

// The bytes of a file, one function per format. Numbers in text have the fewest digits that read
// back as the same double.
namespace geotherm::io {

// `nearest`: one number per vertex, or none at all: the column, property or array `nearest_source`.
// `fields`: what follows it under its own name, faces' values where the format holds faces.
std::string csv_bytes(std::span<const double> distances, std::span<const Index> nearest = {},
                      std::span<const DataField> fields = {});

/// What stands before the values of a .npy file, version 1.0; `type`: such as "<f8".
std::string npy_header(const std::string& type, std::span<const std::uint64_t> shape);

/// Whether values can be written as float32. Errors: kBadInput, with the path.
Result<void> check_float_range(const std::string& path, std::span<const double> values);

/// npy_header() for rows of distances, and the bytes of one of them. Errors of the latter:
/// kBadInput (values beyond the range of float32, with `path`).
std::string npy_rows_header(std::uint64_t rows, std::uint64_t columns, NpyType type);
Result<void> npy_row(const std::string& path, std::span<const double> row, NpyType type,
                     std::string& bytes);

/// Shape V, or V x 2 with `nearest`.
std::string npy_bytes(std::span<const double> distances, std::span<const Index> nearest = {});

/// Binary little endian with the vertex properties `double distance`, `inf` where unreached, and
/// `float quality`, the same for programs that show that name (MeshLab), there the largest
/// distance; with neither where there are no distances.
std::string ply_bytes(const TriangleMesh& mesh, std::span<const double> distances = {},
                      std::span<const Index> nearest = {}, std::span<const DataField> fields = {});

/// VTK XML PolyData; the arrays are appended raw, with 64-bit lengths.
std::string vtp_bytes(const TriangleMesh& mesh, std::span<const double> distances,
                      std::span<const Index> nearest = {}, std::span<const DataField> fields = {});

std::string obj_bytes(const TriangleMesh& mesh);
std::string off_bytes(const TriangleMesh& mesh);

/// Binary. Errors (kBadInput): a coordinate beyond the range of the format's 32-bit numbers.
Result<std::string> stl_bytes(const TriangleMesh& mesh);

}  // namespace geotherm::io
