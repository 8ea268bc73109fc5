// SPDX-License-Identifier: MIT
#include <utility>

#include "bench/contender.h"
#include "bench/plain_heat.h"

namespace geotherm::bench {
namespace {

class BaselineContender final : public Contender {
 public:
  std::string name() const override { return kBaseline; }

  Result<void> set_up(std::shared_ptr<const TriangleMesh> mesh) override {
    heat_ = std::make_unique<PlainHeat>(std::move(mesh));
    if (heat_->set_up()) return {};
    heat_.reset();
    return Error{ErrorCode::kNumericalFailure, "the baseline's factorisation failed"};
  }

  void drop() override { heat_.reset(); }

  Result<std::vector<double>> query(Index source) override {
    std::vector<double> distances = heat_->distances(source);
    if (distances.empty()) {
      return Error{ErrorCode::kNumericalFailure, "the baseline's solve failed"};
    }
    return distances;
  }

  Result<void> batch(std::span<const Index> sources) override {
    for (const Index source : sources) {
      if (const auto answer = query(source); !answer) return answer.error();
    }
    return {};
  }

  double factor_mb() const override { return heat_->factor_bytes() / (1 << 20); }

 private:
  std::unique_ptr<PlainHeat> heat_;
};

}  // namespace

std::unique_ptr<Contender> make_baseline_contender() {
  return std::make_unique<BaselineContender>();
}

}  // namespace geotherm::bench
