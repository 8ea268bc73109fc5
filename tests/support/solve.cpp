// SPDX-License-Identifier: MIT
#include "tests/support/solve.h"

#include <algorithm>
#include <stdexcept>

namespace geotherm::test {
namespace {

std::vector<std::string> names(bool iterative) {
  std::vector<std::string> out;
  for (const std::string& name : backend_names()) {
    if ((*find_backend(name))->iterative() == iterative) out.push_back(name);
  }
  return out;
}

/// GoogleTest reports an error as the failure of the test that is running.
template <class T>
T value_of(Result<T> result) {
  if (!result) throw std::runtime_error(sentence(result.error()));
  return std::move(*result);
}

}  // namespace

HeatMethod method_of(const MeshPtr& mesh, const HeatOptions& options) {
  return value_of(HeatMethod::build(mesh, options));
}

HeatMethod method_of(const std::shared_ptr<const CellComplex>& cells, const HeatOptions& options) {
  return value_of(HeatMethod::build(cells, options));
}

DistanceResult solve(const HeatMethod& method, const SourceSet& sources,
                     const QueryOptions& query) {
  return value_of(method.solve(sources, query));
}

DistanceResult solve(const MeshPtr& mesh, const std::vector<Index>& sources,
                     const HeatOptions& options) {
  return solve(method_of(mesh, options), SourceSet::of_vertices(sources));
}

std::vector<std::string> direct_backends() { return names(false); }
std::vector<std::string> iterative_backends() { return names(true); }

std::string test_name(std::string text) {
  const auto is_odd = [](char c) { return c == '-' || c == ' ' || c == ':' || c == '.'; };
  std::replace_if(text.begin(), text.end(), is_odd, '_');
  return text;
}

std::string backend_test_name(const testing::TestParamInfo<std::string>& info) {
  return test_name(info.param);
}

}  // namespace geotherm::test
