// SPDX-License-Identifier: MIT
// The settings of methods.
#include <cctype>
#include <cmath>
#include <utility>

#include "app/picture/picture_text.h"
#include "app/session/settings.h"
#include "app/session/wording.h"
#include "app/text/text.h"
#include "geotherm/backend.h"
#include "geotherm/options.h"
#include "solver/core/text.h"

namespace geotherm::app {
namespace {

using Names = std::vector<std::string>;
using State = ViewerState;
using Text = std::string;
using enum SettingGroup;
using enum SettingKind;

constexpr int kMaxThreads = 1024;
constexpr int kMaxRefine = 6;
constexpr const char* kFree = "free";  // the memory limit that the machine sets

Result<double> parse_time_factor(const Text& text) {
  const auto factor = number_in<double>(text);
  if (factor && *factor > 0 && std::isfinite(*factor)) return *factor;
  return bad_value(text, "is no time factor", "it must be a positive number, such as 1");
}

/// 0: one a core.
Result<int> parse_threads(const Text& text) {
  const auto threads = number_in<int>(text);
  if (threads && *threads >= 0 && *threads <= kMaxThreads) return *threads;
  return bad_value(text, "is no number of threads",
                   "give 1 to " + std::to_string(kMaxThreads) + ", or 0 for one a core");
}

/// In 2^20 bytes; 0: what is free.
Result<double> parse_memory_limit(const Text& text) {
  if (text == kFree) return 0.0;
  constexpr std::pair<char, double> kUnits[] = {{'K', 1.0 / 1024}, {'M', 1.0}, {'G', 1024.0}};
  Text number = text;
  double unit = 1;
  for (const auto& [letter, megabytes] : kUnits) {
    if (text.empty() || std::toupper(static_cast<unsigned char>(text.back())) != letter) continue;
    number.pop_back();
    unit = megabytes;
  }
  const auto size = number_in<double>(number);
  if (size && *size > 0 && *size * unit > 0 && std::isfinite(*size * unit)) return *size * unit;
  return bad_value(
      text, "is no size",
      "give a positive number of MB, or one with K, M or G, such as 800 or 4G, or free");
}

Result<int> parse_refine(const Text& text) {
  const auto times = number_in<int>(text);
  if (times && *times >= 0 && *times <= kMaxRefine) return *times;
  return bad_value(
      text, "is no number of refinements",
      "give 0 to " + std::to_string(kMaxRefine) + ", each makes four times as many faces");
}

Result<Text> parse_backend(const Text& text) {
  const auto backend = find_backend(text);
  if (backend) return text;
  Error error = backend.error();
  if (parse<MethodKind>(text)) {
    error.hint = {text + " is a method: use ", SettingHint{"method", {text}}};
  }
  return error;
}

Result<Constraint> parse_constraint_option(const Text& text) {
  auto parsed = parse_constraint(text);
  if (parsed) return parsed;
  const bool pins = text.starts_with(to_text(ConstraintMode::kPinVertex));
  return with_hint(parsed.error(),
                   {pins ? "write pin-vertex:V with a vertex id from 0, such as pin-vertex:17"
                         : "write penalty:VALUE with a positive number, such as penalty:1e6"});
}

Result<TimeStep> parse_time_step_option(const Text& text, double factor) {
  auto parsed = parse_time_step(text, factor);
  if (parsed) return parsed;
  return with_hint(parsed.error(),
                   {"write absolute:T with a positive number, such as absolute:0.01"});
}

/// One of each rule.
Names time_steps() {
  constexpr double kTime = 0.01;
  Names texts;
  for (const auto& [rule, name] : named_values(TimeRule{}).all) {
    texts.push_back(to_text(TimeStep{rule, 1, kTime}));
  }
  return texts;
}

/// One of each mode.
Names constraints() {
  Names texts;
  for (const auto& [mode, name] : named_values(ConstraintMode{}).all) {
    texts.push_back(to_text(Constraint{mode}));
  }
  return texts;
}

}  // namespace

std::vector<Setting> method_settings() {
  return {
      choice<&MethodOptions::method>(
          {.name = "method",
           .usual = true,
           .value_name = "NAME",
           .help = "how distance is computed",
           .detail = "heat: the heat method; wavefront, wavefront-fine: near exact; fast-marching: "
                     "first order; exact: exact polyhedral distance, the slowest."}),
      {.name = "backend",
       .of_heat = true,
       .usual = true,
       .value_name = "NAME",
       .help = "linear solver",
       .get = [](const State& s) { return s.options.backend; },
       .set = [](State& s, const Text& t) { return store(parse_backend(t), s.options.backend); },
       .values = backend_names},
      {.name = "time-step",
       .of_heat = true,
       .usual = true,
       .value_name = "RULE",
       .help = "how the diffusion time t is chosen",
       .forms = "mean-edge (t = m h^2, default), mean-face-area (t = m A/F), absolute:T",
       .detail = "mean-edge: t = m g h\u00b2; mean-face-area: t = m g A/F; absolute: t itself. The "
                 "grading g is 1 on most meshes.",
       .get = [](const State& s) { return to_text(s.options.time_step); },
       .set =
           [](State& s, const Text& t) {
             return store(parse_time_step_option(t, s.options.time_step.factor),
                          s.options.time_step);
           },
       .values = time_steps},
      {.name = "time-factor",
       .kind = kNumber,
       .of_heat = true,
       .usual = true,
       .option = "-m,--time-factor",
       .value_name = "M",
       .help = "m of the time step",
       .detail = "Around 1 is right for most meshes; larger smooths the distances, smaller costs "
                 "accuracy on coarse meshes.",
       .get = [](const State& s) { return number_text(s.options.time_step.factor); },
       .set =
           [](State& s, const Text& t) {
             return store(parse_time_factor(t), s.options.time_step.factor);
           }},
      {.name = "constraint",
       .of_heat = true,
       .value_name = "MODE",
       .help = "what makes the Poisson system solvable",
       .forms = "pin-sources (default), pin-vertex[:V], penalty[:VALUE], conserve-energy, "
                "pseudo-inverse",
       .detail = "pin-sources: \u03c6 = 0 on every source; pin-vertex: on one vertex; penalty: a "
                 "number on the diagonal; conserve-energy: the total of \u03c6 is fixed; "
                 "pseudo-inverse: the smallest solution.",
       .get = [](const State& s) { return to_text(s.options.constraint); },
       .set = [](State& s,
                 const Text& t) { return store(parse_constraint_option(t), s.options.constraint); },
       .values = constraints},
      choice<&HeatOptions::heat>(
          {.name = "heat",
           .of_heat = true,
           .value_name = "MODE",
           .help = "what the heat step diffuses",
           .detail =
               "unit: 1 on every source; diffuse: weighted with the source's area; hold: u = 1 "
               "held on the sources."}),
      choice<&HeatOptions::boundary>(
          {.name = "boundary",
           .of_heat = true,
           .value_name = "RULE",
           .help = "the condition on u along the boundary",
           .detail =
               "neumann: no heat leaves; dirichlet: u = 0 on the boundary; average: the mean of "
               "both; auto takes average in volumes, neumann elsewhere."}),
      choice<&HeatOptions::laplacian>(
          {.name = "laplacian",
           .of_heat = true,
           .value_name = "KIND",
           .help = "which triangulation carries the operators",
           .detail =
               "auto flips edges where weights would be negative, on the tufted cover where edges "
               "have three faces, and inserts vertices (refined) where faces are too large or the "
               "boundary is obtuse; cotan takes the mesh as it is."}),
      choice<&HeatOptions::variant>(
          {.name = "variant",
           .of_heat = true,
           .value_name = "NAME",
           .help = "how the method is discretised",
           .detail = "corrected: this program's; classic: as first published."}),
      choice<&HeatOptions::precision>(
          {.name = "precision",
           .of_heat = true,
           .value_name = "NAME",
           .help = "how accurately systems are solved",
           .detail =
               "compact: factors at half the size where the backend can; refined: the same, and "
               "each solve made accurate by another; full: factors in double."}),
      {.name = "memory-limit",
       .of_heat = true,
       .value_name = "SIZE",
       .help = "most that a backend's factors may take, in MB or with K, M or G; what needs more "
               "fails before it starts",
       .forms = "800, 4G, free (default: what the machine has left)",
       .get =
           [](const State& s) {
             const double limit = s.options.memory_limit_mb;
             return limit == 0 ? Text(kFree) : number_text(limit);
           },
       .set = [](State& s,
                 const Text& t) { return store(parse_memory_limit(t), s.options.memory_limit_mb); },
       .values =
           [] {
             return Names{kFree, "500"};
           }},
      {.name = "strict",
       .kind = kSwitch,
       .of_heat = true,
       .bare = "on",
       .help = "a backend that fails is an error; otherwise the next one takes over",
       .get = [](const State& s) { return switch_text(s.options.strict); },
       .set = [](State& s, const Text& t) { return store(parse_switch(t), s.options.strict); }},
      number<&MethodOptions::threads, parse_threads>(
          {.name = "threads",
           .value_name = "N",
           .help = "threads that work at once; 0: one a core"}),
      number<&MethodOptions::refine, parse_refine>(
          {.name = "refine",
           .usual = true,
           .value_name = "N",
           .help = "cuts each face of a mesh into four N times, up to 6, before anything is "
                   "solved: 4^N times the faces, memory and time; the output keeps the model's "
                   "vertices",
           .detail = "Each time there are four times as many faces to solve on, and less error; "
                     "the distances shown are those at the model's own vertices.",
           .values =
               [] {
                 Names times;
                 for (int n = 0; n <= kMaxRefine; ++n) times.push_back(std::to_string(n));
                 return times;
               }}),
  };
}

}  // namespace geotherm::app
