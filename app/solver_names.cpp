// SPDX-License-Identifier: MIT
#include "app/solver_names.h"

#include <algorithm>

#include "app/method_words.h"
#include "app/text.h"
#include "app/told.h"
#include "geotherm/backend.h"

namespace geotherm::app {
namespace {

Result<MethodOptions> solver_named(const std::string& name, const MethodOptions& base) {
  MethodOptions options = base;
  const auto method = parse_method(name);
  if (method && *method != MethodKind::kHeat) {
    options.method = *method;
    return options;
  }
  const auto backend = find_backend(name);
  if (!backend) {
    std::vector<std::string> methods = method_names();
    std::erase(methods, to_text(MethodKind::kHeat));
    Error error = backend.error();
    error.hint.emplace_back("; other methods: " + joined(methods));
    return error;
  }
  options.method = MethodKind::kHeat;
  options.backend = name;
  return options;
}

}  // namespace

Result<std::vector<MethodOptions>> solvers_named(const std::string& text,
                                                 const MethodOptions& base) {
  std::vector<MethodOptions> solvers;
  const auto add = [&](const std::string& name) -> Result<void> {
    auto solver = solver_named(name, base);
    if (!solver) return solver.error();
    const bool known = std::ranges::any_of(solvers, [&](const MethodOptions& other) {
      return solver_name(other) == solver_name(*solver);
    });
    if (!known) solvers.push_back(*std::move(solver));
    return {};
  };
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    const std::string name(trimmed(std::string_view(text).substr(begin, end - begin)));
    begin = end + 1;
    const std::vector<std::string> meant =
        name == "all" ? backend_names() : std::vector<std::string>{name};
    for (const std::string& each : meant) {
      if (auto added = add(each); !added) return added.error();
    }
  }
  return solvers;
}

}  // namespace geotherm::app
