// SPDX-License-Identifier: MIT
#include "bench/models/sculpture.h"

#include <algorithm>
#include <cmath>

namespace geotherm::generate {
namespace {

// In spacings: what must lie in a block, as further cells ask for corners of near ones.
constexpr double kMargin = SparseField::kNear + 0.5;
// From the middle of a unit cube to its corners.
constexpr double kCorner = 0.8660254037844386;

}  // namespace

SparseField::SparseField(const Sculpture& sculpture, double spacing, const Vec3& low,
                         const Vec3& high)
    : sculpture_(sculpture),
      spacing_(spacing),
      axes_(frame({0.86, 0.21, -0.46}, {-0.09, 0.94, 0.33}).transpose()),
      all_parts_(sculpture.all_parts()) {
  // The box around the box, seen along the grid's directions.
  const Vec3 middle = axes_.transpose() * (low + high) / 2;
  const Vec3 half =
      axes_.transpose().cwiseAbs() * (high - low) / 2 + Vec3::Constant(4.3 * spacing_);
  low_ = axes_ * (middle - half);
  for (int axis = 0; axis < 3; ++axis) {
    size_[index(axis)] = static_cast<int>(std::ceil(2 * half[axis] / (kSide * spacing_))) + 1;
  }
  lookup_.assign(index(size_[0]) * index(size_[1]) * index(size_[2]), -1);
}

std::size_t SparseField::cell_of(const GridPoint& block) const {
  return index(block[0]) + index(size_[0]) * (index(block[1]) + index(size_[1]) * index(block[2]));
}

GridPoint SparseField::block_origin(int block) const {
  const GridPoint& at = blocks_[index(block)].at;
  return {at[0] * kSide, at[1] * kSide, at[2] * kSide};
}

bool SparseField::sample(const Progress& progress) {
  const int widest = std::max({size_[0], size_[1], size_[2]});
  int size = 1;
  while (size < widest) size *= 2;
  return descend({0, 0, 0}, size, all_parts_, progress, 0.0, 1.0);
}

Vec3 SparseField::center_of(const GridPoint& block, int size) const {
  return place(kSide * (Vec3(block[0], block[1], block[2]) + Vec3::Constant(0.5 * size)));
}

double SparseField::reach_of(int size) const { return kCorner * kSide * size * spacing_; }

bool SparseField::descend(const GridPoint& block, int size, Sculpture::Parts parts,
                          const Progress& progress, double share, double part_of_whole) {
  for (int axis = 0; axis < 3; ++axis) {
    if (block[index(axis)] >= size_[index(axis)]) return true;
  }
  const double reach = reach_of(size);
  double d = 0;
  const std::vector<int> near = sculpture_.cull(center_of(block, size), reach, parts, d);
  if (std::abs(d) > Sculpture::kSteepest * reach + kMargin * spacing_ + sculpture_.detail_height())
    return true;
  if (size == 1) {
    make_block(block, near);
    return true;
  }
  const int child = size / 2;
  for (int i = 0; i < 8; ++i) {
    const double done = share + part_of_whole * i / 8;
    if (part_of_whole > 1e-3 && !report(progress, "sampling", done)) return false;
    const GridPoint next = {block[0] + (i & 1) * child, block[1] + ((i >> 1) & 1) * child,
                            block[2] + ((i >> 2) & 1) * child};
    if (!descend(next, child, near, progress, done, part_of_whole / 8)) return false;
  }
  return true;
}

int SparseField::make_block(const GridPoint& block, Sculpture::Parts parts) {
  const int number = block_count();
  lookup_[cell_of(block)] = number;
  Block& made = blocks_.emplace_back();
  made.at = block;
  for (int group = 0; group < kGroups; ++group) {
    made.first_part[index(group)] = std::ssize(parts_);
    sample_group(made, group, parts);
  }
  made.first_part[kGroups] = std::ssize(parts_);
  return number;
}

void SparseField::sample_group(Block& block, int group, Sculpture::Parts parts) {
  const GridPoint low = {2 * (group & 1), 2 * ((group >> 1) & 1), 2 * (group >> 2)};
  const Vec3 origin = kSide * Vec3(block.at[0], block.at[1], block.at[2]);
  const auto at = [&](double x, double y, double z) {
    return place(origin + Vec3(low[0] + x, low[1] + y, low[2] + z));
  };
  const double reach = 2 * kCorner * spacing_;
  double d = 0;
  const std::vector<int> near = sculpture_.cull(at(1, 1, 1), reach, parts, d);
  parts_.insert(parts_.end(), near.begin(), near.end());
  // A group that is far from the surface is known well enough by its middle.
  const bool far =
      std::abs(d) > kNear * spacing_ + Sculpture::kSteepest * reach + sculpture_.detail_height();
  for (int i = 0; i < 8; ++i) {
    const GridPoint step = {i & 1, (i >> 1) & 1, i >> 2};
    const int slot = slot_of({low[0] + step[0], low[1] + step[1], low[2] + step[2]});
    block.values[index(slot)] = far ? d : sculpture_.distance(at(step[0], step[1], step[2]), near);
  }
}

int SparseField::block_of(const GridPoint& p) {
  const GridPoint block = {p[0] >> 2, p[1] >> 2, p[2] >> 2};
  const int number = lookup_[cell_of(block)];
  if (number >= 0) return number;
  double d = 0;
  return make_block(block, sculpture_.cull(center_of(block, 1), reach_of(1), all_parts_, d));
}

std::array<double, 8> SparseField::corner_values(const GridPoint& cell) {
  std::array<double, 8> corners{};
  if ((cell[0] & 3) != 3 && (cell[1] & 3) != 3 && (cell[2] & 3) != 3) {  // all in one block
    const double* first = &blocks_[index(block_of(cell))].values[index(slot_of(cell))];
    for (int i = 0; i < 8; ++i) {
      corners[index(i)] = first[(i & 1) + kSide * ((i >> 1) & 1) + kSide * kSide * (i >> 2)];
    }
    return corners;
  }
  for (int i = 0; i < 8; ++i) {
    corners[index(i)] = value({cell[0] + (i & 1), cell[1] + ((i >> 1) & 1), cell[2] + (i >> 2)});
  }
  return corners;
}

Sculpture::Parts SparseField::parts_near(const Vec3& p) const {
  const Vec3 steps = axes_.transpose() * (p - low_) / spacing_;
  GridPoint block{};
  int group = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const int step = std::clamp(static_cast<int>(steps[axis]), 0, size_[index(axis)] * kSide - 1);
    block[index(axis)] = step / kSide;
    group |= (step % kSide / 2) << axis;
  }
  const int number = lookup_[cell_of(block)];
  if (number < 0) return all_parts_;
  const auto& first = blocks_[index(number)].first_part;
  return Sculpture::Parts(parts_).subspan(
      static_cast<std::size_t>(first[index(group)]),
      static_cast<std::size_t>(first[index(group) + 1] - first[index(group)]));
}

}  // namespace geotherm::generate
