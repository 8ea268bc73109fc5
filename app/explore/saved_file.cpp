// SPDX-License-Identifier: MIT
#include "app/explore/saved_file.h"

#include <algorithm>
#include <filesystem>
#include <system_error>

#include "app/text.h"
#include "app/told.h"
#include "geotherm/io.h"
#include "solver/core/text.h"

namespace geotherm::app {
namespace {

namespace fs = std::filesystem;

Error bad(const std::string& path, const std::string& cause) {
  return {ErrorCode::kBadInput, one_line(path) + ": " + cause};
}

/// Whether the file or one of the folders that the path names is hidden.
bool is_hidden(const fs::path& path) {
  return std::ranges::any_of(path, [](const fs::path& part) {
    return part.string().starts_with('.') && part != "." && part != "..";
  });
}

/// Extension and hidden names; `path` has no links in it, or they have been followed.
Result<void> check_name(const std::string& path, const Command& command) {
  if (is_hidden(path)) {
    return bad(path,
               "commands write no hidden files and nothing into hidden folders; choose a path "
               "without names that begin with a dot");
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
  // From the current folder, which may itself lie in a hidden one.
  std::error_code unknown;
  const std::string target = fs::proximate(path, unknown).string();
  if (unknown) return {};  // Opening the file says what is wrong with its path.
  if (const auto checked = check_name(target, command); !checked) {
    return bad(path, "leads by a link to " + told(checked.error()));
  }
  return {};
}

Result<void> check_replaced_by_script(const Command& command) {
  const std::string& path = *saved_path(command);
  std::error_code unknown;
  if (!fs::exists(fs::symlink_status(path, unknown))) return {};
  return bad(path,
             "is there already, and a script replaces only files that it wrote itself in this "
             "run; choose another name, or remove the file");
}

}  // namespace geotherm::app
