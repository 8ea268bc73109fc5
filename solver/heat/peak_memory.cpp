// SPDX-License-Identifier: MIT
#include "solver/heat/peak_memory.h"

#include <cmath>
#include <limits>
#include <string>

#include "solver/core/memory.h"

namespace geotherm {

double heat_peak_bytes(double vertices) {
  // docs/performance.md, torus of 280k and 4.4M faces, backend native, two threads of a Xeon.
  constexpr double kSmall = 140e3, kLarge = 2.2e6;
  constexpr double kBytesOfSmall = 143 * 1048576.0, kBytesOfLarge = 2.62 * 1073741824.0;
  const double power = std::log(kBytesOfLarge / kBytesOfSmall) / std::log(kLarge / kSmall);
  return kBytesOfSmall * std::pow(vertices / kSmall, power);
}

double refined_bytes(std::int64_t faces) { return heat_peak_bytes(static_cast<double>(faces) / 2); }

Result<void> check_refined_memory(Index faces, int refine) {
  const auto free = free_memory();
  const std::int64_t cut = refined_faces(faces, refine);
  if (!free || cut > std::numeric_limits<Index>::max()) return {};
  const auto bytes_free = static_cast<double>(*free);
  if (refined_bytes(cut) <= bytes_free) return {};
  const auto megabytes = [](double bytes) { return std::to_string(std::llround(bytes / 1e6)); };
  int fits = refine - 1;
  while (fits > 0 && refined_bytes(refined_faces(faces, fits)) > bytes_free) --fits;
  return Error{ErrorCode::kOutOfMemory,
               std::to_string(faces) + " faces, each cut into four " + std::to_string(refine) +
                   " times, are " + std::to_string(cut) + " and take " +
                   megabytes(refined_bytes(cut)) + " MB or so, and " + megabytes(bytes_free) +
                   " MB are free",
               {"set ", SettingHint{"refine", {std::to_string(fits)}}}};
}

}  // namespace geotherm
