// SPDX-License-Identifier: MIT
#include "solver/mesh/generate/sculpture.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace geotherm::generate {
namespace {

constexpr double kFar = 1e9;
// The bounds that stand for distances may grow a little faster than distances.
constexpr double kSteepest = 1.25;
// In units of the spacing: the smallest radius of a part that the grid shows in one piece.
constexpr double kThinnest = 0.8;
// In units of the spacing: the smallest reach of parts that are not small themselves, so that
// gaps that the grid cannot show are filled.
constexpr double kSmoothest = 1.5;
// In units of the spacing: the smallest size of a part that is worth thickening.
constexpr double kTiniest = 0.35;
// A tube of more pieces is cut, so that each place needs to look at a few of them only.
constexpr std::size_t kLongest = 3;

double blend_in(double a, double b, double reach) {
  const double h = std::max(reach - std::abs(a - b), 0.0);
  return std::min(a, b) - h * h / (4 * reach);
}

/// The radius that decides how much a shape shows: of a tube the widest, of a ball the middle one.
double size_of(const Shape& shape) {
  if (const auto* ellipsoid = std::get_if<Ellipsoid>(&shape)) {
    const Vec3& r = ellipsoid->radii;
    return r.sum() - r.minCoeff() - r.maxCoeff();
  }
  if (const auto* swept = std::get_if<Tube>(&shape)) {
    return *std::max_element(swept->radii.begin(), swept->radii.end());
  }
  if (const auto* box = std::get_if<RoundBox>(&shape)) return box->half.minCoeff();
  return std::get<Sheet>(shape).half;
}

}  // namespace

double Sculpture::thick(double radius) const { return std::max(radius, kThinnest * spacing_); }

void Sculpture::add(Shape shape, double reach) {
  const bool is_sheet = std::holds_alternative<Sheet>(shape);
  if (!is_sheet && size_of(shape) < kTiniest * spacing_) return;
  if (auto* ellipsoid = std::get_if<Ellipsoid>(&shape)) {
    ellipsoid->radii = ellipsoid->radii.cwiseMax(kThinnest * spacing_);
  } else if (auto* swept = std::get_if<Tube>(&shape)) {
    for (double& radius : swept->radii) radius = thick(radius);
  } else if (auto* sheet = std::get_if<Sheet>(&shape)) {
    sheet->half = thick(sheet->half);
  }
  append(std::move(shape), reach, false);
}

void Sculpture::carve(Shape shape, double reach) { append(std::move(shape), reach, true); }

void Sculpture::append(Shape shape, double asked, bool carved) {
  const double reach = std::max(asked, std::min(kSmoothest * spacing_, 0.5 * size_of(shape)));
  const int group = groups_++;
  const auto* swept = std::get_if<Tube>(&shape);
  if (!swept) {
    parts_.push_back({std::move(shape), reach, carved, group});
    return;
  }
  const std::size_t last = swept->points.size() - 1;
  for (std::size_t from = 0; from < last; from += kLongest) {
    const auto cut = [&](const auto& all) {
      return std::decay_t<decltype(all)>(
          all.begin() + static_cast<std::ptrdiff_t>(from),
          all.begin() + static_cast<std::ptrdiff_t>(std::min(from + kLongest, last) + 1));
    };
    parts_.push_back({Tube{cut(swept->points), cut(swept->radii)}, reach, carved, group});
  }
}

void Sculpture::add_pair(const Shape& shape, double reach) {
  add(shape, reach);
  add(mirrored(shape), reach);
}

void Sculpture::carve_pair(const Shape& shape, double reach) {
  carve(shape, reach);
  carve(mirrored(shape), reach);
}

void Sculpture::set_detail(Detail detail, double height) {
  detail_ = std::move(detail);
  detail_height_ = height;
}

std::vector<int> Sculpture::all_parts() const {
  std::vector<int> parts(parts_.size());
  std::iota(parts.begin(), parts.end(), 0);
  return parts;
}

double Sculpture::blend(double d, double own, const Part& part) {
  return part.carved ? -blend_in(-d, own, part.reach) : blend_in(d, own, part.reach);
}

double Sculpture::distance(const Vec3& p, Parts parts) const {
  double d = kFar;
  const Part* part = nullptr;
  double own = kFar;
  for (const int i : parts) {
    const Part& next = parts_[static_cast<std::size_t>(i)];
    if (part && part->group != next.group) {
      d = blend(d, own, *part);
      own = kFar;
    }
    part = &next;
    own = std::min(own, distance_to(next.shape, p));
  }
  if (part) d = blend(d, own, *part);
  if (detail_ && std::abs(d) < 1.5 * spacing_ + detail_height_) d -= detail_(p);
  return d;
}

std::vector<int> Sculpture::cull(const Vec3& center, double radius, Parts parts,
                                 double& distance_there) const {
  const double r = kSteepest * radius;
  struct Candidate {
    int part;
    double added;
  };
  std::vector<Candidate> near;
  double d = kFar;
  for (std::size_t k = 0; k < parts.size();) {
    const Part& part = parts_[static_cast<std::size_t>(parts[k])];
    const std::size_t earlier = near.size();
    double own = kFar;
    for (; k < parts.size(); ++k) {
      const Part& piece = parts_[static_cast<std::size_t>(parts[k])];
      if (piece.group != part.group) break;
      const double piece_own = distance_to(piece.shape, center);
      own = std::min(own, piece_own);
      const bool idle =
          part.carved ? -piece_own + r < d - r - part.reach : piece_own - r > d + r + part.reach;
      if (!idle) near.push_back({parts[k], part.carved ? -kFar : piece_own});
    }
    if (!part.carved && d - r > own + r + part.reach) {  // alone from here on
      near.erase(near.begin(), near.begin() + static_cast<std::ptrdiff_t>(earlier));
    }
    d = blend(d, own, part);
  }
  distance_there = d;
  double widest = 0;
  for (const Candidate& candidate : near) {
    widest = std::max(widest, parts_[static_cast<std::size_t>(candidate.part)].reach);
  }
  std::vector<int> kept;  // without those that later ones cover altogether
  for (const Candidate& candidate : near) {
    if (candidate.added - r <= d + r + widest) kept.push_back(candidate.part);
  }
  return kept;
}

}  // namespace geotherm::generate
