// SPDX-License-Identifier: MIT
// glTF, 3MF and Collada by way of Assimp, whose importers are asked one by one: no other of them is
// reached, and no step of its post-processing runs. It keeps coordinates in 32 bits.
#include "solver/mesh/io/scene_reader.h"

#include <assimp/BaseImporter.h>
#include <assimp/MemoryIOWrapper.h>
#include <assimp/commonMetaData.h>
#include <assimp/importerdesc.h>
#include <assimp/scene.h>

#include <algorithm>
#include <array>
#include <assimp/IOStream.hpp>
#include <assimp/IOSystem.hpp>
#include <assimp/Importer.hpp>
#include <cerrno>
#include <cmath>
#include <cstdint>
#include <exception>
#include <limits>
#include <memory>
#include <new>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "solver/core/text.h"
#include "solver/mesh/io/input_file.h"
#include "solver/mesh/io/scene_motion.h"
#include "solver/mesh/io/vertex_welder.h"

namespace geotherm::io {
namespace {

constexpr int kUpY = 1, kUpZ = 2;

struct SceneFormat {
  std::string_view name, importer;
  bool keeps_root;  ///< whether the transform of the scene's root is that of the file
  int up_axis;
};
// The root of a Collada scene turns and scales it to metres and y; the file has no transform there.
constexpr SceneFormat kSceneFormats[] = {
    {"gltf", "glTF2 Importer", true, kUpY},
    {"glb", "glTF2 Importer", true, kUpY},
    {"3mf", "3mf Importer", true, kUpZ},
    {"dae", "Collada Importer", false, kUpY},
};

/// The bytes of one file that Assimp reads.
class OpenedFile : public Assimp::MemoryIOStream {
 public:
  explicit OpenedFile(std::string_view bytes)
      : MemoryIOStream(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()) {}
  explicit OpenedFile(FileBytes file) : OpenedFile(file.bytes()) {
    file_.push_back(std::move(file));
  }

 private:
  std::vector<FileBytes> file_;
};

/// The model itself, and what lies in its folder.
class FolderFiles : public Assimp::IOSystem {
 public:
  /// `folder`: with its slash; empty: none.
  FolderFiles(std::string name, std::string_view bytes, std::string folder)
      : name_(std::move(name)), bytes_(bytes), folder_(std::move(folder)) {}

  bool Exists(const char* path) const override { return path == name_ || is_beside(path); }
  char getOsSeparator() const override { return '/'; }
  Assimp::IOStream* Open(const char* path, const char* /*mode*/) override {
    if (path == name_) return new OpenedFile(bytes_);
    if (!is_beside(path)) return nullptr;
    const auto file = InputFile::open_as_is(path);
    return file ? new OpenedFile(FileBytes(*file)) : nullptr;
  }
  void Close(Assimp::IOStream* stream) override { delete stream; }

 private:
  bool is_beside(const std::string& path) const {
    return !folder_.empty() && path.starts_with(folder_) && path.size() > folder_.size() &&
           path[folder_.size()] != '/' && path.find("..") == path.npos;
  }

  std::string name_;
  std::string_view bytes_;
  std::string folder_;
};

[[noreturn]] void fail_in_assimp(const Assimp::BaseImporter& importer) {
  constexpr std::size_t kMaxLetters = 160;
  try {
    if (importer.GetException()) std::rethrow_exception(importer.GetException());
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const ReadFailure&) {
    throw;
  } catch (...) {  // its text follows
  }
  std::string text = printable(importer.GetErrorText().substr(0, kMaxLetters));
  if (text.empty()) text = "no reason is given";
  throw ReadFailure{"Assimp cannot read it: " + text};
}

/// All meshes of a scene where its nodes place them.
class SceneMesh {
 public:
  /// `moves`: write_frames() will follow.
  SceneMesh(const aiScene& scene, bool keeps_root, bool moves)
      : scene_(scene), motion_(scene, keeps_root), moves_(moves), welder_(corner_guess(scene)) {}

  RawMesh read() {
    std::vector<const aiNode*> left = {scene_.mRootNode};
    while (!left.empty()) {  // no recursion: nodes may be nested as deep as a file likes
      const aiNode& node = *left.back();
      left.pop_back();
      for (unsigned m = 0; m < node.mNumMeshes; ++m) add(node.mMeshes[m], node);
      for (unsigned c = node.mNumChildren; c > 0; --c) left.push_back(node.mChildren[c - 1]);
    }
    return finished();
  }

  /// Returns how many were written. Precondition: read() has returned `vertices` vertices.
  std::int64_t write_frames(int descriptor, std::size_t vertices) {
    constexpr double kMaxFrames = 1e5;
    const double last = std::floor(motion_.seconds() * kSceneFrameRate + 1e-6);
    if (!(last < kMaxFrames)) {
      throw ReadFailure{"its animation has more than 100000 frames, at " +
                        std::to_string(kSceneFrameRate) + " a second"};
    }
    if (!(motion_.seconds() > 0)) throw ReadFailure{"the scene has no animation"};
    std::vector<Vec3> frame(vertices), placed;
    const auto count = static_cast<std::int64_t>(last) + 1;
    for (std::int64_t k = 0; k < count; ++k) {
      motion_.set_time(static_cast<double>(k) / kSceneFrameRate);
      for (auto place = places_.rbegin(); place != places_.rend(); ++place) {
        motion_.place(*place->mesh, *place->node, placed);
        // Backwards, so that of several vertices in one place at rest the first one counts.
        for (std::size_t v = placed.size(); v-- > 0;) {
          frame[static_cast<std::size_t>(place->numbers[v])] = placed[v];
        }
      }
      if (!std::ranges::all_of(frame, [](const Vec3& p) { return p.allFinite(); })) {
        throw ReadFailure{"a coordinate of frame " + std::to_string(k) + " is not finite"};
      }
      if (!write_all(descriptor, frame.data(), frame.size() * sizeof(Vec3))) {
        throw ReadFailure{"its frames cannot be written to the folder for temporary files: " +
                              std::generic_category().message(errno),
                          0,
                          {},
                          {"set TMPDIR to a folder with room"}};
      }
    }
    return count;
  }

 private:
  /// A mesh that a node places, and the numbers that its vertices have.
  struct Place {
    const aiMesh* mesh;
    const aiNode* node;
    std::vector<Index> numbers;
  };

  static std::size_t corner_guess(const aiScene& scene) {
    std::size_t vertices = 0;
    for (unsigned m = 0; m < scene.mNumMeshes; ++m) vertices += scene.mMeshes[m]->mNumVertices;
    return std::min<std::size_t>(vertices, 1U << 26);
  }

  void add(unsigned number, const aiNode& node) {
    if (number >= scene_.mNumMeshes) throw ReadFailure{"a node has a mesh that is not there"};
    const aiMesh& mesh = *scene_.mMeshes[number];
    ++placed_;
    vertices_ += mesh.mNumVertices;
    constexpr auto kMaxIndex = static_cast<std::size_t>(std::numeric_limits<Index>::max());
    if (vertices_ > kMaxIndex || raw_.faces.size() + mesh.mNumFaces > kMaxIndex) {
      throw ReadFailure{"the meshes, as often as they are placed, have more than " +
                        std::to_string(kMaxIndex) + " vertices or faces"};
    }
    place(mesh, motion_.transform(node));
    FanBuilder fan(raw_.faces);
    for (unsigned f = 0; f < mesh.mNumFaces; ++f) {
      const aiFace& face = mesh.mFaces[f];
      if (face.mNumIndices < 3) {
        ++others_;
        continue;
      }
      for (unsigned k = 0; k < face.mNumIndices; ++k) {
        if (face.mIndices[k] >= mesh.mNumVertices) {
          throw ReadFailure{"vertex " + std::to_string(face.mIndices[k]) +
                            " of a mesh is used, which has " + std::to_string(mesh.mNumVertices)};
        }
        fan.add(numbers_[face.mIndices[k]]);
      }
      fan.end(raw_.polygons);
    }
    if (moves_) places_.push_back({&mesh, &node, numbers_});
  }

  /// The numbers of the vertices of one mesh; of those in no face none is needed.
  void place(const aiMesh& mesh, const Eigen::Matrix4d& transform) {
    numbers_.resize(mesh.mNumVertices);
    for (unsigned v = 0; v < mesh.mNumVertices; ++v) {
      const aiVector3D& from = mesh.mVertices[v];
      const Eigen::Vector4d at =
          transform * Eigen::Vector4d(static_cast<double>(from.x), static_cast<double>(from.y),
                                      static_cast<double>(from.z), 1);
      if (!at.allFinite()) {
        throw ReadFailure{"a coordinate of vertex " + std::to_string(v) +
                          " of a mesh is not finite"};
      }
      numbers_[v] = welder_.add(at.head<3>());
    }
  }

  RawMesh finished() {
    raw_.positions = welder_.take_positions();
    if (raw_.faces.empty()) {
      throw ReadFailure{"the scene has no triangles or polygons, but " +
                        counted_text(others_, "point or line", "points and lines")};
    }
    if (placed_ > 1) {
      raw_.notes.push_back("the scene places " + std::to_string(placed_) +
                           " meshes, which are one here");
    }
    if (vertices_ > raw_.positions.size()) {
      raw_.notes.push_back(std::to_string(vertices_) + " vertices of the file were joined to " +
                           std::to_string(raw_.positions.size()) +
                           ": those in one place are one, numbered by first appearance");
    }
    if (others_ > 0) {
      raw_.notes.push_back("left out, being no faces: points and lines (" +
                           std::to_string(others_) + ")");
    }
    return std::move(raw_);
  }

  const aiScene& scene_;
  SceneMotion motion_;
  bool moves_;
  VertexWelder welder_;
  RawMesh raw_;
  std::vector<Index> numbers_;
  std::vector<Place> places_;
  std::size_t placed_ = 0, vertices_ = 0, others_ = 0;
};

/// The axis that a Collada file names; it has to be that of the asset, which stands in front.
int collada_up_axis(std::string_view text, int otherwise) {
  constexpr std::string_view kTag = "<up_axis>";
  const std::size_t at = text.find(kTag);
  if (at == text.npos || at + kTag.size() >= text.size()) return otherwise;
  const char axis = text[at + kTag.size()];
  return axis >= 'X' && axis <= 'Z' ? axis - 'X' : otherwise;
}

/// The axis, 0 to 2, that the root of a scene of `render` turns to y; absent: another scene.
std::optional<int> turned_axis(const aiScene& scene) {
  constexpr std::array<std::string_view, 3> kAxes = {"x", "y", "z"};
  aiString program;
  if (scene.mMetaData == nullptr || scene.mRootNode == nullptr ||
      !scene.mMetaData->Get(AI_METADATA_SOURCE_GENERATOR, program) ||
      std::string_view(program.C_Str()) != "geotherm") {
    return std::nullopt;
  }
  const std::string_view name = scene.mRootNode->mName.C_Str();
  if (!name.starts_with(kTurnedRoot)) return std::nullopt;
  const auto* const axis = std::ranges::find(kAxes, name.substr(kTurnedRoot.size()));
  if (axis == kAxes.end()) return std::nullopt;
  return static_cast<int>(axis - kAxes.begin());
}

}  // namespace

RawMesh read_scene_here(std::string_view bytes, std::string_view format, const std::string& folder,
                        SceneFrames* frames) {
  const auto* const known = std::ranges::find(kSceneFormats, format, &SceneFormat::name);
  const std::string name = folder + "model." + std::string(format);
  FolderFiles files(name, bytes, folder);
  Assimp::Importer all;
  Assimp::BaseImporter* importer = nullptr;
  for (std::size_t i = 0; i < all.GetImporterCount(); ++i) {
    if (all.GetImporterInfo(i)->mName == known->importer) importer = all.GetImporter(i);
  }
  if (importer == nullptr) {
    throw ReadFailure{"this Assimp has no " + std::string(known->importer),
                      0,
                      {},
                      {"save the model as .obj or .ply"}};
  }
  const std::unique_ptr<const aiScene> scene(importer->ReadFile(&all, name, &files));
  if (!scene) fail_in_assimp(*importer);
  if (scene->mRootNode == nullptr) throw ReadFailure{"the scene is empty"};
  const std::optional<int> turned = turned_axis(*scene);
  SceneMesh mesh(*scene, known->keeps_root && !turned, frames != nullptr);
  RawMesh raw = mesh.read();
  if (frames != nullptr) {
    frames->count = mesh.write_frames(frames->descriptor, raw.positions.size());
  }
  raw.up_axis =
      format == "dae" ? collada_up_axis(bytes, known->up_axis) : turned.value_or(known->up_axis);
  return raw;
}

}  // namespace geotherm::io
