// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace geotherm::test {

/// Folders of data that are no part of the project: the values of GEOTHERM_TEST_MESHES and
/// GEOTHERM_TEST_EXACT; without the second, the folder `exact` beside the first.
struct DataFolders {
  std::string meshes, exact;
};
std::optional<DataFolders> data_folders();

/// The values of a .npy file of float64 in one dimension; empty where it is not one.
std::vector<double> read_npy(const std::string& path);

}  // namespace geotherm::test
