// SPDX-License-Identifier: MIT
// `geotherm plan`: memory and time of work that is too long to try.
#include <CLI/CLI.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

#include "app/cli/commands.h"
#include "app/session/progress.h"
#include "app/session/report.h"
#include "app/text/text.h"
#include "geotherm/io.h"
#include "geotherm/many.h"
#include "solver/distributed/mesh_block.h"
#include "solver/heat/factor_memory.h"

namespace geotherm::app {
namespace {

/// A figure at two sizes, and between and beyond them the power law through both.
struct Law {
  double small, large;

  double at(double vertices) const {
    const double power = std::log(large / small) / std::log(kLarge / kSmall);
    return small * std::pow(vertices / kSmall, power);
  }
  static constexpr double kSmall = 140e3, kLarge = 2.2e6;  ///< vertices
};

/// docs/performance.md, torus of 280k and 4.4M faces, backend native, two threads of a Xeon.
constexpr Law kSetupSeconds = {0.359, 8.44};
constexpr Law kQuerySeconds = {0.00658, 0.160};
constexpr Law kRowSeconds = {0.00272, 0.0616};  ///< of a source in a block of sixteen
/// Two chunks of sixteen answers, of a thread each.
constexpr double kAnswersOfVertex = 2 * 2 * kSetsInBlock * sizeof(double);

/// One mesh over ranks (docs/large_scale.md): what a rank has before, and of each vertex it owns;
/// torus of a million faces, half a million vertices a rank.
constexpr double kRankBytes = 56 * kMegabyte, kShareBytes = 1150;
/// Seconds of a processor for a vertex of a rank (scripts/plan_rates.sh measures them): to read and
/// share out; blocks with their factors; one solve of a block; BoomerAMG, and an iteration with it;
/// blocks for waves, and these.
constexpr double kSharing = 1.3e-6, kBlocks = 3.1e-6, kBlockSolve = 0.29e-6, kAmg = 2.0e-6,
                 kIteration = 0.21e-6, kCutting = 2.2e-6, kWaves = 1.2e-6;
/// Exchanges of waves for each mean edge of the longest distance (bands and what they need
/// beyond one each), and that distance where a surface is about as long as wide: from one corner of
/// a square to the other, in edges of which half are diagonals.
constexpr double kExchanges = 2.4, kLongest = 1.22;
/// On good meshes 9 to 14.
constexpr double kIterations = 15;
/// How often a block solves: 4.4 times of 16 blocks, and as blocks^0.15 with more (6.7 of 256).
double solves_of_block(double blocks) { return 4.4 * std::pow(blocks / 16, 0.15); }
/// Numbers of PETSc have 32 bits.
constexpr double kMaxShared = std::numeric_limits<Index>::max();

/// Distances are computed on rows numbered by 32 bits; a closed surface has twice as many faces.
constexpr double kMaxVertices = std::numeric_limits<Index>::max() / 3.0;

Result<double> whole_number(const std::string& text, const char* option) {
  const auto number = count_in(text);
  if (number && *number >= 1) return static_cast<double>(*number);
  return Error{ErrorCode::kBadInput,
               std::string(option) + ": '" + one_line(text) + "' is no count",
               {"give a whole number from 1, such as 64 or 2e6"}};
}

struct SharedPlan {
  double own, blocks, rounds, bytes;
  double sharing, setup, heat, poisson;  ///< seconds; set-up without the sharing
  double cutting, waves, exchanges;      ///< of the method wavefront, in place of the last three
};

/// One source on a mesh that ranks share.
SharedPlan plan_shared(double vertices, double ranks) {
  const double own = std::ceil(vertices / ranks);
  const double blocks_of_rank = std::ceil(own / kMaxBlock), blocks = ranks * blocks_of_rank;
  const double rounds = std::ceil(2 * std::sqrt(blocks) + 6);
  // A round takes as long as a block at least, a rank as long as all its solves.
  const double solves = std::max(rounds, blocks_of_rank * solves_of_block(blocks));
  return {.own = own,
          .blocks = blocks,
          .rounds = rounds,
          .bytes = kRankBytes + kShareBytes * own,
          .sharing = kSharing * own,
          .setup = kBlocks * own,
          .heat = solves * kBlockSolve * own / blocks_of_rank,
          .poisson = (kAmg + kIterations * kIteration) * own,
          .cutting = kCutting * own,
          // The front passes as many shares one after the other.
          .waves = kWaves * own * std::sqrt(ranks),
          .exchanges = std::ceil(kExchanges * kLongest * std::sqrt(vertices))};
}

}  // namespace

void add_plan_options(CLI::App& command, PlanArguments& arguments) {
  command.add_option("--vertices", arguments.vertices, "of the mesh, such as 2e6")
      ->type_name("N")
      ->required();
  command.add_option("--sources", arguments.sources, "rows of distances wanted; default 1")
      ->type_name("K");
  command.add_option("--ranks", arguments.ranks, "processes that share them; default 1")
      ->type_name("N");
  add_json_option(command, arguments.json, "the same");
  command.footer(
      "Power laws through figures that were measured on two threads (docs/performance.md). Many "
      "sources are shared out over ranks that hold the whole mesh; with one source ranks share "
      "the mesh (--backend petsc, docs/large_scale.md).\n"
      "Examples:\n"
      "  geotherm plan --vertices 2e6 --sources 10000 --ranks 64\n"
      "  geotherm plan --vertices 1e9 --ranks 256");
}

Result<CommandOutput> run_plan(const PlanArguments& arguments) {
  const auto or_one = [](const std::string& text) { return text.empty() ? "1" : text; };
  const auto vertices = whole_number(arguments.vertices, "--vertices");
  if (!vertices) return vertices.error();
  const auto sources = whole_number(or_one(arguments.sources), "--sources");
  if (!sources) return sources.error();
  const auto ranks = whole_number(or_one(arguments.ranks), "--ranks");
  if (!ranks) return ranks.error();
  const bool shared = *sources == 1 && *ranks > 1;
  const double most_vertices = shared ? kMaxShared : kMaxVertices;
  if (*vertices > most_vertices) {
    return Error{ErrorCode::kBadInput,
                 std::string("--vertices: ") + (shared ? "ranks share" : "a process holds") +
                     " meshes of up to " + grouped(static_cast<std::int64_t>(most_vertices)) +
                     " vertices, not " + grouped(static_cast<std::int64_t>(*vertices)),
                 {shared || *vertices > kMaxShared
                      ? "simplify the mesh first"
                      : "rows of many sources are made by processes that hold all of it, while "
                        "ranks share it for one row, from any number of sources (leave "
                        "--sources out, and give --ranks)"}};
  }
  Outputs outputs;
  if (auto fits = expect_report(arguments.json, outputs); !fits) return fits.error();
  // Blocks are dealt out whole.
  const double blocks = std::ceil(*sources / kSetsInBlock), most = std::ceil(blocks / *ranks);
  const double rows = std::min(kSetsInBlock * most, *sources);
  const double idle = shared ? 0.0 : std::max(0.0, *ranks - blocks);
  const SharedPlan share = plan_shared(*vertices, *ranks);
  const double setup = shared ? share.sharing + share.setup : kSetupSeconds.at(*vertices);
  const double queries = shared          ? share.heat + share.poisson
                         : *sources == 1 ? kQuerySeconds.at(*vertices)
                                         : rows * kRowSeconds.at(*vertices);
  const double bytes =
      shared ? share.bytes
             : heat_peak_bytes(*vertices) + (*sources > 1 ? kAnswersOfVertex * *vertices : 0);
  const auto file =
      static_cast<double>(npy_bytes_of(static_cast<std::uint64_t>(*sources),
                                       static_cast<std::uint64_t>(*vertices), NpyType::kFloat64));
  const auto report = [&] {
    Json json = {{"plan",
                  {{"vertices", *vertices},
                   {"sources", *sources},
                   {"ranks", *ranks},
                   {"rows_of_rank", rows},
                   {"idle_ranks", idle},
                   {"memory_mb_of_rank", bytes / kMegabyte},
                   {"setup_seconds", setup},
                   {"queries_seconds", queries},
                   {"file_bytes", file}}}};
    if (shared) {
      json["plan"]["vertices_of_rank"] = share.own;
      json["plan"]["blocks"] = share.blocks;
      json["plan"]["rounds"] = share.rounds;
      json["plan"]["sharing_seconds"] = share.sharing;
      json["plan"]["heat_seconds"] = share.heat;
      json["plan"]["poisson_seconds"] = share.poisson;
      json["plan"]["waves_setup_seconds"] = share.sharing + share.cutting;
      json["plan"]["waves_seconds"] = share.waves;
      json["plan"]["waves_exchanges"] = share.exchanges;
    }
    return json;
  };
  const auto table = [&] {
    TextTable lines({{"", TextTable::Align::kLeft}, {"", TextTable::Align::kLeft}});
    const auto count = [](double number) { return grouped(static_cast<std::int64_t>(number)); };
    lines.add_row({"memory a rank",
                   bytes_in_words(bytes) + (shared ? ", a share of the mesh and its factors in each"
                                                   : ", whole mesh and factors in each")});
    lines.add_row({"memory of all", bytes_in_words(bytes * *ranks)});
    if (shared) {
      lines.add_row(
          {"vertices a rank", count(share.own) + ", " + count(share.blocks) + " blocks in all"});
      lines.add_row({"rounds", count(share.rounds) + " of the heat step at most"});
    } else {
      lines.add_row({"rows a rank", count(rows) + " at most" +
                                        (idle > 0 ? "; " + count(idle) + " ranks have none" : "")});
    }
    lines.add_row({"set-up", seconds_in_words(setup) +
                                 (shared ? ", " + seconds_in_words(share.sharing) +
                                               " of it to read and share out; one thread a rank"
                                         : ", two threads a rank")});
    lines.add_row({"queries", seconds_in_words(queries) +
                                  (shared ? ", heat " + seconds_in_words(share.heat) +
                                                ", Poisson " + seconds_in_words(share.poisson) +
                                                "; without waiting for the network"
                                          : "")});
    if (shared) {
      lines.add_row({"by waves", "set-up " + seconds_in_words(share.sharing + share.cutting) +
                                     ", query " + seconds_in_words(share.waves) + " and about " +
                                     count(share.exchanges) +
                                     " waits for the network, in place of heat and Poisson"});
    }
    lines.add_row({"array", bytes_in_words(file) + ", half of it as float32"});
    return lines.text();
  };
  return finish_command({}, outputs, arguments.json, report, table);
}

}  // namespace geotherm::app
