// SPDX-License-Identifier: MIT
// Windows from their seeds over the surface: one window through one face, and the order of all.
#include "solver/polyhedral/propagation.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "solver/core/text.h"
#include "solver/polyhedral/wave_surface.h"
#include "solver/polyhedral/window.h"

namespace geotherm {
namespace {

/// A bucket of the queue, in mean edges.
constexpr double kWindowBucketWidth = 0.25;
/// Faces with a height or a side below this, in mean edges, are crossed several times while the
/// windows of one bucket are followed: there these must be in order.
constexpr double kFine = 0.25 * kWindowBucketWidth;

/// The cost of a window, in comparisons of two windows at an edge with many faces.
constexpr std::int64_t kWindowWork = 16;

/// Work between two calls of progress: a few milliseconds.
constexpr std::int64_t kWorkBetweenChecks = kWindowWork << 14;

/// The total number of windows is forecast after this many.
constexpr double kSample = 2e6;

/// The most windows that a query may be forecast to take. On smooth closed surfaces they grow like
/// F^1.5 (measured: 0.35 times that on spheres, 0.5 on tori, 1.5 on Moebius strips), on others more
/// slowly; where each of thousands of vertices bends the paths to everything behind it, they grow
/// like F^2. Small meshes get some two seconds in any case.
double most_windows(double faces) { return std::max(1e7, 4 * faces * std::sqrt(faces)); }

/// share / whole of the length; all of it where that is more, or no number.
double part_of_length(double length, double share, double whole) {
  return share < whole ? length * (share / whole) : length;
}

}  // namespace

Propagation::Propagation(const WindowMesh& mesh, std::size_t most_bytes)
    : mesh_(mesh),
      most_bytes_(most_bytes),
      queue_(kWindowBucketWidth),
      vertices_(static_cast<std::size_t>(mesh.vertex_count())),
      leaders_(static_cast<std::size_t>(mesh.side_count())),
      waiting_(leaders_.size(), nullptr),
      at_branches_(static_cast<std::size_t>(mesh.branch_count())) {}

void Propagation::follow_directions(const StartDirections& starts) {
  starts_ = &starts;
  directions_.assign(vertices_.size(), std::numeric_limits<double>::quiet_NaN());
}

Result<void> Propagation::run(const SourceSeeds& seeds, const Progress& progress, double radius,
                              std::span<const Index> targets) {
  const double base = least_offset(seeds);
  radius_ = radius - base;
  targets_ = targets;
  seed(seeds, base);
  if (auto fine = spread(progress); !fine) return fine;
  for (VertexState& state : vertices_) state.distance += base;
  return {};
}

void Propagation::seed(const SourceSeeds& seeds, double base) {
  for (const auto& seed : seeds.vertices) {
    reach(seed.vertex, seed.offset - base, seed.group, true);
    if (starts_) directions_[static_cast<std::size_t>(seed.vertex)] = 0;
  }
  for (std::size_t i = 0; i < seeds.pieces.size(); ++i) {
    SourceSeeds::Piece piece = seeds.pieces[i];
    piece.offset -= base;
    if (piece.from == piece.to) {
      seed_point(piece, starts_ ? &starts_->of_piece[i] : nullptr);
    } else {
      seed_segment(piece);
    }
  }
}

/// Whether no window that is left can be the nearest to what is asked for. A window finds nothing
/// below its key, and hands on nothing with a smaller one, but for rounding.
bool Propagation::has_all() {
  constexpr double kLess = 1 - 1e-9;
  const double least = queue_.least_key() * kLess;
  if (least > radius_) return true;
  while (has_ < targets_.size() && distance_at(targets_[has_]) < least) ++has_;
  return has_ == targets_.size() && has_ > 0;
}

Result<void> Propagation::spread(const Progress& progress) {
  while (const Window* next = queue_.pop()) {
    if (has_all()) return {};
    const Window window = *next;
    if (window.side < 0) {
      send_from(~window.side, window.sigma, window.group());
    } else {
      Window*& waiting = waiting_[static_cast<std::size_t>(window.side)];
      if (waiting == next) waiting = nullptr;
      follow(window);
    }
    ++windows_;
    work_ += kWindowWork;
    if (work_ < next_check_) continue;
    next_check_ = work_ + kWorkBetweenChecks;
    if (auto fine = check(progress); !fine) return fine;
  }
  return {};
}

Result<void> Propagation::check(const Progress& progress) {
  const std::size_t bytes = queue_.bytes() + crossed_ * sizeof(Window);
  const Index faces = mesh_.side_count() / 3;
  const double all = std::max(mesh_.vertices_in_use(), Index{1});
  if (!report(progress, "solve", static_cast<double>(reached_) / all)) return cancelled_error();
  if (bytes > most_bytes_) {
    return Error{ErrorCode::kOutOfMemory,
                 "exact distances on " + std::to_string(faces) +
                     " faces: " + std::to_string(bytes / sizeof(Window)) +
                     " windows are kept and fill " + std::to_string(most_bytes_ >> 20) + " MB",
                 {most_bytes_ < kMaxBytes ? "take fewer threads, or " : "use ",
                  SettingHint{"method", {"wavefront-fine"}}}};
  }
  const double done = static_cast<double>(work_) / static_cast<double>(kWindowWork);
  const double foreseen = done * all / std::max(reached_, Index{1}), most = most_windows(faces);
  if (done >= kSample && foreseen > most) {
    return Error{ErrorCode::kBudgetEnded,
                 "exact distances on " + std::to_string(faces) + " faces: " + rounded_text(done) +
                     " windows have reached " + std::to_string(reached_) + " of " +
                     rounded_text(all) + " vertices, so that some " + rounded_text(foreseen) +
                     " are foreseen where " + rounded_text(most) + " are worth the wait",
                 {"use ", SettingHint{"method", {"wavefront-fine"}}}};
  }
  return {};
}

/// Notes a distance of a vertex. True where the vertex had none as small before.
bool Propagation::reach(Index vertex, double distance, Index group, bool send_anyway) {
  VertexState& state = vertices_[static_cast<std::size_t>(vertex)];
  if (distance >= state.distance) return false;
  if (state.distance == kUnreached) ++reached_;
  state.distance = distance;
  state.group = group;
  if (!send_anyway && !mesh_.sends(vertex)) return true;
  if (distance >= state.sent * (1 - kTie)) return true;
  state.sent = distance;
  queue_.push({0, 0, 0, 0, distance, ~vertex, Window::label_of(group)}, distance, true);
  return true;
}

/// Reaches a vertex by a path whose first piece is the window's line through (x, y).
void Propagation::reach_by(const Window& window, Index vertex, double x, double y,
                           double distance) {
  if (!reach(vertex, distance, window.group()) || !starts_) return;
  directions_[static_cast<std::size_t>(vertex)] = window.start_direction_to(x, y);
}

void Propagation::send_from(Index vertex, double distance, Index group) {
  if (vertices_[static_cast<std::size_t>(vertex)].sent != distance)
    return;  // a later one is queued
  const auto sides = mesh_.opposite_sides(vertex);
  for (std::size_t i = 0; i < sides.size(); ++i) {
    const Side side = sides[i];
    const auto& frame = mesh_.side(side);
    const auto& next = mesh_.side(next_side(side));
    Window window{0,        frame.length, frame.apex_x,           -frame.apex_y,
                  distance, side,         Window::label_of(group)};
    if (starts_ && starts_->vertex == vertex) {
      window.turn = starts_->of_opposite[i].turn;
      if (starts_->of_opposite[i].mirrored) window.mirror_start();
    } else if (starts_) {
      window.turn = directions_[static_cast<std::size_t>(vertex)];
      window.label |= Window::kBent;
    }
    reach_by(window, frame.origin, 0, 0, distance + mesh_.side(previous_side(side)).length);
    reach_by(window, next.origin, frame.length, 0, distance + next.length);
    cross(side, window, false);
  }
}

/// Sends a window out of a face through `side`. The window is in the frame of the side, or in the
/// reversed one, with its source below.
void Propagation::cross(Side side, Window window, bool against) {
  const auto& frame = mesh_.side(side);
  if (frame.across == WindowMesh::kBoundary) return;
  double at_origin = distance_at(frame.origin);
  double at_length = distance_at(mesh_.side(next_side(side)).origin);
  if (against) std::swap(at_origin, at_length);
  if (!trim_by_ends(window, frame.length, at_origin, at_length)) return;
  if (frame.across <= WindowMesh::kBranch && !is_early_at_branch(side, window, against)) return;
  const double key = window.distance_at(window.nearest_place());
  mesh_.for_each_across(side, [&](Side other, bool opposite) {
    Window child = window;
    child.side = other;
    if (opposite != against) {
      child.reverse(frame.length);
      if (starts_) child.reverse_start();
    }
    if (!merges_with_waiting(child, frame.length)) {
      const bool fine = std::min(frame.length, mesh_.side(other).apex_y) < kFine;
      waiting_[static_cast<std::size_t>(other)] = queue_.push(child, key, fine);
    }
  });
}

/// Two windows that a flat vertex has split meet again side by side on the next edge: they go on as
/// one. Otherwise large flat regions would be split into ever more windows.
bool Propagation::merges_with_waiting(const Window& window, double length) {
  Window* waiting = waiting_[static_cast<std::size_t>(window.side)];
  if (!waiting || (waiting->label | Window::kMerged) != (window.label | Window::kMerged))
    return false;
  const double margin = kOrder * length;
  if (window.begin > waiting->end + margin || window.end < waiting->begin - margin) return false;
  if (!have_same_source(*waiting, window)) return false;
  waiting->begin = std::min(waiting->begin, window.begin);
  waiting->end = std::max(waiting->end, window.end);
  waiting->label |= Window::kMerged;
  return true;
}

/// Windows multiply at an edge with many faces, and without end where they meet again behind the
/// next one. So each goes on only where it gives smaller distances than all before it.
bool Propagation::is_early_at_branch(Side side, Window& window, bool against) {
  const auto& frame = mesh_.side(side);
  auto& others = at_branches_[static_cast<std::size_t>(WindowMesh::kBranch - frame.across)];
  const bool reversed = against != (frame.origin > mesh_.side(next_side(side)).origin);
  Window in_edge = window;
  if (reversed) in_edge.reverse(frame.length);
  work_ += static_cast<std::int64_t>(others.size());
  for (const Window& other : others) {
    if (!trim_dominated_ends(in_edge, other, frame.length)) return false;
  }
  others.push_back(in_edge);
  ++crossed_;
  window.begin = reversed ? frame.length - in_edge.end : in_edge.begin;
  window.end = reversed ? frame.length - in_edge.begin : in_edge.end;
  window.label |= Window::kBranched;
  return true;
}

void Propagation::follow(Window window) {
  const auto& frame = mesh_.side(window.side);
  const Index begin = frame.origin, end = mesh_.side(next_side(window.side)).origin;
  const Index apex = mesh_.side(previous_side(window.side)).origin;
  if (!trim_by_ends(window, frame.length, distance_at(begin), distance_at(end))) return;

  const auto apex_is_left_of = [&](double at) {
    return window.ray_x(at) * frame.apex_y - window.ray_y() * (frame.apex_x - at);
  };
  const double left_of_begin = apex_is_left_of(window.begin);
  const double left_of_end = apex_is_left_of(window.end);
  Passage passage{!(left_of_begin > 0), !(left_of_end < 0)};
  const bool meets_apex = passage.left && passage.right;
  if (meets_apex) {
    reach_by(window, apex, frame.apex_x, frame.apex_y,
             window.distance_to(frame.apex_x, frame.apex_y));
  } else {
    // The way along the outermost line, and then straight on from the side, exists as well. It is
    // what finds corners that stand in the gap of rounding between two windows.
    const double at = passage.left ? window.end : window.begin;
    const double rest = std::hypot(frame.apex_x - at, frame.apex_y);
    reach_by(window, apex, at, 0, window.distance_at(at) + rest);
  }
  if (!yield_to_leader(window, frame.length, frame.apex_x, frame.apex_y,
                       leaders_[static_cast<std::size_t>(window.side)], passage)) {
    return;
  }
  if (passage.left) send_left(window, meets_apex);
  if (passage.right) send_right(window, meets_apex);
}

/// To the side from the apex to the first corner, in the frame from that corner.
void Propagation::send_left(const Window& w, bool from_apex) {
  const auto& frame = mesh_.side(w.side);
  const Side side = previous_side(w.side);
  const auto& target = mesh_.side(side);
  const double ex = frame.apex_x * target.inverse_length;
  const double ey = frame.apex_y * target.inverse_length;
  const auto place = [&](double at) {
    return part_of_length(target.length, w.ray_y() * at,
                          target.length * (w.ray_y() * ex - w.ray_x(at) * ey));
  };
  Window child = w;
  child.begin = place(w.begin);
  child.end = from_apex ? target.length : place(w.end);
  const double x = child.begin * ex, y = child.begin * ey;
  const double from_corner = distance_at(mesh_.side(next_side(w.side)).origin);
  if (from_corner + std::hypot(x - frame.length, y) < w.distance_to(x, y) * (1 - kTie)) return;
  child.x = w.x * ex + w.y * ey;
  child.y = w.y * ex - w.x * ey;
  child.y = w.is_plane() ? std::max(child.y, 0.0) : std::min(child.y, 0.0);
  if (starts_) child.rotate_start(std::atan2(ey, ex));
  cross(side, child, true);
}

/// Sends the window on to the side from the second corner to the apex, in that side's own frame.
void Propagation::send_right(const Window& w, bool from_apex) {
  const auto& frame = mesh_.side(w.side);
  const Side side = next_side(w.side);
  const auto& target = mesh_.side(side);
  const double ex = (frame.apex_x - frame.length) * target.inverse_length;
  const double ey = frame.apex_y * target.inverse_length;
  const auto place = [&](double at) {
    return part_of_length(target.length, w.ray_y() * (frame.length - at),
                          target.length * (w.ray_x(at) * ey - w.ray_y() * ex));
  };
  Window child = w;
  child.begin = place(w.end);
  child.end = from_apex ? target.length : place(w.begin);
  const double x = frame.length + child.begin * ex, y = child.begin * ey;
  const double from_corner = distance_at(frame.origin);
  if (from_corner + std::hypot(x, y) < w.distance_to(x, y) * (1 - kTie)) return;
  const double dx = w.is_plane() ? w.x : w.x - frame.length;
  child.x = dx * ex + w.y * ey;
  child.y = dx * ey - w.y * ex;
  child.y = w.is_plane() ? std::max(child.y, 0.0) : std::min(child.y, 0.0);
  if (w.is_plane()) child.sigma += w.x * frame.length;
  if (starts_) {
    child.rotate_start(std::atan2(ey, ex));
    child.mirror_start();
  }
  cross(side, child, false);
}

}  // namespace geotherm
