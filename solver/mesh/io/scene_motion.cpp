// SPDX-License-Identifier: MIT
#include "solver/mesh/io/scene_motion.h"

#include <assimp/scene.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <utility>

namespace geotherm::io {
namespace {

Vec3 vector_of(const aiVector3D& v) {
  return {static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z)};
}

Eigen::Matrix4d matrix_of(const aiMatrix4x4& from) {
  Eigen::Matrix4d out;
  for (unsigned r = 0; r < 4; ++r) {
    for (unsigned c = 0; c < 4; ++c) out(r, c) = static_cast<double>(from[r][c]);
  }
  return out;
}

std::string_view text_of(const aiString& name) { return {name.data, name.length}; }

/// The keys on both sides of a time, and how far it is from the first to the second: 0 to 1.
template <class Key>
struct Between {
  const Key *from, *to;
  double share;
};
/// Precondition: count > 0.
template <class Key>
Between<Key> keys_at(const Key* keys, unsigned count, double ticks) {
  const Key* const next = std::upper_bound(
      keys, keys + count, ticks, [](double time, const Key& key) { return time < key.mTime; });
  if (next == keys) return {keys, keys, 0};
  if (next == keys + count) return {next - 1, next - 1, 0};
  const Key* const last = next - 1;
  return {last, next, (ticks - last->mTime) / (next->mTime - last->mTime)};
}

Vec3 vector_at(const aiVectorKey* keys, unsigned count, double ticks, const Vec3& without) {
  if (count == 0) return without;
  const auto [from, to, share] = keys_at(keys, count, ticks);
  return (1 - share) * vector_of(from->mValue) + share * vector_of(to->mValue);
}

Eigen::Matrix4d transform_at(const aiNodeAnim& keys, double ticks) {
  Eigen::Quaterniond turned = Eigen::Quaterniond::Identity();
  if (keys.mNumRotationKeys > 0) {
    const auto quaternion = [](const aiQuaternion& q) {
      return Eigen::Quaterniond(static_cast<double>(q.w), static_cast<double>(q.x),
                                static_cast<double>(q.y), static_cast<double>(q.z))
          .normalized();
    };
    const auto [from, to, share] = keys_at(keys.mRotationKeys, keys.mNumRotationKeys, ticks);
    turned = quaternion(from->mValue).slerp(share, quaternion(to->mValue));
  }
  const Vec3 moved = vector_at(keys.mPositionKeys, keys.mNumPositionKeys, ticks, Vec3::Zero());
  const Vec3 scaled = vector_at(keys.mScalingKeys, keys.mNumScalingKeys, ticks, Vec3::Ones());
  Eigen::Matrix4d out = Eigen::Matrix4d::Identity();
  out.topLeftCorner<3, 3>() = turned.toRotationMatrix() * scaled.asDiagonal();
  out.topRightCorner<3, 1>() = moved;
  return out;
}

Vec3 moved_by(const Eigen::Matrix4d& transform, const Vec3& p) {
  return transform.topLeftCorner<3, 3>() * p + transform.topRightCorner<3, 1>();
}

}  // namespace

SceneMotion::SceneMotion(const aiScene& scene, bool keeps_root) {
  std::vector<std::pair<const aiNode*, std::size_t>> left = {{scene.mRootNode, 0}};
  while (!left.empty()) {  // no recursion: nodes may be nested as deep as a file likes
    const auto [node, parent] = left.back();
    left.pop_back();
    const std::size_t number = nodes_.size();
    number_of_.emplace(node, number);
    node_named_.emplace(text_of(node->mName), number);
    const bool counts = number > 0 || keeps_root;
    const Eigen::Matrix4d at_rest =
        counts ? matrix_of(node->mTransformation) : Eigen::Matrix4d(Eigen::Matrix4d::Identity());
    nodes_.push_back({parent, nullptr, at_rest, at_rest});
    for (unsigned c = 0; c < node->mNumChildren; ++c) left.emplace_back(node->mChildren[c], number);
  }
  set_time(0);
  if (scene.mNumAnimations == 0) return;
  const aiAnimation& animation = *scene.mAnimations[0];
  if (animation.mTicksPerSecond > 0) ticks_a_second_ = animation.mTicksPerSecond;
  seconds_ = std::max(0.0, animation.mDuration / ticks_a_second_);
  for (unsigned i = 0; i < animation.mNumChannels; ++i) {
    const auto at = node_named_.find(text_of(animation.mChannels[i]->mNodeName));
    if (at != node_named_.end()) nodes_[at->second].keys = animation.mChannels[i];
  }
  for (unsigned i = 0; i < animation.mNumMorphMeshChannels; ++i) {
    const aiMeshMorphAnim* const weights = animation.mMorphMeshChannels[i];
    if (weights->mNumKeys > 0) weights_of_.emplace(text_of(weights->mName), weights);
  }
}

void SceneMotion::set_time(double seconds) {
  ticks_ = seconds * ticks_a_second_;
  for (std::size_t n = 0; n < nodes_.size(); ++n) {
    Node& node = nodes_[n];
    node.global = node.keys ? transform_at(*node.keys, ticks_) : node.at_rest;
    if (n > 0) node.global = (nodes_[node.parent].global * node.global).eval();
  }
}

const Eigen::Matrix4d& SceneMotion::transform(const aiNode& node) const {
  return nodes_[number_of_.at(&node)].global;
}

/// The vertices of a mesh with its morph targets, before any node or bone moves them.
std::vector<Vec3> SceneMotion::bent(const aiMesh& mesh, const aiNode& node) const {
  std::vector<Vec3> out(mesh.mNumVertices);
  for (unsigned v = 0; v < mesh.mNumVertices; ++v) out[v] = vector_of(mesh.mVertices[v]);
  std::vector<double> weights(mesh.mNumAnimMeshes);
  for (unsigned i = 0; i < mesh.mNumAnimMeshes; ++i) {
    weights[i] = static_cast<double>(mesh.mAnimMeshes[i]->mWeight);
  }
  if (const auto at = weights_of_.find(text_of(node.mName)); at != weights_of_.end()) {
    const auto [from, to, share] = keys_at(at->second->mKeys, at->second->mNumKeys, ticks_);
    std::ranges::fill(weights, 0.0);
    for (const auto& [key, part] : {std::pair(from, 1 - share), std::pair(to, share)}) {
      for (unsigned k = 0; k < key->mNumValuesAndWeights; ++k) {
        if (key->mValues[k] < weights.size()) weights[key->mValues[k]] += part * key->mWeights[k];
      }
    }
  }
  for (unsigned i = 0; i < mesh.mNumAnimMeshes; ++i) {
    const aiAnimMesh& target = *mesh.mAnimMeshes[i];
    if (target.mVertices == nullptr || weights[i] == 0) continue;
    for (unsigned v = 0; v < std::min(mesh.mNumVertices, target.mNumVertices); ++v) {
      out[v] += weights[i] * (vector_of(target.mVertices[v]) - vector_of(mesh.mVertices[v]));
    }
  }
  return out;
}

void SceneMotion::place(const aiMesh& mesh, const aiNode& node,
                        std::vector<Vec3>& positions) const {
  const std::vector<Vec3> from = bent(mesh, node);
  positions.assign(from.size(), Vec3::Zero());
  std::vector<double> weight(from.size(), 0.0);
  for (unsigned b = 0; b < mesh.mNumBones; ++b) {
    const aiBone& bone = *mesh.mBones[b];
    const auto at = node_named_.find(text_of(bone.mName));
    if (at == node_named_.end()) continue;
    const Eigen::Matrix4d transform = nodes_[at->second].global * matrix_of(bone.mOffsetMatrix);
    for (unsigned k = 0; k < bone.mNumWeights; ++k) {
      const auto [v, share] =
          std::pair(bone.mWeights[k].mVertexId, static_cast<double>(bone.mWeights[k].mWeight));
      if (v >= from.size() || !(share > 0)) continue;
      positions[v] += share * moved_by(transform, from[v]);
      weight[v] += share;
    }
  }
  const Eigen::Matrix4d& whole = transform(node);
  for (std::size_t v = 0; v < from.size(); ++v) {
    if (weight[v] > 0) {
      positions[v] /= weight[v];
    } else {
      positions[v] = moved_by(whole, from[v]);
    }
  }
}

}  // namespace geotherm::io
