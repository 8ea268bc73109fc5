// SPDX-License-Identifier: MIT
#include "app/session/reference_beside.h"

#include <chrono>
#include <exception>

#include "solver/core/memory.h"
#include "solver/core/parallel.h"

namespace geotherm::app {

bool ReferenceBeside::is_worth_it(const TriangleMesh& mesh, int threads) {
  constexpr double kNanosecondsPerFace = 400;   // of the wavefront method, set-up and query
  constexpr std::int64_t kBytesPerFace = 4096;  // several times what both need together
  const std::int64_t faces = mesh.face_count();
  if (threads_worth_starting(threads, kNanosecondsPerFace * static_cast<double>(faces)) < 2) {
    return false;
  }
  const auto free = free_memory();
  return !free || *free > kBytesPerFace * faces;
}

TriangulationReady ReferenceBeside::starter() {
  return [this](std::shared_ptr<const IntrinsicSurface> triangulation) {
    if (has_begun()) return;  // by a backend that failed afterwards, on the same triangulation
    thread_ = try_thread([this, triangulation = std::move(triangulation)](std::stop_token stop) {
      try {
        const Progress watched = [this, &stop](std::string_view, double share) {
          share_ = share;
          return !stop.stop_requested();
        };
        answers_.set_value(solve_reference(mesh_, kind_, sets_, 1, triangulation, watched));
      } catch (...) {
        answers_.set_exception(std::current_exception());
      }
    });
  };
}

Result<ReferenceAnswers> ReferenceBeside::wait(const Progress& progress) {
  constexpr std::chrono::milliseconds kBetweenReports{50};
  while (done_.wait_for(kBetweenReports) != std::future_status::ready) {
    if (report(progress, to_text(kind_), share_)) continue;
    thread_.request_stop();
    return cancelled_error();
  }
  return done_.get();
}

}  // namespace geotherm::app
