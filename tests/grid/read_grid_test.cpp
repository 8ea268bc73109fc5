// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>
#include <zlib.h>

#include <algorithm>
#include <cmath>
#include <ostream>
#include <random>

#include "geotherm/domains.h"
#include "tests/mesh/mesh_files.h"

// Files of grids: what is in them, what is wrong with them, and that they read back.
namespace geotherm::test {
namespace {

template <class T>
std::string raw(std::initializer_list<T> values) {
  std::string bytes;
  for (T value : values) bytes.append(reinterpret_cast<const char*>(&value), sizeof(T));
  return bytes;
}

std::string npy(const std::string& type, const std::string& shape, const std::string& data,
                bool fortran = false) {
  std::string header = "{'descr': '" + type +
                       "', 'fortran_order': " + (fortran ? "True" : "False") +
                       ", 'shape': " + shape + ", }\n";
  std::string bytes("\x93NUMPY\x01\x00", 8);
  bytes += raw<std::uint16_t>({static_cast<std::uint16_t>(header.size())});
  return bytes + header + data;
}

std::string packed(const std::string& data) {
  auto size = compressBound(data.size());
  std::string out(size, '\0');
  compress(reinterpret_cast<Bytef*>(out.data()), &size, reinterpret_cast<const Bytef*>(data.data()),
           data.size());
  out.resize(size);
  return out;
}

std::string gzip(const std::string& data) {
  z_stream stream{};
  deflateInit2(&stream, 9, Z_DEFLATED, 16 + MAX_WBITS, 8, Z_DEFAULT_STRATEGY);
  std::string out(data.size() + 100, '\0');
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(data.data()));
  stream.avail_in = static_cast<uInt>(data.size());
  stream.next_out = reinterpret_cast<Bytef*>(out.data());
  stream.avail_out = static_cast<uInt>(out.size());
  deflate(&stream, Z_FINISH);
  out.resize(stream.total_out);
  deflateEnd(&stream);
  return out;
}

std::string big(std::uint32_t value) {
  return {static_cast<char>(value >> 24), static_cast<char>(value >> 16),
          static_cast<char>(value >> 8), static_cast<char>(value)};
}
std::string png_chunk(const std::string& name, const std::string& data) {
  const std::string body = name + data;
  return big(static_cast<std::uint32_t>(data.size())) + body +
         big(static_cast<std::uint32_t>(crc32(0, reinterpret_cast<const Bytef*>(body.data()),
                                              static_cast<uInt>(body.size()))));
}
/// Rows of 8-bit samples; colour: 0 grey, 2 RGB, 3 numbers of a palette, which is RGB.
std::string png(std::uint32_t width, std::uint32_t height, const std::string& samples,
                int colour = 0, const std::string& palette = {}) {
  std::string rows;
  const std::size_t row = samples.size() / height;
  for (std::uint32_t y = 0; y < height; ++y) rows += '\0' + samples.substr(y * row, row);
  return std::string("\x89PNG\r\n\x1a\n") +
         png_chunk("IHDR",
                   big(width) + big(height) + std::string{8, static_cast<char>(colour), 0, 0, 0}) +
         (palette.empty() ? "" : png_chunk("PLTE", palette)) + png_chunk("IDAT", packed(rows)) +
         png_chunk("IEND", "");
}

const std::string kPalette("\xff\xff\xff\x70\x70\x70\0\0\0", 9);

const std::string kNrrd = "NRRD0004\n# made by hand\ntype: uint8\ndimension: 2\nsizes: 3 2\n";
std::string vti(const std::string& array, const std::string& more = "") {
  return "<VTKFile type=\"ImageData\"" + more +
         "><ImageData WholeExtent=\"1 3 0 1 0 0\" Origin=\"10 20 30\" Spacing=\"0.5 2 1\">"
         "<Piece Extent=\"1 3 0 1 0 0\"><PointData Scalars=\"v\">" +
         array + "</PointData></Piece></ImageData></VTKFile>\n";
}
const std::string kVtiArray =
    "<DataArray type=\"Float32\" Name=\"w\" format=\"ascii\">9 9 9 9 9 9</DataArray>"
    "<DataArray type=\"Float64\" Name=\"v\" format=\"ascii\">1 0 2 0.5 nan 4</DataArray>";

struct GridSample {
  std::string name, file, bytes;
  std::array<Index, 3> size;
  std::vector<double> speeds;
  GridValues values = GridValues::kAuto;
};
std::ostream& operator<<(std::ostream& out, const GridSample& s) { return out << s.name; }

std::vector<GridSample> grid_samples() {
  using Speeds = std::vector<double>;
  const Speeds mask = {1, 0, 1, 0, 1, 1}, wide = {1, 0, 2, 0.5, 0, 4};
  const std::string bytes("\1\0\2\0\3\xff", 6);
  const std::string doubles = raw<double>({1, 0, 2, 0.5, std::nan(""), 4});
  std::string swapped;
  for (std::size_t i = 0; i < doubles.size(); i += 8) {
    std::string each = doubles.substr(i, 8);
    std::ranges::reverse(each);
    swapped += each;
  }
  return {
      {"npy_bool", "a.npy", npy("|b1", "(2, 3)", std::string("\1\0\1\0\1\1", 6)), {3, 2, 1}, mask},
      {"npy_u1", "a.npy", npy("|u1", "(2, 3)", bytes), {3, 2, 1}, mask},
      {"npy_i2",
       "a.npy",
       npy("<i2", "(2, 3)", raw<std::int16_t>({7, 0, -1, 0, 2, 9})),
       {3, 2, 1},
       mask},
      {"npy_i8_speeds",
       "a.npy",
       npy("<i8", "(2, 3)", raw<std::int64_t>({1, 0, 3, 0, 2, 9})),
       {3, 2, 1},
       {1, 0, 3, 0, 2, 9},
       GridValues::kSpeeds},
      {"npy_f4",
       "a.npy",
       npy("<f4", "(1, 2, 3)", raw<float>({1, 0, 2, 0.5, NAN, 4})),
       {3, 2, 1},
       wide},
      {"npy_f8_swapped", "a.NPY", npy(">f8", "(2, 3)", swapped), {3, 2, 1}, wide},
      {"npy_f8_mask",
       "a.npy",
       npy("<f8", "(2, 3)", doubles),
       {3, 2, 1},
       {1, 0, 1, 1, 0, 1},
       GridValues::kMask},
      {"npy_fortran",
       "a.npy",
       npy("<f8", "(2, 3)", raw<double>({1, .5, 0, NAN, 2, 4}), true),
       {3, 2, 1},
       wide},
      {"npy_fortran_3",
       "a.npy",
       npy("|u1", "(2, 1, 3)", std::string("\1\0\0\1\1\1", 6), true),
       {3, 1, 2},
       {1, 0, 1, 0, 1, 1}},
      {"png_grey", "a.png", png(3, 2, std::string("\xff\x7f\x80\x01\xc8\xc9", 6)), {3, 2, 1}, mask},
      {"png_colour",
       "a.png",
       png(3, 1, std::string("\xff\xff\xff\xa0\xa0\xa0\x20\x10\x10", 9), 2),
       {3, 1, 1},
       {1, 1, 0}},
      {"png_palette",
       "a.png",
       png(3, 2, std::string("\0\1\0\2\0\0", 6), 3, kPalette),
       {3, 2, 1},
       mask},
      {"png_speeds",
       "a.png",
       png(3, 1, std::string("\xff\x33\0", 3)),
       {3, 1, 1},
       {1, 0.2, 0},
       GridValues::kSpeeds},
      {"nrrd_raw", "a.nrrd", kNrrd + "encoding: raw\n\n" + bytes, {3, 2, 1}, mask},
      {"nrrd_skip",
       "a.nrrd",
       kNrrd + "encoding: raw\nbyte skip: -1\n\njunk" + bytes,
       {3, 2, 1},
       mask},
      {"nrrd_gzip", "a.nrrd", kNrrd + "encoding: gzip\n\n" + gzip(bytes), {3, 2, 1}, mask},
      {"nrrd_kinds",
       "a.nrrd",
       kNrrd + "kinds: domain space\nencoding: raw\n\n" + bytes,
       {3, 2, 1},
       mask},
      {"nrrd_text", "a.nrrd", kNrrd + "encoding: ascii\n\n1 0 2\n0 3 255\n", {3, 2, 1}, mask},
      {"nrrd_big_endian",
       "a.nrrd",
       "NRRD0001\r\ntype: double\r\ndimension: 3\r\nsizes: 3 2 1\r\nendian: big\r\nencoding: "
       "raw\r\n\r\n" +
           swapped,
       {3, 2, 1},
       wide},
      {"vti_text", "a.vti", vti(kVtiArray), {3, 2, 1}, wide},
      {"vti_binary",
       "a.vti",
       vti("<DataArray type=\"UInt8\" Name=\"v\" format=\"binary\">BgAAAA==AQACAAP/</DataArray>"),
       {3, 2, 1},
       mask},
      {"vti_appended",
       "a.vti",
       "<VTKFile type=\"ImageData\" header_type=\"UInt64\"><ImageData WholeExtent=\"0 2 0 1 0 0\">"
       "<Piece Extent=\"0 2 0 1 0 0\"><PointData><DataArray type=\"Float64\" format=\"appended\" "
       "offset=\"0\"/></PointData></Piece></ImageData><AppendedData encoding=\"raw\">_" +
           raw<std::uint64_t>({48}) + doubles + "</AppendedData></VTKFile>",
       {3, 2, 1},
       wide},
  };
}

class GridReader : public testing::TestWithParam<GridSample> {};

TEST_P(GridReader, ReadsSizesAndSpeeds) {
  const GridSample& sample = GetParam();
  const TemporaryDirectory directory;
  const std::string path = directory.write(sample.file, sample.bytes);
  EXPECT_TRUE(holds_grid(*ModelInput::open(path)));
  const auto file = read_grid(path, sample.values);
  ASSERT_TRUE(file) << sentence(file.error());
  EXPECT_EQ(file->grid.size, sample.size);
  ASSERT_EQ(file->grid.speeds.size(), sample.speeds.size());
  for (std::size_t i = 0; i < sample.speeds.size(); ++i) {
    EXPECT_NEAR(file->grid.speeds[i], sample.speeds[i], 1e-12) << i;
  }
}

INSTANTIATE_TEST_SUITE_P(Of, GridReader, testing::ValuesIn(grid_samples()),
                         [](const auto& test) { return test.param.name; });

TEST(GridFiles, StateWhereTheirSamplesLie) {
  const TemporaryDirectory directory;
  const auto image = read_grid(directory.write("a.vti", vti(kVtiArray)));
  ASSERT_TRUE(image) << sentence(image.error());
  EXPECT_EQ(image->grid.position(4), Vec3(11, 22, 30));
  ASSERT_EQ(image->notes.size(), 1U);
  EXPECT_EQ(image->notes[0], "of several arrays v was taken");

  directory.write("b.raw", std::string(6, '\1'));
  const auto scan = read_grid(directory.write(
      "b.nhdr", kNrrd + "encoding: raw\nspace directions: (0.5,0) (0,-2)\nspace origin: (1,2)\n"
                        "data file: b.raw\n"));
  ASSERT_TRUE(scan) << sentence(scan.error());
  EXPECT_EQ(scan->grid.position(4), Vec3(1.5, 0, 0));
  const auto lone = read_grid(directory.write(
      "lone.nhdr", kNrrd + "encoding: raw\nspace directions: (0.5,0) (0,-2)\ndata file: no.raw\n"));
  EXPECT_EQ(sentence(lone.error()), directory.path("no.raw") + ": no such file; check the path");

  const auto picture = read_grid(directory.write("c.png", png(2, 3, std::string(6, '\xff'))));
  ASSERT_TRUE(picture);
  EXPECT_EQ(picture->grid.position(0), Vec3(0, 2, 0)) << "the first row is the top";
  EXPECT_EQ(picture->grid.position(5), Vec3(1, 0, 0));
}

struct GridDamage {
  std::string name, file, bytes, message;
};
std::ostream& operator<<(std::ostream& out, const GridDamage& d) { return out << d.name; }

std::vector<GridDamage> grid_damages() {
  return {
      {"npy_other", "a.npy", "hello, world",
       "byte 0: an array of NumPy starts with the word NUMPY"},
      {"npy_type", "a.npy", npy("<c8", "(2, 2)", ""),
       "byte 20: the type of numbers \"'<c8',\" cannot be read; save booleans, whole numbers, "
       "float32 or float64"},
      {"npy_line", "a.npy", npy("|u1", "(4,)", "abcd"),
       "byte 60: the array has 1 dimension; a grid has 2 or 3"},
      {"npy_short", "a.npy", npy("<f8", "(200, 300)", "abcd"),
       "there are to be 60000 samples of 8 bytes, but only 4 bytes follow"},
      {"npy_huge", "a.npy", npy("<f8", "(2000000, 3000000)", "abcd"),
       "a grid of 3000000 x 2000000 x 1 samples has more than a billion"},
      {"npy_empty", "a.npy", npy("<f8", "(0, 3)", ""), "a grid of 3 x 0 x 1 samples is empty"},
      {"npy_negative", "a.npy", npy("<f8", "(2, 2)", raw<double>({1, 1, 1, -2})),
       "the speed in column 1 of row 1 is -2; speeds are finite, 0 or more; grid mask takes what "
       "is not 0 "
       "as passable"},
      {"npy_walls", "a.npy", npy("|u1", "(2, 2)", std::string("\1\0\0\1", 4)),
       "no two neighbouring samples of the grid pass; as read, 0 is wall, all else passes"},
      {"npy_long", "a.npy", npy("<i2", "(2, 2)", raw<std::int16_t>({1, 1, 1, 1, 1, 1})),
       "there are to be 4 samples of 2 bytes, but 12 bytes follow, 4 too many"},
      {"png_palette", "a.png", png(2, 1, std::string("\0\4", 2), 3, kPalette),
       "the pixel in column 1 of row 0 has the colour 4 of a palette of 3"},
      {"nrrd_gzip_cut", "a.nrrd",
       kNrrd + "encoding: gzip\n\n" + gzip(std::string(6, '\1')).substr(0, 19),
       "the compressed samples are cut off or damaged behind their 6 bytes: 19 compressed ones do "
       "not end with their checksum"},
      {"nrrd_gzip_long", "a.nrrd", kNrrd + "encoding: gzip\n\n" + gzip(std::string(7, '\1')),
       "there are to be 6 bytes, but the compressed samples are more"},
      {"nrrd_colours", "a.nrrd",
       kNrrd + "kinds: RGB-color domain\nencoding: raw\n\n" + std::string(6, '\1'),
       "line 6: axis 0 of 3 values is RGB-color; a grid has one value a sample; save the "
       "brightness or one of them alone"},
      {"nrrd_no_direction", "a.nrrd",
       kNrrd + "encoding: raw\nspace directions: none (1,0)\n\n" + std::string(6, '\1'),
       "line 7: axis 0 of 3 values has no direction; a grid has one value a sample; save the "
       "brightness or one of them alone"},
      {"nrrd_other", "a.nrrd", "hello\n", "line 1: a file of NRRD starts with NRRD000"},
      {"nrrd_encoding", "a.nrrd", kNrrd + "encoding: bzip2\n\n",
       "line 6: the encoding \"bzip2\" is not supported; save it raw or gzip"},
      {"nrrd_turned", "a.nrrd", kNrrd + "encoding: raw\nspace directions: (1,1) (0,1)\n\n",
       "line 7: the axes are not those of space; save it along the axes, or with spacings"},
      {"nrrd_gzip_short", "a.nrrd",
       "NRRD0004\ntype: double\ndimension: 2\nsizes: 3000 2000\nendian: big\nencoding: gzip\n\nabc",
       "there are to be 48000000 bytes, but only 3 compressed ones follow"},
      {"nrrd_text_short", "a.nrrd", kNrrd + "encoding: text\n\n1 2",
       "there are to be 6 samples, but only 3 bytes follow"},
      {"vti_surface", "a.vti", "<VTKFile type=\"PolyData\">\n",
       "line 1: the file holds \"PolyData\", not ImageData; a grid is an image"},
      {"vti_cells", "a.vti",
       "<VTKFile type=\"ImageData\"><ImageData WholeExtent=\"0 1 0 1 0 0\"><Piece Extent=\"0 1 0 1 "
       "0 0\"><CellData></CellData></Piece>",
       "the image has no values of one number at its points; in ParaView, Cell Data to Point Data "
       "makes them of cells"},
      {"vti_extent", "a.vti", "<VTKFile type=\"ImageData\">\n<ImageData WholeExtent=\"0 1 0\">",
       "line 2: WholeExtent is \"0\"; it has 6 numbers"},
  };
}

class GridDamages : public testing::TestWithParam<GridDamage> {};

TEST_P(GridDamages, AreToldInOneLine) {
  const TemporaryDirectory directory;
  const std::string path = directory.write(GetParam().file, GetParam().bytes);
  const auto file = read_grid(path);
  ASSERT_FALSE(file);
  EXPECT_EQ(sentence(file.error()), path + ": " + GetParam().message);
}

INSTANTIATE_TEST_SUITE_P(Of, GridDamages, testing::ValuesIn(grid_damages()),
                         [](const auto& test) { return test.param.name; });

TEST(GridFiles, DamagedInTwoThousandWaysAreAnErrorOrAGrid) {
  const TemporaryDirectory directory;
  const auto samples = grid_samples();
  std::mt19937_64 random(7);
  int read = 0;
  for (int i = 0; i < 2000; ++i) {
    const GridSample& sample = samples[random() % samples.size()];
    std::string bytes = sample.bytes;
    for (std::size_t k = 1 + random() % 4; k > 0; --k) damage(bytes, random);
    const auto file = read_grid(directory.write(sample.file, bytes));
    if (!file) {
      const std::string said = sentence(file.error());
      EXPECT_EQ(said.find('\n'), std::string::npos) << said;
      continue;
    }
    ++read;
    EXPECT_TRUE(check_grid(file->grid)) << i;
  }
  EXPECT_GT(read, 100);
}

TEST(GridFiles, DistancesReadBackInTheShapeOfTheGrid) {
  const TemporaryDirectory directory;
  const Grid grid{{3, 2, 1}, {0.5, -2, 1}, Vec3(1, 2, 3), {}};
  const std::vector<double> distances = {0, 1, 2, 3.5, kUnreached, 7};
  for (const std::string name : {"d.npy", "d.csv", "d.vti"}) {
    ASSERT_TRUE(check_grid_distances_path(name));
    ASSERT_TRUE(write_distances(directory.path(name), grid, distances)) << name;
  }
  EXPECT_FALSE(check_grid_distances_path("d.vtu"));
  EXPECT_NE(bytes_of(directory.path("d.npy")).find("'shape': (2, 3), }"), std::string::npos);
  EXPECT_NE(bytes_of(directory.path("d.csv")).find("3,3.5\n"), std::string::npos);
  const std::string image = bytes_of(directory.path("d.vti"));
  EXPECT_NE(image.find("WholeExtent=\"0 2 0 1 0 0\" Origin=\"1 2 3\" Spacing=\"0.5 2 1\" "
                       "Direction=\"1 0 0 0 -1 0 0 0 1\""),
            std::string::npos);
  EXPECT_FALSE(write_distances(directory.path("e.npy"), grid, std::vector<double>(5)));
  ASSERT_TRUE(write_distances(directory.path("f.vti"), grid, std::vector<double>(6, 0.5)));
  const auto back = read_grid(directory.path("f.vti"));
  ASSERT_TRUE(back) << sentence(back.error());
  EXPECT_EQ(back->grid.size, grid.size);
  EXPECT_EQ(back->grid.spacing, grid.spacing);
  EXPECT_EQ(back->grid.origin, grid.origin);
}

TEST(GridFiles, ArraysKeepTheirAxesAndSayWhatWasLeftOut) {
  const TemporaryDirectory directory;
  const auto thin = read_grid(directory.write("a.npy", npy("|u1", "(1, 2, 3)", "abcdef")));
  ASSERT_TRUE(thin) << sentence(thin.error());
  ASSERT_TRUE(write_distances(directory.path("d.npy"), thin->grid, std::vector<double>(6, 1)));
  EXPECT_NE(bytes_of(directory.path("d.npy")).find("'shape': (1, 2, 3), }"), std::string::npos);

  const auto more =
      read_grid(directory.write("a.nrrd", kNrrd + "encoding: raw\n\n" + std::string(9, '\1')));
  ASSERT_TRUE(more) << sentence(more.error());
  EXPECT_EQ(more->notes, std::vector<std::string>{"3 bytes behind the samples were left out"});
  const auto coloured =
      read_grid(directory.write("a.png", png(2, 1, std::string("\0\0", 2), 3, kPalette)));
  ASSERT_TRUE(coloured) << sentence(coloured.error());
  EXPECT_EQ(coloured->meaning, "brightness of at least half passes, of a palette of 3 colours");
}

TEST(GridPoints, AreTheNearestThatPass) {
  Grid grid{{3, 3, 1}, {1, 1, 1}, Vec3::Zero(), {1, 1, 1, 1, 1, 1, 1, 1, 0}};
  const auto inside = closest_point(grid, {0.5, 0.25, 0});
  ASSERT_TRUE(inside);
  EXPECT_EQ(inside->sample, kNoIndex);
  EXPECT_EQ(inside->in_cell.cell, 0);
  EXPECT_EQ(inside->in_cell.weights, (std::vector<double>{0.375, 0.375, 0.125, 0.125}));
  EXPECT_EQ(closest_point(grid, {1.9, 1.8, 0})->sample, 5) << "the square has a wall";
  const auto outside = closest_point(grid, {-3, 0, 4});
  EXPECT_EQ(outside->sample, 0);
  EXPECT_NEAR(outside->distance, 5, 1e-12);
}

}  // namespace
}  // namespace geotherm::test
