// SPDX-License-Identifier: MIT
// Each rule is tried on text that breaks it before it is trusted with the tree.
#include "tests/rules/source_rules.h"

#include <gtest/gtest.h>

namespace geotherm::rules {
namespace {

struct IncludeCase {
  std::string name;
  std::string path;
  std::string include;  ///< with its brackets or quotes
};

std::ostream& operator<<(std::ostream& stream, const IncludeCase& c) {
  return stream << c.path << " includes " << c.include;
}

std::vector<Violation> include_violations(const IncludeCase& c) {
  return check_includes({c.path, "// text\n#include " + c.include + "\n"});
}

std::string name_of(const testing::TestParamInfo<IncludeCase>& info) { return info.param.name; }

class RulesForbiddenInclude : public testing::TestWithParam<IncludeCase> {};

TEST_P(RulesForbiddenInclude, IsFoundWithItsLine) {
  const std::vector<Violation> found = include_violations(GetParam());
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].line, 2);
  EXPECT_EQ(found[0].path, GetParam().path);
}

INSTANTIATE_TEST_SUITE_P(
    Table, RulesForbiddenInclude,
    testing::Values(
        IncludeCase{"SolverUsesApp", "solver/heat/a.cpp", "\"app/session.h\""},
        IncludeCase{"SolverUsesEngine", "solver/mesh/a.cpp", "\"engine/device.h\""},
        IncludeCase{"SolverUsesVulkan", "solver/heat/a.h", "<vulkan/vulkan.h>"},
        IncludeCase{"SolverUsesGlfw", "solver/mesh/io/a.cpp", "<GLFW/glfw3.h>"},
        IncludeCase{"SolverUsesImGui", "solver/heat/a.cpp", "<imgui.h>"},
        IncludeCase{"SolverUsesJson", "solver/mesh/a.cpp", "<nlohmann/json.hpp>"},
        IncludeCase{"BackendHeaderShowsCholmod", "solver/linear/a.h", "<cholmod.h>"},
        IncludeCase{"HeatUsesCholmod", "solver/heat/a.cpp", "<suitesparse/cholmod.h>"},
        IncludeCase{"BackendUsesVulkan", "solver/linear/a.cpp", "<vulkan/vulkan_raii.hpp>"},
        IncludeCase{"SolverUsesUnknownLibrary", "solver/linear/a.cpp", "<boost/graph/graph.hpp>"},
        IncludeCase{"PublicHeaderShowsPosix", "solver/mesh/a.h", "<sys/mman.h>"},
        IncludeCase{"MethodKnowsTheHeatMethod", "solver/method/a.cpp",
                    "\"geotherm/heat_method.h\""},
        IncludeCase{"MethodKnowsItsOptions", "solver/method/a.cpp", "\"geotherm/options.h\""},
        IncludeCase{"MethodReachesForward", "solver/method/a.cpp", "\"solver/polyhedral/a.h\""},
        IncludeCase{"DirectionsUseRanks", "solver/directions/a.cpp", "\"solver/distributed/a.h\""},
        IncludeCase{"AccuracyUsesRanks", "solver/accuracy/a.cpp", "\"solver/distributed/a.h\""},
        IncludeCase{"AccuracyUsesDirections", "solver/accuracy/a.cpp", "\"geotherm/directions.h\""},
        IncludeCase{"RanksUseMpi", "solver/distributed/a.cpp", "<mpi.h>"},
        IncludeCase{"PublicHeaderShowsInternals", "solver/include/geotherm/a.h",
                    "\"solver/core/parallel.h\""},
        IncludeCase{"ExampleUsesInternals", "docs/examples/a.cpp", "\"solver/core/parallel.h\""},
        IncludeCase{"MeshReachesForward", "solver/mesh/a.cpp", "\"geotherm/heat_method.h\""},
        IncludeCase{"LinearReachesBack", "solver/linear/a.cpp", "\"geotherm/mesh.h\""},
        IncludeCase{"LinearReachesForward", "solver/linear/a.cpp", "\"solver/heat/a.h\""},
        IncludeCase{"CoreReachesForward", "solver/core/a.h", "\"solver/mesh/a.h\""},
        IncludeCase{"EngineUsesSolver", "engine/a.cpp", "\"geotherm/mesh.h\""},
        IncludeCase{"EngineUsesApp", "engine/a.h", "\"app/state.h\""},
        IncludeCase{"EngineHeaderShowsGlfw", "engine/a.h", "<GLFW/glfw3.h>"},
        IncludeCase{"EngineUsesEigen", "engine/a.cpp", "<Eigen/Core>"},
        IncludeCase{"AppUsesVulkan", "app/session/a.cpp", "<vulkan/vulkan.h>"},
        IncludeCase{"AppUsesEngine", "app/session/a.cpp", "\"engine/device.h\""},
        IncludeCase{"AppHeaderShowsPng", "app/picture/a.h", "<png.h>"},
        IncludeCase{"MainDrawingUsesUi", "app/drawing/a.cpp", "\"ui/interface.h\""},
        IncludeCase{"MainWindowUsesVulkan", "app/window/a.cpp", "<vulkan/vulkan.h>"},
        IncludeCase{"MainWindowUsesGlfw", "app/window/a.cpp", "<GLFW/glfw3.h>"},
        IncludeCase{"PictureUsesSession", "app/picture/a.h", "\"app/session/session.h\""},
        IncludeCase{"TextUsesPicture", "app/text/a.cpp", "\"app/picture/drawing.h\""},
        IncludeCase{"SessionUsesTheCommandLine", "app/session/a.cpp", "\"app/cli/options.h\""},
        IncludeCase{"SessionUsesCli11", "app/session/a.cpp", "<CLI/CLI.hpp>"},
        IncludeCase{"MainDrawingUsesVulkan", "app/drawing/a.cpp", "<vulkan/vulkan.h>"},
        IncludeCase{"EngineHeaderShowsStb", "engine/a.h", "<stb/stb_truetype.h>"},
        IncludeCase{"AppUsesUi", "app/cli/a.cpp", "\"ui/panel.h\""},
        IncludeCase{"AppUsesImGui", "app/cli/a.cpp", "\"imgui.h\""},
        IncludeCase{"UiUsesVulkan", "ui/panel.cpp", "<vulkan/vulkan.h>"},
        IncludeCase{"UiUsesEngine", "ui/panel.cpp", "\"engine/device.h\""},
        IncludeCase{"UiUsesBackends", "ui/panel.cpp", "\"geotherm/backend.h\""},
        IncludeCase{"UiUsesImGuiBackend", "ui/panel.cpp", "<imgui_impl_vulkan.h>"},
        IncludeCase{"ShaderUsesEngine", "shaders/a.vert", "\"engine/device.h\""},
        IncludeCase{"SolverUsesTests", "solver/heat/a.cpp", "\"tests/zoo.h\""},
        IncludeCase{"AppUsesBench", "app/cli/a.cpp", "\"bench/baseline.h\""},
        IncludeCase{"AppSculptsModels", "app/session/model.cpp", "\"bench/models/generate.h\""},
        IncludeCase{"ModelsUseBench", "bench/models/a.cpp", "\"bench/bench_mesh.h\""},
        IncludeCase{"ModelsUseMethods", "bench/models/a.cpp", "\"geotherm/heat_method.h\""},
        IncludeCase{"MainUsesTests", "app/main.cpp", "\"tests/zoo.h\""},
        IncludeCase{"BenchUsesTests", "bench/a.cpp", "\"tests/zoo.h\""},
        IncludeCase{"AngleBracketsHideAFolder", "solver/heat/a.cpp", "<app/session.h>"},
        IncludeCase{"RelativePath", "solver/heat/a.cpp", "\"heat_method.h\""},
        IncludeCase{"PathUpwards", "solver/heat/a.cpp", "\"../mesh/triangle_mesh.h\""}),
    name_of);

class RulesAllowedInclude : public testing::TestWithParam<IncludeCase> {};

TEST_P(RulesAllowedInclude, Passes) { EXPECT_TRUE(include_violations(GetParam()).empty()); }

INSTANTIATE_TEST_SUITE_P(
    Table, RulesAllowedInclude,
    testing::Values(
        IncludeCase{"SolverUsesStandard", "solver/heat/a.h", "<vector>"},
        IncludeCase{"SolverUsesEigen", "solver/heat/a.h", "<Eigen/Core>"},
        IncludeCase{"ExampleUsesTheFrontDoor", "docs/examples/a.cpp", "<geotherm/geotherm.h>"},
        IncludeCase{"ExampleUsesItsNeighbour", "docs/examples/a.cpp", "\"require.h\""},
        IncludeCase{"HeatUsesBounds", "solver/heat/a.cpp", "\"solver/accuracy/distance_bounds.h\""},
        IncludeCase{"RanksUseTheCheck", "solver/distributed/a.cpp", "\"geotherm/accuracy.h\""},
        IncludeCase{"HeatUsesAllBefore", "solver/heat/a.cpp", "\"geotherm/backend.h\""},
        IncludeCase{"BackendUsesCholmod", "solver/linear/a.cpp", "<cholmod.h>"},
        IncludeCase{"ReaderMapsFiles", "solver/mesh/io/a.cpp", "<sys/mman.h>"},
        IncludeCase{"EngineUsesVulkan", "engine/a.h", "<vulkan/vulkan_raii.hpp>"},
        IncludeCase{"EngineSharesStructs", "engine/a.h", "\"shaders/structs.h\""},
        IncludeCase{"ShaderUsesItsNeighbour", "shaders/a.vert", "\"frame.glsl\""},
        IncludeCase{"AppUsesSolver", "app/cli/a.cpp", "\"geotherm/heat_method.h\""},
        IncludeCase{"GenerateSculptsModels", "app/cli/cmd_generate.cpp",
                    "\"bench/models/generate.h\""},
        IncludeCase{"AppUsesCli11", "app/cli/a.cpp", "<CLI/CLI.hpp>"},
        IncludeCase{"SessionUsesPicture", "app/session/a.h", "\"app/picture/a.h\""},
        IncludeCase{"AppUsesJson", "app/session/a.h", "<nlohmann/json.hpp>"},
        IncludeCase{"AppWritesPng", "app/picture/png_file.cpp", "<png.h>"},
        IncludeCase{"MainWindowMeetsUi", "app/window/a.cpp", "\"ui/interface.h\""},
        IncludeCase{"MainWindowMeetsEngine", "app/window/a.cpp", "\"engine/window/window.h\""},
        IncludeCase{"MainDrawingMeetsEngine", "app/drawing/a.cpp", "\"engine/device.h\""},
        IncludeCase{"EngineUsesResult", "engine/a.h", "\"geotherm/error.h\""},
        IncludeCase{"EngineUsesStb", "engine/a.cpp", "<stb/stb_truetype.h>"},
        IncludeCase{"UiUsesImGui", "ui/panel.cpp", "<imgui.h>"},
        IncludeCase{"UiUsesApp", "ui/panel.cpp", "\"app/state.h\""},
        IncludeCase{"MainMeetsEngine", "app/main.cpp", "\"engine/device.h\""},
        IncludeCase{"MainMeetsVulkan", "app/main.cpp", "<vulkan/vulkan.h>"},
        IncludeCase{"TestsUseAll", "tests/a.cpp", "\"bench/baseline.h\""},
        IncludeCase{"BenchUsesLibraries", "bench/a.cpp", "<tiny_obj_loader.h>"}),
    name_of);

TEST(Rules, AFolderWithoutARuleIsFound) {
  for (const char* path : {"extras/a.cpp", "solver/extras/a.cpp", "solver/a.cpp"}) {
    EXPECT_EQ(check_includes({path, "#include <vector>\n"}).size(), 1U) << path;
  }
}

TEST(Rules, ASecondUserOfGlfwInTheEngineIsFound) {
  const std::string text = "#include <GLFW/glfw3.h>\n";
  const std::vector<SourceFile> one = {{"engine/a.cpp", text}, {"app/main.cpp", text}};
  const std::vector<SourceFile> two = {{"engine/a.cpp", text}, {"engine/b.cpp", text}};
  EXPECT_TRUE(check_lone_users(one).empty());
  ASSERT_EQ(check_lone_users(two).size(), 1U);
  EXPECT_EQ(check_lone_users(two)[0].path, "engine/b.cpp");
}

TEST(Rules, AMissingLicenceLineIsFound) {
  EXPECT_TRUE(check_licence({"a.h", "// SPDX-License-Identifier: MIT\n"}).empty());
  EXPECT_TRUE(check_licence({"a.sh", "#!/bin/bash\n# SPDX-License-Identifier: MIT\n"}).empty());
  EXPECT_EQ(check_licence({"a.h", "#pragma once\n"}).size(), 1U);
  EXPECT_EQ(check_licence({"a.h", "\n\n// SPDX-License-Identifier: MIT\n"}).size(), 1U);
  EXPECT_EQ(check_licence({"a.h", ""}).size(), 1U);
}

TEST(Rules, AFileOfMoreThan400LinesIsFound) {
  std::string text;
  for (int i = 0; i < 400; ++i) text += "//\n";
  EXPECT_TRUE(check_length({"a.h", text}).empty());
  EXPECT_EQ(check_length({"a.h", text + "//\n"}).size(), 1U);
}

TEST(Rules, AConditionOnABackendOutsideTheRegistryIsFound) {
  for (const char* condition :
       {"#ifdef GEOTHERM_HAS_CHOLMOD\n", "  # if defined(GEOTHERM_WITH_CHOLMOD) && 1\n",
        "#if __has_include(<cholmod.h>)\n", "#elif USE_SUITESPARSE\n"}) {
    EXPECT_EQ(check_backend_conditions({"solver/heat/a.cpp", condition}).size(), 1U) << condition;
    EXPECT_EQ(check_backend_conditions({"tests/a.cpp", condition}).size(), 1U) << condition;
    EXPECT_TRUE(
        check_backend_conditions({"solver/linear/backend_registry.cpp", condition}).empty());
  }
  for (const char* condition : {"#ifdef NDEBUG\n", "#if defined(__x86_64__)\n", "#endif\n"}) {
    EXPECT_TRUE(check_backend_conditions({"solver/linear/a.cpp", condition}).empty()) << condition;
  }
}

TEST(Rules, AnOptionInAStringOutsideTheCommandLineIsFound) {
  for (const char* line : {"f(\"use --method wavefront\");\n", "f('\"', \"a\\\"b\", \"--x\");\n"}) {
    for (const char* file : {"solver/heat/a.cpp", "engine/a.cpp", "app/session/a.cpp"}) {
      EXPECT_EQ(check_option_names({file, line}).size(), 1U) << file << ": " << line;
    }
    EXPECT_TRUE(check_option_names({"app/cli/a.cpp", line}).empty()) << line;
  }
  for (const char* line : {"--count;\n", "f(\"a\", --b, \"c\");\n", "f(\"-- 3\");\n",
                           "f();  // \"--method wavefront\"\n", "f('\"', --b, '\"');\n"}) {
    EXPECT_TRUE(check_option_names({"solver/heat/a.cpp", line}).empty()) << line;
  }
}

TEST(Rules, ASubCommandInAStringOfTheLibraryIsFound) {
  const std::string line = "f(\"draw with geotherm render\");\n";
  for (const char* file : {"solver/a.cpp", "solver/mesh/io/a.inl", "engine/vulkan/a.cpp"}) {
    EXPECT_EQ(check_option_names({file, line}).size(), 1U) << file;
  }
  EXPECT_TRUE(check_option_names({"app/session/a.cpp", line}).empty());
  for (const char* other : {"f(\"geotherm \");\n", "f(\"geotherm: error\");\n",
                            "f();  // \"geotherm render\"\n", "#include \"geotherm/mesh.h\"\n"}) {
    EXPECT_TRUE(check_option_names({"solver/a.cpp", other}).empty()) << other;
  }
}

TEST(Rules, ASnippetThatIsInNoExampleIsFound) {
  const std::vector<SourceFile> files = {{"docs/examples/a.cpp", "int main() {\n  f(1);\n}\n"},
                                         {"docs/examples/b.cpp", "h(3);\n"},
                                         {"solver/a.cpp", "g(2);\n"}};
  const auto lines_found = [&](const std::string& page) {
    std::vector<int> lines;
    for (const Violation& found : check_snippets({"README.md", page}, files)) {
      lines.push_back(found.line);
    }
    return lines;
  };
  EXPECT_EQ(lines_found("```cpp\nf(1);\n```\n```\nany(3);\n```\n"), std::vector<int>{});
  EXPECT_EQ(lines_found("```cpp\nf(1);\n\ng(2);\n```\n"), std::vector{4});
  EXPECT_EQ(lines_found("```cpp\nf(1\n```\n"), std::vector{2});
  EXPECT_EQ(lines_found("```cpp\nf(1);\n\nh(3);\n```\n"), std::vector{4}) << "of two examples";
}

TEST(Rules, APathOfAPageThatIsNoneIsFound) {
  const auto found =
      check_paths({"docs/a.md", "`solver/`, `solver/no.cpp`\n`docs/testing.md` `any/no.cpp`\n"},
                  GEOTHERM_SOURCE_DIR);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].what, "solver/no.cpp does not exist");
}

class RulesTree : public testing::Test {
 protected:
  static const std::vector<SourceFile>& files() {
    static const std::vector<SourceFile> kFiles = read_tree(GEOTHERM_SOURCE_DIR);
    return kFiles;
  }

  template <class Check>
  static std::string violations(Check check) {
    std::string text;
    for (const SourceFile& file : files()) text += text_of(check(file));
    return text;
  }

  static std::string text_of(const std::vector<Violation>& found) {
    std::string text;
    for (const Violation& violation : found) {
      text += "\n" + violation.path + ":" + std::to_string(violation.line) + ": " + violation.what;
    }
    return text;
  }
};

TEST_F(RulesTree, IsReadAtAll) {
  const auto holds = [](std::string_view path) {
    return std::any_of(files().begin(), files().end(),
                       [&](const SourceFile& file) { return file.path == path; });
  };
  EXPECT_TRUE(holds("solver/include/geotherm/heat_method.h"));
  EXPECT_TRUE(holds("tests/rules/source_rules_test.cpp"));
  EXPECT_TRUE(holds("cmake/FindCHOLMOD.cmake"));
  EXPECT_TRUE(holds("scripts/test.sh"));
}

TEST_F(RulesTree, EachFolderIncludesOnlyWhatItMay) {
  EXPECT_EQ(violations(check_includes), "");
  EXPECT_EQ(text_of(check_lone_users(files())), "");
}

TEST_F(RulesTree, EachFileSaysItsLicence) { EXPECT_EQ(violations(check_licence), ""); }

TEST_F(RulesTree, NoFileIsLong) { EXPECT_EQ(violations(check_length), ""); }

TEST_F(RulesTree, NoStringBelowTheCommandLineNamesAnOptionOrASubCommand) {
  EXPECT_EQ(violations(check_option_names), "");
}

TEST_F(RulesTree, EverySnippetIsPartOfAnExample) {
  std::string text;
  for (const SourceFile& page : read_pages(GEOTHERM_SOURCE_DIR)) {
    text += text_of(check_snippets(page, files()));
  }
  EXPECT_EQ(text, "");
}

TEST_F(RulesTree, EveryPathInAPageExists) {
  std::string text;
  for (const SourceFile& page : read_pages(GEOTHERM_SOURCE_DIR)) {
    text += text_of(check_paths(page, GEOTHERM_SOURCE_DIR));
  }
  EXPECT_EQ(text, "");
}

TEST_F(RulesTree, OnlyTheRegistryHasConditionsOnBackends) {
  EXPECT_EQ(violations(check_backend_conditions), "");
}

}  // namespace
}  // namespace geotherm::rules
