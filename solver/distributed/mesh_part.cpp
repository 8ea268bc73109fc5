// SPDX-License-Identifier: MIT
#include "solver/distributed/mesh_part.h"

#include <cmath>
#include <limits>
#include <tuple>

#include "solver/core/sorting.h"
#include "solver/mesh/connectivity.h"

namespace geotherm {

int part_of_share(std::int64_t number, std::int64_t all, int parts) {
  auto part = static_cast<int>((number + 1) * parts / all);
  part = std::clamp(part, 0, parts - 1);
  while (number < share_begin(all, part, parts)) --part;
  while (number >= share_begin(all, part + 1, parts)) ++part;
  return part;
}

namespace {

/// A vertex with its place along the curve.
struct CurveVertex {
  std::uint64_t key;
  GlobalIndex file_id;
  double at[3];

  auto place() const { return std::tuple(key, file_id); }
};

/// Morton's order within the box of all ranks' vertices.
std::vector<CurveVertex> along_curve(const RankGroup& ranks, const MeshSlice& slice) {
  constexpr double kPlaces = (1 << 21) - 1;
  std::array<double, 6> box;
  box.fill(-kUnreached);
  for (const Vec3& p : slice.positions) {
    for (std::size_t k = 0; k < 3; ++k) {
      const double x = p[static_cast<Eigen::Index>(k)];
      box[k] = std::max(box[k], x);
      box[k + 3] = std::max(box[k + 3], -x);
    }
  }
  ranks.all_reduce(box, RankGroup::Reduction::kMax);
  const double width = std::max({box[0] + box[3], box[1] + box[4], box[2] + box[5]});
  std::vector<CurveVertex> out(slice.positions.size());
  for (std::size_t i = 0; i < out.size(); ++i) {
    out[i] = {0, slice.first_vertex + static_cast<GlobalIndex>(i), {}};
    for (std::size_t k = 0; k < 3; ++k) {
      out[i].at[k] = slice.positions[i][static_cast<Eigen::Index>(k)];
      const double share = width > 0 ? (out[i].at[k] + box[k + 3]) / width : 0.0;
      out[i].key |= spread_bits(static_cast<std::uint64_t>(share * kPlaces)) << k;
    }
  }
  std::ranges::sort(out, {}, &CurveVertex::place);
  return out;
}

/// Sample sort: each rank gets what lies between two of the places that samples of all ranks say.
std::vector<CurveVertex> share_out(const RankGroup& ranks, std::vector<CurveVertex> mine) {
  constexpr std::size_t kSamples = 256;
  struct Place {
    std::uint64_t key;
    GlobalIndex id;
    auto operator<=>(const Place&) const = default;
  };
  std::vector<Place> samples;
  for (std::size_t i = 0; i < kSamples && !mine.empty(); ++i) {
    const CurveVertex& at = mine[(2 * i + 1) * mine.size() / (2 * kSamples)];
    samples.push_back({at.key, at.file_id});
  }
  samples = ranks.all_gather(samples);
  std::ranges::sort(samples);
  const auto count = static_cast<std::size_t>(ranks.count());
  PerRank<CurveVertex> out(count);
  auto next = mine.begin();
  for (std::size_t r = 0; r < count; ++r) {
    auto end = mine.end();
    if (r + 1 < count) {
      const Place cut = samples[(r + 1) * samples.size() / count];
      end = std::lower_bound(next, mine.end(), cut, [](const CurveVertex& v, const Place& place) {
        return Place{v.key, v.file_id} < place;
      });
    }
    out[r].assign(next, end);
    next = end;
  }
  mine = {};
  const PerRank<CurveVertex> in = ranks.all_to_all(out);
  for (const auto& each : in) mine.insert(mine.end(), each.begin(), each.end());
  std::ranges::sort(mine, {}, &CurveVertex::place);
  return mine;
}

using GlobalFace = std::array<GlobalIndex, 3>;

/// Renames corners from numbers in the file to global ones, by a directory that the ranks share.
void rename_corners(const RankGroup& ranks, const MeshPart& part, std::vector<GlobalFace>& faces) {
  struct Entry {
    GlobalIndex file_id, id;
  };
  const int count = ranks.count();
  const auto holder = [&](GlobalIndex file_id) {
    return static_cast<std::size_t>(part_of_share(file_id, part.vertices, count));
  };
  const GlobalIndex begin = share_begin(part.vertices, ranks.rank(), count);
  std::vector<GlobalIndex> directory(
      static_cast<std::size_t>(share_begin(part.vertices, ranks.rank() + 1, count) - begin));
  {
    PerRank<Entry> out(static_cast<std::size_t>(count));
    for (Index v = 0; v < part.own; ++v) {
      out[holder(part.file_id[v])].push_back({part.file_id[v], part.id[v]});
    }
    for (const auto& each : ranks.all_to_all(out)) {
      for (const Entry& entry : each) {
        directory[static_cast<std::size_t>(entry.file_id - begin)] = entry.id;
      }
    }
  }
  std::vector<GlobalIndex> asked;
  asked.reserve(3 * faces.size());
  for (const GlobalFace& face : faces) asked.insert(asked.end(), face.begin(), face.end());
  std::ranges::sort(asked);
  asked.erase(std::unique(asked.begin(), asked.end()), asked.end());
  PerRank<GlobalIndex> questions(static_cast<std::size_t>(count));
  for (const GlobalIndex id : asked) questions[holder(id)].push_back(id);
  PerRank<GlobalIndex> answers = ranks.all_to_all(questions);
  for (auto& each : answers) {
    for (GlobalIndex& id : each) id = directory[static_cast<std::size_t>(id - begin)];
  }
  std::vector<GlobalIndex> names;  // in the order of `asked`, since shares ascend
  for (const auto& each : ranks.all_to_all(answers)) {
    names.insert(names.end(), each.begin(), each.end());
  }
  for (GlobalFace& face : faces) {
    for (GlobalIndex& corner : face) {
      corner =
          names[static_cast<std::size_t>(std::ranges::lower_bound(asked, corner) - asked.begin())];
    }
  }
}

/// Faces to the owners of their corners.
std::vector<GlobalFace> hand_out(const RankGroup& ranks, const MeshPart& part,
                                 const std::vector<GlobalFace>& faces) {
  PerRank<GlobalFace> out(static_cast<std::size_t>(ranks.count()));
  for (const GlobalFace& face : faces) {
    const std::array<int, 3> owner = {part.owner(face[0]), part.owner(face[1]),
                                      part.owner(face[2])};
    for (std::size_t k = 0; k < 3; ++k) {
      const auto before = owner.begin() + static_cast<std::ptrdiff_t>(k);
      if (std::find(owner.begin(), before, owner[k]) == before) {
        out[static_cast<std::size_t>(owner[k])].push_back(face);
      }
    }
  }
  std::vector<GlobalFace> mine;
  for (const auto& each : ranks.all_to_all(out)) mine.insert(mine.end(), each.begin(), each.end());
  return mine;
}

/// Appends faces; corners that are new here come at the end of the halo.
void add_faces(const RankGroup& ranks, std::span<const GlobalFace> faces, MeshPart& part) {
  for (const GlobalFace& face : faces) {
    Face& corners = part.corners.emplace_back();
    for (std::size_t k = 0; k < 3; ++k) {
      Index here = part.local(face[k], ranks.rank());
      if (here == kNoIndex) {
        here = part.size();
        part.halo.emplace(face[k], here);
        part.id.push_back(face[k]);
      }
      corners[k] = here;
    }
  }
}

void fetch_positions(const RankGroup& ranks, Index from, MeshPart& part) {
  std::vector<Index> fresh;
  for (Index v = from; v < part.size(); ++v) fresh.push_back(v);
  part.positions.resize(part.id.size(), Vec3::Zero());
  struct Point {
    double at[3];
  };
  std::vector<Point> points(part.id.size());
  for (Index v = 0; v < part.own; ++v) {
    points[v] = {{part.positions[v][0], part.positions[v][1], part.positions[v][2]}};
  }
  Halo(ranks, part, fresh).fetch(ranks, points);
  for (const Index v : fresh)
    part.positions[v] = Vec3(points[v].at[0], points[v].at[1], points[v].at[2]);
}

/// Brings the positions of all ranks into one unit, which is returned.
double normalise(const RankGroup& ranks, std::vector<Vec3>& positions) {
  double most = 0;
  for (const Vec3& p : positions) most = std::max(most, p.cwiseAbs().maxCoeff());
  int exponent = 0;
  std::frexp(ranks.max(most), &exponent);
  for (Vec3& p : positions) {
    for (double& x : p) x = std::ldexp(x, -exponent);
  }
  return std::ldexp(1.0, exponent);
}

}  // namespace

Result<MeshPart> share_mesh(const RankGroup& ranks, MeshSlice slice) {
  MeshPart part;
  part.vertices = slice.vertices;
  part.faces = slice.faces;
  part.unit = normalise(ranks, slice.positions);
  std::vector<CurveVertex> mine = share_out(ranks, along_curve(ranks, slice));
  slice.positions = {};
  // Vertices with their halo, and three entries a face, are numbered by 32 bits.
  constexpr std::size_t kMaxOwn = std::numeric_limits<Index>::max() / 24;
  Result<void> fits;
  if (mine.size() > kMaxOwn || part.vertices > std::numeric_limits<Index>::max()) {
    fits = Error{ErrorCode::kBadInput,
                 std::to_string(part.vertices) + " vertices over " + std::to_string(ranks.count()) +
                     " ranks are more than 32 bits number",
                 {"take more ranks, of at most " + std::to_string(kMaxOwn) +
                  " vertices each and 2^31 in all"}};
  }
  if (auto all = ranks.agree(fits); !all) return all.error();
  part.own = static_cast<Index>(mine.size());
  part.first = ranks.all_gather(std::vector<GlobalIndex>{part.own});
  part.first.insert(part.first.begin(), 0);
  for (std::size_t r = 1; r < part.first.size(); ++r) part.first[r] += part.first[r - 1];
  const GlobalIndex begin = part.first[static_cast<std::size_t>(ranks.rank())];
  for (const CurveVertex& v : mine) {
    part.id.push_back(begin + std::ssize(part.id));
    part.file_id.push_back(v.file_id);
    part.positions.emplace_back(v.at[0], v.at[1], v.at[2]);
  }
  mine = {};
  rename_corners(ranks, part, slice.corners);
  const std::vector<GlobalFace> faces = hand_out(ranks, part, slice.corners);
  slice.corners = {};
  add_faces(ranks, faces, part);
  part.own_faces = static_cast<Index>(part.corners.size());
  part.ring_begin = {part.own, part.size()};
  fetch_positions(ranks, part.own, part);
  return part;
}

void grow_halo(const RankGroup& ranks, int rings, MeshPart& part) {
  if (part.rings() >= rings) return;
  const CornerTable at_own(part.size(),
                           std::span(part.corners).first(static_cast<std::size_t>(part.own_faces)));
  const GlobalIndex first = part.first[static_cast<std::size_t>(ranks.rank())];
  const Index fresh = part.size();
  while (part.rings() < rings) {
    const Index begin = part.ring_begin[part.ring_begin.size() - 2], end = part.size();
    PerRank<GlobalIndex> asked(static_cast<std::size_t>(ranks.count()));
    for (Index v = begin; v < end; ++v) {
      asked[static_cast<std::size_t>(part.owner(part.id[v]))].push_back(part.id[v]);
    }
    PerRank<GlobalFace> answers;
    for (const auto& each : ranks.all_to_all(asked)) {
      std::vector<Index> faces;
      for (const GlobalIndex v : each) {
        for (const Side side : at_own.at(static_cast<Index>(v - first))) {
          faces.push_back(face_of(side));
        }
      }
      std::ranges::sort(faces);
      faces.erase(std::unique(faces.begin(), faces.end()), faces.end());
      auto& out = answers.emplace_back();
      for (const Index f : faces) {
        const Face& face = part.corners[f];
        out.push_back({part.id[face[0]], part.id[face[1]], part.id[face[2]]});
      }
    }
    // Faces at rings before are here; others may come from several owners.
    std::vector<GlobalFace> found;
    for (const auto& each : ranks.all_to_all(answers)) {
      for (const GlobalFace& face : each) {
        const bool here = std::ranges::any_of(face, [&](GlobalIndex v) {
          const Index at = part.local(v, ranks.rank());
          return at != kNoIndex && at < begin;
        });
        if (!here) found.push_back(face);
      }
    }
    const auto sorted = [](GlobalFace face) {
      std::ranges::sort(face);
      return face;
    };
    std::ranges::sort(found, {}, sorted);
    const auto same = [&](const GlobalFace& a, const GlobalFace& b) {
      return sorted(a) == sorted(b);
    };
    found.erase(std::unique(found.begin(), found.end(), same), found.end());
    add_faces(ranks, found, part);
    part.ring_begin.push_back(part.size());
  }
  fetch_positions(ranks, fresh, part);
}

Halo::Halo(const RankGroup& ranks, const MeshPart& part, std::span<const Index> wanted)
    : take_(static_cast<std::size_t>(ranks.count())) {
  PerRank<GlobalIndex> asked(take_.size());
  for (const Index v : wanted) {
    const auto owner = static_cast<std::size_t>(part.owner(part.id[v]));
    asked[owner].push_back(part.id[v]);
    take_[owner].push_back(v);
  }
  const GlobalIndex first = part.first[static_cast<std::size_t>(ranks.rank())];
  for (const auto& each : ranks.all_to_all(asked)) {
    auto& out = send_.emplace_back();
    for (const GlobalIndex v : each) out.push_back(static_cast<Index>(v - first));
  }
}

}  // namespace geotherm
