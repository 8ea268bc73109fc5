// SPDX-License-Identifier: MIT
#pragma once

#include <new>
#include <string>
#include <string_view>
#include <system_error>

#include "solver/core/progress.h"
#include "solver/core/result.h"
#include "solver/mesh/triangle_mesh.h"

namespace geotherm {

/// The result of `work`, or kOutOfMemory where the memory, or what else the system lends, ends
/// before it. `what`: is worked on, for the message.
template <class Work>
auto within_memory(std::string_view what, const TriangleMesh& mesh, Work&& work)
    -> decltype(work()) {
  const auto ended = [&](const char* end) {
    return Error{ErrorCode::kOutOfMemory,
                 std::string(end) + " while " + std::string(what) + " was sought on a mesh of " +
                     std::to_string(mesh.face_count()) + " faces; take a mesh with fewer faces"};
  };
  try {
    return work();
  } catch (const std::bad_alloc&) {
    return ended("the memory ended");
  } catch (const std::system_error&) {
    return ended("the system had no thread or lock left");
  }
}

/// The same for work(progress), whose progress may throw anything: that is thrown again, and no
/// error of the work.
template <class Work>
auto within_memory(std::string_view what, const TriangleMesh& mesh, const Progress& progress,
                   Work&& work) -> decltype(work(progress)) {
  SharedProgress shared(progress);
  const Progress watched = shared.function();
  auto result = within_memory(what, mesh, [&] { return work(watched); });
  shared.rethrow();
  return result;
}

}  // namespace geotherm
