// SPDX-License-Identifier: MIT
#include "bench/benches.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "bench/bench_mesh.h"
#include "bench/estimates.h"
#include "bench/measure.h"
#include "geotherm/backend.h"
#include "geotherm/heat_method.h"
#include "solver/core/memory.h"
#include "solver/core/parallel.h"

namespace geotherm::bench {
namespace {

constexpr std::size_t kSources = 16;

constexpr Effort kQuick = {{1'500, 3, 6'000}, {600, 9, 4'000}, {600, 3, 6'000}};
constexpr Effort kFull = {{8'000, 5, 60'000}, {4'000, 21, 20'000}, {4'000, 5, 30'000}};

/// What a backend may take on one mesh, and what its rates may.
constexpr double kMaxQuickMs = 25'000, kMaxFullMs = 300'000;
constexpr double kRatesQuickMs = 300, kRatesFullMs = 1'500;

/// Rates take a set-up more: not where it is longer than this.
constexpr double kLongestRatesMs = 60'000;

/// Shares of the free memory: of one contender, and of all that are set up at once.
constexpr double kMemoryOfOne = 0.8, kMemoryOfAll = 0.6;

/// Meshes from this size on are estimated before they are measured; where nothing smaller was
/// measured (--only), on the sizes below.
constexpr Index kEstimatedFrom = 150'000;
constexpr Index kProbeFaces[] = {30'000, 100'000};

/// The baseline's distances against ours with the same discretisation.
double disagreement(const std::vector<double>& theirs, std::shared_ptr<const TriangleMesh> mesh,
                    Index source, int threads) {
  HeatOptions options;
  options.threads = threads;
  options.strict = true;
  options.variant = Variant::kClassic;
  options.laplacian = LaplacianKind::kCotan;
  options.constraint.mode = ConstraintMode::kPinVertex;
  const auto method = HeatMethod::build(std::move(mesh), options);
  if (!method) return kNotMeasured;
  const auto ours = method->solve(SourceSet::of_vertices({source}));
  if (!ours) return kNotMeasured;
  return relative_difference(ours->distances, theirs);
}

/// 2^20 bytes.
double free_megabytes() {
  const auto bytes = free_memory();
  return bytes ? static_cast<double>(*bytes) / (1024 * 1024)
               : std::numeric_limits<double>::infinity();
}

class SolveBench {
 public:
  SolveBench(const SolvePlan& plan, const Say& say) : plan_(plan), say_(say) {}

  SolveGroup measure_case(const Case& c, const std::vector<std::string>& backends) {
    SolveGroup group;
    group.mesh = c.mesh;
    group.regular = c.regular;
    const Say say = [&](std::string_view what) { say_(case_name(c) + ": " + std::string(what)); };
    std::vector<std::string> names = backends;
    if (make_baseline_contender() != nullptr) names.push_back(kBaseline);
    if (c.faces >= kEstimatedFrom) probe(names);

    say("making the mesh");
    auto made = make_mesh(c.mesh, c.faces);
    if (!made) {
      group.failure = sentence(made.error());
      return group;
    }
    const auto mesh = std::make_shared<const TriangleMesh>(std::move(*made));
    group.vertices = mesh->vertex_count();
    group.faces = mesh->face_count();
    const std::vector<Index> sources = pick_sources(group.vertices, kSources);

    std::vector<std::unique_ptr<Contender>> contenders;
    std::vector<std::size_t> places;  // of the contenders, among the figures
    const bool one_at_a_time = choose(names, group, contenders, places);
    std::vector<double> baseline_distances;
    const Race race{mesh, contenders, sources, plan_.quick ? kQuick : kFull, one_at_a_time};
    auto figures =
        measure(race, say, [&](std::size_t contender, const std::vector<double>& answer) {
          if (contenders[contender]->name() == kBaseline) baseline_distances = answer;
        });
    for (std::size_t k = 0; k < places.size(); ++k) {
      Figures& target = group.figures[places[k]];
      target = std::move(figures[k]);
      if (!target.failure.empty()) continue;
      estimates_.learn(group.faces, target);
      say("rates of " + target.name);
      target.rates = rates(mesh, target);
    }
    if (!baseline_distances.empty()) {
      say("comparing distances");
      group.disagreement = disagreement(baseline_distances, mesh, sources[0], plan_.threads);
    }
    return group;
  }

 private:
  /// Makes the contenders that may run, and rows that say why for the others. True when those that
  /// run must not all be set up at once.
  bool choose(const std::vector<std::string>& names, SolveGroup& group,
              std::vector<std::unique_ptr<Contender>>& contenders,
              std::vector<std::size_t>& places) const {
    const double free = free_megabytes();
    const Limits limits{plan_.quick ? kMaxQuickMs : kMaxFullMs, kMemoryOfOne * free};
    double together = 0;
    for (const std::string& name : names) {
      auto contender =
          name == kBaseline ? make_baseline_contender() : make_contender(name, plan_.threads);
      Figures& figures = group.figures.emplace_back();
      figures.name = name;
      figures.heat_method = contender->heat_method();
      if (const auto estimate = estimates_.of(name, group.faces)) {
        figures.not_run = reason_not_to_run(*estimate, limits, name == kBaseline);
        if (!figures.not_run.empty()) continue;
        together += estimate->peak_mb;
      }
      places.push_back(group.figures.size() - 1);
      contenders.push_back(std::move(contender));
    }
    return together > kMemoryOfAll * free;
  }

  /// One set-up and query on small meshes for those of which nothing is known.
  void probe(const std::vector<std::string>& names) {
    constexpr Effort kOnce = {{0, 1, 1e9}, {0, 1, 1e9}, {0, 0, 0}};  // and no batch
    std::vector<std::unique_ptr<Contender>> unknown;
    for (const std::string& name : names) {
      if (estimates_.of(name, kEstimatedFrom)) continue;
      unknown.push_back(name == kBaseline ? make_baseline_contender()
                                          : make_contender(name, plan_.threads));
    }
    if (unknown.empty()) return;
    for (const Index faces : kProbeFaces) {
      say_("estimating on small meshes");
      auto made = make_mesh("torus", faces);
      if (!made) return;
      const auto mesh = std::make_shared<const TriangleMesh>(std::move(*made));
      const std::vector<Index> sources = pick_sources(mesh->vertex_count(), 1);
      const Say nothing = [](std::string_view) {};
      for (const Figures& figures : measure({mesh, unknown, sources, kOnce}, nothing)) {
        if (figures.failure.empty()) estimates_.learn(mesh->face_count(), figures);
      }
    }
  }

  Rates rates(std::shared_ptr<const TriangleMesh> mesh, const Figures& figures) const {
    const auto backends = backend_names();
    const bool known = std::ranges::find(backends, figures.name) != backends.end();
    if (!known || figures.setup_ms > kLongestRatesMs) return {};
    const auto measured = measure_rates(std::move(mesh), figures.name, thread_count(plan_.threads),
                                        plan_.quick ? kRatesQuickMs : kRatesFullMs);
    return measured ? *measured : Rates{.failure = sentence(measured.error())};
  }

  const SolvePlan& plan_;
  const Say& say_;
  Estimates estimates_;
};

}  // namespace

const Figures* SolveGroup::baseline() const {
  const bool there = !figures.empty() && figures.back().name == kBaseline;
  return there ? &figures.back() : nullptr;
}

std::vector<SolveGroup> measure_solves(const SolvePlan& plan, const Say& say,
                                       const OnGroup& on_group) {
  SolveBench bench(plan, say);
  std::vector<SolveGroup> groups;
  for (const Case& c : all_cases()) {
    const std::vector<std::string> backends = backends_for(c, plan);
    if (backends.empty()) continue;
    groups.push_back(bench.measure_case(c, backends));
    on_group(groups.back());
  }
  return groups;
}

}  // namespace geotherm::bench
