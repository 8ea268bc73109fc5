// SPDX-License-Identifier: MIT
#include "ui/file_dialog.h"

#include <system_error>
#include <utility>

#include "ui/file_task.h"
#include "ui/frame.h"

namespace geotherm::ui {

namespace fs = std::filesystem;

void FileDialog::ask(FilePurpose purpose, const app::ViewerState& state) {
  purpose_ = purpose;
  asked_ = true;
  question_ = all_files_ = false;
  take_focus_ = true;
  error_.clear();
  const FileTask& task = file_task(purpose);
  name_ = task.saves ? suggested_name(state.model, task) : "";
  if (width_ == 0) width_ = state.picture.width;
  if (height_ == 0) height_ = state.picture.height;
  std::error_code error;
  if (folder_.empty()) folder_ = fs::current_path(error);
  if (folder_.empty()) folder_ = "/";
  list();
}

void FileDialog::list() {
  listing_ = list_folder(
      folder_, all_files_ ? std::span<const std::string_view>() : file_task(purpose_).extensions);
  error_ = listing_.error;
}

void FileDialog::enter(const fs::path& folder) {
  const fs::path before = std::exchange(folder_, folder);
  list();
  if (listing_.error.empty()) return;
  // Stays where it was, and says why.
  const std::string why = listing_.error;
  folder_ = before;
  list();
  error_ = why;
}

void FileDialog::accept(Frame& frame) {
  if (name_.empty()) return;
  const FileTask& task = file_task(purpose_);
  fs::path file = typed_path(name_, folder_);
  std::error_code ignored;
  if (fs::is_directory(file, ignored)) {
    name_.clear();
    return enter(file);
  }
  if (!task.saves) {
    if (fs::exists(file, ignored)) return finish(frame, file);
    error_ = "there is no file " + file.string();
    return;
  }
  if (!has_extension(file, task.extensions)) file += std::string(task.extensions.front());
  if (!fs::is_directory(file.parent_path(), ignored)) {
    error_ = "there is no folder " + file.parent_path().string();
    return;
  }
  if (fs::exists(file, ignored) && !question_) {
    question_ = true;
    return;
  }
  finish(frame, file);
}

void FileDialog::finish(Frame& frame, const fs::path& file) {
  using namespace app;
  const std::string path = file.string();
  switch (purpose_) {
    case FilePurpose::kOpenModel:
      frame.send(command::Open{path});
      break;
    case FilePurpose::kOpenSession:
      frame.ui.write_question.send(frame, command::Run{path});
      break;
    case FilePurpose::kSavePicture:
      frame.send(as_shown_ ? command::SavePicture{path, 0, 0, panels_}
                           : command::SavePicture{path, width_, height_, panels_});
      break;
    case FilePurpose::kSaveDistances:
      frame.send(command::SaveDistances{path});
      break;
    case FilePurpose::kSaveSession:
      frame.send(command::SaveSession{path});
      break;
    case FilePurpose::kSaveLog:
      frame.send(command::SaveLog{path});
      break;
    case FilePurpose::kSaveFigures:
      frame.send(command::SaveFigures{path});
      break;
  }
  folder_ = file.parent_path();
  done_ = true;
}

}  // namespace geotherm::ui
