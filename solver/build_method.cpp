// SPDX-License-Identifier: MIT
#include "geotherm/build_method.h"

#include <new>
#include <string>
#include <utility>

#include "geotherm/heat_method.h"
#include "geotherm/polyhedral_methods.h"
#include "solver/core/parallel.h"
#include "solver/grid/grid_marching.h"
#include "solver/heat/factor_memory.h"
#include "solver/method/mapped_method.h"
#include "solver/polyhedral/wave_surface.h"
#include "solver/volume/tet_marching_method.h"

namespace geotherm {
namespace {

using Built = Result<std::shared_ptr<const DistanceMethod>>;

template <class Method>
Built as_method(Result<std::shared_ptr<const Method>> built) {
  if (!built) return built.error();
  return std::shared_ptr<const DistanceMethod>(*std::move(built));
}

Built as_heat(Result<HeatMethod> built) {
  if (!built) return built.error();
  return std::shared_ptr<const DistanceMethod>(
      std::make_shared<const HeatMethod>(*std::move(built)));
}

/// `earlier`: a method on the same triangles elsewhere, or null.
Built on_waves(std::shared_ptr<const WaveSurface> waves, const MethodOptions& options,
               const Progress& progress, const WavefrontMethod* earlier = nullptr) {
  using Samples = WavefrontMethod::Samples;
  switch (options.method) {
    case MethodKind::kWavefront:
    case MethodKind::kHeat:
      break;
    case MethodKind::kWavefrontFine:
      return as_method(WavefrontMethod::build(std::move(waves), Samples::kQuarters, options.threads,
                                              progress, earlier));
    case MethodKind::kFastMarching:
      return as_method(FastMarchingMethod::build(std::move(waves), options.threads, progress));
    case MethodKind::kExact:
      return as_method(ExactMethod::build(std::move(waves), options.threads, progress));
  }
  return as_method(WavefrontMethod::build(std::move(waves), Samples::kMidpoint, options.threads,
                                          progress, earlier));
}

/// The surface that a method walks over; null for methods that walk over none.
std::shared_ptr<const WaveSurface> waves_of(const DistanceMethod* method) {
  if (const auto* waves = dynamic_cast<const WaveMethod*>(method)) return waves->surface();
  return nullptr;
}

RefineRule refine_rule(MethodKind method) {
  return walks_on_inserted(method) ? RefineRule::kWhereNeeded : RefineRule::kNever;
}

/// Builds the method on the mesh as it is, neither refined nor welded.
Built build_plain(std::shared_ptr<const TriangleMesh> mesh, const MethodOptions& options,
                  const Progress& progress, std::shared_ptr<const WaveSurface> waves) {
  if (options.method == MethodKind::kHeat) {
    return as_heat(HeatMethod::build(std::move(mesh), options, progress));
  }
  if (!waves) {
    auto made = build_wave_surface(mesh, refine_rule(options.method), part_of(progress, 0.0, 0.5),
                                   thread_count(options.threads));
    if (!made) return made.error();
    waves = *std::move(made);
  }
  return on_waves(std::move(waves), options, part_of(progress, 0.5, 1.0));
}

using Mapping = std::shared_ptr<const MeshMapping>;

bool needs_mapping(const TriangleMesh& mesh, const MethodOptions& options) {
  return options.refine != 0 || !mesh.same_as().empty();
}

Result<Mapping> mapping_of(std::shared_ptr<const TriangleMesh> mesh, const MethodOptions& options,
                           const Progress& progress) {
  if (options.refine > 0 && !report(progress, "refine", 0.0)) return cancelled_error();
  if (options.refine != 0) {
    auto fits = check_refined_memory(mesh->face_count(), options.refine);
    if (!fits) return fits.error();
  }
  auto mapping = MeshMapping::build(std::move(mesh), options.refine);
  if (!mapping) return mapping.error();
  return std::make_shared<const MeshMapping>(*std::move(mapping));
}

/// The options for the inner mesh. Errors: kBadInput, a vertex that the outer one has not.
Result<MethodOptions> inner_options(const MeshMapping& mapping, MethodOptions options) {
  options.refine = 0;
  Index& pin = options.constraint.pin_vertex;
  if (options.constraint.mode != ConstraintMode::kPinVertex || pin == kNoIndex) return options;
  const Index count = mapping.mesh().vertex_count();
  if (pin < 0 || pin >= count) {
    return Error{ErrorCode::kBadInput, "vertex " + std::to_string(pin) +
                                           " cannot be pinned: it is not on the surface (0 to " +
                                           std::to_string(count - 1) + ")"};
  }
  pin = mapping.mesh().standing_for(pin);
  return options;
}

Built mapped(Mapping mapping, Built inner) {
  if (!inner) return inner;
  return std::shared_ptr<const DistanceMethod>(
      std::make_shared<const MappedMethod>(std::move(mapping), *std::move(inner)));
}

Built build_mapped(std::shared_ptr<const TriangleMesh> mesh, const MethodOptions& options,
                   const Progress& progress, std::shared_ptr<const WaveSurface> waves) {
  constexpr double kShare = 0.1;  // of the set-up, where all is refined
  auto mapping = mapping_of(mesh, options, progress);
  if (!mapping) return mapping.error();
  const auto inner = inner_options(**mapping, options);
  if (!inner) return inner.error();
  const bool other = (*mapping)->inner() != mesh;
  if (other) waves.reset();
  return mapped(*mapping,
                build_plain((*mapping)->inner(), *inner,
                            part_of(progress, other ? kShare : 0.0, 1.0), std::move(waves)));
}

Error memory_ended(const MethodOptions& options) {
  return {ErrorCode::kOutOfMemory,
          "the memory ended while the method " + to_text(options.method) + " was set up",
          {options.refine > 0 ? "refine the mesh less often" : "take a mesh with fewer faces"}};
}

/// A heat method with other options beside one that there is.
Built beside(const HeatMethod& other, const MethodOptions& options, const Progress& progress) {
  return as_heat(other.with(options, progress));
}

/// What works in a space that is no surface: heat and fast marching, on it as it is.
Result<void> check_space_options(const MethodOptions& options, const std::string& space) {
  if (auto fits = check_threads(options.threads); !fits) return fits;
  if (options.refine > 0) {
    return Error{ErrorCode::kNotAvailable,
                 "a " + space + " cannot be refined",
                 {"leave ", SettingHint{"refine"}, " out"}};
  }
  if (options.method == MethodKind::kFastMarching || options.method == MethodKind::kHeat) return {};
  return Error{ErrorCode::kNotAvailable,
               "the method " + to_text(options.method) + " is of surfaces, and this is a " + space,
               {"use ", SettingHint{"method", {"heat", "fast-marching"}}}};
}

}  // namespace

bool same_method(const MethodOptions& a, const MethodOptions& b) {
  if (a.method != b.method || a.threads != b.threads || a.refine != b.refine) return false;
  return a.method != MethodKind::kHeat || a == b;
}

Built build_method(std::shared_ptr<const TriangleMesh> mesh, const MethodOptions& options,
                   const Progress& progress, std::shared_ptr<const WaveSurface> waves) try {
  if (auto fits = check_threads(options.threads); !fits) return fits.error();
  if (needs_mapping(*mesh, options)) {
    return build_mapped(std::move(mesh), options, progress, std::move(waves));
  }
  return build_plain(std::move(mesh), options, progress, std::move(waves));
} catch (const std::bad_alloc&) {
  return memory_ended(options);
}

Built build_method_sharing(std::shared_ptr<const TriangleMesh> mesh, const MethodOptions& options,
                           const DistanceMethod* other, const Progress& progress) try {
  const HeatMethod* const heat = other ? other->heat() : nullptr;
  const auto* const outer = dynamic_cast<const MappedMethod*>(other);
  if (heat == nullptr || options.method != MethodKind::kHeat ||
      (outer ? outer->mapping()->refine() : 0) != options.refine) {
    return build_method(std::move(mesh), options, progress);
  }
  if (outer == nullptr) return beside(*heat, options, progress);
  const auto inner = inner_options(*outer->mapping(), options);
  if (!inner) return inner.error();
  return mapped(outer->mapping(), beside(*heat, *inner, progress));
} catch (const std::bad_alloc&) {
  return memory_ended(options);
}

Built build_method_moved(std::shared_ptr<const TriangleMesh> moved, const MethodOptions& options,
                         const DistanceMethod* earlier, const Progress& progress) try {
  if (auto fits = check_threads(options.threads); !fits) return fits.error();
  const auto* const heat = dynamic_cast<const HeatMethod*>(earlier);
  if (heat != nullptr && options.method == MethodKind::kHeat && !needs_mapping(*moved, options)) {
    return as_heat(heat->with_mesh(std::move(moved), options, progress));
  }
  const std::shared_ptr<const WaveSurface> waves = waves_of(earlier);
  if (waves == nullptr || options.method == MethodKind::kHeat || needs_mapping(*moved, options)) {
    return build_method(std::move(moved), options, progress);
  }
  if (auto same = check_moved(*waves->base.mesh, *moved); !same) return same.error();
  auto made =
      build_wave_surface(std::move(moved), refine_rule(options.method), part_of(progress, 0.0, 0.5),
                         thread_count(options.threads), waves.get());
  if (!made) return made.error();
  return on_waves(*std::move(made), options, part_of(progress, 0.5, 1.0),
                  dynamic_cast<const WavefrontMethod*>(earlier));
} catch (const std::bad_alloc&) {
  return memory_ended(options);
}

Built build_method(std::shared_ptr<const TetMesh> mesh, const MethodOptions& options,
                   const Progress& progress) try {
  if (auto fits = check_space_options(options, "volume"); !fits) return fits.error();
  if (options.method == MethodKind::kFastMarching) {
    return build_tet_marching(std::move(mesh), options.threads, progress);
  }
  auto made = cells_of(*mesh);
  if (!made) return made.error();
  return as_heat(
      HeatMethod::build(std::make_shared<const CellComplex>(*std::move(made)), options, progress));
} catch (const std::bad_alloc&) {
  return memory_ended(options);
}

Built build_method(std::shared_ptr<const Grid> grid, const MethodOptions& options,
                   const Progress& progress) try {
  if (auto fits = check_space_options(options, "grid"); !fits) return fits.error();
  if (options.method == MethodKind::kFastMarching) {
    return build_grid_marching(std::move(grid), options.threads, progress);
  }
  return as_heat(HeatMethod::build(std::move(grid), options, progress));
} catch (const std::bad_alloc&) {
  return memory_ended(options);
}

std::shared_ptr<const IntrinsicSurface> triangulation_for_waves(const DistanceMethod& method) {
  const HeatMethod* const heat = method.heat();
  return heat == &method ? heat->delaunay_triangulation() : nullptr;
}

}  // namespace geotherm
