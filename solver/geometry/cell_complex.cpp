// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <new>
#include <numeric>
#include <span>
#include <string>
#include <vector>

#include "geotherm/domains.h"
#include "solver/core/text.h"

namespace geotherm {
namespace {

Error bad_cells(std::string message) { return {ErrorCode::kBadInput, std::move(message)}; }

Error bad_size(const std::string& what, std::size_t there, std::size_t wanted) {
  return bad_cells("there are " + std::to_string(there) + " " + what + ", and " +
                   std::to_string(wanted) + " are needed");
}

/// Sizes of the arrays, before any entry is looked at.
Result<void> check_sizes(const CellComplex& cells) {
  const auto count = static_cast<std::size_t>(cells.cell_count());
  if (count == 0) return bad_cells("there are no " + cells.cells_name);
  if (cells.dimension < 1 || cells.dimension > 3) {
    return bad_cells("the dimension is " + std::to_string(cells.dimension) + "; it must be 1 to 3");
  }
  if (cells.start.size() != count + 1) return bad_size("starts", cells.start.size(), count + 1);
  if (cells.widths.size() != count) return bad_size("widths", cells.widths.size(), count);
  if (cells.start.front() != 0 || cells.start.back() != std::ssize(cells.corners)) {
    return bad_cells("the starts go from " + std::to_string(cells.start.front()) + " to " +
                     std::to_string(cells.start.back()) + ", and there are " +
                     std::to_string(cells.corners.size()) + " corners");
  }
  const std::size_t gradients = cells.corners.size() * static_cast<std::size_t>(cells.dimension);
  if (cells.gradients.size() != gradients) {
    return bad_size("numbers of gradients", cells.gradients.size(), gradients);
  }
  if (!cells.shares.empty() && cells.shares.size() != cells.corners.size()) {
    return bad_size("shares", cells.shares.size(), cells.corners.size());
  }
  const auto vertices = static_cast<std::size_t>(std::max(cells.vertices, 0));
  if (!cells.positions.empty() && cells.positions.size() != vertices) {
    return bad_size("positions", cells.positions.size(), vertices);
  }
  if (!cells.numbers.empty() && cells.numbers.size() != count) {
    return bad_size("numbers of cells", cells.numbers.size(), count);
  }
  if (!cells.virtual_vertices.empty()) {
    if (cells.virtual_vertices.size() != count) {
      return bad_size("virtual vertices", cells.virtual_vertices.size(), count);
    }
    if (cells.positions.empty() || cells.numbers.empty() || cells.dimension != 2) {
      return bad_cells("virtual vertices are of numbered cells in two dimensions with positions");
    }
  }
  if (!std::ranges::is_sorted(cells.numbers)) return bad_cells("the numbers do not ascend");
  if (!cells.numbers.empty() && cells.numbers.front() < 0) {
    return bad_cells("the number of " + cells.cell_name + " 0 is " +
                     std::to_string(cells.numbers.front()) + "; it must not be negative");
  }
  if (!cells.on_boundary.empty() && cells.on_boundary.size() != vertices) {
    return bad_size("boundary flags", cells.on_boundary.size(), vertices);
  }
  return {};
}

Result<void> check_cell(const CellComplex& cells, Index cell) {
  const auto c = static_cast<std::size_t>(cell);
  const std::string name = cells.cell_name + " " + std::to_string(cell);
  const std::int64_t count = cells.start[c + 1] - cells.start[c];
  if (cells.start[c] < 0 || count < 2 || cells.start[c + 1] > std::ssize(cells.corners)) {
    return bad_cells(name + " has " + std::to_string(count) + " corners; it needs two or more");
  }
  const auto corners = cells.corners_of(cell);
  for (std::size_t k = 0; k < corners.size(); ++k) {
    if (corners[k] < 0 || corners[k] >= cells.vertices) {
      return bad_cells(name + " has the corner " + std::to_string(corners[k]) +
                       ", which is out of range (0 to " + std::to_string(cells.vertices - 1) + ")");
    }
    if (std::find(corners.begin(), corners.begin() + static_cast<std::ptrdiff_t>(k), corners[k]) !=
        corners.begin() + static_cast<std::ptrdiff_t>(k)) {
      return bad_cells(name + " has the corner " + std::to_string(corners[k]) + " twice");
    }
  }
  for (const auto& [what, value] :
       {std::pair{"measure", cells.measures[c]}, std::pair{"width", cells.widths[c]}}) {
    if (value > 0 && std::isfinite(value)) continue;
    return bad_cells(name + " has the " + what + " " + rounded_text(value) +
                     "; it must be above 0");
  }
  constexpr double kRounding = 1e-9;  // of the largest gradient, of 1
  if (!cells.shares.empty()) {
    const std::span shares(cells.shares.data() + cells.start[c], corners.size());
    const double sum = std::accumulate(shares.begin(), shares.end(), 0.0);
    if (!(std::ranges::min(shares) >= 0) || !(std::abs(sum - 1) <= kRounding)) {
      return bad_cells("the shares of " + name + " are at least " +
                       rounded_text(std::ranges::min(shares)) + " and sum to " + rounded_text(sum) +
                       "; they must not be below 0 and sum to 1");
    }
  }
  for (int e = 0; e < cells.dimension; ++e) {
    double sum = 0, largest = 0;
    for (std::int64_t k = cells.start[c]; k < cells.start[c + 1]; ++k) {
      const double g = cells.gradients[static_cast<std::size_t>(k * cells.dimension + e)];
      sum += g;
      largest = std::max(largest, std::abs(g));
    }
    if (!(std::abs(sum) <= kRounding * largest) || !std::isfinite(largest)) {
      return bad_cells("the gradients of " + name + " sum to " + rounded_text(sum) +
                       "; a constant has the gradient 0");
    }
  }
  return {};
}

/// Every corner of a cell has a share of some cell, without which its row would have no mass.
Result<void> check_masses(const CellComplex& cells) {
  if (cells.shares.empty()) return {};
  std::vector<char> has_mass(static_cast<std::size_t>(cells.vertices), 0);
  for (std::size_t k = 0; k < cells.corners.size(); ++k) {
    if (cells.shares[k] > 0) has_mass[cells.corners[k]] = 1;
  }
  for (const Index v : cells.corners) {
    if (has_mass[v]) continue;
    return bad_cells("vertex " + std::to_string(v) +
                     " has the share 0 of each of its cells; it needs one above 0");
  }
  return {};
}

}  // namespace

Result<void> check_cells(const CellComplex& cells) {
  if (const auto sizes = check_sizes(cells); !sizes) return sizes;
  for (Index c = 0; c < cells.cell_count(); ++c) {
    if (const auto valid = check_cell(cells, c); !valid) return valid;
  }
  if (const auto valid = check_masses(cells); !valid) return valid;
  for (std::size_t v = 0; v < cells.positions.size(); ++v) {
    if (!cells.positions[v].allFinite()) {
      return bad_cells("vertex " + std::to_string(v) + " has a coordinate that is not finite");
    }
  }
  return {};
}

Result<CellComplex> cells_of(const Graph& graph) try {
  CellComplex out;
  out.cell_name = "edge";
  out.cells_name = "edges";
  out.vertices = graph.vertices;
  out.dimension = 1;
  out.start.push_back(0);
  for (std::size_t e = 0; e < graph.edges.size(); ++e) {
    const auto& [from, to, length] = graph.edges[e];
    const std::string name = "edge " + std::to_string(e);
    if (std::min(from, to) < 0 || std::max(from, to) >= graph.vertices) {
      return bad_cells(name + " joins " + std::to_string(from) + " and " + std::to_string(to) +
                       ", and there are " + std::to_string(graph.vertices) + " vertices");
    }
    if (from == to)
      return bad_cells(name + " joins vertex " + std::to_string(from) + " with itself");
    if (!(length > 0) || !std::isfinite(length)) {
      return bad_cells(name + " has the length " + rounded_text(length) + "; it must be above 0");
    }
    out.corners.insert(out.corners.end(), {from, to});
    out.start.push_back(std::ssize(out.corners));
    out.gradients.insert(out.gradients.end(), {-1 / length, 1 / length});
    out.measures.push_back(length);
    out.widths.push_back(length);
  }
  if (graph.edges.empty()) return bad_cells("the graph has no edges");
  return out;
} catch (const std::bad_alloc&) {
  return Error{ErrorCode::kOutOfMemory, "the memory ended while cells were made of a graph"};
}

}  // namespace geotherm
