// SPDX-License-Identifier: MIT
// Files that others write while they are read, and texts that are read by pieces.
#include <gtest/gtest.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <fstream>
#include <functional>
#include <random>
#include <string>
#include <thread>
#include <utility>

#include "geotherm/domains.h"
#include "geotherm/io.h"
#include "solver/distributed/mesh_part.h"
#include "tests/mesh/mesh_files.h"

namespace geotherm::test {
namespace {

std::string grid_obj(int side) {
  std::string text;
  for (int y = 0; y <= side; ++y) {
    for (int x = 0; x <= side; ++x) {
      text += "v " + std::to_string(x) + ' ' + std::to_string(y) + " 0\n";
    }
  }
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side; ++x) {
      const int corner = y * (side + 1) + x + 1;
      text += "f " + std::to_string(corner) + ' ' + std::to_string(corner + 1) + ' ' +
              std::to_string(corner + side + 2) + ' ' + std::to_string(corner + side + 1) + '\n';
    }
  }
  return text;
}

class ChangingFile : public testing::TestWithParam<const char*> {};

TEST_P(ChangingFile, IsAMeshOrOneLineOfErrorWhileItIsTruncatedByAParallelThread) {
  constexpr int kReads = 60, kSide = 300;
  const TemporaryDirectory folder;
  const std::string obj = folder.write("a.obj", grid_obj(kSide));
  const std::string path = folder.path(GetParam());
  const auto whole = read_mesh(obj);
  ASSERT_TRUE(whole);
  ASSERT_TRUE(write_mesh(path, whole->mesh));
  const std::string bytes = bytes_of(path);
  std::atomic<bool> ended = false;
  std::thread writer([&] {
    while (!ended) {
      EXPECT_EQ(::truncate(path.c_str(), static_cast<off_t>(bytes.size() / 3)), 0);
      folder.write(GetParam(), bytes);
    }
  });
  int failures = 0;
  for (int i = 0; i < kReads; ++i) {
    const auto file = read_mesh(path);
    if (file) {  // of the file as it stood for a while, which may end at any line
      EXPECT_LE(file->mesh.vertex_count(), whole->mesh.vertex_count());
      EXPECT_LE(file->mesh.face_count(), whole->mesh.face_count());
    } else {
      ++failures;
      EXPECT_EQ(sentence(file.error()).find('\n'), std::string::npos);
    }
  }
  ended = true;
  writer.join();
  EXPECT_GT(failures, 0) << "the file was never changed while it was read";
}

INSTANTIATE_TEST_SUITE_P(EveryFormat, ChangingFile,
                         testing::Values("a.obj", "a.ply", "a.off", "a.stl"),
                         [](const auto& test) { return std::string(test.param).substr(2); });

/// What is said of a file to which another thread appends blank lines all the while: that it was
/// changed, or what was said last after some seconds.
std::string said_of_growing(const std::string& path, const std::function<std::string()>& read) {
  constexpr std::chrono::seconds kMost(10);
  std::atomic<bool> ended = false;
  std::thread writer([&] {
    std::ofstream file(path, std::ios::app);
    while (!ended) file.put('\n').flush();
  });
  std::string said;
  const auto last = std::chrono::steady_clock::now() + kMost;
  do {
    said = read();
  } while (said.find("was changed") == said.npos && std::chrono::steady_clock::now() < last);
  ended = true;
  writer.join();
  return said;
}

TEST(GrowingFiles, AreSaidToChangeBeforeWhatIsWrongInThem) {
  const TemporaryDirectory folder;
  const std::string header =
      "NRRD0004\ntype: uint8\ndimension: 2\nsizes: 30000 30000\nencoding: raw\n";
  const auto triangle =
      TriangleMesh::build({Vec3::Zero(), Vec3::UnitX(), Vec3::UnitY()}, {{0, 1, 2}});
  ASSERT_TRUE(triangle);
  const std::string image = folder.write("a.nrrd", header + "\n1");
  const std::string outside = folder.write("b.nhdr", header + "data file: b.raw\n\n");
  const std::string samples = folder.write("b.raw", "1");
  const std::string mask = folder.write("c.txt", "7 8 9\n");
  const std::string part = folder.write(
      "d.ply",
      "ply\nformat binary_little_endian 1.0\nelement vertex 900000000\nproperty double x\n"
      "property double y\nproperty double z\nelement face 1\n"
      "property list uchar int vertex_indices\nend_header\n1");
  const std::pair<std::string, std::function<std::string()>> reads[] = {
      {image, [&] { return sentence(read_grid(image).error()); }},
      {samples, [&] { return sentence(read_grid(outside).error()); }},
      {mask, [&] { return sentence(read_mask(mask, *triangle).error()); }},
      {part, [&] { return sentence(read_ply_slice(part, 0, 2).error()); }},
  };
  for (const auto& [path, read] : reads) {
    const std::string said = said_of_growing(path, read);
    EXPECT_TRUE(said.starts_with(path + ": was changed while it was read")) << said;
  }
}

TEST(ObjPieces, GiveTheMeshOfTheWholeWhereverLinesEnd) {
  std::mt19937_64 random(3);
  std::uniform_int_distribution<int> any(0, 9999);
  std::string text = "\xef\xbb\xbf";
  std::vector<Vec3> positions;
  std::vector<Face> faces;
  const char* const ends[] = {"\n", "\r\n", " \\\n\n", " # a remark\n"};
  while (text.size() < 3'000'000) {
    const int kind = any(random) % 8;
    if (kind == 0 && any(random) % 50 == 0) {
      text += "# " + std::string(static_cast<std::size_t>(40 * any(random)), 'x') + '\n';
    } else if (kind < 4 || positions.size() < 3) {
      const Vec3 p(any(random), any(random), any(random));
      positions.push_back(p);
      text += "v " + std::to_string(static_cast<int>(p.x())) + " \\\n" +
              std::to_string(static_cast<int>(p.y())) + ' ' +
              std::to_string(static_cast<int>(p.z())) + ends[any(random) % 4];
    } else {
      const auto count = static_cast<Index>(positions.size());
      faces.push_back({count - 1, count - 2, count - 3});
      text += any(random) % 2 == 0
                  ? "f -1 -2 -3"
                  : "f " + std::to_string(count) + ' ' + std::to_string(count - 1) + " \\\r\n" +
                        std::to_string(count - 2);
      text += ends[any(random) % 4];
    }
  }
  const auto file = read_bytes("a.obj", text);
  ASSERT_TRUE(file) << file.error().message;
  EXPECT_TRUE(std::ranges::equal(file->mesh.positions(), positions));
  EXPECT_TRUE(std::ranges::equal(file->mesh.faces(), faces));
  // The line of a failure behind many pieces is that of the file.
  const auto lines = std::ranges::count(text, '\n');
  for (const char* const bad : {"v 1 x 2\n", "f 1 2 99999999\n"}) {
    const auto failed = read_bytes("b.obj", text + bad);
    ASSERT_FALSE(failed);
    EXPECT_NE(sentence(failed.error()).find(": line " + std::to_string(lines + 1) + ": "),
              std::string::npos)
        << failed.error().message;
  }
}

}  // namespace
}  // namespace geotherm::test
