// SPDX-License-Identifier: MIT
#include "solver/mesh/write_file.h"

#include "solver/mesh/growing_file.h"

namespace geotherm {

Result<void> write_file(const std::string& path, std::string_view bytes) {
  auto file = GrowingFile::open(path);
  if (!file) return file.error();
  if (auto written = file->append(bytes); !written) return written;
  return file->finish();
}

}  // namespace geotherm
