// SPDX-License-Identifier: MIT
#include <tiny_obj_loader.h>

#include "bench/load_bench.h"

namespace geotherm::bench {

Result<bool> read_with_tinyobjloader(const std::string& path) {
  tinyobj::ObjReader reader;
  if (reader.ParseFromFile(path)) return true;
  return Error{ErrorCode::kBadFile, "tinyobjloader: " + reader.Error()};
}

}  // namespace geotherm::bench
