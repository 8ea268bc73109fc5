// SPDX-License-Identifier: MIT
#include "solver/method/mapped_method.h"

#include <new>
#include <utility>

namespace geotherm {

MappedMethod::MappedMethod(std::shared_ptr<const MeshMapping> mapping,
                           std::shared_ptr<const DistanceMethod> inner)
    : mapping_(std::move(mapping)),
      inner_(std::move(inner)),
      timing_(inner_->timing()),
      warnings_(mapping_->warnings()) {
  warnings_.insert(warnings_.end(), inner_->warnings().begin(), inner_->warnings().end());
  // A method that took its operators over took the mesh over as well.
  if (timing_.operators > 0) {
    timing_.operators += mapping_->milliseconds();
    timing_.setup += mapping_->milliseconds();
  }
}

Result<std::vector<DistanceResult>> MappedMethod::solve_each(std::span<const SourceSet> sets,
                                                             const QueryOptions& query,
                                                             const Progress& progress) const try {
  std::vector<SourceSet> mapped;
  for (const SourceSet& set : sets) {
    auto sources = mapping_->inner_sources(set);
    if (!sources) return sources.error();
    mapped.push_back(*std::move(sources));
  }
  auto results = inner_->solve_each(mapped, query, progress);
  if (!results) return results;
  for (std::size_t i = 0; i < sets.size(); ++i) mapping_->take_back(sets[i], (*results)[i]);
  return results;
} catch (const std::bad_alloc&) {
  return Error{
      ErrorCode::kOutOfMemory, "the memory ended in a query", {"refine the mesh less often"}};
}

}  // namespace geotherm
