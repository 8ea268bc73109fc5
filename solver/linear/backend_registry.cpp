// SPDX-License-Identifier: MIT
// The one place that knows which backends a build has.
#include <array>

#include "solver/linear/backend.h"
#include "solver/linear/backends.h"

namespace geotherm {
namespace {

std::span<const Backend* const> all() {
  static const std::array kBackends = {
#ifdef GEOTHERM_HAS_CHOLMOD
      cholmod_backend(),
#endif
      eigen_ldlt_backend(),
      cg_backend(),
  };
  return kBackends;
}

}  // namespace

std::vector<std::string> backend_names() {
  std::vector<std::string> names;
  for (const Backend* backend : all()) names.emplace_back(backend->name());
  return names;
}

Result<const Backend*> find_backend(std::string_view name) {
  std::string known;
  for (const Backend* backend : all()) {
    if (backend->name() == name) return backend;
    known += (known.empty() ? "" : ", ") + std::string(backend->name());
  }
  return Error{ErrorCode::kNotAvailable,
               "there is no backend '" + std::string(name) + "' in this build; there are " + known};
}

}  // namespace geotherm
