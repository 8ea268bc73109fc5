// SPDX-License-Identifier: MIT
#include <algorithm>
#include <atomic>
#include <cmath>
#include <new>
#include <string>

#include "geotherm/domains.h"
#include "solver/core/parallel.h"
#include "solver/core/sorting.h"
#include "solver/core/text.h"
#include "solver/points/sorted_points.h"
#include "solver/points/star.h"

namespace geotherm {
namespace {

/// Thrown within this file where the progress says stop.
struct Stopped {};

/// The work from points to faces, all of it on sorted points.
class SurfaceOfPoints {
 public:
  SurfaceOfPoints(const PointCloud& cloud, const PointOptions& options, SharedProgress& progress,
                  int threads)
      : cloud_(cloud),
        options_(options),
        progress_(progress),
        threads_(threads),
        sorted_(sort_points(cloud.positions(), threads)) {}

  void find_stars() {
    const NeighbourTree tree(sorted_.positions);
    const std::size_t count = sorted_.positions.size();
    radius_.resize(count);
    nearest_.resize(count);
    between_.assign(count, 0);
    opposed_.assign(count, 0);
    std::atomic<std::int64_t> done = 0;
    list_rows(
        size(), threads_,
        [&](Index i, std::vector<Index>& list) {
          // A star of some six triangles takes a few microseconds.
          constexpr std::int64_t kAskEvery = 1024;
          if (const std::int64_t before = done++; before % kAskEvery == 0) {
            ask(kSorted + (kStars - kSorted) * static_cast<double>(before) / double(count));
          }
          add_star(tree, i, list);
        },
        star_start_, star_corners_);
  }

  std::vector<Face> list_faces() {
    ask(kStars);
    std::vector<std::int64_t> start;
    std::vector<Index> corners;
    list_rows(
        size(), threads_, [&](Index i, std::vector<Index>& list) { add_faces(i, list); }, start,
        corners);
    std::vector<Face> faces(corners.size() / 3);
    for (std::size_t f = 0; f < faces.size(); ++f) {
      for (std::size_t k = 0; k < 3; ++k) {
        faces[f][k] = sorted_.number[static_cast<std::size_t>(corners[3 * f + k])];
      }
    }
    ask(1);
    return faces;
  }

  double mean_spacing() const {
    const auto sum = [&](std::int64_t begin, std::int64_t end) {
      double part = 0;
      for (std::int64_t i = begin; i < end; ++i) part += nearest_[static_cast<std::size_t>(i)];
      return part;
    };
    return parallel_sum(1, size(), sum) / size() * sorted_.unit;
  }

  Index points_between() const { return static_cast<Index>(std::ranges::count(between_, 1)); }
  Index points_opposed() const { return static_cast<Index>(std::ranges::count(opposed_, 1)); }
  Index size() const { return static_cast<Index>(sorted_.positions.size()); }
  const SortedPoints& sorted() const { return sorted_; }

 private:
  static constexpr double kSorted = 0.1, kStars = 0.9;  ///< shares of the whole

  void ask(double share) {
    if (!progress_("surface", share)) throw Stopped{};
  }

  /// The unit normal that came with a point; 0 where none did.
  Vec3 given_normal(Index i) const {
    if (cloud_.normals().empty()) return Vec3::Zero();
    const Vec3& normal =
        cloud_.normals()[static_cast<std::size_t>(sorted_.number[static_cast<std::size_t>(i)])];
    if (!normal.allFinite()) return Vec3::Zero();
    const double most = normal.cwiseAbs().maxCoeff();
    if (!(most > 0)) return Vec3::Zero();
    return (normal / most).normalized();
  }

  void add_star(const NeighbourTree& tree, Index i, std::vector<Index>& list) {
    Neighbourhood around;
    find_neighbours(tree, sorted_.positions, i, options_.neighbours, around);
    radius_[i] = around.radius;
    nearest_[i] = around.count > 0 ? std::sqrt(around.all[0].square) * around.radius : 0;
    Vec3 normal = given_normal(i);
    if (around.count < 2 || !(around.radius > 0)) return;
    const bool is_given = !normal.isZero(0);
    if (!is_given) normal = fitted_normal(around);
    const double gap = sheet_gap(around, normal);
    if (is_given && options_.normals_separate) {
      const int all = around.count;
      drop_opposed(normal, around);
      // On one sheet no more than those round a sharp edge are opposed.
      constexpr int kOneIn = 5;
      opposed_[i] = gap == 0 && (all - around.count) * kOneIn > all;
    }
    Star star;
    find_star(around, normal, star);
    between_[i] = gap > 0 && star.height > gap / 2;
    for (const auto& [j, k] : star.triangles) {
      list.push_back(j);
      list.push_back(k);
    }
  }

  void drop_opposed(const Vec3& normal, Neighbourhood& around) const {
    constexpr double kOpposed = -0.5;  // cosine of 120 degrees
    int kept = 0;
    for (const auto& neighbour : around.neighbours()) {
      if (given_normal(neighbour.number).dot(normal) < kOpposed) continue;
      around.all[kept++] = neighbour;
    }
    around.count = kept;
  }

  std::span<const Index> star(Index i) const {
    const auto at = static_cast<std::size_t>(i);
    return std::span(star_corners_)
        .subspan(static_cast<std::size_t>(star_start_[at]),
                 static_cast<std::size_t>(star_start_[at + 1] - star_start_[at]));
  }

  /// Whether the star of i has the triangle with j and k.
  bool found_by(Index i, Index j, Index k) const {
    const auto corners = star(i);
    for (std::size_t c = 0; c < corners.size(); c += 2) {
      if ((corners[c] == j && corners[c + 1] == k) || (corners[c] == k && corners[c + 1] == j)) {
        return true;
      }
    }
    return false;
  }

  /// Whether each of two points is among the nearest of the other.
  bool are_neighbours(Index i, Index j) const {
    const double distance = (sorted_.positions[i] - sorted_.positions[j]).norm();
    return distance <= std::min(radius_[i], radius_[j]) * (1 + 1e-12);
  }

  /// Appends the triangles of the star of i that no corner with a smaller number has found.
  void add_faces(Index i, std::vector<Index>& list) const {
    const auto corners = star(i);
    for (std::size_t c = 0; c < corners.size(); c += 2) {
      const Index j = corners[c], k = corners[c + 1];
      const bool of_j = found_by(j, i, k), of_k = found_by(k, i, j);
      if ((of_j && j < i) || (of_k && k < i)) continue;
      if (!of_j && !of_k &&
          !(are_neighbours(i, j) && are_neighbours(i, k) && are_neighbours(j, k))) {
        continue;
      }
      list.insert(list.end(), {i, j, k});
    }
  }

  const PointCloud& cloud_;
  const PointOptions& options_;
  SharedProgress& progress_;
  const int threads_;
  const SortedPoints sorted_;
  std::vector<double> radius_;   ///< to the last neighbour
  std::vector<double> nearest_;  ///< distance of the first
  std::vector<char> between_;    ///< its faces join two sheets
  std::vector<char> opposed_;    ///< normals near it point both ways, though there is one sheet
  std::vector<std::int64_t> star_start_;
  std::vector<Index> star_corners_;  ///< two a triangle
};

Result<void> check_options(const PointOptions& options) {
  constexpr int kFewest = 6;
  if (options.neighbours >= kFewest && options.neighbours <= NeighbourTree::kMaxNeighbours)
    return {};
  return Error{
      ErrorCode::kBadInput,
      "a point cannot be triangulated with " + std::to_string(options.neighbours) + " neighbours",
      {"take from " + std::to_string(kFewest) + " to " +
       std::to_string(NeighbourTree::kMaxNeighbours)}};
}

Error no_surface(Index points, Index places) {
  return {
      ErrorCode::kBadInput,
      counted_text(static_cast<std::size_t>(points), "point", "points") + " at " +
          counted_text(static_cast<std::size_t>(places), "place", "places") +
          " make no surface: no triangle was found among them",
      {"give at least four points that are not on one line: each takes its triangles from three "
       "others"}};
}

/// Pieces of the surface. `used`: for each point whether it is in a face.
Index part_count(const TriangleMesh& mesh, const std::vector<char>& used) {
  DisjointSets pieces(used.size());
  for (const Face& face : mesh.faces()) {
    pieces.join(face[0], face[1]);
    pieces.join(face[1], face[2]);
  }
  Index count = 0;
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    count += used[static_cast<std::size_t>(v)] != 0 && pieces.root(v) == v;
  }
  return count;
}

std::string share_text(Index part, Index whole) {
  return std::to_string(part) + " of " + std::to_string(whole) + " points";
}

/// Sentences about what was found. `opposed`: points whose neighbours' normals contradict theirs.
void describe(PointSurface& surface, Index opposed) {
  const Index points = surface.mesh.vertex_count();
  surface.notes.push_back(
      "the surface of " + counted_text(static_cast<std::size_t>(points), "point", "points") +
      " has " + counted_text(static_cast<std::size_t>(surface.mesh.face_count()), "face", "faces") +
      "; a point is " + rounded_text(surface.spacing) + " from the nearest other in the mean");
  if (surface.parts > 1) {
    surface.notes.push_back("it has " + std::to_string(surface.parts) +
                            " parts: sources in one of them do not reach the others");
  }
  if (surface.duplicates > 0) {
    surface.notes.push_back(share_text(surface.duplicates, points) +
                            " lie where an earlier one does, and have its distance");
  }
  if (surface.outliers > 0) {
    surface.warnings.push_back({share_text(surface.outliers, points) +
                                " lie off the surface, in no triangle, and are not reached"});
  }
  constexpr Index kFew = 1000;  // one in so many is no second sheet
  if (surface.between_sheets > points / kFew) {
    surface.warnings.push_back(
        {share_text(surface.between_sheets, points) +
             " join two sheets that are nearer to each other than their points, so that distances "
             "may pass from one to the other",
         {"give normals, which keep them apart, or more points"}});
  }
  if (opposed > points / 10) {
    surface.warnings.push_back({"normals near " + share_text(opposed, points) +
                                    " point to both sides of one sheet, which is torn there",
                                {"turn them to one side, or leave them out"}});
  }
}

}  // namespace

Result<PointSurface> surface_of(const PointCloud& cloud, const PointOptions& options,
                                const Progress& progress, int threads) {
  if (auto valid = check_options(options); !valid) return valid.error();
  SharedProgress shared(progress);
  if (!shared("surface", 0)) return shared.rethrow(), cancelled_error();
  try {
    SurfaceOfPoints work(cloud, options, shared, thread_count(threads));
    work.find_stars();
    std::vector<Face> faces = work.list_faces();
    const Index points = cloud.point_count();
    if (faces.empty()) return no_surface(points, work.size());
    std::vector<char> used(static_cast<std::size_t>(points), 0);
    for (const Face& face : faces) {
      for (const Index corner : face) used[static_cast<std::size_t>(corner)] = 1;
    }
    Index outliers = 0;
    for (const Index number : work.sorted().number) {
      outliers += used[static_cast<std::size_t>(number)] == 0;
    }
    std::vector<Vec3> positions(cloud.positions().begin(), cloud.positions().end());
    Result<TriangleMesh> mesh =
        work.sorted().same_as.empty()
            ? TriangleMesh::build(std::move(positions), std::move(faces))
            : TriangleMesh::build(std::move(positions), std::move(faces), work.sorted().same_as);
    if (!mesh) return mesh.error();
    const Index parts = part_count(*mesh, used);
    PointSurface surface{*std::move(mesh),      points - work.size(), parts, outliers,
                         work.points_between(), work.mean_spacing(),  {},    {}};
    describe(surface, work.points_opposed());
    return surface;
  } catch (const Stopped&) {
    shared.rethrow();
    return cancelled_error();
  } catch (const std::bad_alloc&) {
    return Error{ErrorCode::kOutOfMemory,
                 "the memory ended while the surface of " + std::to_string(cloud.point_count()) +
                     " points was made",
                 {"take fewer points"}};
  }
}

}  // namespace geotherm
