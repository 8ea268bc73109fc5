// SPDX-License-Identifier: MIT
// Frames of a surface that moves: what is in their files, and what is wrong with them.
#include "solver/mesh/frames.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <random>

#include "tests/mesh/mesh_files.h"

namespace geotherm::test {
namespace {

using Positions = std::vector<Vec3>;

/// A triangle in two frames; every number is a float.
const std::array<Positions, 2> kFrames = {
    Positions{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}},
    Positions{{0, 0, 0.5}, {1, 0, -2}, {0, 1.25, 3}},
};

std::shared_ptr<const TriangleMesh> mesh_of(Positions positions, std::vector<Face> faces) {
  return std::make_shared<const TriangleMesh>(
      *TriangleMesh::build(std::move(positions), std::move(faces)));
}

std::shared_ptr<const TriangleMesh> triangle() { return mesh_of(kFrames[0], {{0, 1, 2}}); }

// Written by Python: struct.pack('<12siiffi', b'POINTCACHE2\0', 1, 3, 0.0, 1.0, 2) and '<18f'.
constexpr std::string_view kPointCache =
    "504f494e54434143484532000100000003000000000000000000803f020000000000000000000000"
    "000000000000803f0000000000000000000000000000803f0000000000000000000000000000003f"
    "0000803f00000000000000c0000000000000a03f00004040";

// Written by Python: struct.pack('>2i', 2, 3), '>2f' of the times 0 and 1/24, and '>18f'.
constexpr std::string_view kMotionDesigner =
    "0000000200000003000000003d2aaaab0000000000000000000000003f8000000000000000000000"
    "000000003f8000000000000000000000000000003f0000003f80000000000000c000000000000000"
    "3fa0000040400000";

std::string from_hex(std::string_view digits) {
  std::string bytes;
  for (std::size_t i = 0; i < digits.size(); i += 2) {
    bytes += static_cast<char>(std::stoi(std::string(digits.substr(i, 2)), nullptr, 16));
  }
  return bytes;
}

template <class Number>
void append_number(std::string& bytes, Number number, std::endian order) {
  std::array<char, sizeof(Number)> raw{};
  std::memcpy(raw.data(), &number, sizeof(Number));
  if (order != std::endian::native) std::ranges::reverse(raw);
  bytes.append(raw.data(), raw.size());
}

template <class Number>
std::string numbers(std::endian order) {
  std::string bytes;
  for (const Positions& frame : kFrames) {
    for (const Vec3& p : frame) {
      for (int axis = 0; axis < 3; ++axis)
        append_number(bytes, static_cast<Number>(p[axis]), order);
    }
  }
  return bytes;
}

std::string npy(const std::string& type, const std::string& shape, const std::string& data,
                bool fortran = false) {
  const std::string header = "{'descr': '" + type +
                             "', 'fortran_order': " + (fortran ? "True" : "False") +
                             ", 'shape': " + shape + ", }\n";
  std::string bytes("\x93NUMPY\x01\x00", 8);
  append_number(bytes, static_cast<std::uint16_t>(header.size()), std::endian::little);
  return bytes + header + data;
}

constexpr auto kLittleFrames = std::endian::little, kBigFrames = std::endian::big;

std::vector<Sample> sequence_samples() {
  return {{"pc2", "walk.pc2", from_hex(kPointCache)},
          {"mdd", "walk.mdd", from_hex(kMotionDesigner)},
          {"npy_double", "walk.npy", npy("<f8", "(2, 3, 3)", numbers<double>(kLittleFrames))},
          {"npy_float", "walk.npy", npy("<f4", "(2, 3, 3)", numbers<float>(kLittleFrames))},
          {"npy_big", "walk.NPY", npy(">f8", "(2, 3, 3)", numbers<double>(kBigFrames))}};
}

class FrameFile : public testing::TestWithParam<Sample> {};

TEST_P(FrameFile, HoldsThePositionsOfEachFrame) {
  const TemporaryDirectory folder;
  const std::string path = folder.write(GetParam().file, GetParam().bytes);
  const auto mesh = triangle();
  const auto frames = Frames::open(path, mesh);
  ASSERT_TRUE(frames) << frames.error().message;
  ASSERT_EQ(frames->count(), 2);
  EXPECT_EQ(frames->name(1), path + ": frame 1");
  for (const std::int64_t k : {1, 0}) {  // in any order
    EXPECT_EQ(frames->number(k), k);
    const auto frame = frames->read(k);
    ASSERT_TRUE(frame) << frame.error().message;
    EXPECT_TRUE(std::ranges::equal(frame->positions(), kFrames[static_cast<std::size_t>(k)]));
    EXPECT_TRUE(check_moved(*mesh, *frame));
  }
}

TEST_P(FrameFile, IsRefusedWithBothNumbersForAnotherMesh) {
  const TemporaryDirectory folder;
  const std::string path = folder.write(GetParam().file, GetParam().bytes);
  const auto frames = Frames::open(path, mesh_of(pyramid_positions(), pyramid_faces()));
  ASSERT_FALSE(frames);
  EXPECT_EQ(frames.error().code, ErrorCode::kBadFile);
  EXPECT_EQ(sentence(frames.error()), path +
                                          ": its frames have 3 vertices, and the model 5; all "
                                          "frames have the vertices and faces of the model");
}

TEST_P(FrameFile, IsRefusedWhereItIsShorterOrLongerThanItsHeaderSays) {
  const TemporaryDirectory folder;
  const std::string& bytes = GetParam().bytes;
  for (std::size_t size = 1; size < bytes.size(); ++size) {
    const std::string path = folder.write(GetParam().file, bytes.substr(0, size));
    const auto frames = Frames::open(path, triangle());
    ASSERT_FALSE(frames) << size;
    ASSERT_TRUE(sentence(frames.error()).starts_with(path + ": ")) << sentence(frames.error());
  }
  const std::string cut = folder.write(GetParam().file, bytes.substr(0, bytes.size() - 1));
  const auto shorter = Frames::open(cut, triangle());
  ASSERT_FALSE(shorter);
  EXPECT_NE(sentence(shorter.error()).find("the header announces 2 frames of 3 vertices, and "),
            std::string::npos);
  EXPECT_NE(sentence(shorter.error()).find("1 whole frames: the file was cut short"),
            std::string::npos)
      << sentence(shorter.error());
  const auto longer = Frames::open(folder.write(GetParam().file, bytes + "x"), triangle());
  ASSERT_FALSE(longer);
  EXPECT_NE(sentence(longer.error()).find("the header does not fit the file"), std::string::npos);
}

TEST_P(FrameFile, ThatIsDamagedGivesFramesOrOneLineOfWhyNot) {
  constexpr int kInputs = 2000;
  constexpr std::uint64_t kSeed = 20261;
  const TemporaryDirectory folder;
  std::mt19937_64 random(kSeed);
  const auto mesh = triangle();
  int refused = 0;
  const auto expect_a_line = [&](const Error& error, const std::string& path) {
    ++refused;
    const std::string line = sentence(error);
    ASSERT_TRUE(line.starts_with(path + ": ")) << line;
    ASSERT_LT(line.size(), path.size() + 300) << line;
    for (const char c : line) ASSERT_TRUE(c >= ' ' && c < 0x7f) << line;
  };
  for (int i = 0; i < kInputs; ++i) {
    std::string bytes = GetParam().bytes;
    for (std::size_t k = 1 + random() % 3; k > 0; --k) damage(bytes, random);
    const std::string path = folder.write(GetParam().file, bytes);
    const auto frames = Frames::open(path, mesh);
    if (!frames) {
      expect_a_line(frames.error(), path);
      continue;
    }
    for (std::int64_t k = 0; k < frames->count(); ++k) {
      const auto frame = frames->read(k);
      if (!frame) {
        expect_a_line(frame.error(), path);
        continue;
      }
      for (const Vec3& p : frame->positions()) ASSERT_TRUE(p.allFinite());
    }
  }
  EXPECT_GT(refused, kInputs / 10);
  EXPECT_LT(refused, kInputs);
}

INSTANTIATE_TEST_SUITE_P(Formats, FrameFile, testing::ValuesIn(sequence_samples()),
                         [](const auto& test) { return test.param.name; });

struct Damaged {
  std::string name, file, bytes, says;
};
void PrintTo(const Damaged& damaged, std::ostream* out) { *out << damaged.name; }

std::string with(std::string bytes, std::size_t at, std::string_view other) {
  return bytes.replace(at, other.size(), other);
}

class DamagedFrameFile : public testing::TestWithParam<Damaged> {};

TEST_P(DamagedFrameFile, SaysWhatIsWrong) {
  const TemporaryDirectory folder;
  const std::string path = folder.write(GetParam().file, GetParam().bytes);
  const auto frames = Frames::open(path, triangle());
  ASSERT_FALSE(frames);
  EXPECT_NE(sentence(frames.error()).find(GetParam().says), std::string::npos)
      << sentence(frames.error());
}

INSTANTIATE_TEST_SUITE_P(
    Each, DamagedFrameFile,
    testing::Values(
        Damaged{"pc2_magic", "a.pc2", with(from_hex(kPointCache), 0, "pointcache2"),
                "byte 0: a point cache starts with the word POINTCACHE2"},
        Damaged{"pc2_version", "a.pc2", with(from_hex(kPointCache), 12, "\7"),
                "byte 12: version 7 is unknown; there is 1"},
        Damaged{"pc2_header", "a.pc2", from_hex(kPointCache).substr(0, 20),
                "the file ends in its header of 32 bytes"},
        Damaged{"pc2_negative", "a.pc2", with(from_hex(kPointCache), 28, "\xff\xff\xff\xff"),
                "the header announces -1 frames of 3 vertices"},
        Damaged{"mdd_little", "a.mdd",
                with(from_hex(kMotionDesigner), 0, std::string("\2\0\0\0", 4)),
                "the header announces 33554432 frames of 3 vertices"},
        Damaged{"mdd_none", "a.mdd", std::string(8, '\0'), "announces 0 frames of 0 vertices"},
        Damaged{
            "npy_type", "a.npy", npy("<i4", "(2, 3, 3)", numbers<float>(kLittleFrames)),
            "byte 20: positions are float32 or float64 numbers, not \"'<i4',\"; save them with"},
        Damaged{"npy_plane", "a.npy", npy("<f4", "(2, 9)", numbers<float>(kLittleFrames)),
                "the array is 2 x 9, and positions are frames x vertices x 3"},
        Damaged{"npy_four", "a.npy", npy("<f4", "(2, 3, 4)", numbers<float>(kLittleFrames)),
                "the array is 2 x 3 x 4, and positions"},
        Damaged{"npy_fortran", "a.npy",
                npy("<f4", "(2, 3, 3)", numbers<float>(kLittleFrames), true), "fortran_order"},
        Damaged{"npy_huge", "a.npy", npy("<f8", "(999999999999999999, 3, 3)", "abcd"),
                "the file was cut short"},
        Damaged{"other", "a.obj", "v 0 0 0\n", "is no sequence of frames; give numbered meshes"}),
    [](const auto& test) { return test.param.name; });

TEST(FrameFileWithNaN, NamesFrameAndVertexAndTheOthersAreRead) {
  std::string data = numbers<double>(kLittleFrames);
  std::string bad;
  append_number(bad, std::nan(""), kLittleFrames);
  data.replace(10 * sizeof(double), sizeof(double), bad);  // frame 1, vertex 0
  const TemporaryDirectory folder;
  const std::string path = folder.write("walk.npy", npy("<f8", "(2, 3, 3)", data));
  const auto frames = Frames::open(path, triangle());
  ASSERT_TRUE(frames);
  EXPECT_TRUE(frames->read(0));
  const auto frame = frames->read(1);
  ASSERT_FALSE(frame);
  EXPECT_EQ(frame.error().code, ErrorCode::kBadFile);
  EXPECT_EQ(frame.error().message,
            path + ": frame 1: vertex 0 has a coordinate that is not finite");
}

TEST(NumberedFrames, BeginAtTheLeastNumberAndEndAtTheLargest) {
  const TemporaryDirectory folder;
  const std::string face = "f 1 2 3\n";
  folder.write("f_0003.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n" + face);
  folder.write("f_0004.obj", "v 0 0 1\nv 1 0 0\nv 0 1 0\n" + face);
  folder.write("f_0006.obj", "v 0 0 2\nv 1 0 0\nv 0 1 0\n" + face);
  folder.write("f_7.obj", "has too few digits");
  folder.write("f_00010.obj", "has too many");
  folder.write("f_0008.obj.bak", "is another file");
  const auto frames = Frames::open(folder.path("f_%04d.obj"), triangle());
  ASSERT_TRUE(frames) << frames.error().message;
  ASSERT_EQ(frames->count(), 4);
  EXPECT_EQ(frames->number(0), 3);
  EXPECT_EQ(frames->name(1), folder.path("f_0004.obj"));
  EXPECT_EQ(frames->read(3)->positions()[0].z(), 2);
  const auto missing = frames->read(2);
  ASSERT_FALSE(missing);
  EXPECT_EQ(sentence(missing.error()),
            folder.path("f_0005.obj") + ": no such file; check the path");
}

TEST(NumberedFrames, MayHaveMoreDigitsThanTheyAreToHave) {
  const TemporaryDirectory folder;
  for (const int k : {99, 100}) {
    folder.write("f" + std::to_string(k) + ".obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  }
  const auto frames = Frames::open(folder.path("f%02d.obj"), triangle());
  ASSERT_TRUE(frames) << frames.error().message;
  EXPECT_EQ(frames->count(), 2);
  EXPECT_EQ(frames->name(1), folder.path("f100.obj"));
}

TEST(NumberedFrames, OfAnotherMeshAreRefusedWithTheNumbers) {
  const TemporaryDirectory folder;
  folder.write("f0.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nf 1 2 3\n");
  folder.write("f1.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 3 2\n");
  const auto frames = Frames::open(folder.path("f%d.obj"), triangle());
  ASSERT_TRUE(frames);
  EXPECT_EQ(frames->read(0).error().message,
            folder.path("f0.obj") +
                ": the frame has 4 vertices and 1 triangles, and the model 3 vertices and 1 "
                "triangles");
  EXPECT_EQ(frames->read(1).error().message,
            folder.path("f1.obj") + ": triangle 0 has other corners than in the model");
}

TEST(NumberedFrames, KeepTheTrianglesOfPolygonsThatWouldBeCutOtherwise) {
  const TemporaryDirectory folder;
  const std::string face = "f 1 2 3 4\nf 1 5 2\n";
  const std::string square = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 -1 0\n";
  const std::string arrow = "v 0 0 0\nv 1 0 0\nv 0.2 0.2 0\nv 0 1 0\nv 0 -1 0\n";
  const std::string dart = "v 0 0 0\nv 0.2 0.4 0\nv 1 1 0\nv 0 1 0\nv 0 -1 0\n";
  const auto model = read_mesh(folder.write("square.obj", square + face));
  ASSERT_TRUE(model);
  folder.write("f0.obj", arrow + face);
  folder.write("f1.obj", dart + face);
  // One of them is cut along the other diagonal where it is read by itself.
  const auto alone = [&](const char* name) {
    const auto mesh = read_mesh(folder.path(name))->mesh;
    return std::vector<Face>(mesh.faces().begin(), mesh.faces().end());
  };
  ASSERT_NE(alone("f0.obj"), alone("f1.obj"));
  const auto mesh = std::make_shared<const TriangleMesh>(model->mesh);
  const auto frames = Frames::open(folder.path("f%d.obj"), mesh);
  ASSERT_TRUE(frames);
  for (const std::int64_t k : {0, 1}) {
    const auto frame = frames->read(k);
    ASSERT_TRUE(frame) << frame.error().message;
    EXPECT_TRUE(std::ranges::equal(frame->faces(), mesh->faces()));
  }
  EXPECT_EQ(frames->read(0)->positions()[2], Vec3(0.2, 0.2, 0));
}

TEST(NumberedFrames, OfAWeldedModelStayWelded) {
  const TemporaryDirectory folder;
  const std::string face = "f 1 2 3\nf 4 5 6\n";
  const auto model = read_mesh(
      folder.write("m.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n" + face));
  ASSERT_TRUE(model);
  folder.write("f0.obj", "v 0 0 2\nv 1 0 0\nv 0 1 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n" + face);
  const auto welded = std::make_shared<const TriangleMesh>(weld(model->mesh, 0)->mesh);
  const auto frames = Frames::open(folder.path("f%d.obj"), welded);
  ASSERT_TRUE(frames);
  const auto frame = frames->read(0);
  ASSERT_TRUE(frame) << frame.error().message;
  EXPECT_EQ(frame->positions()[0].z(), 2);
  EXPECT_TRUE(std::ranges::equal(frame->same_as(), welded->same_as()));
}

TEST(NumberedPaths, AreReadAndRefused) {
  EXPECT_EQ(NumberedPath::parse("a/f_%04d.obj")->path(7), "a/f_0007.obj");
  EXPECT_EQ(NumberedPath::parse("a/f_%04d.obj")->path(12345), "a/f_12345.obj");
  EXPECT_EQ(NumberedPath::parse("f%d")->path(0), "f0");
  for (const char* wrong : {"f.obj", "f%s.obj", "f%.obj", "f%0d.obj", "f%4d.obj", "f%d_%d.obj",
                            "f%d/a.obj", "f%", "f%0"}) {
    const auto path = NumberedPath::parse(wrong);
    ASSERT_FALSE(path) << wrong;
    EXPECT_EQ(path.error().code, ErrorCode::kBadInput);
    EXPECT_NE(sentence(path.error()).find("write %d, or %04d for four digits"), std::string::npos);
  }
}

TEST(FrameFiles, ThatAreMissingAskForThePath) {
  const TemporaryDirectory folder;
  for (const char* name : {"f.npy", "f.glb"}) {
    const auto none = Frames::open(folder.path(name), triangle());
    ASSERT_FALSE(none);
    EXPECT_EQ(sentence(none.error()), folder.path(name) + ": no such file; check the path");
  }
}

TEST(NumberedPaths, WithoutAFileSayWhatIsMissing) {
  const TemporaryDirectory folder;
  const auto none = Frames::open(folder.path("f_%04d.obj"), triangle());
  ASSERT_FALSE(none);
  EXPECT_EQ(none.error().code, ErrorCode::kBadFile);
  EXPECT_NE(none.error().message.find("there is no such file, whatever the number"),
            std::string::npos);
  const auto nowhere = Frames::open(folder.path("no/f_%04d.obj"), triangle());
  ASSERT_FALSE(nowhere);
  EXPECT_NE(nowhere.error().message.find("No such file or directory"), std::string::npos)
      << nowhere.error().message;
}

}  // namespace
}  // namespace geotherm::test
