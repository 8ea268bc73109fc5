// SPDX-License-Identifier: MIT
// What the fuzzers start from and what they ever found, and small damages of it.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>

#include "tests/fuzz/fuzz_targets.h"

namespace geotherm::test {
namespace {

constexpr std::uint64_t kSeed = 20253;

struct Target {
  const char* name;  ///< and the folder of its corpus
  std::string (*fuzz)(Bytes bytes);
  int mutations;  ///< of the whole corpus: a fraction of a second of work
};

void PrintTo(const Target& target, std::ostream* out) { *out << target.name; }

const Target kTargets[] = {
    {"obj", fuzz_obj, 5000},         {"ply", fuzz_ply, 5000},     {"off", fuzz_off, 5000},
    {"stl", fuzz_stl, 5000},         {"vtk", fuzz_vtk, 4000},     {"vtu", fuzz_vtu, 4000},
    {"vtp", fuzz_vtp, 4000},         {"msh", fuzz_msh, 4000},     {"mesh", fuzz_mesh, 4000},
    {"meshb", fuzz_meshb, 4000},     {"node", fuzz_node, 4000},   {"xyz", fuzz_xyz, 4000},
    {"pts", fuzz_pts, 4000},         {"pcd", fuzz_pcd, 4000},     {"npy", fuzz_npy, 4000},
    {"png", fuzz_png, 4000},         {"nrrd", fuzz_nrrd, 4000},   {"vti", fuzz_vti, 4000},
    {"gii", fuzz_gii, 4000},         {"fsurf", fuzz_fsurf, 4000}, {"mask", fuzz_mask, 2000},
    {"gz", fuzz_gz, 4000},           {"glb", fuzz_glb, 40},       {"dae", fuzz_dae, 40},
    {"threemf", fuzz_threemf, 40},   {"solve", fuzz_solve, 300},
#ifdef GEOTHERM_FUZZ_COMMANDS
    {"command", fuzz_command, 1000},
#endif
};

struct Input {
  std::string name;
  std::string bytes;
};

std::vector<Input> corpus(const std::string& target) {
  std::vector<Input> inputs;
  const auto folder = std::filesystem::path(GEOTHERM_FUZZ_CORPUS) / target;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    std::ifstream file(entry.path(), std::ios::binary);
    inputs.push_back({entry.path().filename().string(), {std::istreambuf_iterator(file), {}}});
  }
  std::ranges::sort(inputs, {}, &Input::name);
  return inputs;
}

std::string fault(const Target& target, const std::string& bytes) {
  return target.fuzz({reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()});
}

std::size_t below(std::mt19937_64& random, std::size_t bound) { return random() % bound; }

/// Flips, cuts out, repeats or splices in a piece of another input.
void damage(std::string& bytes, const std::string& other, std::mt19937_64& random) {
  const std::size_t at = below(random, bytes.size() + 1);
  switch (below(random, 4)) {
    case 0:
      if (at < bytes.size()) bytes[at] = static_cast<char>(random());
      break;
    case 1:
      bytes.erase(at, 1 + below(random, 16));
      break;
    case 2:
      bytes.insert(at, bytes.substr(at, 1 + below(random, 32)));
      break;
    default:
      if (!other.empty()) bytes.insert(at, other.substr(below(random, other.size()), 16));
  }
}

class Corpus : public testing::TestWithParam<Target> {};

TEST_P(Corpus, HasNoFinding) {
  const std::vector<Input> inputs = corpus(GetParam().name);
  ASSERT_FALSE(inputs.empty());
  for (const Input& input : inputs) EXPECT_EQ(fault(GetParam(), input.bytes), "") << input.name;
  EXPECT_EQ(fault(GetParam(), ""), "") << "no bytes";
}

TEST_P(Corpus, HasNoFindingWhenDamaged) {
  const std::vector<Input> inputs = corpus(GetParam().name);
  ASSERT_FALSE(inputs.empty());
  std::mt19937_64 random(kSeed);
  for (int i = 0; i < GetParam().mutations; ++i) {
    std::string bytes = inputs[below(random, inputs.size())].bytes;
    for (std::size_t k = 1 + below(random, 4); k > 0; --k) {
      damage(bytes, inputs[below(random, inputs.size())].bytes, random);
    }
    ASSERT_EQ(fault(GetParam(), bytes), "") << "mutation " << i;
  }
}

INSTANTIATE_TEST_SUITE_P(Of, Corpus, testing::ValuesIn(kTargets),
                         [](const auto& test) { return std::string(test.param.name); });

}  // namespace
}  // namespace geotherm::test
