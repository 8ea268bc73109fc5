// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "solver/mesh/generate/shapes.h"

namespace geotherm::generate {

/// A solid made by adding and carving shapes one after another, each blended into what is there.
///
/// distance(p) is negative inside and about the distance near the surface. Blending is the
/// quadratic smooth minimum with compact support: a shape changes nothing where it is further
/// from the surface than its reach, which is what cull() lives on.
class Sculpture {
 public:
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

  /// Those of `parts` that can matter within `radius` of `center`; `distance_there` gets the
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

}  // namespace geotherm::generate
