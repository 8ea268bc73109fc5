// SPDX-License-Identifier: MIT
#include "tests/points/point_samples.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <map>
#include <numbers>
#include <utility>

#include "tests/support/dice.h"

namespace geotherm::test {

SamplePoints sphere_points(Index count) {
  SamplePoints out;
  const double golden_angle = std::numbers::pi * (3 - std::sqrt(5.0));
  for (Index i = 0; i < count; ++i) {
    const double z = 1 - (2 * i + 1.0) / count, radius = std::sqrt(1 - z * z);
    out.positions.emplace_back(radius * std::cos(golden_angle * i),
                               radius * std::sin(golden_angle * i), z);
  }
  out.normals = out.positions;
  return out;
}

SamplePoints plane_points(Index side, double amount, unsigned seed) {
  SamplePoints out;
  Dice dice(seed);
  for (Index j = 0; j < side; ++j) {
    for (Index i = 0; i < side; ++i) {
      const double x = i + dice.between(-amount, amount), y = j + dice.between(-amount, amount);
      out.positions.emplace_back(x, y, 0);
    }
  }
  out.normals.assign(out.positions.size(), Vec3::UnitZ());
  return out;
}

void add_noise(SamplePoints& points, double deviation, unsigned seed) {
  Dice dice(seed);
  for (std::size_t i = 0; i < points.positions.size(); ++i) {
    // Box, Muller 1958.
    const double length = std::sqrt(-2 * std::log(1 - dice.unit()));
    points.positions[i] +=
        deviation * length * std::cos(2 * std::numbers::pi * dice.unit()) * points.normals[i];
  }
}

PointCloud cloud_of(std::vector<Vec3> positions, std::vector<Vec3> normals) {
  auto cloud = PointCloud::build(std::move(positions), std::move(normals));
  if (!cloud) {
    ADD_FAILURE() << cloud.error().message;
    return *PointCloud::build({Vec3::Zero()});
  }
  return *std::move(cloud);
}

PointSurface surface_from(const PointCloud& cloud, const PointOptions& options) {
  auto surface = surface_of(cloud, options);
  if (!surface) {
    ADD_FAILURE() << surface.error().message;
    return {*TriangleMesh::build({Vec3::Zero()}, {{0, 0, 0}}), 0, 0, 0, 0, 0, {}, {}};
  }
  return *std::move(surface);
}

Result<PointFile> read_point_bytes(std::string_view name, std::string_view bytes) {
  const TemporaryDirectory directory;
  return read_points(directory.write(name, bytes));
}

std::vector<Vec3> sample_places() { return pyramid_positions(); }

std::vector<Vec3> sample_normals() {
  return {{0, 0, -1}, {1, 0, 0}, {0, 1, 0}, {-0.6, 0.8, 0}, {0, 0, 1}};
}

std::string pcd_header(const std::string& data) {
  return "# .PCD v0.7 - Point Cloud Data file format\nVERSION 0.7\n"
         "FIELDS x y rgb z normal_x normal_y normal_z curvature\nSIZE 4 8 4 4 4 4 8 2\n"
         "TYPE F F U F F F F I\nCOUNT 1 1 1 1 1 1 1 2\nWIDTH 5\nHEIGHT 1\n"
         "VIEWPOINT 0 0 0 1 0 0 0\nPOINTS 5\nDATA " +
         data + "\n";
}

std::string pack_lzf(std::string_view bytes) {
  constexpr std::size_t kLongestLiteral = 32, kLongestCopy = 264, kFarthest = 8192;
  std::string out, literals;
  std::map<std::string, std::size_t> seen;
  const auto flush = [&] {
    if (!literals.empty()) out += static_cast<char>(literals.size() - 1) + literals;
    literals.clear();
  };
  for (std::size_t at = 0; at < bytes.size();) {
    const std::string key(bytes.substr(at, 3));
    const auto found = seen.find(key);
    std::size_t length = 0, distance = 0;
    if (key.size() == 3 && found != seen.end() && at - found->second <= kFarthest) {
      distance = at - found->second - 1;
      while (length < kLongestCopy && at + length < bytes.size() &&
             bytes[at + length] == bytes[found->second + length]) {
        ++length;
      }
    }
    seen[key] = at;
    if (length < 3) {
      literals += bytes[at++];
      if (literals.size() == kLongestLiteral) flush();
      continue;
    }
    flush();
    const std::size_t code = length - 2;
    out += static_cast<char>((std::min<std::size_t>(code, 7) << 5) | (distance >> 8));
    if (code >= 7) out += static_cast<char>(code - 7);
    out += static_cast<char>(distance & 255);
    at += length;
  }
  flush();
  return out;
}

namespace {

std::string text_rows(const char* gap, const char* before, const char* behind) {
  std::string out;
  for (std::size_t i = 0; i < 5; ++i) {
    for (const Vec3& v : {sample_places()[i], sample_normals()[i]}) {
      for (const double x : v) {
        // Of such short numbers all digits are written.
        std::string digits = std::to_string(x);
        digits.erase(digits.find_last_not_of('0') + 1);
        out += (out.empty() || out.back() == '\n' ? before : gap) + digits;
      }
    }
    out += std::string(behind) + "\n";
  }
  return out;
}

std::string ply_head(const std::string& format) {
  return "ply\nformat " + format +
         " 1.0\nelement vertex 5\nproperty uchar red\nproperty double x\nproperty float y\n"
         "property float z\nproperty float nx\nproperty float ny\nproperty double nz\n"
         "element face 0\nproperty list uchar int vertex_indices\nend_header\n";
}

std::string ply_bytes(const std::string& format, std::endian order) {
  std::string out = ply_head(format);
  for (std::size_t i = 0; i < 5; ++i) {
    const Vec3 p = sample_places()[i], n = sample_normals()[i];
    out += '\x07' + bytes_of_number(p.x(), order);
    for (const double x : {p.y(), p.z(), n.x(), n.y()}) {
      out += bytes_of_number(static_cast<float>(x), order);
    }
    out += bytes_of_number(n.z(), order);
  }
  return out;
}

/// The fields of pcd_header() of one point.
std::vector<std::string> pcd_values(std::size_t i) {
  const Vec3 p = sample_places()[i], n = sample_normals()[i];
  const auto single = [](double x) { return bytes_of_number(static_cast<float>(x)); };
  return {single(p.x()),
          bytes_of_number(p.y()),
          bytes_of_number(std::uint32_t{0x00ff8800}),
          single(p.z()),
          single(n.x()),
          single(n.y()),
          bytes_of_number(n.z()),
          bytes_of_number(std::int16_t{-1}) + bytes_of_number(std::int16_t{2})};
}

std::string pcd_binary() {
  std::string out = pcd_header("binary");
  for (std::size_t i = 0; i < 5; ++i) {
    for (const std::string& value : pcd_values(i)) out += value;
  }
  return out;
}

std::string pcd_packed() {
  std::string columns;
  for (std::size_t field = 0; field < 8; ++field) {
    for (std::size_t i = 0; i < 5; ++i) columns += pcd_values(i)[field];
  }
  const std::string packed = pack_lzf(columns);
  return pcd_header("binary_compressed") +
         bytes_of_number(static_cast<std::uint32_t>(packed.size())) +
         bytes_of_number(static_cast<std::uint32_t>(columns.size())) + packed;
}

std::string pcd_ascii() {
  std::string out = pcd_header("ascii");
  for (std::size_t i = 0; i < 5; ++i) {
    const Vec3 p = sample_places()[i], n = sample_normals()[i];
    for (const double x : {p.x(), p.y(), 16746496.0, p.z(), n.x(), n.y(), n.z(), -1.0, 2.0}) {
      out += std::to_string(x) + ' ';
    }
    out += '\n';
  }
  return out;
}

}  // namespace

std::vector<Sample> point_samples() {
  const std::string plain = text_rows(" ", "", "");
  return {
      {"xyz", "a.xyz", plain},
      {"xyz_with_commas", "a.XYZ", text_rows(", ", " ", ",")},
      {"xyz_with_everything", "a.xyz",
       "\xef\xbb\xbf# comment\n//X Y Z\n\n \t\r\n" + text_rows("\t", "\t", " 255 0 word # end\r")},
      {"xyz_without_last_newline", "a.xyz", plain.substr(0, plain.size() - 1)},
      {"ply_ascii", "a.ply", ply_head("ascii") + text_rows(" ", "9 ", "")},
      {"ply_little_endian", "a.ply", ply_bytes("binary_little_endian", std::endian::little)},
      {"ply_big_endian", "a.ply", ply_bytes("binary_big_endian", std::endian::big)},
      {"pcd_ascii", "a.pcd", pcd_ascii()},
      {"pcd_binary", "a.pcd", pcd_binary()},
      {"pcd_packed", "a.pcd", pcd_packed()},
  };
}

}  // namespace geotherm::test
