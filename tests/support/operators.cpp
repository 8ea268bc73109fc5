// SPDX-License-Identifier: MIT
#include "tests/support/operators.h"

#include <gtest/gtest.h>

#include <numeric>

namespace geotherm::test {

Intrinsic intrinsic_of(const TriangleMesh& mesh, bool flip) {
  Intrinsic out{clean_faces(mesh), {}, {}};
  const double unit = mean_edge_length(mesh.positions(), out.clean.edges);
  out.mesh = build_intrinsic_mesh(mesh.positions(), out.clean, unit);
  if (flip) out.flips = *flip_to_delaunay(out.mesh);
  return out;
}

Numbering numbering_of(const TriangleMesh& mesh, const CleanFaces& clean) {
  Numbering out;
  out.local.assign(static_cast<std::size_t>(mesh.vertex_count()), kNoIndex);
  for (const Face& face : clean.faces) {
    for (const Index corner : face) out.local[static_cast<std::size_t>(corner)] = 0;
  }
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    Index& number = out.local[static_cast<std::size_t>(v)];
    if (number == kNoIndex) continue;
    number = static_cast<Index>(out.vertex.size());
    out.vertex.push_back(v);
  }
  return out;
}

SymmetricPattern pattern_of(const IntrinsicMesh& mesh, const Numbering& numbers) {
  std::vector<Face> faces = mesh.faces;
  for (Face& face : faces) {
    for (Index& corner : face) corner = numbers.local[static_cast<std::size_t>(corner)];
  }
  return pattern_of_faces(static_cast<Index>(numbers.vertex.size()), faces);
}

std::shared_ptr<const OperatorMesh> operators_of(const TriangleMesh& mesh, const Intrinsic& in) {
  const Numbering numbers = numbering_of(mesh, in.clean);
  std::vector<Index> order(numbers.vertex.size());
  std::iota(order.begin(), order.end(), 0);
  const SymmetricPattern pattern = pattern_of(in.mesh, numbers);
  return build_operator_mesh(in.mesh, pattern, numbers.local, order, connected_components(pattern));
}

Analysed analysed(const TriangleMesh& mesh, const Backend& backend, bool flip) {
  const Intrinsic in = intrinsic_of(mesh, flip);
  const Numbering numbers = numbering_of(mesh, in.clean);
  const SymmetricPattern pattern = pattern_of(in.mesh, numbers);
  std::vector<Vec3> positions;
  for (const Index v : numbers.vertex) positions.push_back(mesh.positions()[v]);
  auto analysis = backend.analyze(pattern, positions, 1);
  if (!analysis) {
    ADD_FAILURE() << analysis.error().message;
    return {};
  }
  return {*analysis, build_operator_mesh(in.mesh, pattern, numbers.local, (*analysis)->order(),
                                         connected_components(pattern))};
}

}  // namespace geotherm::test
