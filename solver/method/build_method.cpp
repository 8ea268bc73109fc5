// SPDX-License-Identifier: MIT
#include "solver/method/build_method.h"

#include <new>
#include <string>
#include <utility>

#include "solver/exact/exact_method.h"
#include "solver/heat/heat_method.h"
#include "solver/wave/fast_marching_method.h"
#include "solver/wave/wavefront_method.h"

namespace geotherm {
namespace {

using Built = Result<std::shared_ptr<const DistanceMethod>>;

template <class Method>
Built as_method(Result<std::shared_ptr<const Method>> built) {
  if (!built) return built.error();
  return std::shared_ptr<const DistanceMethod>(*std::move(built));
}

Built on_waves(std::shared_ptr<const WaveSurface> waves, const MethodOptions& options,
               const Progress& progress) {
  using Samples = WavefrontMethod::Samples;
  switch (options.method) {
    case MethodKind::kWavefront:
    case MethodKind::kHeat:
      break;
    case MethodKind::kWavefrontFine:
      return as_method(
          WavefrontMethod::build(std::move(waves), Samples::kQuarters, options.threads, progress));
    case MethodKind::kFastMarching:
      return as_method(FastMarchingMethod::build(std::move(waves), options.threads, progress));
    case MethodKind::kExact:
      return as_method(ExactMethod::build(std::move(waves), options.threads, progress));
  }
  return as_method(
      WavefrontMethod::build(std::move(waves), Samples::kMidpoint, options.threads, progress));
}

}  // namespace

bool same_method(const MethodOptions& a, const MethodOptions& b) {
  if (a.method != b.method || a.threads != b.threads) return false;
  return a.method != MethodKind::kHeat || a == b;
}

Built build_method(std::shared_ptr<const TriangleMesh> mesh, const MethodOptions& options,
                   const Progress& progress, std::shared_ptr<const WaveSurface> waves) try {
  if (options.method == MethodKind::kHeat) {
    auto built = HeatMethod::build(std::move(mesh), options, progress);
    if (!built) return built.error();
    return std::shared_ptr<const DistanceMethod>(
        std::make_shared<const HeatMethod>(*std::move(built)));
  }
  if (!waves) {
    auto made = build_wave_surface(mesh, part_of(progress, 0.0, 0.5));
    if (!made) return made.error();
    waves = *std::move(made);
  }
  return on_waves(std::move(waves), options, part_of(progress, 0.5, 1.0));
} catch (const std::bad_alloc&) {
  return Error{ErrorCode::kOutOfMemory, "the memory ended while the method " +
                                            to_text(options.method) +
                                            " was set up; take a mesh with fewer faces"};
}

}  // namespace geotherm
