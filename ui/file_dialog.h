// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "app/explore/viewer_state.h"
#include "ui/folder_listing.h"

namespace geotherm::ui {

struct Frame;

enum class FilePurpose {
  kOpenModel,
  kOpenSession,
  kSavePicture,
  kSaveDistances,
  kSaveSession,
  kSaveLog,
  kSaveFigures,
};

/// The extension of session files, which are scripts of commands.
inline constexpr std::string_view kSessionExtension = ".geotherm";

/// Asks for a file and sends the command that reads or writes it. One at a time, over all else.
class FileDialog {
 public:
  /// Opens with the next draw(), in the folder of the last time.
  void ask(FilePurpose purpose, const app::ViewerState& state);
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
  void accept(Frame& frame);
  void finish(Frame& frame, const std::filesystem::path& file);

  FilePurpose purpose_ = FilePurpose::kOpenModel;
  bool asked_ = false;
  bool done_ = false;  ///< closes at the end of this frame
  std::filesystem::path folder_;
  FolderListing listing_;
  std::string name_, error_;
  bool all_files_ = false;
  bool question_ = false;    ///< whether to replace a file
  bool take_focus_ = false;  ///< of the field for the name
  int width_ = 0, height_ = 0;
  bool as_shown_ = true, panels_ = false;
};

}  // namespace geotherm::ui
