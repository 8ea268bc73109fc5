// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <span>
#include <vector>

#include "engine/scene/scene.h"

namespace geotherm::engine {

/// A mesh as the surface pipeline draws it: indexed triangles whose vertices are those of the
/// model, copied where faces meet sharply (one normal each) and where edges are to be drawn (one
/// label each).
struct DrawMesh {
  struct Vertex {
    glm::vec3 position;
    std::array<std::int16_t, 4> normal_and_label;  ///< times 32767; label -1, 0 or 1
    /// Times 255: of the normal's side, of the other one; two that say nothing.
    std::array<std::uint8_t, 4> openness{255, 255, 0, 0};
  };
  std::vector<Vertex> vertices;
  std::vector<std::uint32_t> origin;                ///< the model's vertex of each
  std::vector<std::array<std::uint32_t, 3>> faces;  ///< the model's faces, in their order
};

/// Faces that meet at more than this angle (degrees) get normals of their own.
inline constexpr float kCreaseAngle = 60;

/// Every corner's normal is the mean of the normals, weighted by area, of the faces at its vertex
/// that meet its own face at less than kCreaseAngle, turned to its own face's side: neighbours may
/// be oriented differently. Faces without area take any normal of their vertices; where more than
/// 64 faces meet, all share one.
///
/// The three corners of each face get labels -1, 0 and 1, which is how the shader knows how far it
/// is from each edge: a vertex is copied when faces need it under several labels (on ordinary
/// meshes there are about 1.5 copies of each). Cost: O(F).
DrawMesh build_draw_mesh(const SurfaceGeometry& geometry);

/// The same mesh while its vertices move: only what lies at those that have moved is done again.
class MovingDrawMesh {
 public:
  explicit MovingDrawMesh(const SurfaceGeometry& geometry);
  MovingDrawMesh(MovingDrawMesh&&) noexcept;
  MovingDrawMesh& operator=(MovingDrawMesh&&) noexcept;
  ~MovingDrawMesh();

  /// Equal to build_draw_mesh() of the same positions.
  const DrawMesh& mesh() const;

  /// Puts the vertices there: as many as there were, with what light comes to them now. True: faces
  /// and origins are as before. False: there are creases where there were none, or fewer, and all
  /// was built again.
  bool move(std::span<const glm::vec3> positions, std::span<const Openness> openness = {});

 private:
  friend DrawMesh build_draw_mesh(const SurfaceGeometry& geometry);
  struct State;
  std::unique_ptr<State> state_;
};

/// The three vertices of every face for itself, 3F: faces may then have values of their own.
std::vector<DrawMesh::Vertex> separate_faces(const DrawMesh& mesh);

}  // namespace geotherm::engine
