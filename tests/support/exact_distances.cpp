// SPDX-License-Identifier: MIT
#include "tests/support/exact_distances.h"

#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>

namespace geotherm::test {

std::optional<DataFolders> data_folders() {
  const char* meshes = std::getenv("GEOTHERM_TEST_MESHES");  // NOLINT: no thread sets it
  const char* exact = std::getenv("GEOTHERM_TEST_EXACT");    // NOLINT
  if (meshes == nullptr || *meshes == '\0') return std::nullopt;
  DataFolders folders{meshes, {}};
  folders.exact = exact != nullptr && *exact != '\0'
                      ? std::string(exact)
                      : (std::filesystem::path(meshes) / ".." / "exact").string();
  if (!std::filesystem::is_directory(folders.exact)) return std::nullopt;
  return folders;
}

std::vector<double> read_npy(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(file), {}};
  constexpr std::size_t kHeader = 10;  // magic, version, length of the header's text
  if (bytes.size() < kHeader || bytes.compare(1, 5, "NUMPY") != 0) return {};
  const std::size_t begin =
      kHeader + static_cast<unsigned char>(bytes[8]) + 256U * static_cast<unsigned char>(bytes[9]);
  if (bytes.size() < begin || bytes.substr(0, begin).find("'<f8'") == std::string::npos) return {};
  std::vector<double> values((bytes.size() - begin) / sizeof(double));
  std::memcpy(values.data(), bytes.data() + begin, values.size() * sizeof(double));
  return values;
}

}  // namespace geotherm::test
