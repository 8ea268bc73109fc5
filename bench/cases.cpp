// SPDX-License-Identifier: MIT
#include "bench/cases.h"

namespace geotherm::bench {
namespace {

// Factors of 3 to 4 between sizes, up to what a machine of 24 GB can do; a regular and an irregular
// mesh of each. The torus is alike at every size, so that growth is not the shape's; the gargoyle
// is a shape that people have, with all sizes of triangles.
constexpr Case kCases[] = {
    {"grid", 30'000, true, true},        {"torus", 30'000, false, true},
    {"terrain", 33'000, false, false},   {"grid", 100'000, true, true},
    {"torus", 100'000, false, true},     {"gargoyle", 100'000, false, true},
    {"grid", 280'000, true, true},       {"torus", 280'000, false, true},
    {"gargoyle", 280'000, false, false}, {"grid", 1'100'000, true, true},
    {"torus", 1'100'000, false, true},   {"gargoyle", 1'100'000, false, false},
    {"sphere", 1'300'000, true, false},  {"grid", 4'400'000, true, false},
    {"torus", 4'400'000, false, false},
};

}  // namespace

std::span<const Case> all_cases() { return kCases; }

std::string case_name(const Case& c) {
  return std::string(c.mesh) + "-" + std::to_string(c.faces / 1000) + "k";
}

std::vector<std::string> backends_for(const Case& c, const SolvePlan& plan) {
  std::vector<std::string> out;
  if (plan.quick && !c.quick && !plan.chosen) return out;
  for (const std::string& backend : plan.backends) {
    if (std::regex_search(case_name(c) + "/" + backend, plan.only)) out.push_back(backend);
  }
  return out;
}

}  // namespace geotherm::bench
