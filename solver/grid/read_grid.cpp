// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "geotherm/domains.h"
#include "geotherm/names.h"
#include "solver/core/text.h"
#include "solver/geometry/grid_mesh.h"
#include "solver/grid/io/raw_grid.h"
#include "solver/mesh/io/formats.h"
#include "solver/mesh/io/input_file.h"

namespace geotherm::io {

std::size_t count_samples(const std::array<std::int64_t, 3>& size) {
  std::int64_t count = 1;
  for (const std::int64_t each : size) {
    if (each < 1 || each > kMaxGridSamples / count) {
      throw ReadFailure{"a grid of " + std::to_string(size[0]) + " x " + std::to_string(size[1]) +
                        " x " + std::to_string(size[2]) +
                        (each < 1 ? " samples is empty" : " samples has more than a billion")};
    }
    count *= each;
  }
  return static_cast<std::size_t>(count);
}

std::vector<double> decode_samples(std::string_view bytes, std::size_t count, NumberType type,
                                   std::endian order) {
  if (count > bytes.size() / size_of(type)) {
    throw ReadFailure{"there are to be " + std::to_string(count) + " samples of " +
                      counted_text(size_of(type), "byte", "bytes") + ", but only " +
                      std::to_string(bytes.size()) + " bytes follow"};
  }
  return decode_numbers(bytes, count, type, order);
}

RawGrid::Values values_of(NumberType type) {
  return is_whole(type) ? RawGrid::Values::kWholes : RawGrid::Values::kReals;
}

}  // namespace geotherm::io

namespace geotherm {
namespace {

struct GridFormat {
  std::string_view extension;
  io::RawGrid (*read)(std::string_view bytes);  ///< null: NRRD, which may have two files
};
constexpr GridFormat kGridFormats[] = {{".npy", io::read_npy},
                                       {".png", io::read_png},
                                       {".vti", io::read_vti},
                                       {".nrrd", nullptr},
                                       {".nhdr", nullptr}};
static_assert(io::reads_all(kGridFormats, io::kGrid));

/// "in column 3 of row 5", "in column 3 of row 5 of layer 7".
std::string place_in(const std::array<std::int64_t, 3>& size, std::size_t sample) {
  const auto i = static_cast<std::int64_t>(sample);
  std::string place = "in column " + std::to_string(i % size[0]) + " of row " +
                      std::to_string(i / size[0] % size[1]);
  if (size[2] > 1) place += " of layer " + std::to_string(i / size[0] / size[1]);
  return place;
}

/// Turns values into speeds, in place; returns what they mean. Throws ReadFailure.
std::string to_speeds(io::RawGrid& raw, GridValues asked) {
  using Values = io::RawGrid::Values;
  const bool pixels = raw.type == Values::kPixels;
  const bool speeds =
      asked == GridValues::kSpeeds || (asked == GridValues::kAuto && raw.type == Values::kReals);
  constexpr double kWhite = 255, kHalf = 128;
  for (std::size_t i = 0; i < raw.values.size(); ++i) {
    double& value = raw.values[i];
    if (std::isnan(value)) value = 0;
    if (!speeds) {
      value = (pixels ? value >= kHalf : value != 0) ? 1 : 0;
    } else if (!(value >= 0 && value <= std::numeric_limits<double>::max())) {
      throw io::ReadFailure{"the speed " + place_in(raw.size, i) + " is " + rounded_text(value),
                            0,
                            {},
                            {"speeds are finite, 0 or more; ", SettingHint{"grid", {"mask"}},
                             " takes what is not 0 as passable"}};
    } else if (pixels) {
      value /= kWhite;
    }
  }
  if (speeds) return pixels ? "speed is brightness, black is wall" : "values are speeds, 0 is wall";
  return pixels ? "brightness of at least half passes" : "0 is wall, all else passes";
}

GridFile finish_grid(io::RawGrid raw, GridValues values) {
  GridFile out;
  out.meaning = to_speeds(raw, values) + raw.detail;
  for (std::size_t e = 0; e < 3; ++e) {
    out.grid.size[e] = static_cast<Index>(raw.size[e]);
    out.grid.spacing[e] = raw.spacing[e];
  }
  out.grid.origin = raw.origin;
  out.grid.three_axes = raw.three_axes;
  const bool one = std::ranges::all_of(raw.values, [](double speed) { return speed == 1; });
  if (!one) out.grid.speeds = std::move(raw.values);
  out.notes = std::move(raw.notes);
  if (auto valid = check_grid(out.grid); !valid) {
    throw io::ReadFailure{valid.error().message, 0, {}, {"as read, " + out.meaning}};
  }
  return out;
}

/// The file in the folder of the header that holds its samples. Throws ReadFailure.
std::string data_path(const io::InputFile& header, const std::string& data_file) {
  const std::string& path = header.path();
  if (path.empty()) {
    throw io::ReadFailure{"the samples are in a file beside it, " + io::printable(data_file) +
                              ", and nothing is beside a stream",
                          0,
                          {},
                          {"name the file of the header"}};
  }
  return path.substr(0, path.rfind('/') + 1) + data_file;
}

/// Throws ReadFailure and std::bad_alloc, or gives the error of the other file.
Result<io::RawGrid> read_nrrd(const io::InputFile& file, std::string_view bytes) {
  const io::NrrdHeader header = io::read_nrrd_header(bytes);
  if (header.data_file.empty()) {
    return io::read_nrrd_data(header, bytes.substr(header.data_begins));
  }
  // The header says how it is packed.
  const auto data = io::InputFile::open_as_is(data_path(file, header.data_file));
  if (!data) return data.error();
  return io::read_unchanged(*data, file.shown() + ": " + data->shown(), "grid",
                            [&]() -> Result<io::RawGrid> {
                              return io::read_nrrd_data(header, io::FileBytes(*data).bytes());
                            });
}

}  // namespace

NamedValues<GridValues> named_values(GridValues) {
  return {
      "'*' is no meaning of a grid's values",
      {{GridValues::kAuto, "auto"}, {GridValues::kMask, "mask"}, {GridValues::kSpeeds, "speeds"}}};
}

std::vector<std::string> grid_formats() { return io::formats_holding(io::kGrid); }

bool holds_grid(const ModelInput& input) {
  return io::format_of(kGridFormats, input.file().extension()) != nullptr;
}

Result<GridFile> read_grid(const ModelInput& input, GridValues values) {
  const io::InputFile& file = input.file();
  const GridFormat* const format = io::format_of(kGridFormats, file.extension());
  if (format == nullptr) return io::unknown_model(file, " of grids", io::kGrid);
  return io::read_unchanged(file, file.shown(), "grid", [&]() -> Result<GridFile> {
    const io::FileBytes bytes(file);
    auto raw =
        format->read != nullptr ? format->read(bytes.bytes()) : read_nrrd(file, bytes.bytes());
    if (!raw) return raw.error();
    return finish_grid(*std::move(raw), values);
  });
}

Result<GridFile> read_grid(const std::string& path, GridValues values) {
  const auto input = ModelInput::open(path);
  return input ? read_grid(*input, values) : input.error();
}

}  // namespace geotherm
