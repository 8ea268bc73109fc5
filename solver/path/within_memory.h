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

/// `end`: which resource ran out. `what`: the task that needed it.
inline Error ended_error(const char* end, std::string_view what, const TriangleMesh& mesh) {
  return {ErrorCode::kOutOfMemory,
          std::string(end) + " while " + std::string(what) + " was sought on a mesh of " +
              std::to_string(mesh.face_count()) + " faces",
          {"take a mesh with fewer faces"}};
}

/// The result of `work`, or kOutOfMemory where memory, threads or locks run out. `what`: names the
/// task in the message.
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

/// The same for work(progress). What the progress callback throws is thrown again and not taken for
/// an error of the work, except std::bad_alloc.
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
