// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "app/session/machine.h"
#include "bench/measure.h"
#include "solver/core/processor.h"

namespace geotherm::bench {

/// What the figures were measured on.
struct Machine : app::Machine {
  std::string compiler;
  double load = 0;  ///< of other programs when this was read: runnable threads, a minute's mean
};

Machine read_machine();

/// What the machine can do at best, measured in the same run as what is divided by it: the best of
/// many short attempts, since other programs only ever take away.
struct MachineLimits {
  /// How fast an array is read, in 10^9 bytes a second.
  struct Reading {
    double bytes;
    double one_gbs, all_gbs;  ///< by one thread, by all
  };

  int threads = 1;  ///< what "all" means
  std::vector<Reading> reading =
      {};                  ///< ascending sizes; the last is beyond every cache where it fits
  double cache_bytes = 0;  ///< of the last level; 0: the system does not say

  /// Fused multiply-adds in registers, in 10^9 operations a second, by the best instruction set.
  double one_gflops = kNotMeasured, all_gflops = kNotMeasured;
  /// The product of two matrices of 1500 rows by the BLAS; not measured where there is none.
  double one_dgemm_gflops = kNotMeasured, all_dgemm_gflops = kNotMeasured;

  /// Reading of the largest array: memory. Not a number when nothing was measured.
  double memory_gbs(int with_threads) const;

  /// Reading of `bytes`, which a cache may hold: between the sizes measured, on logarithmic scales.
  double reading_gbs(double bytes, int with_threads) const;

  bool measured() const { return !reading.empty(); }
};

/// `largest_bytes`: of the array that is read last; 0 for four times the last cache and 1.5 GB at
/// least, as far as a third of the free memory holds it. Cost: about ten seconds with the default.
MachineLimits measure_limits(int threads, double largest_bytes, const Say& say);

/// Measures again, and keeps the better of both figures: after work that takes long, since a busy
/// minute before it would set its limits too low. Cost: as much once more.
MachineLimits remeasure_limits(const MachineLimits& before, const Say& say);

/// Sums `count` doubles with as many registers as keep up with memory. Precondition: a multiple of
/// 64, aligned to 64 bytes. The sum is returned so that no compiler leaves the reading out.
double read_all(const double* values, std::size_t count, InstructionSet set);

/// So many rounds of independent fused multiply-adds that live in registers. Returns the
/// floating-point operations done (two each); `sink` gets what was computed.
double multiply_add(std::int64_t rounds, InstructionSet set, double& sink);

}  // namespace geotherm::bench
