// SPDX-License-Identifier: MIT
#include "solver/linear/mpi_module.h"

#include <dlfcn.h>

#include <cstdlib>
#include <filesystem>
#include <mutex>
#include <system_error>

namespace geotherm {
namespace {

namespace fs = std::filesystem;

/// Empty: there is none.
const std::string& module_path() {
  static const std::string kPath = []() -> std::string {
    std::error_code unknown;
    if (const char* const named = std::getenv("GEOTHERM_MPI_MODULE")) {
      return fs::is_regular_file(named, unknown) ? fs::absolute(named, unknown).string()
                                                 : std::string();
    }
    const fs::path program = fs::read_symlink("/proc/self/exe", unknown).parent_path();
    for (const fs::path& path :
         {program / GEOTHERM_INSTALLED_MPI_MODULE, fs::path(GEOTHERM_BUILT_MPI_MODULE)}) {
      if (!path.empty() && fs::is_regular_file(path, unknown)) return path.string();
    }
    return {};
  }();
  return kPath;
}

Error not_there(const std::string& what) {
  return {ErrorCode::kNotAvailable,
          what,
          {"install the package geotherm-mpi, or build where libpetsc-real-dev and libopenmpi-dev "
           "are"}};
}

std::mutex starting;
bool started = false;

}  // namespace

bool has_mpi_module() { return !module_path().empty(); }

Result<const MpiModule*> mpi_module() {
  static const Result<const MpiModule*> kModule = []() -> Result<const MpiModule*> {
    if (!has_mpi_module()) return not_there("MPI and PETSc are not there");
    // Global: what MPI itself loads later looks for its names there.
    void* const library = ::dlopen(module_path().c_str(), RTLD_NOW | RTLD_GLOBAL);
    if (library == nullptr) {
      return not_there("MPI and PETSc cannot be loaded: " + std::string(::dlerror()));
    }
    using Entry = const MpiModule* (*)();
    const auto entry = reinterpret_cast<Entry>(::dlsym(library, kMpiModuleEntry));
    if (entry == nullptr) return not_there(module_path() + " is not a part of this program");
    return entry();
  }();
  return kModule;
}

Result<RankOfCount> start_mpi() {
  const auto module = mpi_module();
  if (!module) return module.error();
  const std::lock_guard lock(starting);
  static RankOfCount ours;
  if (started) return ours;
  const std::string problem = (*module)->start(&ours.rank, &ours.count);
  if (!problem.empty()) return Error{ErrorCode::kNotAvailable, "MPI does not start: " + problem};
  started = true;
  std::atexit(finish_mpi);
  return ours;
}

bool mpi_is_started() {
  const std::lock_guard lock(starting);
  return started;
}

void finish_mpi() {
  const std::lock_guard lock(starting);
  if (!started) return;
  started = false;
  (*mpi_module())->finish();
}

void end_all_ranks(int exit_code) {
  if (mpi_is_started()) (*mpi_module())->abort(exit_code);
}

}  // namespace geotherm
