// SPDX-License-Identifier: MIT
#pragma once

#include <cholmod.h>

#include <cstdint>
#include <memory>

namespace geotherm {

/// CHOLMOD's two families of functions under one name: `int` indices where they suffice, 64-bit
/// ones (cholmod_l_*) for factors of more than 2^31 entries.
template <class Int>
struct CholmodApi;

template <>
struct CholmodApi<int> {
  static constexpr int kType = CHOLMOD_INT;
  static constexpr auto start = cholmod_start;
  static constexpr auto finish = cholmod_finish;
  static constexpr auto analyze = cholmod_analyze_p;
  static constexpr auto copy = cholmod_copy_factor;
  static constexpr auto factorize = cholmod_factorize;
  static constexpr auto free_factor = cholmod_free_factor;
};

template <>
struct CholmodApi<SuiteSparse_long> {
  static constexpr int kType = CHOLMOD_LONG;
  static constexpr auto start = cholmod_l_start;
  static constexpr auto finish = cholmod_l_finish;
  static constexpr auto analyze = cholmod_l_analyze_p;
  static constexpr auto copy = cholmod_l_copy_factor;
  static constexpr auto factorize = cholmod_l_factorize;
  static constexpr auto free_factor = cholmod_l_free_factor;
};

/// A factor together with the workspace it was made in: CHOLMOD counts memory per workspace, so
/// both must go together.
template <class Int>
class CholmodFactor {
 public:
  CholmodFactor() {
    CholmodApi<Int>::start(&common);
    common.print = 0;
    common.nmethods = 1;
    common.method[0].ordering = CHOLMOD_GIVEN;
    common.postorder = 1;
    common.final_pack = 1;
  }
  ~CholmodFactor() {
    if (factor != nullptr) CholmodApi<Int>::free_factor(&factor, &common);
    CholmodApi<Int>::finish(&common);
  }
  CholmodFactor(const CholmodFactor&) = delete;
  CholmodFactor& operator=(const CholmodFactor&) = delete;

  cholmod_common common{};
  cholmod_factor* factor = nullptr;
};

}  // namespace geotherm
