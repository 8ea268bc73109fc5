// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include <functional>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

#include "geotherm/error.h"
#include "solver/linear/mpi_module.h"

namespace geotherm {

/// The number of a vertex among those of all ranks.
using GlobalIndex = std::int64_t;

/// What a rank has for each rank, or has got from each.
template <class T>
using PerRank = std::vector<std::vector<T>>;

/// The ranks that hold one mesh together, and what they hand to each other. What it offers is
/// called by all of them, in the same order.
class RankGroup {
 public:
  using Reduction = MpiModule::Reduction;
  /// The error of the lowest rank that has one, on all of them.
  using Agree = std::function<Result<void>(const Result<void>& mine)>;

  /// Precondition: MPI is started (start_mpi()).
  RankGroup(const MpiModule& module, RankOfCount ours, Agree agree)
      : module_(module), ours_(ours), agree_(std::move(agree)) {}

  int rank() const { return ours_.rank; }
  int count() const { return ours_.count; }
  const MpiModule& module() const { return module_; }

  Result<void> agree(const Result<void>& mine) const { return agree_(mine); }
  /// Agrees on an outcome that has a value: each rank gets its own value, or all get an error.
  template <class Value>
  Result<Value> agree_on(Result<Value> mine) const {
    const auto all = agree(mine ? Result<void>() : Result<void>(mine.error()));
    return all ? std::move(mine) : Result<Value>(all.error());
  }

  /// out[r] goes to rank r; what comes back are those of each rank for this one.
  template <class T>
  PerRank<T> all_to_all(const PerRank<T>& out) const {
    static_assert(std::is_trivially_copyable_v<T>);
    std::vector<std::int64_t> sizes;
    std::vector<T> all;
    for (const std::vector<T>& each : out) {
      sizes.push_back(std::ssize(each) * static_cast<std::int64_t>(sizeof(T)));
      all.insert(all.end(), each.begin(), each.end());
    }
    struct Context {
      std::vector<std::int64_t> sizes;
      std::vector<T> all;
    } in{std::vector<std::int64_t>(sizes.size()), {}};
    module_.all_to_all(reinterpret_cast<const char*>(all.data()), sizes.data(), &in,
                       [](void* context, const std::int64_t* theirs) {
                         auto& taken = *static_cast<Context*>(context);
                         std::int64_t sum = 0;
                         for (auto& size : taken.sizes) sum += size = *theirs++;
                         taken.all.resize(static_cast<std::size_t>(sum) / sizeof(T));
                         return reinterpret_cast<char*>(taken.all.data());
                       });
    PerRank<T> result;
    auto at = in.all.cbegin();
    for (const std::int64_t size : in.sizes) {
      const auto end = at + size / static_cast<std::int64_t>(sizeof(T));
      result.emplace_back(at, end);
      at = end;
    }
    return result;
  }

  /// The values of all ranks, one rank after the other in their order.
  template <class T>
  std::vector<T> all_gather(const std::vector<T>& mine) const {
    std::vector<T> all;
    for (const auto& each : all_to_all(PerRank<T>(static_cast<std::size_t>(count()), mine))) {
      all.insert(all.end(), each.begin(), each.end());
    }
    return all;
  }

  /// Each number becomes that of all ranks.
  void all_reduce(std::span<double> values, Reduction how) const {
    module_.all_reduce(values.data(), std::ssize(values), how);
  }
  double sum(double mine) const {
    all_reduce({&mine, 1}, Reduction::kSum);
    return mine;
  }
  double max(double mine) const {
    all_reduce({&mine, 1}, Reduction::kMax);
    return mine;
  }

 private:
  const MpiModule& module_;
  RankOfCount ours_;
  Agree agree_;
};

/// A number of any size: mantissa * 2^exponent, the mantissa's size in [1/2, 1); 0 has exponent 0.
struct WideNumber {
  double mantissa = 0;
  std::int32_t exponent = 0;

  WideNumber() = default;
  /// value * 2^shift.
  WideNumber(double value, std::int32_t shift) {
    if (value == 0) return;
    int own = 0;
    mantissa = std::frexp(value, &own);
    exponent = own + shift;
  }
  /// This number times 2^-reference; 0 where that is too small for a double.
  double relative_to(std::int32_t reference) const {
    return mantissa == 0 ? 0.0 : std::ldexp(mantissa, std::max(exponent - reference, -2000));
  }
  WideNumber plus(const WideNumber& other) const {
    if (mantissa == 0) return other;
    if (other.mantissa == 0) return *this;
    const std::int32_t reference = std::max(exponent, other.exponent);
    return {relative_to(reference) + other.relative_to(reference), reference};
  }
  double logarithm() const { return std::log(mantissa) + exponent * M_LN2; }
};

}  // namespace geotherm
