// SPDX-License-Identifier: MIT
#include <tiny_obj_loader.h>

#include "bench/load_bench.h"
#include "solver/core/stopwatch.h"

namespace geotherm::bench {

Result<double> time_tinyobjloader(const std::string& path) {
  tinyobj::ObjReader reader;
  const Stopwatch watch;
  const bool read = reader.ParseFromFile(path);
  const double elapsed = watch.milliseconds();
  if (read) return elapsed;
  return Error{ErrorCode::kBadFile, "tinyobjloader: " + reader.Error()};
}

}  // namespace geotherm::bench
