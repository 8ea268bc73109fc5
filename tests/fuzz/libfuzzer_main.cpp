// SPDX-License-Identifier: MIT
// GEOTHERM_FUZZ_TARGET is one function of fuzz_targets.h.
#include <cstdio>
#include <cstdlib>

#include "tests/fuzz/fuzz_targets.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string fault = geotherm::test::GEOTHERM_FUZZ_TARGET({data, size});
  if (fault.empty()) return 0;
  std::fprintf(stderr, "finding: %s\n", fault.c_str());
  std::abort();
}
