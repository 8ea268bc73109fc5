// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "geotherm/backend.h"
#include "geotherm/heat_method.h"
#include "tests/support/compare.h"
#include "tests/support/shapes.h"

namespace geotherm::test {

/// A method that must be possible to build.
HeatMethod method_of(const MeshPtr& mesh, const HeatOptions& options = {});
HeatMethod method_of(const std::shared_ptr<const CellComplex>& cells,
                     const HeatOptions& options = {});

/// An answer that must be possible to give; no distances where it was not.
DistanceResult solve(const HeatMethod& method, const SourceSet& sources,
                     const QueryOptions& query = {});
DistanceResult solve(const MeshPtr& mesh, const std::vector<Index>& sources,
                     const HeatOptions& options = {});

/// Names of the backends that factor, and of those that iterate.
std::vector<std::string> direct_backends();
std::vector<std::string> iterative_backends();

inline HeatOptions with_backend(const std::string& name, HeatOptions options = {}) {
  options.backend = name;
  return options;
}

/// A name as GoogleTest wants it.
std::string test_name(std::string text);
std::string backend_test_name(const testing::TestParamInfo<std::string>& info);

}  // namespace geotherm::test
