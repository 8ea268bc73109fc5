// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "bench/models/volumes.h"
#include "geotherm/domains.h"
#include "tests/mesh/mesh_files.h"
#include "tests/volume/tet_files.h"

namespace geotherm::test {
namespace {

TEST(TetWriter, FilesReadBackAsTheyWere) {
  const TetMesh ball = make_ball_tets(3);
  const TemporaryDirectory directory;
  for (const std::string name : {"a.mesh", "a.vtu"}) {
    const std::string path = directory.path(name);
    ASSERT_TRUE(write_tets(path, ball));
    const Result<TetFile> file = read_tets(path);
    ASSERT_TRUE(file) << sentence(file.error());
    EXPECT_TRUE(file->notes.empty());
    EXPECT_TRUE(std::ranges::equal(file->mesh.positions(), ball.positions()));
    EXPECT_TRUE(std::ranges::equal(file->mesh.tets(), ball.tets()));
  }
  EXPECT_EQ(directory.names(), (std::vector<std::string>{"a.mesh", "a.vtu"}));
}

TEST(TetWriter, DistancesStandBesideTheVolume) {
  const TetMesh& box = small_box();
  std::vector<double> distances;
  for (const Vec3& p : box.positions()) distances.push_back(p.norm());
  distances[7] = kUnreached;
  const std::vector<Index> nearest = {0, 0, 0, 1, 1, 1, 0, kNoIndex};
  const std::vector<DataField> fields = {
      {"height", DataField::Place::kVertices, DataField::Type::kFloat64, distances},
      {"part", DataField::Place::kFaces, DataField::Type::kUint8, {0, 1, 2, 3, 4, 255}}};
  const TemporaryDirectory directory;
  const std::string path = directory.path("d.vtu");
  ASSERT_TRUE(write_distances(path, box, distances, nearest, fields));
  const std::string bytes = bytes_of(path);
  EXPECT_NE(bytes.find("<DataArray type=\"Float64\" Name=\"distance\" format=\"appended\" "
                       "offset=\"0\"/>"),
            bytes.npos);
  // 8 lengths of 8 bytes, and what they announce.
  const std::size_t begin = bytes.find("\n_") + 2;
  const std::size_t size = bytes.find("\n</AppendedData>") - begin;
  EXPECT_EQ(size, 8U * 8 + 64 + 32 + 64 + 6 + 192 + 96 + 48 + 6);
  EXPECT_EQ(read_tets(path)->mesh.tet_count(), 6);

  const std::string csv = directory.path("d.csv");
  ASSERT_TRUE(write_distances(csv, box, distances, nearest));
  EXPECT_TRUE(bytes_of(csv).starts_with("vertex,distance,nearest_source\n0,0,0\n1,2,0\n"));
  ASSERT_TRUE(write_distances(directory.path("d.npy"), box, distances));
}

TEST(TetWriter, SaysWhatItCannotWrite) {
  const TetMesh& box = small_box();
  const std::vector<double> distances(8, 1.0);
  const TemporaryDirectory directory;
  EXPECT_EQ(sentence(write_tets("a.ply", box).error()),
            "a.ply: unknown extension \".ply\" for a volume; there are .mesh .vtu");
  EXPECT_EQ(sentence(write_distances("a.mesh", box, distances).error()),
            "a.mesh: unknown extension \".mesh\" for a volume; there are .csv .npy .vtu");
  EXPECT_EQ(sentence(write_distances("a.vtu", box, std::vector<double>(3)).error()),
            "a.vtu: 3 distances for 8 vertices or tetrahedra");
  const DataField field{"f", DataField::Place::kFaces, DataField::Type::kFloat64,
                        std::vector<double>(6)};
  EXPECT_EQ(sentence(write_distances("a.csv", box, distances, {}, {&field, 1}).error()),
            "a.csv: .csv holds no field \"f\"; write .vtu");
  EXPECT_FALSE(write_tets(directory.path("no/such/folder.vtu"), box));
  EXPECT_TRUE(directory.names().empty());
}

}  // namespace
}  // namespace geotherm::test
