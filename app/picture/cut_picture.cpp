// SPDX-License-Identifier: MIT
#include "app/picture/cut_picture.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "app/picture/openness.h"
#include "solver/volume/tet_slice.h"

namespace geotherm::app {
namespace {

/// Vertices this near to the plane lie on it; of the model's extent, above the rounding of floats.
constexpr double kOnPlane = 1e-6;

std::vector<Vec3> to_vectors(const std::vector<PictureData::Vector>& all) {
  std::vector<Vec3> out;
  out.reserve(all.size());
  for (const auto& [x, y, z] : all) out.emplace_back(x, y, z);
  return out;
}

std::vector<Face> to_faces(const std::vector<std::array<std::uint32_t, 3>>& all) {
  std::vector<Face> out;
  out.reserve(all.size());
  for (const auto& [a, b, c] : all) {
    out.push_back({static_cast<Index>(a), static_cast<Index>(b), static_cast<Index>(c)});
  }
  return out;
}

struct PlaneInScene {
  SlicePlane plane;
  double extent = 0;  ///< of the model along the normal

  /// Whether a source or a point of a path goes with what is removed; on the cut they are seen.
  bool removes(const PictureData::Vector& p) const {
    constexpr double kSeen = 0.01;
    const double height = plane.normal.dot(Vec3(p[0], p[1], p[2])) - plane.offset;
    return height > kSeen * extent;
  }
};

/// The plane of the settings; none where the model has no extent along its normal.
std::optional<PlaneInScene> plane_of(const std::vector<Vec3>& positions,
                                     const std::vector<Face>& faces,
                                     const PictureDataSettings& settings) {
  if (!settings.slice || faces.empty()) return std::nullopt;
  const auto& [x, y, z] = *settings.slice;
  const Vec3 normal = Vec3(x, y, z).stableNormalized();
  double low = kUnreached, high = -kUnreached;
  for (const Face& face : faces) {
    for (const Index v : face) {
      const double height = normal.dot(positions[static_cast<std::size_t>(v)]);
      low = std::min(low, height);
      high = std::max(high, height);
    }
  }
  if (!(high - low > kOnPlane)) return std::nullopt;
  return PlaneInScene{{normal, low + settings.slice_at * (high - low)}, high - low};
}

/// Whether a cell stays: all of its corners do, or its sides would stand out as spikes. What is not
/// reached is far.
class Threshold {
 public:
  Threshold(const PictureData& data, const Peel& peel) : values_(data.values), peel_(peel) {
    double most = data.value_unit;
    if (data.value_base != 0) {
      most = std::max(std::abs(data.smallest_value), std::abs(data.greatest_value));
    }
    base_ = data.value_base / most;
    unit_ = data.value_unit / most;
  }

  template <class Cell>
  bool keeps(const Cell& cell) const {
    return std::ranges::all_of(cell, [this](Index v) {
      const float value = values_[static_cast<std::size_t>(v)];
      const double share = value == kNoPictureValue ? kUnreached : std::abs(base_ + value * unit_);
      return peel_.side == PeelSide::kBelow ? share <= peel_.share : share >= peel_.share;
    });
  }

 private:
  const std::vector<float>& values_;
  const Peel& peel_;
  double base_, unit_;  // of the values, in shares of the largest
};

/// What is drawn, in the making: faces over vertices and points.
struct Parts {
  std::vector<EdgePoint> points;
  std::vector<Face> faces;
  std::vector<Index> origin;
  std::vector<Index> tets;  ///< of the faces; empty on surfaces
};

/// Faces inside that are no cut are the sides of tets: each has points of its own, so that it is
/// shaded as the flat face it is.
void separate(Parts& parts, std::size_t first, std::size_t last, std::size_t vertices) {
  for (std::size_t f = first; f < last; ++f) {
    if (parts.origin[f] != kNoIndex) continue;
    for (Index& corner : parts.faces[f]) {
      const auto c = static_cast<std::size_t>(corner);
      parts.points.push_back(c < vertices ? EdgePoint{corner, corner, 0}
                                          : parts.points[c - vertices]);
      corner = static_cast<Index>(vertices + parts.points.size() - 1);
    }
  }
}

Parts parts_of(const PictureData& whole, const PictureDataSettings& settings,
               const std::vector<Vec3>& positions, const std::vector<Face>& all,
               const std::optional<PlaneInScene>& cut) {
  Parts parts{{}, all, {}, whole.face_tets};
  for (std::size_t f = 0; f < all.size(); ++f) parts.origin.push_back(static_cast<Index>(f));
  std::vector<Tet> tets;
  std::vector<Index> numbers;  // of tets, where some are peeled off
  if (whole.volume) tets.assign(whole.volume->tets().begin(), whole.volume->tets().end());
  if (settings.peel.side != PeelSide::kOff && !whole.values.empty()) {
    const Threshold threshold(whole, settings.peel);
    if (whole.volume) {
      std::vector<char> keep;
      for (std::size_t t = 0; t < tets.size(); ++t) {
        keep.push_back(threshold.keeps(tets[t]) ? 1 : 0);
        if (keep[t] != 0) numbers.push_back(static_cast<Index>(t));
      }
      PeeledSurface peeled = peel(*whole.volume, all, keep);
      parts.faces = std::move(peeled.faces);
      parts.origin = std::move(peeled.origin);
      parts.tets = std::move(peeled.tets);
    } else {
      std::erase_if(parts.origin, [&](Index f) { return !threshold.keeps(all[f]); });
      parts.faces.clear();
      for (const Index f : parts.origin) parts.faces.push_back(all[f]);
    }
    std::erase_if(tets, [&](const Tet& tet) { return !threshold.keeps(tet); });
  }
  std::size_t sides = parts.faces.size();
  if (cut) {
    SlicedSurface sliced = slice(positions, parts.faces, tets, cut->plane, kOnPlane * cut->extent);
    sides = 0;
    std::vector<Index> tets_of_faces;
    for (Index& from : sliced.origin) {
      if (from == kNoIndex) break;  // the cut comes last
      const auto f = static_cast<std::size_t>(from);
      if (!parts.tets.empty()) tets_of_faces.push_back(parts.tets[f]);
      from = parts.origin[f];
      ++sides;
    }
    for (const Index t : sliced.tets) {
      tets_of_faces.push_back(numbers.empty() ? t : numbers[static_cast<std::size_t>(t)]);
    }
    parts = {std::move(sliced.points), std::move(sliced.faces), std::move(sliced.origin),
             std::move(tets_of_faces)};
  }
  separate(parts, 0, sides, positions.size());
  return parts;
}

PictureData::Vector between(const PictureData::Vector& a, const PictureData::Vector& b, double t) {
  PictureData::Vector out{};
  for (std::size_t k = 0; k < 3; ++k) {
    out[k] = static_cast<float>((1 - t) * double{a[k]} + t * double{b[k]});
  }
  return out;
}

float value_between(float a, float b, double t) {
  if (t == 0) return a;
  if (a == kNoPictureValue || b == kNoPictureValue) return kNoPictureValue;
  return static_cast<float>((1 - t) * double{a} + t * double{b});
}

double apart(const PictureData::Vector& a, const PictureData::Vector& b) {
  return std::hypot(double{a[0]} - double{b[0]}, double{a[1]} - double{b[1]},
                    double{a[2]} - double{b[2]});
}

/// The group whose source is nearer, by the way along the edge.
Index nearest_of(const PictureData& data, const EdgePoint& point) {
  const auto a = static_cast<std::size_t>(point.a), b = static_cast<std::size_t>(point.b);
  if (data.nearest[a] == data.nearest[b] || data.values.empty()) return data.nearest[a];
  const double way = apart(data.positions[a], data.positions[b]);
  const double unit = data.value_unit / data.model_per_scene;
  const double from_a = double{data.values[a]} * unit + point.share * way;
  const double from_b = double{data.values[b]} * unit + (1 - point.share) * way;
  return data.nearest[from_b < from_a ? b : a];
}

/// Takes away the sources and the points of paths that a slice would leave in the air.
void remove_beyond(const PlaneInScene& cut, PictureData& data) {
  std::erase_if(data.sources, [&cut](const PictureData::Segment& source) {
    return cut.removes(source.from) || cut.removes(source.to);
  });
  for (PictureData::Line& line : data.lines) {
    for (PictureData::Vector& point : line.points) {
      if (cut.removes(point)) point.fill(std::numeric_limits<float>::quiet_NaN());
    }
  }
}

/// The values of the faces that are left; a face of the cut has none of its own and gets `none`.
template <class Value>
std::vector<Value> left_of(const std::vector<Value>& all, const std::vector<Index>& origin,
                           const Value& none) {
  std::vector<Value> out;
  if (all.empty()) return out;
  out.reserve(origin.size());
  for (const Index f : origin) {
    out.push_back(f == kNoIndex ? none : all[static_cast<std::size_t>(f)]);
  }
  return out;
}

}  // namespace

bool is_cut(const PictureData& data, const PictureDataSettings& settings) {
  return settings.slice || (settings.peel.side != PeelSide::kOff && !data.values.empty());
}

CutPicture cut_picture(const PictureData& whole, const PictureDataSettings& settings) {
  const std::vector<Vec3> positions = to_vectors(whole.positions);
  const std::vector<Face> faces = to_faces(whole.faces);
  const auto cut = plane_of(positions, faces, settings);
  const Parts parts = parts_of(whole, settings, positions, faces, cut);
  CutPicture out{whole, parts.origin};
  PictureData& data = out.data;
  if (cut) remove_beyond(*cut, data);
  data.faces.clear();
  for (const Face& face : parts.faces) {
    data.faces.push_back({static_cast<std::uint32_t>(face[0]), static_cast<std::uint32_t>(face[1]),
                          static_cast<std::uint32_t>(face[2])});
  }
  for (const EdgePoint& p : parts.points) {
    const auto a = static_cast<std::size_t>(p.a), b = static_cast<std::size_t>(p.b);
    data.positions.push_back(between(whole.positions[a], whole.positions[b], p.share));
    if (!whole.values.empty()) {
      data.values.push_back(value_between(whole.values[a], whole.values[b], p.share));
    }
    if (!whole.nearest.empty()) data.nearest.push_back(nearest_of(whole, p));
  }
  data.openness = openness_of(data.positions, data.faces);
  data.face_values = left_of(whole.face_values, out.origin, kNoPictureValue);
  data.heat_directions = left_of(whole.heat_directions, out.origin, {});
  data.distance_gradients = left_of(whole.distance_gradients, out.origin, {});
  data.face_tets = parts.tets;
  if (whole.volume) {
    show_tets(data);
  } else {
    data.solid = false;  // one sees into it
  }
  return out;
}

}  // namespace geotherm::app
