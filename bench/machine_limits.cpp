// SPDX-License-Identifier: MIT
#include "bench/machine_limits.h"

#include <sys/mman.h>
#include <unistd.h>
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <memory>
#include <numeric>

#include "solver/core/memory.h"
#include "solver/core/parallel.h"
#include "solver/core/stopwatch.h"
#include "solver/linear/blas_threads.h"

#if defined(__x86_64__)
#include <immintrin.h>
#endif

// Weak: absent in a build without BLAS.
extern "C" {
__attribute__((weak)) void dgemm_(const char*, const char*, const int*, const int*, const int*,
                                  const double*, const double*, const int*, const double*,
                                  const int*, const double*, double*, const int*);
}

namespace geotherm::bench {
namespace {

constexpr const char* compiler_name() {
#if defined(__clang__)
  return "clang " __clang_version__;
#else
  return "g++ " __VERSION__;
#endif
}

// Multiply-adds take four cycles and two begin in each (Fog, instruction tables: Zen 2 and later,
// Skylake and later), so eight must be under way. Twelve leave room, and with their two factors
// still fit into AVX2's sixteen registers.
constexpr int kChains = 12;

// Near 1, so that no chain grows or becomes denormal, which would be slow.
constexpr double kFactor = 0.999999999, kSummand = 1e-9;

double read_plain(const double* values, std::size_t count) {
  double sum[8] = {};
  for (std::size_t i = 0; i < count; i += 8) {
    for (int k = 0; k < 8; ++k) sum[k] += values[i + k];
  }
  return sum[0] + sum[1] + sum[2] + sum[3] + sum[4] + sum[5] + sum[6] + sum[7];
}

double multiply_add_plain(std::int64_t rounds, double& sink) {
  double chain[kChains];
  for (int k = 0; k < kChains; ++k) chain[k] = 1 + k;
  for (std::int64_t r = 0; r < rounds; ++r) {
    for (double& x : chain) x = x * kFactor + kSummand;
  }
  for (const double x : chain) sink += x;
  return 2.0 * kChains * static_cast<double>(rounds);
}

#if defined(__x86_64__)

__attribute__((target("avx2,fma"))) double read_avx2(const double* values, std::size_t count) {
  __m256d sum[8];
  for (__m256d& s : sum) s = _mm256_setzero_pd();
  for (std::size_t i = 0; i < count; i += 32) {
    for (int k = 0; k < 8; ++k) sum[k] = _mm256_add_pd(sum[k], _mm256_load_pd(values + i + 4 * k));
  }
  for (int k = 1; k < 8; ++k) sum[0] = _mm256_add_pd(sum[0], sum[k]);
  return sum[0][0] + sum[0][1] + sum[0][2] + sum[0][3];
}

__attribute__((target("avx512f"))) double read_avx512(const double* values, std::size_t count) {
  __m512d sum[8];
  for (__m512d& s : sum) s = _mm512_setzero_pd();
  for (std::size_t i = 0; i < count; i += 64) {
    for (int k = 0; k < 8; ++k) sum[k] = _mm512_add_pd(sum[k], _mm512_load_pd(values + i + 8 * k));
  }
  for (int k = 1; k < 8; ++k) sum[0] = _mm512_add_pd(sum[0], sum[k]);
  double total = 0;
  for (int k = 0; k < 8; ++k) total += sum[0][k];
  return total;
}

__attribute__((target("avx2,fma"))) double multiply_add_avx2(std::int64_t rounds, double& sink) {
  const __m256d factor = _mm256_set1_pd(kFactor), summand = _mm256_set1_pd(kSummand);
  __m256d chain[kChains];
  for (int k = 0; k < kChains; ++k) chain[k] = _mm256_set1_pd(1 + k);
  for (std::int64_t r = 0; r < rounds; ++r) {
    for (__m256d& x : chain) x = _mm256_fmadd_pd(x, factor, summand);
  }
  for (const __m256d& x : chain) sink += x[0] + x[3];
  return 2.0 * 4 * kChains * static_cast<double>(rounds);
}

__attribute__((target("avx512f"))) double multiply_add_avx512(std::int64_t rounds, double& sink) {
  const __m512d factor = _mm512_set1_pd(kFactor), summand = _mm512_set1_pd(kSummand);
  __m512d chain[kChains];
  for (int k = 0; k < kChains; ++k) chain[k] = _mm512_set1_pd(1 + k);
  for (std::int64_t r = 0; r < rounds; ++r) {
    for (__m512d& x : chain) x = _mm512_fmadd_pd(x, factor, summand);
  }
  for (const __m512d& x : chain) {
    for (int k = 0; k < 8; ++k) sink += x[k];
  }
  return 2.0 * 8 * kChains * static_cast<double>(rounds);
}

#endif

}  // namespace

Machine read_machine() {
  Machine machine{app::this_machine(), compiler_name(), 0};
  if (getloadavg(&machine.load, 1) != 1) machine.load = 0;
  return machine;
}

double read_all(const double* values, std::size_t count, [[maybe_unused]] InstructionSet set) {
#if defined(__x86_64__)
  if (set == InstructionSet::kAvx512) return read_avx512(values, count);
  if (set == InstructionSet::kAvx2) return read_avx2(values, count);
#endif
  return read_plain(values, count);
}

double multiply_add(std::int64_t rounds, [[maybe_unused]] InstructionSet set, double& sink) {
#if defined(__x86_64__)
  if (set == InstructionSet::kAvx512) return multiply_add_avx512(rounds, sink);
  if (set == InstructionSet::kAvx2) return multiply_add_avx2(rounds, sink);
#endif
  return multiply_add_plain(rounds, sink);
}

namespace {

constexpr double kSmallest = 4e6;  // bytes: in nobody's first-level cache, in most second levels
constexpr double kLargest = 1.5e9;
constexpr double kStep = 4;  // from one size to the next

/// Attempts go on for this long, a few at least.
constexpr double kAttemptsMs = 300;
constexpr int kMinAttempts = 4;

/// The greatest of what attempts give.
template <class Attempt>
double best_of(Attempt&& attempt) {
  const Stopwatch watch;
  double best = 0;
  for (int k = 0; k < kMinAttempts || watch.milliseconds() < kAttemptsMs; ++k) {
    best = std::max(best, attempt());
  }
  return best;
}

/// Pages of the largest size that the system gives: small ones cost time of their own to look up.
class Array {
 public:
  explicit Array(double bytes) : count_(static_cast<std::size_t>(bytes) / kPage * (kPage / 8)) {
    data_.reset(static_cast<double*>(std::aligned_alloc(kPage, count_ * sizeof(double))));
    if (!data_) {
      count_ = 0;
      return;
    }
#ifdef MADV_HUGEPAGE
    madvise(data_.get(), count_ * sizeof(double), MADV_HUGEPAGE);
#endif
  }
  std::size_t count() const { return count_; }
  double* data() { return data_.get(); }

 private:
  static constexpr std::size_t kPage = 1 << 21;
  struct Free {
    void operator()(double* p) const { std::free(p); }
  };
  std::size_t count_;
  std::unique_ptr<double, Free> data_;
};

double last_cache_bytes() {
#ifdef _SC_LEVEL3_CACHE_SIZE
  return std::max(0.0, static_cast<double>(sysconf(_SC_LEVEL3_CACHE_SIZE)));
#else
  return 0;
#endif
}

double largest_array(double cache_bytes) {
  const double wanted = std::max(kLargest, 4 * cache_bytes);
  const auto free = free_memory();
  return free ? std::min(wanted, static_cast<double>(*free) / 3) : wanted;
}

/// 10^9 bytes a second of the first `count` values, several times over where they are few.
double read_rate(const double* values, std::size_t count, int threads) {
  constexpr double kBytesPerAttempt = 4e8;
  constexpr std::int64_t kBlock = 64;  // doubles that a kernel takes at once
  const double bytes = static_cast<double>(count) * sizeof(double);
  const int passes = std::max(1, static_cast<int>(kBytesPerAttempt / bytes));
  const InstructionSet set = best_instruction_set();
  return best_of([&] {
    const Stopwatch watch;
    parallel_for(threads, static_cast<std::int64_t>(count) / kBlock, 1,
                 [&](std::int64_t begin, std::int64_t end) {
                   volatile double sum = 0;
                   for (int p = 0; p < passes; ++p) {
                     sum = sum + read_all(values + begin * kBlock,
                                          static_cast<std::size_t>((end - begin) * kBlock), set);
                   }
                 });
    return bytes * passes / watch.milliseconds() * 1e-6;
  });
}

double multiply_add_rate(int threads) {
  constexpr std::int64_t kRounds = 2'000'000;  // some milliseconds: threads start in much less
  const InstructionSet set = best_instruction_set();
  return best_of([&] {
    std::vector<double> operations(static_cast<std::size_t>(threads), 0.0);
    const Stopwatch watch;
    parallel_each(threads, threads, 1, [&](std::int64_t k) {
      double sink = 0;
      const double done = multiply_add(kRounds, set, sink);
      operations[static_cast<std::size_t>(k)] = sink != 0 ? done : 0;
    });
    const double elapsed = watch.milliseconds();
    return std::accumulate(operations.begin(), operations.end(), 0.0) / elapsed * 1e-6;
  });
}

double dgemm_rate(int threads) {
  if (dgemm_ == nullptr) return kNotMeasured;
  constexpr int kSize = 1500;
  const std::vector<double> a(std::size_t{kSize} * kSize, 0.5), b = a;
  std::vector<double> c(a.size());
  const double one = 1, zero = 0;
  const BlasThreads blas(threads);
  return best_of([&] {
    const Stopwatch watch;
    dgemm_("N", "N", &kSize, &kSize, &kSize, &one, a.data(), &kSize, b.data(), &kSize, &zero,
           c.data(), &kSize);
    return 2.0 * kSize * kSize * kSize / watch.milliseconds() * 1e-6;
  });
}

}  // namespace

double MachineLimits::memory_gbs(int with_threads) const {
  if (reading.empty()) return kNotMeasured;
  return with_threads > 1 ? reading.back().all_gbs : reading.back().one_gbs;
}

double MachineLimits::reading_gbs(double bytes, int with_threads) const {
  if (reading.empty() || !(bytes > 0)) return kNotMeasured;
  const auto rate = [&](const Reading& r) { return with_threads > 1 ? r.all_gbs : r.one_gbs; };
  if (bytes <= reading.front().bytes) return rate(reading.front());
  for (std::size_t i = 1; i < reading.size(); ++i) {
    const Reading &below = reading[i - 1], &above = reading[i];
    if (bytes > above.bytes) continue;
    const double part = std::log(bytes / below.bytes) / std::log(above.bytes / below.bytes);
    return rate(below) * std::pow(rate(above) / rate(below), part);
  }
  return rate(reading.back());
}

MachineLimits measure_limits(int threads, double largest_bytes, const Say& say) {
  MachineLimits limits;
  limits.threads = threads;
  limits.cache_bytes = last_cache_bytes();
  say("limits of the machine: arithmetic");
  limits.one_gflops = multiply_add_rate(1);
  limits.all_gflops = threads > 1 ? multiply_add_rate(threads) : limits.one_gflops;
  limits.one_dgemm_gflops = dgemm_rate(1);
  limits.all_dgemm_gflops = threads > 1 ? dgemm_rate(threads) : limits.one_dgemm_gflops;

  say("limits of the machine: memory");
  Array array(largest_bytes > 0 ? largest_bytes : largest_array(limits.cache_bytes));
  if (array.count() == 0) return limits;
  parallel_for(threads, static_cast<std::int64_t>(array.count()), 1 << 16,
               [&](std::int64_t begin, std::int64_t end) {
                 std::fill(array.data() + begin, array.data() + end, 1.0);
               });
  const double most = static_cast<double>(array.count()) * sizeof(double);
  for (double bytes = std::min(kSmallest, most);; bytes = std::min(bytes * kStep, most)) {
    if (bytes * 1.5 > most) bytes = most;
    const auto count = static_cast<std::size_t>(bytes) / 512 * 64;
    const double one = read_rate(array.data(), count, 1);
    const double all = threads > 1 ? read_rate(array.data(), count, threads) : one;
    limits.reading.push_back({bytes, one, all});
    if (bytes >= most) break;
  }
  return limits;
}

MachineLimits remeasure_limits(const MachineLimits& before, const Say& say) {
  if (!before.measured()) return before;
  MachineLimits best = measure_limits(before.threads, before.reading.back().bytes, say);
  // fmax leaves out what is not a number.
  for (double MachineLimits::*rate :
       {&MachineLimits::one_gflops, &MachineLimits::all_gflops, &MachineLimits::one_dgemm_gflops,
        &MachineLimits::all_dgemm_gflops}) {
    best.*rate = std::fmax(best.*rate, before.*rate);
  }
  if (best.reading.size() != before.reading.size()) {
    best.reading = before.reading;  // the memory for it was gone
    return best;
  }
  for (std::size_t i = 0; i < best.reading.size(); ++i) {
    MachineLimits::Reading& reading = best.reading[i];
    reading.one_gbs = std::max(reading.one_gbs, before.reading[i].one_gbs);
    reading.all_gbs = std::max(reading.all_gbs, before.reading[i].all_gbs);
  }
  return best;
}

}  // namespace geotherm::bench
