// SPDX-License-Identifier: MIT
#include "app/method_words.h"

#include <cmath>

#include "app/text.h"
#include "geotherm/options.h"

namespace geotherm::app {

std::string solver_name(const MethodOptions& options) {
  return options.method == MethodKind::kHeat ? options.backend : to_text(options.method);
}

std::string solver_at_work(const DistanceMethod& method, const DistanceResult& result) {
  return method.heat() != nullptr ? result.backend : to_text(method.kind());
}

std::string method_caption(const DistanceMethod& method) {
  const HeatMethod* heat = method.heat();
  if (heat == nullptr) return to_text(method.kind());
  const double t = heat->t();
  const bool is_double = std::isnormal(t);  // a model of size 1e200 or 1e-200 has another t
  return (is_double ? "t = " + significant(t) + ", " : "") + heat->options().backend;
}

std::string laplacian_name(const HeatMethod& method) { return to_text(method.laplacian()); }

}  // namespace geotherm::app
