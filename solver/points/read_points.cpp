// SPDX-License-Identifier: MIT
#include <algorithm>
#include <new>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "geotherm/domains.h"
#include "solver/core/text.h"
#include "solver/mesh/io/formats.h"
#include "solver/mesh/io/input_file.h"
#include "solver/mesh/io/ply_header.h"
#include "solver/points/io/raw_points.h"

namespace geotherm {
namespace {

struct PointFormat {
  std::string_view extension;
  io::RawPoints (*read)(std::string_view bytes);
};

constexpr std::string_view kPly = ".ply";
constexpr PointFormat kPointFormats[] = {{kPly, io::read_ply_points},
                                         {".xyz", io::read_xyz_points},
                                         {".pts", io::read_pts_points},
                                         {".pcd", io::read_pcd_points}};
static_assert(io::reads_all(kPointFormats, io::kPoints));

/// The header of a PLY file, from as much of the file as it takes. Throws ReadFailure.
bool has_no_faces(const io::InputFile& file) {
  constexpr std::string_view kEnd = "end_header";
  constexpr std::size_t kFirst = 4096;
  std::vector<char> bytes;
  for (std::size_t size = std::min(kFirst, file.size());; size = std::min(8 * size, file.size())) {
    bytes.assign(size + io::FileBytes::kPadding, '\0');
    file.read(bytes.data(), size, 0);
    const std::string_view text(bytes.data(), size);
    if (size < file.size() && text.find(kEnd) == text.npos) continue;
    const io::PlyHeader header = io::parse_ply_header(text);
    const auto rows = [&header](std::string_view name) {
      const io::PlyElement* const element = header.find(name);
      return element == nullptr ? 0 : element->count;
    };
    return rows("vertex") > 0 && rows("face") == 0 && rows("tristrips") == 0;
  }
}

}  // namespace

std::vector<std::string> point_formats() { return io::formats_holding(io::kPoints); }

Result<PointFile> read_points(const ModelInput& input) {
  const io::InputFile& file = input.file();
  const PointFormat* const format = io::format_of(kPointFormats, file.extension());
  if (format == nullptr) return io::unknown_model(file, " of points", io::kPoints);
  return io::read_unchanged(file, file.shown(), "points", [&]() -> Result<PointFile> {
    io::RawPoints raw = format->read(io::FileBytes(file).bytes());
    auto points = PointCloud::build(std::move(raw.positions), std::move(raw.normals));
    if (points) return PointFile{*std::move(points), std::move(raw.notes)};
    return Error{ErrorCode::kBadFile, file.shown() + ": " + points.error().message,
                 points.error().hint};
  });
}

Result<PointFile> read_points(const std::string& path) {
  const auto input = ModelInput::open(path);
  return input ? read_points(*input) : input.error();
}

Result<bool> is_point_file(const ModelInput& input) {
  const io::InputFile& file = input.file();
  if (file.extension() != kPly) return io::format_of(kPointFormats, file.extension()) != nullptr;
  try {
    return has_no_faces(file);
  } catch (const io::ReadFailure&) {
    return false;
  } catch (const std::bad_alloc&) {
    return Error{ErrorCode::kOutOfMemory, file.shown() + ": not enough memory to read its header"};
  }
}

}  // namespace geotherm
