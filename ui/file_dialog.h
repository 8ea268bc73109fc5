// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "app/session/command.h"
#include "app/session/state.h"
#include "ui/action.h"

namespace geotherm::ui {

/// A folder or a file as a dialog lists it.
struct FolderEntry {
  std::string name;
  bool is_folder = false;
  std::uintmax_t bytes = 0;
};

/// What a folder holds: folders first, both in alphabetical order whatever the case. Files: those
/// with one of the extensions (".obj"; whatever the case), or all of them without extensions.
/// Names that begin with a dot are left out. `error`: why there is nothing, one sentence.
struct FolderListing {
  std::vector<FolderEntry> entries;
  std::string error;
};
FolderListing list_folder(const std::filesystem::path& folder,
                          std::span<const std::string_view> extensions);

/// Whether a file name ends in one of the extensions; with .gz among them, in another and .gz.
bool has_extension(const std::filesystem::path& file, std::span<const std::string_view> extensions);

/// What was typed as a path: `~` is the user's folder, what is relative starts at `folder`.
std::filesystem::path typed_path(const std::string& text, const std::filesystem::path& folder);

struct Frame;

/// What a file dialog is opened for.
struct FileTask {
  Action action;
  const char* title;
  const char* verb;  ///< on the button
  bool saves;
  std::span<const std::string_view> extensions;  ///< the default first
  app::Command (*make)(std::string path);
};
/// Null where the action asks for no file.
const FileTask* file_task(Action action);

/// Asks for a file and sends the command that reads or writes it. One at a time, over all else.
class FileDialog {
 public:
  /// Opens with the next draw(), in the folder of the last time.
  void ask(const FileTask& task, const app::ViewerState& state);
  void draw(Frame& frame);

 private:
  void enter(const std::filesystem::path& folder);
  void list();
  void draw_folder(Frame& frame);
  void draw_entries(Frame& frame, float height);
  void draw_name(Frame& frame);
  void draw_picture_options(Frame& frame);
  void draw_formats(Frame& frame);
  void draw_buttons(Frame& frame);
  void draw_question(Frame& frame);
  float height_below(const Frame& frame) const;
  /// Whether a size is asked for.
  bool is_sized() const;
  /// Whether the file that is named will be a picture of pixels, on which there can be panels.
  bool is_of_pixels() const;
  void accept(Frame& frame);
  void finish(Frame& frame, const std::filesystem::path& file);

  const FileTask* task_ = file_task(Action::kOpenModel);
  bool asked_ = false;
  bool done_ = false;  ///< closes at the end of this frame
  std::filesystem::path folder_;
  FolderListing listing_;
  std::string name_, error_;
  bool all_files_ = false;
  std::filesystem::path replaced_;  ///< the file that a question is about; empty: none
  bool take_focus_ = false;         ///< of the field for the name
  std::string size_;                ///< of a picture
  bool as_shown_ = true, panels_ = false;
};

/// A name for a new file, after the model's.
std::string suggested_name(const std::string& model, const FileTask& task);

}  // namespace geotherm::ui
