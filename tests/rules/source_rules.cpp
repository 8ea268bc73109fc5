// SPDX-License-Identifier: MIT
#include "tests/rules/source_rules.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <fstream>
#include <map>
#include <set>
#include <sstream>
#include <utility>

namespace geotherm::rules {
namespace {

constexpr int kLongestFile = 400;
constexpr std::array kHouse = {"solver", "engine", "shaders", "app",      "ui",           "tests",
                               "bench",  "cmake",  "scripts", "geotherm", "docs/examples"};

/// What a condition on a backend has in it, in lower case.
constexpr const char* kBackendWords[] = {"geotherm_with_", "geotherm_has_", "geotherm_have_",
                                         "geotherm_use_",  "cholmod",       "suitesparse",
                                         "eigen_ldlt",     "backend"};

using Names = std::set<std::string, std::less<>>;

/// What a folder may include. "any" among the libraries stands for every library; "geotherm" are
/// the public headers, of which a folder of the library sees what lies below it.
struct Permission {
  std::string_view folder;  ///< of the including file, or the file itself
  Names house;              ///< folders of the project
  Names libraries;          ///< in headers and sources
  Names private_libraries;  ///< in .cpp and .inl only
};

/// The first entry that fits a path counts.
const std::vector<Permission>& permissions() {
  const auto with = [](Names names, const Names& more) {
    names.insert(more.begin(), more.end());
    return names;
  };
  const Names base = {"solver/core", "geotherm/types.h", "geotherm/error.h", "geotherm/names.h",
                      "geotherm/progress.h"};
  const Names mesh =
      with(base, {"solver/mesh", "geotherm/mesh.h", "geotherm/io.h", "geotherm/sources.h"});
  const Names linear = with(base, {"solver/linear", "geotherm/backend.h"});
  const Names geometry =
      with(with(mesh, linear), {"solver/geometry", "geotherm/mesh_report.h", "geotherm/domains.h"});
  const Names method =
      with(geometry, {"solver/method", "geotherm/distance_method.h", "geotherm/many.h"});
  const Names path = with(method, {"solver/path", "geotherm/path.h"});
  const Names polyhedral =
      with(method, {"solver/polyhedral", "solver/accuracy/distance_bounds.h",
                    "solver/accuracy/check_waves.h", "geotherm/polyhedral_methods.h"});
  const Names volume = with(method, {"solver/volume", "geotherm/domains.h"});
  const Names heat =
      with(polyhedral, {"solver/heat", "solver/volume", "solver/grid", "solver/accuracy",
                        "geotherm/heat_method.h", "geotherm/options.h", "geotherm/domains.h"});
  const Names directions =
      with(path, {"solver/directions", "solver/polyhedral", "solver/heat", "geotherm/directions.h",
                  "geotherm/polyhedral_methods.h", "geotherm/heat_method.h"});
  const Names accuracy = with(heat, {"geotherm/accuracy.h", "geotherm/build_method.h"});
  static const std::vector<Permission> kPermissions = {
      {"solver/include", {"geotherm"}, {"std", "eigen"}, {}},
      {"solver/core", base, {"std", "eigen"}, {"posix"}},
      {"solver/mesh", mesh, {"std", "eigen"}, {"posix", "zlib", "assimp"}},
      {"solver/linear", linear, {"std", "eigen"}, {"posix", "algebra"}},
      {"solver/geometry", geometry, {"std", "eigen"}, {}},
      {"solver/method", method, {"std", "eigen"}, {}},
      {"solver/points",
       with(mesh, {"solver/points", "geotherm/domains.h"}),
       {"std", "eigen"},
       {"nanoflann"}},
      {"solver/path", path, {"std", "eigen"}, {}},
      {"solver/polyhedral", polyhedral, {"std", "eigen"}, {}},
      {"solver/volume", volume, {"std", "eigen"}, {}},
      {"solver/grid", with(volume, {"solver/grid"}), {"std", "eigen"}, {"png"}},
      {"solver/heat", heat, {"std", "eigen"}, {}},
      {"solver/directions", directions, {"std", "eigen"}, {}},
      {"solver/accuracy", accuracy, {"std", "eigen"}, {}},
      {"solver/distributed", with(accuracy, {"solver/distributed"}), {"std", "eigen"}, {}},
      {"solver/build_method.cpp", {"solver", "geotherm"}, {"std", "eigen"}, {}},
      {"docs/examples", {"geotherm", "docs/examples"}, {"std", "eigen"}, {}},
      {"app/main.cpp", {"solver", "geotherm", "engine", "shaders", "app", "ui"}, {"any"}, {}},
      {"app/drawing",
       {"solver", "geotherm", "engine", "app"},
       {"std", "glm", "json", "embedded"},
       {"zlib"}},
      {"app/window", {"solver", "geotherm", "engine", "app", "ui"}, {"std", "glm", "imgui"}, {}},
      {"engine",
       with(base, {"engine", "shaders"}),
       {"std", "vulkan", "glm"},
       {"posix", "stb", "embedded", "glfw", "imgui", "imgui end"}},
      {"shaders", {"shaders"}, {"std", "glm"}, {}},
      {"app/cli/cmd_generate.cpp",
       {"app", "solver", "geotherm", "bench/models"},
       {"std", "cli11"},
       {}},
      {"app/text", with(base, {"app/text"}), {"std"}, {}},
      {"app/picture",
       {"app/picture", "app/text", "solver", "geotherm"},
       {"std", "eigen"},
       {"png", "cairo"}},
      {"app/session",
       {"app/session", "app/picture", "app/text", "solver", "geotherm"},
       {"std", "json", "eigen"},
       {"posix"}},
      {"app/c",
       {"app/c", "app/session", "app/picture", "app/text", "solver", "geotherm"},
       {"std", "json", "eigen"},
       {"posix"}},
      {"app/cli",
       {"app/cli", "app/session", "app/picture", "app/text", "solver", "geotherm"},
       {"std", "cli11", "json", "eigen"},
       {"posix"}},
      {"ui", {"ui", "app"}, {"std", "imgui"}, {}},
      {"bench/models", with(mesh, {"bench/models", "geotherm/domains.h"}), {"std", "eigen"}, {}},
      {"bench", {"solver", "geotherm", "engine", "shaders", "app", "ui", "bench"}, {"any"}, {}},
      {"tests",
       {"solver", "geotherm", "engine", "shaders", "app", "ui", "tests", "bench"},
       {"any"},
       {}},
  };
  return kPermissions;
}

bool starts_with_folder(std::string_view path, std::string_view folder) {
  return path.starts_with(folder) && (path.size() == folder.size() || path[folder.size()] == '/');
}

bool is_public_header(std::string_view path) {
  return (path.ends_with(".h") || path.ends_with(".hpp"));
}

/// Library headers by how they begin.
struct LibraryPrefix {
  std::string_view begin, library;
};
constexpr LibraryPrefix kLibraries[] = {
    {"stdint.h", "std"},
    {"Eigen/", "eigen"},
    {"unsupported/Eigen/", "eigen"},
    {"sys/", "posix"},
    {"unistd.h", "posix"},
    {"fcntl.h", "posix"},
    {"spawn.h", "posix"},
    {"dirent.h", "posix"},
    {"dlfcn.h", "posix"},
    {"glob.h", "posix"},
    {"malloc.h", "posix"},
    {"poll.h", "posix"},
    {"pthread.h", "posix"},
    {"sched.h", "posix"},
    {"signal.h", "posix"},
    {"time.h", "posix"},
    {"termios.h", "posix"},
    {"nanoflann", "nanoflann"},
    {"cholmod", "algebra"},
    {"amd.h", "algebra"},
    {"colamd.h", "algebra"},
    {"suitesparse/", "algebra"},
    {"SuiteSparse", "algebra"},
    {"umfpack", "algebra"},
    {"metis.h", "algebra"},
    {"petsc", "algebra"},
    {"cblas.h", "algebra"},
    {"lapacke.h", "algebra"},
    {"openblas", "algebra"},
    {"immintrin.h", "algebra"},
    {"vulkan/", "vulkan"},
    {"vk_", "vulkan"},
    {"GLFW/", "glfw"},
    {"glm/", "glm"},
    {"imgui_impl_", "imgui end"},
    {"imgui", "imgui"},
    {"CLI/", "cli11"},
    {"nlohmann/", "json"},
    {"png.h", "png"},
    {"cairo-", "cairo"},
    {"zlib.h", "zlib"},
    {"assimp/", "assimp"},
    {"stb_", "stb"},
    {"stb/", "stb"},
    {"embedded/", "embedded"},  // made while building, from files that travel in the program
};

/// The library a header belongs to; "?" for one that is not known here.
std::string_view library_of(std::string_view header) {
  for (std::string_view folder : {"imgui/", "backends/"}) {
    if (header.starts_with(folder)) header.remove_prefix(folder.size());
  }
  for (const LibraryPrefix& known : kLibraries) {
    if (header.starts_with(known.begin)) return known.library;
  }
  return header.find_first_of("/.") == std::string_view::npos ? "std" : "?";
}

template <class Body>
void for_each_line(const std::string& text, Body&& body) {
  std::istringstream stream(text);
  int number = 0;
  for (std::string line; std::getline(stream, line);) body(++number, line);
}

/// The preprocessor directive of a line and what follows it; both empty when there is none.
std::pair<std::string_view, std::string_view> directive(std::string_view line) {
  const auto trim = [&line] {
    line.remove_prefix(std::min(line.find_first_not_of(" \t"), line.size()));
  };
  trim();
  if (!line.starts_with('#')) return {};
  line.remove_prefix(1);
  trim();
  const auto end = std::find_if_not(line.begin(), line.end(), [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) || c == '_';
  });
  const std::string_view name = line.substr(0, static_cast<std::size_t>(end - line.begin()));
  line.remove_prefix(name.size());
  trim();
  return {name, line};
}

/// Calls body(line, header, quoted) for each include.
template <class Body>
void for_each_include(const std::string& text, Body&& body) {
  for_each_line(text, [&](int number, const std::string& line) {
    const auto [name, rest] = directive(line);
    if (name != "include" || rest.empty()) return;
    const bool quoted = rest[0] == '"';
    const std::size_t end = rest.find(quoted ? '"' : '>', 1);
    body(number, std::string(rest.substr(1, end == std::string_view::npos ? end : end - 1)),
         quoted);
  });
}

const Permission* permission_of(std::string_view path) {
  for (const Permission& permission : permissions()) {
    if (starts_with_folder(path, permission.folder)) return &permission;
  }
  return nullptr;
}

/// Why `path` may not include `header`; empty when it may.
std::string refusal(std::string_view path, const Permission& permission, const std::string& header,
                    bool quoted) {
  const bool in_house = std::any_of(kHouse.begin(), kHouse.end(), [&](const char* folder) {
    return header.starts_with(std::string(folder) + "/");
  });
  const std::string from(permission.folder);
  if (in_house) {
    const bool allowed =
        std::any_of(permission.house.begin(), permission.house.end(),
                    [&](const std::string& folder) { return starts_with_folder(header, folder); });
    return allowed ? "" : from + " must not use " + header;
  }
  const std::string library(library_of(header));
  if (quoted && library == "?") return "\"" + header + "\" is not written from the root";
  const Names& open = permission.libraries;
  if (open.contains("any") || open.contains(library)) return {};
  if (permission.private_libraries.contains(library)) {
    if (!is_public_header(path)) return {};
    return from + " may use " + header + " (" + library + ") in a .cpp only";
  }
  return from + " must not use " + header + " (" + library + ")";
}

}  // namespace

bool is_code(std::string_view path) {
  static const std::set<std::string> kExtensions = {".h",    ".hpp",  ".cpp",  ".inl",
                                                    ".glsl", ".vert", ".frag", ".comp"};
  return kExtensions.contains(std::filesystem::path(path).extension().string());
}

std::vector<Violation> check_includes(const SourceFile& file) {
  std::vector<Violation> found;
  if (!is_code(file.path)) return found;
  const Permission* permission = permission_of(file.path);
  if (!permission) return {{file.path, 0, "lies in a folder that has no rule"}};
  for_each_include(file.text, [&](int line, const std::string& header, bool quoted) {
    // GLSL compilers look beside the including file, not at the root; examples are no part of it.
    const std::string_view folder = permission->folder;
    const bool beside = quoted && (folder == "shaders" || folder == "docs/examples") &&
                        header.find('/') == std::string::npos;
    std::string why = refusal(file.path, *permission,
                              beside ? std::string(folder) + "/" + header : header, quoted);
    if (!why.empty()) found.push_back({file.path, line, std::move(why)});
  });
  return found;
}

std::vector<Violation> check_lone_users(std::span<const SourceFile> files) {
  std::map<std::string, std::string> first_user;
  std::vector<Violation> found;
  for (const SourceFile& file : files) {
    if (!starts_with_folder(file.path, "engine")) continue;
    for_each_include(file.text, [&](int line, const std::string& header, bool) {
      const std::string library(library_of(header));
      if (library != "glfw" && library != "imgui end") return;
      const auto [user, is_first] = first_user.emplace(library, file.path);
      if (is_first || user->second == file.path) return;
      found.push_back({file.path, line, library + " is already used by " + user->second});
    });
  }
  return found;
}

std::vector<Violation> check_licence(const SourceFile& file) {
  const std::size_t second = file.text.find('\n', file.text.find('\n') + 1);
  const std::string_view begin = std::string_view(file.text).substr(0, second);
  if (begin.find("SPDX-License-Identifier: MIT") != begin.npos) return {};
  return {{file.path, 1, "has no line SPDX-License-Identifier: MIT"}};
}

std::vector<Violation> check_length(const SourceFile& file) {
  int lines = 0;
  for_each_line(file.text, [&](int number, const std::string&) { lines = number; });
  if (lines <= kLongestFile) return {};
  return {{file.path, 0,
           std::to_string(lines) + " lines; at most " + std::to_string(kLongestFile) +
               " are allowed: split it by idea"}};
}

std::vector<Violation> check_backend_conditions(const SourceFile& file) {
  static const Names kConditions = {"if", "ifdef", "ifndef", "elif", "elifdef", "elifndef"};
  std::vector<Violation> found;
  if (!is_code(file.path) || file.path == "solver/linear/backend_registry.cpp") return found;
  for_each_line(file.text, [&](int number, const std::string& line) {
    const auto [name, rest] = directive(line);
    if (!kConditions.contains(name)) return;
    std::string condition(rest);
    std::transform(condition.begin(), condition.end(), condition.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    const bool on_backend =
        std::any_of(std::begin(kBackendWords), std::end(kBackendWords),
                    [&](const char* word) { return condition.find(word) != std::string::npos; });
    if (!on_backend) return;
    found.push_back({file.path, number, "a condition on a backend belongs in the registry"});
  });
  return found;
}

std::vector<SourceFile> read_tree(const std::filesystem::path& root) {
  namespace fs = std::filesystem;
  static const std::set<std::string> kOthers = {".c", ".cmake", ".in", ".py", ".sh"};
  std::vector<fs::path> paths = {root / "CMakeLists.txt"};
  for (const char* folder : kHouse) {
    if (!fs::is_directory(root / folder)) continue;
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(root / folder)) {
      const fs::path& path = entry.path();
      if (entry.is_regular_file() &&
          (is_code(path.string()) || kOthers.contains(path.extension().string()) ||
           path.filename() == "CMakeLists.txt")) {
        paths.push_back(path);
      }
    }
  }
  std::sort(paths.begin(), paths.end());
  std::vector<SourceFile> files;
  for (const fs::path& path : paths) files.push_back(read_file(root, path));
  return files;
}

SourceFile read_file(const std::filesystem::path& root, const std::filesystem::path& path) {
  std::ostringstream text;
  text << std::ifstream(path, std::ios::binary).rdbuf();
  return {std::filesystem::relative(path, root).generic_string(), text.str()};
}

}  // namespace geotherm::rules
