// SPDX-License-Identifier: MIT
#include "solver/heat/moved_surface.h"

#include <algorithm>
#include <utility>

#include "solver/core/parallel.h"
#include "solver/core/sorting.h"
#include "solver/linear/elimination_tree.h"

namespace geotherm {
namespace {

/// A factor that would be larger by more than this, against that of the last fresh order, has a new
/// order made.
constexpr double kMaxGrowth = 1.15;

std::shared_ptr<const KeptOrder> order_of(const Surface& fresh) {
  const EliminationTree* const tree = fresh.analysis->tree();
  if (tree == nullptr) return nullptr;
  auto out = std::make_shared<KeptOrder>();
  out->parent = tree->parent;
  out->node_of_vertex.assign(static_cast<std::size_t>(fresh.mesh->vertex_count()), kNoIndex);
  for (Index row = 0; row < fresh.size(); ++row) {
    if (!fresh.is_of_input(row)) continue;
    out->vertices.push_back(fresh.vertex_of_row[row]);
    out->node_of_vertex[out->vertices.back()] = tree->node_of_row[row];
  }
  out->factor_bytes = fresh.analysis->factor_bytes(FactorStorage::kFull);
  return out;
}

/// The nodes of an elimination tree by their rows.
struct Nodes {
  std::span<const Index> parent, of_row;
};

/// What differs from an earlier surface in the same units: faces with other corners or lengths, and
/// those at vertices that have another node. Empty where the nodes are others, or a quarter of the
/// rows would be in it. Precondition: vertices of one node that have not changed it stand in the
/// order that they had.
OperatorChanges find_changes(const Surface& earlier, const Surface& now, const Nodes& nodes,
                             int threads) {
  const EliminationTree* const before = earlier.analysis->tree();
  const IntrinsicMesh &old = earlier.intrinsic, &mesh = now.intrinsic;
  if (before == nullptr || !std::ranges::equal(before->parent, nodes.parent) ||
      earlier.refinement.points != now.refinement.points || old.back != mesh.back ||
      earlier.size() != now.size() || old.faces.size() != mesh.faces.size()) {
    return {};
  }
  const auto size = static_cast<std::size_t>(now.size());
  OperatorChanges out{std::vector<char>(mesh.faces.size()), std::vector<char>(size, 0),
                      std::vector<char>(size), std::vector<Index>(size)};
  for (std::size_t row = 0; row < size; ++row) {
    const Index was = earlier.row_of_vertex[now.vertex_of_row[row]];
    if (was == kNoIndex) return {};
    out.earlier_row[row] = was;
    out.rose[row] = before->node_of_row[was] != nodes.of_row[row] ? 1 : 0;
  }
  const bool any_rose = std::ranges::find(out.rose, 1) != out.rose.end();
  constexpr std::int64_t kFacesAPiece = 1 << 14;
  parallel_each<std::size_t>(threads, mesh.face_count(), kFacesAPiece, [&](std::size_t f) {
    const auto rose = [&](Index v) { return out.rose[now.row_of_vertex[v]] != 0; };
    const bool same = mesh.faces[f] == old.faces[f] && mesh.lengths[f] == old.lengths[f] &&
                      !(any_rose && std::ranges::any_of(mesh.faces[f], rose));
    out.faces[f] = same ? 0 : 1;
  });
  for_each_with_value(out.faces, char{1}, [&](Index f) {
    for (const Index v : mesh.faces[f]) out.rows[now.row_of_vertex[v]] = 1;
    for (const Index v : old.faces[f]) out.rows[now.row_of_vertex[v]] = 1;
  });
  if (4 * std::ranges::count(out.rows, 1) > now.size()) return {};
  return out;
}

/// The node of each row of an order.
std::vector<Index> nodes_of_rows(const NodeOrder& order) {
  std::vector<Index> node(order.order.size());
  for (std::size_t s = 0; s + 1 < order.first.size(); ++s) {
    std::fill(node.begin() + order.first[s], node.begin() + order.first[s + 1],
              static_cast<Index>(s));
  }
  return node;
}

}  // namespace

bool moved_little(const IntrinsicSurface& earlier, const TriangleMesh& mesh) {
  constexpr Index kShare = 8;
  Index moved = 0;
  const auto before = earlier.mesh->positions(), now = mesh.positions();
  for (std::size_t v = 0; v < now.size(); ++v) moved += now[v] != before[v];
  return kShare * moved <= mesh.vertex_count();
}

bool keep_order(const Surface& earlier, bool little, int threads, Stopwatch& watch, Surface& out) {
  if (earlier.backend != out.backend || earlier.asked != out.asked) return false;
  OperatorChanges changes;
  if (same_triangles(earlier, out, threads)) {
    out.kept_order = earlier.kept_order;
    out.vertex_of_row = earlier.vertex_of_row;
    out.row_of_vertex = earlier.row_of_vertex;
    out.analysis = earlier.analysis;
    const EliminationTree* const tree = earlier.analysis->tree();
    if (little && tree != nullptr) {
      changes = find_changes(earlier, out, {tree->parent, tree->node_of_row}, threads);
    }
    out.operators = moved_operator_mesh(*earlier.operators, out.intrinsic, changes, threads);
    out.changed_rows = std::move(changes.rows);
    out.timing.operators += watch.lap();
    return true;
  }
  const auto kept = earlier.kept_order ? earlier.kept_order : order_of(earlier);
  if (!kept) return false;
  std::vector<Index> node = kept->node_of_vertex;
  node.resize(static_cast<std::size_t>(out.vertex_count()), kNoIndex);
  const auto nodes = order_along(kept->parent, kept->vertices, node, out.intrinsic.faces);
  if (!nodes) return false;
  out.number_rows(nodes->order, out.vertex_count());
  // A fresh order has inserted vertices anywhere within a node, one that is kept has them last.
  if (little && (earlier.kept_order || out.refinement.points == 0)) {
    changes = find_changes(earlier, out, {nodes->parent, nodes_of_rows(*nodes)}, threads);
  }
  out.timing.operators += watch.lap();
  std::shared_ptr<const Analysis> analysis;
  const auto take = [&analysis](Result<std::shared_ptr<const Analysis>> followed) {
    if (followed) analysis = *std::move(followed);
  };
  auto operators =
      changes.empty()
          ? follow_order(out.intrinsic, out.vertex_of_row, out.row_of_vertex, out.parts, threads,
                         [&](const SymmetricPattern& pattern, int half) {
                           take(earlier.analysis->follow(*nodes, pattern, half));
                         })
          : update_operators(*earlier.operators, out.intrinsic, changes, out.vertex_of_row,
                             out.row_of_vertex, out.parts, threads,
                             [&](const LowerPattern& lower, int half) {
                               take(earlier.analysis->update(
                                   *nodes, lower, {changes.earlier_row, changes.rows}, half));
                             });
  out.timing.analyze += watch.lap();
  if (!analysis) return false;
  const auto bytes = static_cast<double>(analysis->factor_bytes(FactorStorage::kFull));
  if (bytes > kMaxGrowth * static_cast<double>(kept->factor_bytes)) return false;
  out.kept_order = kept;
  out.analysis = std::move(analysis);
  out.operators = std::move(operators);
  out.changed_rows = std::move(changes.rows);
  return true;
}

}  // namespace geotherm
