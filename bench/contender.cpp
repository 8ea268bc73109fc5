// SPDX-License-Identifier: MIT
#include "bench/measure.h"

#include <utility>

#include "geotherm/build_method.h"

namespace geotherm::bench {
namespace {

class BackendContender final : public Contender {
 public:
  BackendContender(std::string name, int threads) : name_(std::move(name)) {
    const auto method = parse<MethodKind>(name_);
    if (method && *method != MethodKind::kHeat) {
      options_.method = *method;
    } else {
      options_.backend = name_;
    }
    options_.threads = threads;
    options_.strict = true;
  }

  std::string name() const override { return name_; }
  bool heat_method() const override { return options_.method == MethodKind::kHeat; }

  Result<void> set_up(std::shared_ptr<const TriangleMesh> mesh) override {
    method_.reset();
    auto built = build_method(std::move(mesh), options_);
    if (!built) return built.error();
    method_ = *std::move(built);
    return {};
  }

  void drop() override { method_.reset(); }

  Result<std::vector<double>> query(Index source) override {
    auto answer = method_->solve(SourceSet::of_vertices({source}), kDistancesOnly);
    if (!answer) return answer.error();
    return std::move(answer->distances);
  }

  Result<void> batch(std::span<const Index> sources) override {
    std::vector<SourceSet> sets;
    for (const Index source : sources) sets.push_back(SourceSet::of_vertices({source}));
    const auto answers = method_->solve_each(sets, kDistancesOnly);
    if (!answers) return answers.error();
    return {};
  }

  double factor_mb() const override { return method_->memory_mb(); }

 private:
  /// Other libraries compute no quality figures.
  static constexpr QueryOptions kDistancesOnly{.quality = false, .fields = false};

  std::string name_;
  MethodOptions options_;
  std::shared_ptr<const DistanceMethod> method_;
};

}  // namespace

std::unique_ptr<Contender> make_contender(std::string name, int threads) {
  return std::make_unique<BackendContender>(std::move(name), threads);
}

}  // namespace geotherm::bench
