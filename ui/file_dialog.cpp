// SPDX-License-Identifier: MIT
#include "ui/file_dialog.h"

#include <algorithm>
#include <cstdlib>
#include <iterator>
#include <system_error>
#include <utility>

#include "app/picture/picture_text.h"
#include "app/session/model.h"
#include "app/session/script.h"
#include "ui/frame.h"

namespace geotherm::ui {
namespace {

namespace fs = std::filesystem;

bool comes_first(const FolderEntry& a, const FolderEntry& b) {
  if (a.is_folder != b.is_folder) return a.is_folder;
  const std::string x = lower_case(a.name), y = lower_case(b.name);
  return x != y ? x < y : a.name < b.name;
}

}  // namespace

bool has_extension(const fs::path& file, std::span<const std::string_view> extensions) {
  constexpr std::string_view kPacked = ".gz";
  const std::string extension = lower_case(file.extension().string());
  const auto is_known = [&](std::string_view text) {
    return std::find(extensions.begin(), extensions.end(), text) != extensions.end();
  };
  if (extension == kPacked && is_known(kPacked)) {
    return is_known(lower_case(file.stem().extension().string()));
  }
  return is_known(extension);
}

FolderListing list_folder(const fs::path& folder, std::span<const std::string_view> extensions) {
  FolderListing listing;
  std::error_code error;
  fs::directory_iterator at(folder, error);
  for (; !error && at != fs::directory_iterator(); at.increment(error)) {
    FolderEntry entry;
    entry.name = at->path().filename().string();
    if (entry.name.starts_with('.')) continue;
    std::error_code unknown;  // a link to nowhere is no reason to list nothing
    entry.is_folder = at->is_directory(unknown);
    if (!entry.is_folder) {
      if (!extensions.empty() && !has_extension(at->path(), extensions)) continue;
      entry.bytes = at->file_size(unknown);
      if (unknown) entry.bytes = 0;
    }
    listing.entries.push_back(std::move(entry));
  }
  if (error) listing.error = folder.string() + " cannot be listed: " + error.message();
  std::sort(listing.entries.begin(), listing.entries.end(), comes_first);
  return listing;
}

fs::path typed_path(const std::string& text, const fs::path& folder) {
  fs::path path = text;
  if (text == "~" || text.starts_with("~/")) {
    const char* home = std::getenv("HOME");
    if (home) path = fs::path(home) / text.substr(std::min<std::size_t>(2, text.size()));
  }
  return (path.is_absolute() ? path : folder / path).lexically_normal();
}

namespace {

constexpr std::string_view kPictures[] = {".png", ".pdf", ".svg"};
constexpr std::string_view kDistances[] = {".csv", ".npy", ".ply", ".vtp", ".vtu", ".vti"};
constexpr std::string_view kSessions[] = {app::kSessionExtension};
constexpr std::string_view kScripts[] = {app::kSessionExtension, ".txt"};
constexpr std::string_view kMeshes[] = {".obj", ".ply", ".off", ".stl"};
constexpr std::string_view kSequences[] = {".npy", ".pc2", ".mdd", ".glb", ".gltf"};
constexpr std::string_view kFigures[] = {".json"};

template <class Kind>
app::Command made(std::string path) {
  return Kind{std::move(path)};
}

}  // namespace

const FileTask* file_task(Action action) {
  using namespace app;
  static const FileTask kTasks[] = {
      {Action::kOpenModel, "Open a model", "Open", false, model_extensions(), made<command::Open>},
      {Action::kOpenSession, "Open a session", "Open", false, kScripts, made<command::Run>},
      {Action::kOpenSequence, "Open a sequence", "Open", false, kSequences,
       made<command::ShowSequence>},
      {Action::kSavePicture, "Save the picture", "Save", true, kPictures,
       made<command::SavePicture>},
      {Action::kSaveDistances, "Save the distances", "Save", true, kDistances,
       made<command::SaveDistances>},
      {Action::kSaveSession, "Save the session", "Save", true, kSessions,
       made<command::SaveSession>},
      {Action::kSaveLog, "Save the log of commands", "Save", true, kSessions,
       made<command::SaveLog>},
      {Action::kSaveFigures, "Save the report", "Save", true, kFigures, made<command::SaveFigures>},
      {Action::kSaveMesh, "Save the mesh", "Save", true, kMeshes, made<command::SaveMesh>},
  };
  const auto* const found = std::ranges::find(kTasks, action, &FileTask::action);
  return found == std::end(kTasks) ? nullptr : found;
}

std::string suggested_name(const std::string& model, const FileTask& task) {
  std::string name = std::filesystem::path(model).stem().string();
  if (name.empty()) name = "geotherm";
  if (task.action == Action::kSaveLog) name += "-log";
  if (task.action == Action::kSaveMesh) name += "-sculpted";
  return name + std::string(task.extensions.front());
}

namespace fs = std::filesystem;

void FileDialog::ask(const FileTask& task, const app::ViewerState& state) {
  task_ = &task;
  asked_ = true;
  replaced_.clear();
  all_files_ = false;
  take_focus_ = true;
  error_.clear();
  name_ = task.saves ? suggested_name(state.model, task) : "";
  if (as_shown_ || !app::parse_size(size_)) size_ = app::size_text(state.picture);
  std::error_code error;
  if (folder_.empty()) folder_ = fs::current_path(error);
  if (folder_.empty()) folder_ = "/";
  list();
}

void FileDialog::list() {
  listing_ =
      list_folder(folder_, all_files_ ? std::span<const std::string_view>() : task_->extensions);
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

bool FileDialog::is_sized() const { return task_->action == Action::kSavePicture && !as_shown_; }

bool FileDialog::is_of_pixels() const {
  return !has_extension(name_, std::span(task_->extensions).subspan(1));
}

void FileDialog::accept(Frame& frame) {
  if (name_.empty()) return;
  const FileTask& task = *task_;
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
  if (is_sized()) {
    app::PictureSettings picture = frame.state().picture;
    const auto size = app::parse_size(size_);
    const auto fits = size ? app::set_size(picture, *size) : size.error();
    if (!fits) {
      error_ = sentence(fits.error());
      return;
    }
  }
  if (fs::exists(file, ignored) && file != replaced_) {
    replaced_ = file;
    return;
  }
  finish(frame, file);
}

void FileDialog::finish(Frame& frame, const fs::path& file) {
  app::Command command = task_->make(file.string());
  if (auto* const save = std::get_if<app::command::SavePicture>(&command)) {
    save->panels = panels_ && is_of_pixels();
    if (is_sized()) save->size = *app::parse_size(size_);
  }
  if (task_->saves) {  // what that replaces has been asked here
    frame.send(std::move(command));
  } else {
    frame.ui.write_question.send(frame, std::move(command));
  }
  folder_ = file.parent_path();
  done_ = true;
}

}  // namespace geotherm::ui
