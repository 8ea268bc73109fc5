// SPDX-License-Identifier: MIT
#include "bench/benches.h"

#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <filesystem>

#include "geotherm/io.h"
#include "solver/core/stopwatch.h"

#ifdef GEOTHERM_BENCH_TINYOBJLOADER
#include <tiny_obj_loader.h>
#endif

namespace geotherm::bench {
namespace {

/// A file that is gone when this is.
class TemporaryFile {
 public:
  explicit TemporaryFile(const std::string& ending)
      : path_(std::filesystem::temp_directory_path() /
              ("geotherm_bench_" + std::to_string(getpid()) + ending)) {}
  ~TemporaryFile() {
    std::error_code ignored;
    std::filesystem::remove(path_, ignored);
  }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;

  std::string path() const { return path_.string(); }

 private:
  std::filesystem::path path_;
};

bool write_obj(const std::string& path, const TriangleMesh& mesh) {
  std::FILE* file = std::fopen(path.c_str(), "w");
  if (file == nullptr) return false;
  for (const Vec3& p : mesh.positions()) {
    std::fprintf(file, "v %.6f %.6f %.6f\n", p.x(), p.y(), p.z());
  }
  for (const auto& [a, b, c] : mesh.faces()) {
    std::fprintf(file, "f %d %d %d\n", a + 1, b + 1, c + 1);
  }
  const bool whole = std::ferror(file) == 0;
  return std::fclose(file) == 0 && whole;
}

/// Milliseconds that tinyobjloader takes to read the file; kNotMeasured in a build without it.
Result<double> time_tinyobjloader([[maybe_unused]] const std::string& path) {
#ifdef GEOTHERM_BENCH_TINYOBJLOADER
  tinyobj::ObjReader reader;
  const Stopwatch watch;
  const bool read = reader.ParseFromFile(path);
  const double elapsed = watch.milliseconds();
  if (read) return elapsed;
  return Error{ErrorCode::kBadFile, "tinyobjloader: " + reader.Error()};
#else
  return kNotMeasured;
#endif
}

}  // namespace

LoadRow measure_load(const std::string& name, const TriangleMesh& mesh, int runs) {
  LoadRow row;
  row.mesh = name;
  row.faces = mesh.face_count();
  const TemporaryFile file(".obj");
  if (!write_obj(file.path(), mesh)) {
    row.failure = file.path() + ": cannot be written";
    return row;
  }
  for (int run = 0; run < runs; ++run) {
    const Stopwatch watch;
    const auto ours = read_mesh(file.path());
    row.ms = std::fmin(row.ms, watch.milliseconds());  // fmin passes over what is not measured
    if (!ours) {
      row.failure = sentence(ours.error());
      return row;
    }
    const Result<double> theirs = time_tinyobjloader(file.path());
    if (!theirs) {
      row.failure = sentence(theirs.error());
      return row;
    }
    row.tinyobjloader_ms = std::fmin(row.tinyobjloader_ms, *theirs);
  }
  return row;
}

}  // namespace geotherm::bench
