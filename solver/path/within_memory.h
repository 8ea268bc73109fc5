// SPDX-License-Identifier: MIT
#pragma once

#include <new>
#include <string>
#include <string_view>
#include <system_error>

#include "geotherm/error.h"
#include "geotherm/mesh.h"
#include "geotherm/progress.h"
#include "solver/core/parallel.h"

namespace geotherm {

/// `end`: what has ended. `what`: was worked on.
inline Error ended_error(const char* end, std::string_view what, const TriangleMesh& mesh) {
  return {ErrorCode::kOutOfMemory,
          std::string(end) + " while " + std::string(what) + " was sought on a mesh of " +
              std::to_string(mesh.face_count()) + " faces",
          {"take a mesh with fewer faces"}};
}

/// The result of `work`, or kOutOfMemory where the memory, or what else the system lends, ends
/// before it. `what`: is worked on, for the message.
template <class Work>
auto within_memory(std::string_view what, const TriangleMesh& mesh, Work&& work)
    -> decltype(work()) {
  try {
    return work();
  } catch (const std::bad_alloc&) {
    return ended_error("the memory ended", what, mesh);
  } catch (const std::system_error&) {
    return ended_error("the system had no thread or lock left", what, mesh);
  }
}

/// The same for work(progress), whose progress may throw anything: that is thrown again, and no
/// error of the work, but for std::bad_alloc.
template <class Work>
auto within_memory(std::string_view what, const TriangleMesh& mesh, const Progress& progress,
                   Work&& work) -> decltype(work(progress)) {
  SharedProgress shared(progress);
  const Progress watched = shared.function();
  auto result = within_memory(what, mesh, [&] { return work(watched); });
  try {
    shared.rethrow();
  } catch (const std::bad_alloc&) {
    return ended_error("the memory ended", what, mesh);
  }
  return result;
}

}  // namespace geotherm
