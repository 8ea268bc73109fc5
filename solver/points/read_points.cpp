// SPDX-License-Identifier: MIT
#include <algorithm>
#include <new>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "geotherm/domains.h"
#include "solver/core/text.h"
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

const PointFormat* point_format_of(std::string_view extension) {
  const auto found = std::ranges::find(kPointFormats, extension, &PointFormat::extension);
  return found == std::end(kPointFormats) ? nullptr : found;
}

Result<PointFile> parse_points(const std::string& shown, const io::InputFile& file,
                               const PointFormat& format) {
  return io::guarded_read(shown, "points", file.size(), [&]() -> Result<PointFile> {
    io::RawPoints raw = format.read(io::FileBytes(file).bytes());
    auto points = PointCloud::build(std::move(raw.positions), std::move(raw.normals));
    if (!points) {
      return Error{ErrorCode::kBadFile, shown + ": " + points.error().message, points.error().hint};
    }
    return PointFile{*std::move(points), std::move(raw.notes)};
  });
}

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

std::vector<std::string> point_formats() {
  std::vector<std::string> names;
  for (const PointFormat& format : kPointFormats) names.emplace_back(format.extension.substr(1));
  return names;
}

Result<PointFile> read_points(const std::string& path) {
  const std::string extension = io::file_extension(path), shown = io::printable(path);
  const auto file = io::InputFile::open(path);
  if (!file) return file.error();
  const PointFormat* const format = point_format_of(extension);
  if (format == nullptr) {
    return Error{ErrorCode::kNotAvailable,
                 shown + ": unknown extension \"" + io::printable(extension) + "\" of points",
                 {"there are .ply .xyz .pts .pcd"}};
  }
  auto points = parse_points(shown, *file, *format);
  // Before what was wrong in it: it may have been half of what it is to be.
  if (auto same = file->check_unchanged(); !same) return same.error();
  return points;
}

Result<bool> is_point_file(const std::string& path) {
  const std::string extension = io::file_extension(path);
  if (extension != kPly) return point_format_of(extension) != nullptr;
  const auto file = io::InputFile::open(path);
  if (!file) return file.error();
  try {
    return has_no_faces(*file);
  } catch (const io::ReadFailure&) {
    return false;
  } catch (const std::bad_alloc&) {
    return Error{ErrorCode::kOutOfMemory,
                 io::printable(path) + ": not enough memory to read its header"};
  }
}

}  // namespace geotherm
