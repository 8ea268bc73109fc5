// SPDX-License-Identifier: MIT
#include "app/explore/saved_file.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <system_error>

#include "app/text.h"
#include "solver/mesh/io/file_extension.h"
#include "solver/mesh/write_distances.h"

namespace geotherm::app {
namespace {

namespace fs = std::filesystem;

Error bad(const std::string& path, const std::string& cause) {
  return {ErrorCode::kBadInput, one_line(path) + ": " + cause};
}

/// Extension and hidden name; `path` has no links in it, or they have been followed.
Result<void> check_name(const std::string& path, const Command& command) {
  if (fs::path(path).filename().string().starts_with('.')) {
    return bad(path, "commands write no hidden files; choose a name without a dot in front");
  }
  if (std::holds_alternative<command::SaveDistances>(command)) return check_distance_path(path);
  std::string what = "sessions and logs are", extension = ".geotherm";
  if (std::holds_alternative<command::SavePicture>(command)) {
    what = "pictures are";
    extension = ".png";
  } else if (std::holds_alternative<command::SaveFigures>(command)) {
    what = "figures are";
    extension = ".json";
  }
  if (io::file_extension(path) == extension) return {};
  return bad(path, what + " written as " + extension + "; name a FILE" + extension);
}

/// Whether a file that begins like this was written by the program.
bool is_ours(const std::string& extension, std::string_view head) {
  const auto holds = [head](std::string_view text) { return head.find(text) != head.npos; };
  if (extension == ".geotherm") return head.starts_with(kScriptMark);
  if (extension == ".png") {
    constexpr std::string_view kSoftware("Software\0geotherm ", 18);
    return head.starts_with("\x89PNG") && holds(kSoftware);
  }
  if (extension == ".json") {
    return head.starts_with("{\n  \"model\": {\n") && holds("\"mean_edge_length\": ");
  }
  if (extension == ".csv") return head.starts_with("vertex,distance");
  if (extension == ".ply")
    return head.starts_with("ply\n") && holds("\nproperty double distance\n");
  if (extension == ".vtp") return holds("<PointData Scalars=\"distance\">");
  return false;
}

}  // namespace

const std::string* saved_path(const Command& command) {
  return std::visit(
      []<class Kind>(const Kind& c) -> const std::string* {
        constexpr bool kSaves = std::is_same_v<Kind, command::SavePicture> ||
                                std::is_same_v<Kind, command::SaveDistances> ||
                                std::is_same_v<Kind, command::SaveFigures> ||
                                std::is_same_v<Kind, command::SaveSession> ||
                                std::is_same_v<Kind, command::SaveLog>;
        if constexpr (kSaves) return &c.path;
        return nullptr;
      },
      command);
}

Result<void> check_saved_name(const Command& command) {
  const std::string& path = *saved_path(command);
  if (path == "-") {
    return Error{ErrorCode::kBadInput, "a command writes files alone; give the name of one, not -"};
  }
  if (auto checked = check_name(path, command); !checked) return checked;
  std::error_code unknown;
  if (!fs::is_symlink(path, unknown)) return {};
  const std::string target = fs::weakly_canonical(path, unknown).string();
  if (const auto checked = check_name(target, command); !checked) {
    return bad(path, "is a link to " + checked.error().message);
  }
  return {};
}

Result<void> check_replaced_by_script(const Command& command) {
  const std::string& path = *saved_path(command);
  std::error_code unknown;
  const fs::file_status status = fs::symlink_status(path, unknown);
  if (!fs::exists(status)) return {};
  const auto refuse = [&path](const std::string& why) {
    return bad(path, why +
                         "; a script replaces only files of its own kind that geotherm wrote: "
                         "remove it, or choose another name");
  };
  if (!fs::is_regular_file(path, unknown)) return refuse("is there already and is no plain file");
  constexpr std::size_t kHead = 4096;
  std::array<char, kHead> head{};
  std::ifstream file(path, std::ios::binary);
  file.read(head.data(), kHead);
  const std::string_view read(head.data(), static_cast<std::size_t>(file.gcount()));
  if (is_ours(io::file_extension(path), read)) return {};
  return refuse("is there already");
}

}  // namespace geotherm::app
