// SPDX-License-Identifier: MIT
// Animations of glTF, as frames of a sequence: nodes, bones and morph targets by their formulas.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <numbers>

#include "solver/mesh/frames.h"
#include "tests/mesh/mesh_files.h"
#include "tests/volume/tet_files.h"

namespace geotherm::test {
namespace {

/// Arrays of a glTF file: their bytes, and the parts of the text that say where they lie.
class Arrays {
 public:
  /// Returns the number of its accessor. `type`: "VEC3".
  int add(const std::vector<float>& numbers, const std::string& type, int components,
          const std::string& more = "") {
    const std::string bytes(reinterpret_cast<const char*>(numbers.data()),
                            numbers.size() * sizeof(float));
    return add_bytes(bytes, 5126, type, numbers.size() / static_cast<std::size_t>(components),
                     more);
  }

  int add_bytes(const std::string& bytes, int kind, const std::string& type, std::size_t count,
                const std::string& more = "") {
    views_ += (views_.empty() ? "" : ",") + std::string(R"({"buffer":0,"byteOffset":)") +
              std::to_string(bytes_.size()) + R"(,"byteLength":)" + std::to_string(bytes.size()) +
              "}";
    accessors_ += (accessors_.empty() ? "" : ",") + std::string(R"({"bufferView":)") +
                  std::to_string(count_) + R"(,"componentType":)" + std::to_string(kind) +
                  R"(,"count":)" + std::to_string(count) + R"(,"type":")" + type + "\"" + more +
                  "}";
    bytes_ += bytes;
    return count_++;
  }

  std::string text() const {
    return R"("buffers":[{"byteLength":)" + std::to_string(bytes_.size()) +
           R"(,"uri":"data:application/octet-stream;base64,)" + base64(bytes_) +
           R"("}],"bufferViews":[)" + views_ + R"(],"accessors":[)" + accessors_ + "]";
  }

 private:
  std::string bytes_, views_, accessors_;
  int count_ = 0;
};

constexpr const char* kBox = R"(,"min":[0,0,0],"max":[1,1,0])";
const std::vector<float> kOneTriangle = {0, 0, 0, 1, 0, 0, 0, 1, 0};
/// Of a quarter turn about z, and of none.
const std::vector<float> kTurn = {
    0, 0, 0, 1, 0, 0, std::numbers::sqrt2_v<float> / 2, std::numbers::sqrt2_v<float> / 2};

/// A triangle whose node turns and moves in one second while its morph target comes up.
std::string moving_node() {
  Arrays arrays;
  const int corners = arrays.add(kOneTriangle, "VEC3", 3, kBox);
  const int target = arrays.add({0, 0, 0, 0, 0, 1, 0, 0, 0}, "VEC3", 3);
  const int times = arrays.add({0, 1}, "SCALAR", 1, R"(,"min":[0],"max":[1])");
  const int moves = arrays.add({0, 0, 0, 2, 0, 0}, "VEC3", 3);
  const int turns = arrays.add(kTurn, "VEC4", 4);
  const int weights = arrays.add({0, 1}, "SCALAR", 1);
  const auto sampler = [times](int values) {
    return R"({"input":)" + std::to_string(times) + R"(,"output":)" + std::to_string(values) + "}";
  };
  const auto channel = [](int number, const char* path) {
    return R"({"sampler":)" + std::to_string(number) + R"(,"target":{"node":0,"path":")" + path +
           "\"}}";
  };
  return R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],)"
         R"("nodes":[{"name":"n","mesh":0}],"meshes":[{"primitives":[{"attributes":{"POSITION":)" +
         std::to_string(corners) + R"(},"targets":[{"POSITION":)" + std::to_string(target) +
         R"(}]}],"weights":[0]}],"animations":[{"samplers":[)" + sampler(moves) + "," +
         sampler(turns) + "," + sampler(weights) + R"(],"channels":[)" + channel(0, "translation") +
         "," + channel(1, "rotation") + "," + channel(2, "weights") + "]}]," + arrays.text() + "}";
}

/// A triangle of two bones, of which one turns and the other stays: halves of both at vertex 1, the
/// turning one alone at vertex 2.
std::string skinned() {
  Arrays arrays;
  const int corners = arrays.add(kOneTriangle, "VEC3", 3, kBox);
  const int joints = arrays.add_bytes(std::string("\1\0\0\0\0\1\0\0\0\0\0\0", 12), 5121, "VEC4", 3);
  const int weights = arrays.add({1, 0, 0, 0, 0.5F, 0.5F, 0, 0, 1, 0, 0, 0}, "VEC4", 4);
  const int times = arrays.add({0, 1}, "SCALAR", 1, R"(,"min":[0],"max":[1])");
  const int turns = arrays.add(kTurn, "VEC4", 4);
  const std::vector<float> identity = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
  std::vector<float> both = identity;
  both.insert(both.end(), identity.begin(), identity.end());
  const int binds = arrays.add(both, "MAT4", 16);  // Assimp ends without them
  return R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0,1,2]}],)"
         R"("nodes":[{"name":"body","mesh":0,"skin":0,"translation":[7,7,7]},)"
         R"({"name":"turning"},{"name":"still"}],"skins":[{"joints":[1,2],"inverseBindMatrices":)" +
         std::to_string(binds) +
         R"(}],)"
         R"("meshes":[{"primitives":[{"attributes":{"POSITION":)" +
         std::to_string(corners) + R"(,"JOINTS_0":)" + std::to_string(joints) + R"(,"WEIGHTS_0":)" +
         std::to_string(weights) + R"(}}]}],"animations":[{"samplers":[{"input":)" +
         std::to_string(times) + R"(,"output":)" + std::to_string(turns) +
         R"(}],"channels":[{"sampler":0,"target":{"node":1,"path":"rotation"}}]}],)" +
         arrays.text() + "}";
}

/// The frames of a scene for the mesh in it; skips where no scenes are read.
#define GEOTHERM_OPEN_SCENE(frames, text)                                                   \
  const TemporaryDirectory folder;                                                          \
  const std::string path = folder.write("a.gltf", text);                                    \
  const auto file = read_mesh(path);                                                        \
  if (!file && sentence(file.error()).find("built") != std::string::npos) {                 \
    GTEST_SKIP() << sentence(file.error());                                                 \
  }                                                                                         \
  ASSERT_TRUE(file) << sentence(file.error());                                              \
  const auto frames = Frames::open(path, std::make_shared<const TriangleMesh>(file->mesh)); \
  ASSERT_TRUE(frames) << sentence(frames.error())

constexpr double kFloat = 1e-6;  // coordinates, times and turns are 32-bit numbers

TEST(MovingScene, FollowsItsNodesAndMorphTargets) {
  GEOTHERM_OPEN_SCENE(frames, moving_node());
  ASSERT_EQ(frames->count(), 25) << "one second of 24 frames, with both ends";
  EXPECT_EQ(frames->name(3), path + ": frame 3");
  const double half = std::numbers::sqrt2 / 2;
  for (const auto& [k, expected] :
       {std::pair(24, Vec3(2, 1, 1)), std::pair(12, Vec3(1 + half, half, 0.5)),
        std::pair(0, Vec3(1, 0, 0))}) {
    const auto frame = frames->read(k);
    ASSERT_TRUE(frame) << sentence(frame.error());
    EXPECT_LT((frame->positions()[1] - expected).norm(), kFloat) << "frame " << k;
  }
}

TEST(MovingScene, FollowsItsBonesAndNotTheNodeOfTheSkin) {
  GEOTHERM_OPEN_SCENE(frames, skinned());
  ASSERT_EQ(frames->count(), 25);
  const auto frame = frames->read(12);
  ASSERT_TRUE(frame) << sentence(frame.error());
  const double half = std::numbers::sqrt2 / 2;
  EXPECT_LT((frame->positions()[1] - Vec3((1 + half) / 2, half / 2, 0)).norm(), kFloat);
  EXPECT_LT((frame->positions()[2] - Vec3(-half, half, 0)).norm(), kFloat);
}

TEST(MovingScene, WithoutAnimationOrOfAnotherMeshIsOneLine) {
  std::string still = moving_node();
  const std::size_t from = still.find(R"("animations")"), to = still.find(R"("buffers")");
  still.erase(from, to - from);
  const TemporaryDirectory folder;
  const auto mesh = std::make_shared<const TriangleMesh>(
      *TriangleMesh::build(pyramid_positions(), pyramid_faces()));
  for (const auto& [text, says] :
       {std::pair(still, "the scene has no animation"),
        std::pair(moving_node(), "the frame has 3 vertices and 1 triangles, and the model 5")}) {
    const std::string path = folder.write("a.gltf", text);
    const auto frames = Frames::open(path, mesh);
    ASSERT_FALSE(frames);
    const std::string said = sentence(frames.error());
    if (said.find("built") != std::string::npos) GTEST_SKIP() << said;
    EXPECT_TRUE(said.starts_with(path + ": " + says)) << said;
  }
}

}  // namespace
}  // namespace geotherm::test
