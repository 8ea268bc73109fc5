// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "geotherm/backend.h"
#include "geotherm/distance_method.h"
#include "geotherm/error.h"
#include "geotherm/mesh_report.h"
#include "geotherm/options.h"
#include "geotherm/progress.h"
#include "geotherm/sources.h"
#include "solver/geometry/domain_operator.h"
#include "solver/heat/source_anchors.h"
#include "solver/linear/symmetric_pattern.h"

// What the heat method asks of a space. Everything in this folder that works on a Domain alone
// works on every space; surface.h is the domain of triangle meshes.
namespace geotherm {

enum class BelowLine;
struct HeatField;
struct Surface;
struct Workspace;

/// How large a component is, in units of its domain.
struct ComponentSize {
  double mean_edge = 1;
  double area =
      0;  ///< of all cells: the sum of the squares of their widths where they are no faces
  Index cells = 0;      ///< that were not left out; of a triangle mesh those of the mesh
  double inserted = 0;  ///< share of the vertices that the input has not
  double grading = 1;   ///< the diffusion time that the cells resolve over mean_edge^2
};

/// Cells in the components that hold a source, and those of them where the heat has no direction,
/// whether or not it could have one.
struct CellCounts {
  Index in_reach = 0, without_direction = 0;
  double area = 0;  ///< of faces whose slope counts, in the mesh's units; of other cells 0
};

/// X = -grad u / |grad u| on every cell of a domain, for K source sets: the second of the heat
/// method's three steps. It may be shortened where fronts meet.
class UnitField {
 public:
  virtual ~UnitField() = default;

  /// b, n x K: the integral of X against the gradient of every vertex's hat function, so that
  /// L phi = b makes grad phi closest to X. Cost: one pass over the cells, nothing stored.
  virtual Block divergence(std::span<const SourceAnchors> anchors) const = 0;

  /// What the cells say of an answer `phi` (elimination order, units of the domain): mean of
  /// | |grad phi| - 1 |, lost gradients of u, edges that are too steep, all over the components
  /// that hold a source. Cells whose corners are all anchors or `held_at_zero` (a flag per row, or
  /// empty) have no gradient to lose. The same bits with any number of threads.
  virtual CellCounts inspect(std::span<const double> phi, Eigen::Index column,
                             const SourceAnchors& anchors, std::span<const char> held_at_zero,
                             int threads, Quality& quality) const = 0;
};

/// A space made ready for the heat method: analysed by a backend and renumbered into its
/// elimination order. Immutable; shared by every HeatMethod of the same input, backend and
/// Laplacian. Lengths are in units of `unit`, so that what follows sees numbers of order 1.
struct Domain {
  virtual ~Domain() = default;

  /// What a domain is made of, and made of again when backend or Laplacian change.
  class Input {
   public:
    virtual ~Input() = default;
    virtual Index cell_count() const = 0;
    /// "face", "faces".
    virtual std::array<const char*, 2> cell_names() const = 0;
    /// `progress` is asked as stages "operators" and "analyze". Errors: kBadInput (nothing that has
    /// a size, a Laplacian that the domain has not), kCancelled, and the backend's.
    virtual Result<std::shared_ptr<const Domain>> make(const Backend& backend,
                                                       LaplacianKind laplacian, int threads,
                                                       const Progress& progress) const = 0;
  };

  std::shared_ptr<const Input> input;
  double unit = 1;                   ///< length of 1 in model units: the mean edge length
  Index input_vertices = 0;          ///< V: they have distances; vertices from V on were inserted
  std::vector<Index> row_of_vertex;  ///< V, then inserted vertices: elimination number, kNoIndex
                                     ///< where in no cell
  std::vector<Index> vertex_of_row;  ///< n
  std::vector<char> on_boundary;     ///< n
  BoundaryRule auto_boundary = BoundaryRule::kNeumann;  ///< what BoundaryRule::kAuto is here
  std::vector<ComponentSize> component_sizes;
  std::shared_ptr<const Analysis> analysis;
  std::shared_ptr<BufferPool> factor_memory;  ///< of a domain that moves; null elsewhere
  /// n, EarlierFactor::changed beside the domain from which this one moved; empty where much has.
  std::vector<char> changed_rows;
  SetupTiming timing;             ///< operators with their stages, and analyze
  std::vector<Warning> findings;  ///< about the input

  Index size() const { return static_cast<Index>(vertex_of_row.size()); }
  /// Sets vertex_of_row, and row_of_vertex by it. `vertices`: with those that were inserted.
  void number_rows(std::vector<Index> vertex_of, Index vertices) {
    vertex_of_row = std::move(vertex_of);
    row_of_vertex.assign(static_cast<std::size_t>(vertices), kNoIndex);
    for (Index row = 0; row < size(); ++row) row_of_vertex[vertex_of_row[row]] = row;
  }
  /// Whether a row is a vertex of the input, not one that was inserted.
  bool is_of_input(Index row) const { return vertex_of_row[row] < input_vertices; }

  /// The components of the rows, numbered as `component_sizes`.
  virtual const Components& parts_of_rows() const = 0;
  virtual std::span<const double> mass() const = 0;  ///< n, lumped, > 0

  /// a A + s L with held rows. `consistent_share`: of the mass, as FemOperator has it; where it
  /// does not help, domains lump all of it.
  virtual std::shared_ptr<const DomainOperator> combine(double mass_factor,
                                                        const PerComponent& stiffness_factor,
                                                        std::vector<Index> held,
                                                        const PerComponent& consistent_share,
                                                        int threads) const = 0;

  /// y = L x. The same bits with any number of threads.
  virtual void apply_stiffness(std::span<const double> x, std::span<double> y,
                               int threads) const = 0;

  /// Errors (kBadInput, with the numbers): sources that are not in the domain, offsets above 0.
  virtual Result<SourceAnchors> place(const SourceSet& sources) const = 0;

  /// X for a solved heat step. `t` in squares of the unit, or 0 everywhere: |X| = 1, as published.
  /// Keeps references.
  virtual std::unique_ptr<const UnitField> unit_field(const HeatField& heat, const PerComponent& t,
                                                      const Workspace& work) const = 0;

  /// Near-exact distances around the sources, which stand in for heat's. There are none where
  /// UnitField::divergence() corrects X around the sources instead.
  virtual Result<std::vector<NearVertex>> near_field(const SourceAnchors& /*anchors*/) const {
    return std::vector<NearVertex>();
  }

  /// Fills in how many distances are below the straight line to the nearest source
  /// (Quality::below_straight_line), and raises them where `below` says so, where the space lies in
  /// R^3 and its lengths are those of lines.
  virtual void apply_straight_line_bound(const SourceSet& sources, BelowLine below, int threads,
                                         DistanceResult& result) const = 0;

  /// Flips of its triangles before its operators were made, and what was inserted into them.
  virtual Index flip_count() const { return 0; }
  virtual const RefinementCounts& inserted() const {
    static const RefinementCounts kNone;
    return kNone;
  }

  /// Itself, where it is a triangle mesh.
  virtual const Surface* surface() const { return nullptr; }
};

}  // namespace geotherm
