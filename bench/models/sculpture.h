// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <variant>
#include <vector>

#include "bench/models/draft_mesh.h"
#include "geotherm/error.h"
#include "geotherm/progress.h"
#include "geotherm/types.h"

namespace geotherm::generate {

/// The solids that models are sculpted from. Each distance is negative inside, zero on the surface
/// and, near the surface, about the distance to it: exact for the box, a bound for the others.

/// |R (p - center) / radii| = 1; the rows of R are the axes (J. Quilez's bound of the distance).
struct Ellipsoid {
  Vec3 center;
  Vec3 radii;
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();
};

/// Balls of changing radius swept along a polyline; see tube() for a smooth one.
struct Tube {
  std::vector<Vec3> points;
  std::vector<double> radii;
};

/// A box with edges rounded by `radius` (the half sizes include the rounding).
struct RoundBox {
  Vec3 center;
  Vec3 half;
  double radius;
};

/// A sheet with ribs: a flat outline of half thickness `half`, thickened by rods, and bent out of
/// its plane by `bow` u^2 + `lean` v^2, with `billow` more between the rods.
struct Sheet {
  struct Rod {
    Eigen::Vector2d from, to;
    double from_radius, to_radius;
  };
  Vec3 origin;
  Eigen::Matrix3d axes;  ///< rows: u, v, normal
  std::vector<Eigen::Vector2d> outline;
  std::vector<Rod> rods;
  double half;
  double bow, lean, billow;
};

using Shape = std::variant<Ellipsoid, Tube, RoundBox, Sheet>;

double distance_to(const Ellipsoid& shape, const Vec3& p);
double distance_to(const Tube& shape, const Vec3& p);
double distance_to(const RoundBox& shape, const Vec3& p);
double distance_to(const Sheet& shape, const Vec3& p);
double distance_to(const Shape& shape, const Vec3& p);

/// A shape mirrored at the plane x = 0.
Shape mirrored(const Shape& shape);

/// A point of a curve with the radius of the solid around it.
struct Knot {
  Vec3 point;
  double radius;
};

/// A smooth tube through the knots: a Catmull-Rom curve, `steps` pieces between two knots.
Tube tube(const std::vector<Knot>& knots, int steps = 6);

/// Rows: three perpendicular axes, the first along `main`, the second nearest to `second`.
Eigen::Matrix3d frame(const Vec3& main, const Vec3& second);

/// A solid made by adding and carving shapes one after another, each blended into what is there.
///
/// distance(p) is negative inside and about the distance near the surface. Blending is the
/// quadratic smooth minimum with compact support: a shape changes nothing where it is further
/// from the surface than its reach, which is what cull() lives on.
class Sculpture {
 public:
  /// How much faster than distances the bounds that stand for them may grow.
  static constexpr double kSteepest = 1.25;
  using Parts = std::span<const int>;  ///< numbers of shapes, in the order they were made in
  using Detail = std::function<double(const Vec3& p)>;

  /// `spacing`, about, of the grid that will sample it: shapes thinner than the grid can hold are
  /// thickened.
  explicit Sculpture(double spacing) : spacing_(spacing) {}

  void add(Shape shape, double reach);
  void carve(Shape shape, double reach);
  void add_pair(const Shape& shape, double reach);    ///< with its mirror image, x -> -x
  void carve_pair(const Shape& shape, double reach);  ///< with its mirror image, x -> -x

  /// Raises the surface by detail(p), at most `height` in size, where that is near.
  void set_detail(Detail detail, double height);

  double spacing() const { return spacing_; }
  std::vector<int> all_parts() const;
  double distance(const Vec3& p, Parts parts) const;

  /// The parts among `parts` that can matter within `radius` of `center`; `distance_there` gets the
  /// distance at the centre. Shapes only: how much the detail may add is detail_height().
  std::vector<int> cull(const Vec3& center, double radius, Parts parts,
                        double& distance_there) const;
  double detail_height() const { return detail_height_; }

 private:
  /// Long tubes are kept as several parts of one group, whose union (not blended) counts as one.
  struct Part {
    Shape shape;
    double reach;
    bool carved;
    int group;
  };
  double thick(double radius) const;
  void append(Shape shape, double asked, bool carved);
  static double blend(double d, double own, const Part& part);

  double spacing_;
  double detail_height_ = 0;
  int groups_ = 0;
  std::vector<Part> parts_;
  Detail detail_;
};

/// A point of the grid, counted from the box's lowest corner.
using GridPoint = std::array<int, 3>;

/// A sculpture's distances at the points of a cubic grid, kept in blocks of 4 x 4 x 4 points, and
/// only in blocks near the surface, each with the few shapes that matter there.
///
/// The grid stands aslant: a plane of the sculpture that ran along it, a little rough, would give
/// sometimes one and sometimes three squares of the grid's surface per square of its own.
///
/// Every point has one value, whichever cell asks for it. A block that is asked for and is not
/// there is made then. Cost: proportional to the surface, not to the volume.
class SparseField {
 public:
  static constexpr int kSide = 4;
  /// In spacings: values are exact where they are smaller; the surface crosses no grid edge that
  /// starts further away.
  static constexpr double kNear = 2.0;
  static constexpr int kPoints = kSide * kSide * kSide;

  /// Covers the box from `low` to `high`. `sculpture` must outlive the field.
  SparseField(const Sculpture& sculpture, double spacing, const Vec3& low, const Vec3& high);

  /// Finds and samples the blocks near the surface; false when the caller cancelled.
  bool sample(const Progress& progress);

  double spacing() const { return spacing_; }
  Vec3 position(const GridPoint& p) const { return place(Vec3(p[0], p[1], p[2])); }
  int block_count() const { return static_cast<int>(blocks_.size()); }
  GridPoint block_origin(int block) const;

  /// The block that holds the point, made when it is missing.
  int block_of(const GridPoint& p);
  static int slot_of(const GridPoint& p) {
    return (p[0] & 3) + kSide * ((p[1] & 3) + kSide * (p[2] & 3));
  }
  double value(const GridPoint& p) { return blocks_[index(block_of(p))].values[index(slot_of(p))]; }
  /// The values at the corners of the cell: bit 0 of a corner's number is x, bit 1 y, bit 2 z.
  std::array<double, 8> corner_values(const GridPoint& cell);
  void set_value(const GridPoint& p, double value) {
    blocks_[index(block_of(p))].values[index(slot_of(p))] = value;
  }

  /// The shapes that matter around `p`.
  Sculpture::Parts parts_near(const Vec3& p) const;
  const Sculpture& sculpture() const { return sculpture_; }

 private:
  /// Blocks are sampled in groups of 2 x 2 x 2 points, each with shapes of its own.
  static constexpr int kGroups = 8;
  struct Block {
    GridPoint at;                                      ///< in blocks
    std::array<std::int64_t, kGroups + 1> first_part;  ///< of each group, in parts_
    std::array<double, kPoints> values;
  };
  static std::size_t index(int i) { return static_cast<std::size_t>(i); }
  std::size_t cell_of(const GridPoint& block) const;
  Vec3 place(const Vec3& steps) const { return low_ + spacing_ * (axes_ * steps); }
  Vec3 center_of(const GridPoint& block, int size) const;
  double reach_of(int size) const;  ///< from the centre of a cube of `size` blocks to its corners
  bool descend(const GridPoint& block, int size, Sculpture::Parts parts, const Progress& progress,
               double share, double part_of_whole);
  int make_block(const GridPoint& block, Sculpture::Parts parts);
  void sample_group(Block& block, int group, Sculpture::Parts parts);

  const Sculpture& sculpture_;
  double spacing_;
  Eigen::Matrix3d axes_;  ///< columns: the grid's directions
  Vec3 low_;
  GridPoint size_;  ///< in blocks
  std::vector<int> all_parts_;
  std::vector<int> lookup_;  ///< per cell of the block grid: its block, or -1
  std::vector<Block> blocks_;
  std::vector<int> parts_;  ///< of all groups, one after another
};

/// What sculpt() makes a mesh of: the solid for a given grid spacing, and a box around it.
struct SculptureModel {
  std::function<Sculpture(double spacing)> carve;
  Vec3 low, high;
  double area;  ///< of the surface, about: where the search for the spacing starts
};

/// A closed mesh of about `faces` faces of the solid: finds the grid's spacing that gives this many
/// (within 2 %, or the nearest of ten), extracts the surface, then evens out its triangles on it.
/// Error: kCancelled.
Result<DraftMesh> sculpt(const SculptureModel& model, Index faces, const Progress& progress);

}  // namespace geotherm::generate
