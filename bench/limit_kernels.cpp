// SPDX-License-Identifier: MIT
#include "bench/limit_kernels.h"

#if defined(__x86_64__)
#include <immintrin.h>
#endif

namespace geotherm::bench {
namespace {

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

}  // namespace geotherm::bench
