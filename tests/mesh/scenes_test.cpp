// SPDX-License-Identifier: MIT
// glTF, Collada and 3MF: all meshes where the scene places them, with vertices that are joined.
#include <gtest/gtest.h>

#include <bit>
#include <cstdint>
#include <cstring>

#include "tests/mesh/mesh_files.h"
#include "tests/volume/tet_files.h"

namespace geotherm::test {
namespace {

/// The pyramid as a .gltf, every face with vertices of its own. `buffer`: its URI.
std::string gltf_buffer() {
  std::string bytes;
  for (const Face& face : pyramid_faces()) {
    for (const Index corner : face) {
      for (int axis = 0; axis < 3; ++axis) {
        const auto x =
            static_cast<float>(pyramid_positions()[static_cast<std::size_t>(corner)][axis]);
        bytes.append(reinterpret_cast<const char*>(&x), sizeof x);
      }
    }
  }
  for (std::uint16_t k = 0; k < 18; ++k) bytes.append(reinterpret_cast<const char*>(&k), sizeof k);
  return bytes;
}

std::string gltf(const std::string& uri, const std::string& nodes, int mode = 4) {
  return R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":)" + nodes +
         R"(,"meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1,"mode":)" +
         std::to_string(mode) + R"(}]}],"buffers":[{"byteLength":252,"uri":")" + uri +
         R"("}],"bufferViews":[{"buffer":0,"byteLength":216},{"buffer":0,"byteOffset":216,)"
         R"("byteLength":36}],"accessors":[{"bufferView":0,"componentType":5126,"count":18,)"
         R"("type":"VEC3","min":[0,0,0],"max":[2,2,1.5]},{"bufferView":1,"componentType":5123,)"
         R"("count":18,"type":"SCALAR"}]})";
}

std::string embedded() { return "data:application/octet-stream;base64," + base64(gltf_buffer()); }

/// Skips where the library was built without what reads scenes.
#define GEOTHERM_NEEDS_SCENES()                                     \
  if (const auto there = read_bytes("a.glb", "x");                  \
      sentence(there.error()).find("built") != std::string::npos) { \
    GTEST_SKIP() << sentence(there.error());                        \
  }

TEST(Scene, JoinsVerticesThatTheFileSplits) {
  GEOTHERM_NEEDS_SCENES();
  const auto file = read_bytes("a.gltf", gltf(embedded(), R"([{"mesh":0}])"));
  ASSERT_TRUE(file) << sentence(file.error());
  EXPECT_EQ(file->mesh.vertex_count(), 5);
  EXPECT_EQ(file->mesh.face_count(), 6);
  EXPECT_EQ(file->up_axis, 1);
  ASSERT_EQ(file->notes.size(), 1U);
  EXPECT_TRUE(file->notes[0].starts_with("18 vertices of the file were joined to 5"))
      << file->notes[0];
  // Numbered by first appearance, as an STL is.
  const auto p = pyramid_positions();
  EXPECT_TRUE(
      std::ranges::equal(file->mesh.positions(), std::vector<Vec3>{p[0], p[1], p[4], p[2], p[3]}));
}

TEST(Scene, PlacesMeshesAsOftenAsItsNodesDo) {
  GEOTHERM_NEEDS_SCENES();
  const auto file = read_bytes(
      "a.gltf", gltf(embedded(), R"([{"children":[1,2],"scale":[2,2,2]},{"mesh":0},)"
                                 R"({"mesh":0,"translation":[10,0,0],"rotation":[0,0,1,0]}])"));
  ASSERT_TRUE(file) << sentence(file.error());
  EXPECT_EQ(file->mesh.vertex_count(), 10);
  EXPECT_EQ(file->mesh.face_count(), 12);
  EXPECT_TRUE(file->mesh.positions()[2].isApprox(Vec3(2, 2, 3)));
  EXPECT_TRUE(file->mesh.positions()[7].isApprox(Vec3(18, -2, 3), 1e-6)) << "turned, then moved";
}

TEST(Scene, ReadsTheBufferBesideItAndNoOther) {
  GEOTHERM_NEEDS_SCENES();
  const TemporaryDirectory directory;
  directory.write("a.bin", gltf_buffer());
  const std::string path = directory.write("a.gltf", gltf("a.bin", R"([{"mesh":0}])"));
  ASSERT_TRUE(read_mesh(path)) << sentence(read_mesh(path).error());
  for (const std::string& uri : {directory.path("a.bin"), std::string("../") + "a.bin"}) {
    const auto file = read_mesh(directory.write("b.gltf", gltf(uri, R"([{"mesh":0}])")));
    ASSERT_FALSE(file) << uri;
    EXPECT_NE(sentence(file.error()).find("a.bin"), std::string::npos) << sentence(file.error());
  }
}

TEST(Scene, WithoutFacesIsOneLine) {
  GEOTHERM_NEEDS_SCENES();
  for (const std::string& text :
       {gltf(embedded(), R"([{"mesh":0}])", 0), gltf(embedded(), R"([{"name":"empty"}])"),
        std::string("{}"), std::string("glTF")}) {
    const auto file = read_bytes("a.gltf", text);
    ASSERT_FALSE(file);
    EXPECT_EQ(sentence(file.error()).find('\n'), std::string::npos) << sentence(file.error());
  }
}

std::string collada(const std::string& axis) {
  return R"(<?xml version="1.0"?><COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" )"
         R"(version="1.4.1"><asset><unit name="cm" meter="0.01"/><up_axis>)" +
         axis +
         R"(</up_axis></asset><library_geometries><geometry id="g"><mesh><source id="p">)"
         R"(<float_array id="pa" count="15">0 0 0 2 0 0 2 2 0 0 2 0 1 1 1.5</float_array>)"
         R"(<technique_common><accessor source="#pa" count="5" stride="3"><param name="X" )"
         R"(type="float"/><param name="Y" type="float"/><param name="Z" type="float"/></accessor>)"
         R"(</technique_common></source><vertices id="v"><input semantic="POSITION" source="#p"/>)"
         R"(</vertices><polylist count="5"><input semantic="VERTEX" source="#v" offset="0"/>)"
         R"(<vcount>3 3 3 3 4</vcount><p>0 1 4 1 2 4 2 3 4 3 0 4 3 2 1 0</p></polylist></mesh>)"
         R"(</geometry></library_geometries><library_visual_scenes><visual_scene id="s"><node>)"
         R"(<instance_geometry url="#g"/></node></visual_scene></library_visual_scenes><scene>)"
         R"(<instance_visual_scene url="#s"/></scene></COLLADA>)";
}

TEST(Scene, OfColladaKeepsItsUnitsAxesAndPolygons) {
  GEOTHERM_NEEDS_SCENES();
  for (int axis = 0; axis < 3; ++axis) {
    const auto file = read_bytes("a.dae", collada(std::string(1, "XYZ"[axis]) + "_UP"));
    ASSERT_TRUE(file) << sentence(file.error());
    EXPECT_EQ(file->up_axis, axis);
    EXPECT_EQ(file->polygons, 1);
    const auto p = pyramid_positions();
    EXPECT_TRUE(std::ranges::equal(file->mesh.positions(),
                                   std::vector<Vec3>{p[0], p[1], p[4], p[2], p[3]}));
  }
}

TEST(Scene, ThatEndsAssimpEndsNothingElse) {
  GEOTHERM_NEEDS_SCENES();
  // A packed folder without a model, at which Assimp ends its process.
  const std::string empty = std::string("PK\x05\x06") + std::string(18, '\0');
  const auto file = read_bytes("a.3mf", empty);
  ASSERT_FALSE(file);
  const std::string said = sentence(file.error());
  EXPECT_NE(said.find("Assimp"), std::string::npos) << said;
  EXPECT_EQ(said.find('\n'), std::string::npos);
}

}  // namespace
}  // namespace geotherm::test
