// SPDX-License-Identifier: MIT
#include <fcntl.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <ostream>

#include "geotherm/domains.h"
#include "tests/mesh/mesh_files.h"

// What a header of NRRD has to say, and what would be misread without it.
namespace geotherm::test {
namespace {

const std::string kBytesHeader = "NRRD0004\ntype: uint8\ndimension: 2\nsizes: 3 2\n";

TEST(NrrdHeader, HasTheSameMeaningInCapitals) {
  const std::string header =
      "NRRD0004\nType: Short\nDimension: 2\nSizes: 3 2\nEndian: Big\nEncoding: RAW\n"
      "kinds: Domain SPACE\n\n";
  const TemporaryDirectory directory;
  const auto file =
      read_grid(directory.write("a.nrrd", header + std::string("\0\1\0\2\0\0\0\3\0\4\1\0", 12)),
                GridValues::kSpeeds);
  ASSERT_TRUE(file) << sentence(file.error());
  EXPECT_EQ(file->grid.speeds, (std::vector<double>{1, 2, 0, 3, 4, 256}));
}

TEST(NrrdHeader, SpacingsThatAreNotKnownAreOne) {
  const TemporaryDirectory directory;
  for (const std::string& header :
       {kBytesHeader + "spacings: nan nan\n",
        std::string("NRRD0004\ntype: uint8\ndimension: 3\nspacings: nan 1 1\nsizes: 1 3 2\n")}) {
    const auto file = read_grid(directory.write("a.nrrd", header + "encoding: raw\n\n123456"));
    ASSERT_TRUE(file) << sentence(file.error());
    EXPECT_EQ(file->grid.spacing, (std::array<double, 3>{1, 1, 1})) << header;
  }
}

TEST(NrrdHeader, DirectionsThatAreNoNumbersAreRefused) {
  const TemporaryDirectory directory;
  for (const std::string second : {"1", "nan"}) {
    const std::string directions = "space directions: (nan,0) (0," + second + ")\n";
    const auto file =
        read_grid(directory.write("a.nrrd", kBytesHeader + directions + "encoding: raw\n\n123456"));
    ASSERT_FALSE(file) << second;
    EXPECT_NE(sentence(file.error()).find("axis 0 of the grid has a spacing of nan"),
              std::string::npos);
  }
}

struct NrrdDamage {
  std::string name, bytes, message;
};
std::ostream& operator<<(std::ostream& out, const NrrdDamage& d) { return out << d.name; }

std::vector<NrrdDamage> nrrd_damages() {
  const std::string doubles = "NRRD0004\ntype: double\ndimension: 2\nsizes: 3 2\n";
  return {
      {"no_endian", doubles + "encoding: raw\n\n" + std::string(48, '\1'),
       "the samples have 8 bytes each, and the header has no endian, the order of them; add the "
       "line endian: little, or endian: big"},
      {"endian", doubles + "endian: middle\n\n",
       "line 5: the endian \"middle\" is unknown; it is big or little"},
      {"no_dimension", "NRRD0004\ntype: uint8\nsizes: 3 2\n\n123456",
       "line 3: there are 2 sizes, and the dimension is not given; give a size for each axis"},
      {"dimension", "NRRD0004\ntype: uint8\ndimension: 3\nsizes: 3 2\n\n123456",
       "line 4: there are 2 sizes, and the dimension is 3; give a size for each axis"},
      {"spacings", kBytesHeader + "spacings: 0.5\n\n123456",
       "line 5: there are 2 sizes, but this is said of 1 axis"},
      {"spacing_unknown", kBytesHeader + "spacings: nan 2\n\n123456",
       "line 5: the spacing along one axis is nan, and that along another is not; give all of "
       "them"},
      {"directions", kBytesHeader + "space directions: (1,0,0) (0,1,0) (0,0,1)\n\n123456",
       "line 5: there are 2 sizes, but this is said of 3 axes"},
      {"elsewhere", kBytesHeader + "data file: /etc/passwd\n",
       "line 5: the samples are in /etc/passwd, outside the folder of the header; move them beside "
       "it, and name the file alone"},
      {"above", kBytesHeader + "data file: ../a.raw\n",
       "line 5: the samples are in ../a.raw, outside the folder of the header; move them beside "
       "it, and name the file alone"},
  };
}

class NrrdDamages : public testing::TestWithParam<NrrdDamage> {};

TEST_P(NrrdDamages, AreToldInOneLine) {
  const TemporaryDirectory directory;
  const std::string path = directory.write("a.nhdr", GetParam().bytes);
  const auto file = read_grid(path);
  ASSERT_FALSE(file);
  EXPECT_EQ(sentence(file.error()), path + ": " + GetParam().message);
}

INSTANTIATE_TEST_SUITE_P(Of, NrrdDamages, testing::ValuesIn(nrrd_damages()),
                         [](const auto& test) { return test.param.name; });

TEST(NrrdHeader, InAStreamHasNoFileBesideIt) {
  const TemporaryDirectory directory;
  const std::string path =
      directory.write("a.nhdr", kBytesHeader + "encoding: raw\ndata file: a.raw\n");
  const int descriptor = ::open(path.c_str(), O_RDONLY);
  const auto input = ModelInput::stream(descriptor, "the stream");
  ::close(descriptor);
  ASSERT_TRUE(input) << sentence(input.error());
  EXPECT_EQ(sentence(read_grid(*input).error()),
            "the stream: the samples are in a file beside it, a.raw, and nothing is beside a "
            "stream; name the file of the header");
}

}  // namespace
}  // namespace geotherm::test
