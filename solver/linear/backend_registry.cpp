// SPDX-License-Identifier: MIT
// The one place that knows which backends a build has.
#include <algorithm>
#include <mutex>
#include <utility>

#include "geotherm/backend.h"
#include "solver/linear/backends.h"

namespace geotherm {
namespace {

/// Those of the build, then those that were added.
class Registry {
 public:
  static Registry& instance() {
    static Registry registry;
    return registry;
  }

  std::vector<const Backend*> all() const {
    const std::lock_guard lock(mutex_);
    return all_;
  }

  void add(const Backend* backend) {
    const std::lock_guard lock(mutex_);
    all_.push_back(backend);
  }

  void remove(const Backend* backend) {
    const std::lock_guard lock(mutex_);
    std::erase(all_, backend);
  }

 private:
  mutable std::mutex mutex_;
  std::vector<const Backend*> all_ = {
      native_backend(),
#ifdef GEOTHERM_HAS_CHOLMOD
      cholmod_backend(),
#endif
      eigen_ldlt_backend(),
      cg_backend(),
  };
};

}  // namespace

std::vector<std::string> backend_names() {
  std::vector<std::string> names;
  for (const Backend* backend : Registry::instance().all()) names.emplace_back(backend->name());
  return names;
}

Result<const Backend*> find_backend(std::string_view name) {
  std::string known;
  for (const Backend* backend : Registry::instance().all()) {
    if (backend->name() == name) return backend;
    known += (known.empty() ? "" : ", ") + std::string(backend->name());
  }
  return Error{ErrorCode::kNotAvailable,
               "there is no backend '" + std::string(name) + "' in this build",
               {"there are " + known}};
}

AddedBackend::AddedBackend(std::unique_ptr<const Backend> backend) : backend_(std::move(backend)) {
  Registry::instance().add(backend_.get());
}

AddedBackend::~AddedBackend() { Registry::instance().remove(backend_.get()); }

}  // namespace geotherm
