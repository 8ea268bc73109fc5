// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <bit>
#include <cstring>
#include <string>
#include <string_view>
#include <vector>

#include "geotherm/domains.h"
#include "tests/mesh/mesh_files.h"

namespace geotherm::test {

/// Points on a surface and its normals there.
struct SamplePoints {
  std::vector<Vec3> positions, normals;
};

/// `count` points spread evenly over the unit sphere (a Fibonacci lattice).
SamplePoints sphere_points(Index count);

/// Side x side points of a grid of step 1 in the plane z = 0, each moved at random by up to
/// `amount` along both axes; point (i, j) is j * side + i.
SamplePoints plane_points(Index side, double amount, unsigned seed);

/// Moves each point along its normal by a normally distributed length.
void add_noise(SamplePoints& points, double deviation, unsigned seed);

/// A cloud that must be valid, and its surface, which must exist.
PointCloud cloud_of(std::vector<Vec3> positions, std::vector<Vec3> normals = {});
PointSurface surface_from(const PointCloud& cloud, const PointOptions& options = {});

/// Writes `bytes` into a file of this name and reads it as points.
Result<PointFile> read_point_bytes(std::string_view name, std::string_view bytes);

/// The corners of a pyramid with normals, in every format.
std::vector<Sample> point_samples();

/// Their places and unit normals.
std::vector<Vec3> sample_places();
std::vector<Vec3> sample_normals();

/// The header of a PCD file of the samples up to its data.
std::string pcd_header(const std::string& data);

/// What packs bytes as LZF does, greedily.
std::string pack_lzf(std::string_view bytes);

/// The bytes of a number.
template <class T>
std::string bytes_of_number(T value, std::endian order = std::endian::little) {
  std::string bytes(sizeof(T), '\0');
  std::memcpy(bytes.data(), &value, sizeof(T));
  if (order != std::endian::native) std::reverse(bytes.begin(), bytes.end());
  return bytes;
}

}  // namespace geotherm::test
