// SPDX-License-Identifier: MIT
#include "bench/solve_bench.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "bench/bench_mesh.h"
#include "solver/heat/heat_method.h"

namespace geotherm::bench {
namespace {

constexpr std::size_t kSources = 16;

struct Case {
  const char* mesh;
  Index faces;
  bool quick;  ///< part of the quick run
};

constexpr Case kCases[] = {
    {"torus", 30'000, true},      {"terrain", 33'000, true},     {"sphere", 80'000, false},
    {"torus", 100'000, true},     {"gargoyle", 100'000, true},   {"torus", 200'000, true},
    {"gargoyle", 200'000, true},  {"terrain", 200'000, false},   {"torus", 500'000, false},
    {"gargoyle", 500'000, false}, {"torus", 1'050'000, true},    {"gargoyle", 1'050'000, true},
    {"sphere", 1'300'000, false}, {"terrain", 1'050'000, false},
};

constexpr Effort kQuick = {{1'500, 3, 6'000}, {600, 9, 4'000}, {600, 3, 6'000}};
constexpr Effort kFull = {{8'000, 5, 60'000}, {4'000, 21, 20'000}, {4'000, 5, 30'000}};

/// Backends whose time grows too fast for large meshes to tell anything new.
Index largest_mesh(const std::string& backend, bool quick) {
  if (backend == "eigen-ldlt") return quick ? 250'000 : 600'000;
  if (backend == "cg") return quick ? 120'000 : 250'000;
  return std::numeric_limits<Index>::max();
}

std::string case_name(const Case& c) {
  return std::string(c.mesh) + "-" + std::to_string(c.faces / 1000) + "k";
}

/// The plan's backends for this case.
std::vector<std::string> backends_for(const Case& c, const SolvePlan& plan) {
  std::vector<std::string> out;
  if (plan.quick && !c.quick) return out;
  for (const std::string& backend : plan.backends) {
    if (c.faces > largest_mesh(backend, plan.quick)) continue;
    if (std::regex_search(case_name(c) + "/" + backend, plan.only)) out.push_back(backend);
  }
  return out;
}

/// The baseline's distances against ours with the same discretisation.
double disagreement(Contender& baseline, std::shared_ptr<const TriangleMesh> mesh, Index source,
                    int threads) {
  HeatOptions options;
  options.threads = threads;
  options.strict = true;
  options.variant = Variant::kClassic;
  options.laplacian = LaplacianKind::kCotan;
  options.constraint.mode = ConstraintMode::kPinVertex;
  const auto method = HeatMethod::build(std::move(mesh), options);
  if (!method) return kNotMeasured;
  const auto ours = method->solve(SourceSet::of_vertices({source}));
  const auto theirs = baseline.query(source);
  if (!ours || !theirs) return kNotMeasured;
  double largest = 0, difference = 0;
  for (std::size_t v = 0; v < theirs->size(); ++v) {
    largest = std::max(largest, ours->distances[v]);
    difference = std::max(difference, std::abs(ours->distances[v] - (*theirs)[v]));
  }
  return difference / largest;
}

SolveGroup measure_case(const Case& c, const std::vector<std::string>& backends,
                        const SolvePlan& plan, const Say& say) {
  SolveGroup group;
  group.mesh = c.mesh;
  say("making the mesh");
  auto made = make_mesh(c.mesh, c.faces);
  if (!made) {
    group.failure = made.error().message;
    return group;
  }
  const auto mesh = std::make_shared<const TriangleMesh>(std::move(*made));
  group.vertices = mesh->vertex_count();
  group.faces = mesh->face_count();

  std::vector<std::unique_ptr<Contender>> contenders;
  contenders.reserve(backends.size() + 1);
  for (const std::string& backend : backends) {
    contenders.push_back(make_contender(backend, plan.threads));
  }
  if (auto baseline = make_baseline_contender()) contenders.push_back(std::move(baseline));

  const std::vector<Index> sources = pick_sources(group.vertices, kSources);
  group.figures =
      measure(mesh, contenders, sources, plan.quick ? kQuick : kFull,
              [&](std::string_view what) { say(case_name(c) + ": " + std::string(what)); });
  if (group.baseline() != nullptr && group.baseline()->failure.empty()) {
    say(case_name(c) + ": comparing distances");
    group.disagreement = disagreement(*contenders.back(), mesh, sources[0], plan.threads);
  }
  return group;
}

/// The slope of y over x, with an offset of its own for each key.
class CommonSlope {
 public:
  void add(const std::string& key, double x, double y) {
    if (std::isfinite(x) && std::isfinite(y)) points_[key].emplace_back(x, y);
  }
  double slope() const {
    double xx = 0, xy = 0;
    for (const auto& [key, points] : points_) {
      double mean_x = 0, mean_y = 0;
      for (const auto& [x, y] : points) {
        mean_x += x / static_cast<double>(points.size());
        mean_y += y / static_cast<double>(points.size());
      }
      for (const auto& [x, y] : points) {
        xx += (x - mean_x) * (x - mean_x);
        xy += (x - mean_x) * (y - mean_y);
      }
    }
    return xx > 0 ? xy / xx : kNotMeasured;
  }

 private:
  std::map<std::string, std::vector<std::pair<double, double>>> points_;
};

}  // namespace

const Figures* SolveGroup::baseline() const {
  const bool there = !figures.empty() && figures.back().name == kBaseline;
  return there ? &figures.back() : nullptr;
}

std::vector<SolveGroup> measure_solves(const SolvePlan& plan, const Say& say,
                                       const OnGroup& on_group) {
  std::vector<SolveGroup> groups;
  for (const Case& c : kCases) {
    const std::vector<std::string> backends = backends_for(c, plan);
    if (backends.empty()) continue;
    groups.push_back(measure_case(c, backends, plan, say));
    on_group(groups.back());
  }
  return groups;
}

std::vector<Growth> measure_growth(const std::vector<SolveGroup>& groups) {
  std::vector<std::string> names;
  std::map<std::string, CommonSlope> setup, query;
  for (const SolveGroup& group : groups) {
    for (const Figures& figures : group.figures) {
      if (!figures.failure.empty()) continue;
      if (!setup.contains(figures.name)) names.push_back(figures.name);
      const double size = std::log(group.faces);
      setup[figures.name].add(group.mesh, size, std::log(figures.setup_ms));
      query[figures.name].add(group.mesh, size, std::log(figures.query_ms));
    }
  }
  std::vector<Growth> out;
  for (const std::string& name : names) {
    const Growth growth{name, setup[name].slope(), query[name].slope()};
    if (std::isfinite(growth.setup_exponent)) out.push_back(growth);
  }
  return out;
}

}  // namespace geotherm::bench
