// SPDX-License-Identifier: MIT
#include "bench/benches.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <filesystem>
#include <system_error>
#include <thread>

#include "app/session/session.h"
#include "app/window/scene_screen.h"
#include "bench/bench_mesh.h"
#include "geotherm/io.h"
#include "solver/core/stopwatch.h"

namespace geotherm::bench {
namespace {

using namespace geotherm::app;

constexpr glm::ivec2 kWindow(1280, 800);
constexpr PictureArea kArea{{310, 22}, {660, 756}};
constexpr int kDrags = 40;
constexpr int kFrames = 15;
constexpr double kStrokeMs = 5000, kTouchMs = 16;

/// Faces of the model that is only turned: its set-up takes long.
constexpr Index kLargeModel = 1'000'000;
constexpr int kTurns = 30;

/// A session on a worker and what draws it, as in the window.
class Hand {
 public:
  explicit Hand(std::unique_ptr<SceneScreen> screen)
      : screen_(std::move(screen)), session_(hooks()) {}

  Result<void> open(const std::string& path) {
    if (auto done = session_.submit(command::Open{path}); !done) return done;
    if (auto done = session_.finish(); !done) return done;
    if (auto done = screen_->update(session_, kArea); !done) return done;
    return frame();
  }

  /// Draws a picture as the viewer does while something is dragged, or when the picture rests.
  Result<void> frame(Detail detail = Detail::kFewFaces) { return screen_->draw({}, detail); }

  /// Submits a command and waits until what is shown is what the command asks for.
  Result<void> follow(const Command& command) {
    const std::uint64_t before = session_.explored().version;
    if (auto done = session_.submit(command); !done) return done;
    while (session_.explored().version == before || session_.stale()) {
      rung_.wait(false);
      rung_ = false;
      session_.update();
    }
    return {};
  }

  /// One drag of a source, from the mouse to the picture.
  Result<double> drag(Index vertex) {
    const Stopwatch watch;
    if (auto done = follow(command::MoveSource{0, VertexList{{vertex}}}); !done) {
      return done.error();
    }
    query_.push_back(session_.explored().a->result.timing.query);
    Stopwatch part;
    if (auto done = screen_->update(session_, kArea); !done) return done.error();
    upload_.push_back(part.lap());
    if (auto done = frame(); !done) return done.error();
    frame_.push_back(part.lap());
    return watch.milliseconds();
  }

  Result<void> measure_drag(ExploreRow& row) {
    session_.set_dragging(true);
    const Index vertices = session_.explored().model->mesh->vertices;
    std::vector<double> all;
    for (int i = 0; i < kDrags; ++i) {
      const auto ms = drag(static_cast<Index>((17 + 131 * i) % vertices));
      if (!ms) return ms.error();
      if (i > 3) all.push_back(*ms);
    }
    row.drag_ms = median(all);
    row.query_ms = median(query_);
    row.upload_ms = median(upload_);
    row.frame_ms = median(frame_);
    session_.set_dragging(false);
    return session_.finish();
  }

  /// The model turns under the hand, then rests while the pointer moves over panels.
  Result<void> measure_turn(ExploreRow& row) {
    std::vector<double> turned, rested;
    for (int i = 0; i < kTurns; ++i) {
      const Stopwatch watch;
      if (auto done = session_.submit(command::Orbit{3, 0}); !done) return done;
      if (auto done = screen_->update(session_, kArea); !done) return done;
      if (auto done = frame(); !done) return done;
      if (i > 2) turned.push_back(watch.milliseconds());
    }
    Stopwatch watch;
    if (auto done = frame(Detail::kFull); !done) return done;
    row.full_frame_ms = watch.lap();
    for (int i = 0; i < kFrames; ++i) {
      if (auto done = screen_->update(session_, kArea); !done) return done;
      if (auto done = frame(Detail::kFull); !done) return done;
      rested.push_back(watch.lap());
    }
    row.turn_pictures = 1e3 / median(turned);
    row.hover_ms = median(rested);
    return {};
  }

  /// A hand goes on with a stroke, and pictures with new distances follow as fast as they can.
  Result<void> measure_stroke(ExploreRow& row) {
    session_.set_dragging(true);
    const MeshReport mesh = *session_.explored().model->mesh;
    const double radius = 0.06 * (mesh.box_max - mesh.box_min).norm();
    const auto point = [&](int i) {
      return FacePoint{(1000 + 7 * i) % mesh.faces, {0.25, 0.25, 0.5}};
    };
    const command::Sculpt first{{SculptTool::kPull, radius, 0.01, {point(0)}}};
    if (auto done = follow(first); !done) return done;
    std::vector<double> setups;
    const Stopwatch watch;
    for (int touches = 1; watch.milliseconds() < kStrokeMs;) {
      if (watch.milliseconds() > touches * kTouchMs) {
        if (auto done = session_.submit(command::ExtendStroke{{point(++touches)}}); !done) {
          return done;
        }
      }
      const std::uint64_t before = session_.explored().version;
      session_.update();
      if (session_.explored().version == before) {
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
        continue;
      }
      setups.push_back(session_.explored().a->setup_ms);
      if (auto done = screen_->update(session_, kArea); !done) return done;
      if (auto done = frame(); !done) return done;
    }
    row.stroke_pictures = 1e3 * static_cast<double>(setups.size()) / watch.milliseconds();
    row.stroke_setup_ms = median(setups);
    session_.set_dragging(false);
    return session_.finish();
  }

  /// Frames go on while the worker factors for another t.
  Result<void> measure_switch(ExploreRow& row) {
    std::vector<double> quiet;
    for (int i = 0; i < kFrames; ++i) {
      const Stopwatch watch;
      if (auto done = session_.submit(command::Orbit{1, 0}); !done) return done;
      if (auto done = screen_->update(session_, kArea); !done) return done;
      if (auto done = frame(Detail::kFull); !done) return done;
      quiet.push_back(watch.milliseconds());
    }
    row.usual_frame_ms = median(quiet);
    std::vector<double> longest, times;
    for (const char* factor : {"2", "3", "5"}) {
      const Stopwatch whole;
      if (auto done = session_.submit(command::Set{"time-factor", factor}); !done) return done;
      double most = 0;
      while (session_.stale()) {
        const Stopwatch watch;
        session_.update();
        if (auto done = session_.submit(command::Orbit{1, 0}); !done) return done;
        if (auto done = screen_->update(session_, kArea); !done) return done;
        if (auto done = frame(Detail::kFull); !done) return done;
        most = std::max(most, watch.milliseconds());
      }
      longest.push_back(most);
      times.push_back(whole.milliseconds());
    }
    row.longest_frame_ms = *std::ranges::max_element(longest);
    row.switch_ms = median(times);
    return {};
  }

 private:
  SessionHooks hooks() {
    SessionHooks hooks;
    hooks.wake = [this] {
      rung_ = true;
      rung_.notify_one();
    };
    return hooks;
  }

  std::atomic<bool> rung_ = false;  ///< by the session's work
  std::unique_ptr<SceneScreen> screen_;
  Session session_;
  std::vector<double> query_, upload_, frame_;
};

Result<ExploreRow> measure_mesh(const char* name, Index faces) {
  const auto mesh = make_mesh(name, faces);
  if (!mesh) return mesh.error();
  const std::string path =
      (std::filesystem::temp_directory_path() / "geotherm_bench_explore.ply").string();
  if (auto written = write_mesh(path, *mesh); !written) return written.error();
  ExploreRow row{.mesh = name, .faces = mesh->face_count()};
  const auto measured = [&]() -> Result<void> {
    auto screen = SceneScreen::open_without_window(kWindow, {});
    if (!screen) return screen.error();
    Hand hand(*std::move(screen));
    if (auto done = hand.open(path); !done) return done;
    if (auto done = hand.measure_turn(row); !done) return done;
    if (row.faces > kLargeModel / 2) return {};
    if (auto done = hand.measure_switch(row); !done) return done;
    if (auto done = hand.measure_drag(row); !done) return done;
    return hand.measure_stroke(row);
  }();
  std::error_code unknown;
  std::filesystem::remove(path, unknown);
  if (!measured) return measured.error();
  return row;
}

}  // namespace

ExploreBench measure_explore(const Say& say) {
  ExploreBench bench;
  for (const Index faces : {69'000, 200'000, kLargeModel}) {
    say("exploring " + std::to_string(faces) + " faces");
    auto row = measure_mesh("gargoyle", faces);
    if (!row) {
      bench.failure = sentence(row.error());
      return bench;
    }
    bench.rows.push_back(*std::move(row));
  }
  return bench;
}

}  // namespace geotherm::bench
