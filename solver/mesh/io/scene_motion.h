// SPDX-License-Identifier: MIT
// How a scene of Assimp's moves: nodes along the keys of its first animation, meshes with them, by
// the weights of their bones and of their morph targets. Between two keys positions, scales and
// weights follow a straight line, and rotations a great circle, whatever the file asks for.
#pragma once

#include <string_view>
#include <unordered_map>
#include <vector>

#include "geotherm/types.h"

struct aiMesh;
struct aiMeshMorphAnim;
struct aiNode;
struct aiNodeAnim;
struct aiScene;

namespace geotherm::io {

class SceneMotion {
 public:
  /// The scene, which must outlive it, as it is at rest; set_time() moves it.
  /// `keeps_root`: the transform of the root counts.
  SceneMotion(const aiScene& scene, bool keeps_root);

  /// Length of the animation; 0: nothing moves.
  double seconds() const { return seconds_; }

  /// Puts all nodes where they are then.
  void set_time(double seconds);

  /// The transform from the frame of a node's meshes to that of the scene.
  const Eigen::Matrix4d& transform(const aiNode& node) const;

  /// Where the vertices of a mesh are, which a node places. `positions` is overwritten.
  void place(const aiMesh& mesh, const aiNode& node, std::vector<Vec3>& positions) const;

 private:
  struct Node {
    std::size_t parent = 0;  ///< the root's is itself
    const aiNodeAnim* keys = nullptr;
    Eigen::Matrix4d at_rest, global;
  };

  std::vector<Vec3> bent(const aiMesh& mesh, const aiNode& node) const;

  std::vector<Node> nodes_;  ///< parents before their children
  std::unordered_map<const aiNode*, std::size_t> number_of_;
  std::unordered_map<std::string_view, std::size_t> node_named_;
  std::unordered_map<std::string_view, const aiMeshMorphAnim*> weights_of_;  ///< of a node's meshes
  double seconds_ = 0, ticks_a_second_ = 1, ticks_ = 0;
};

}  // namespace geotherm::io
