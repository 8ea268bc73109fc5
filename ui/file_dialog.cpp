// SPDX-License-Identifier: MIT
#include "ui/file_dialog.h"

#include <algorithm>
#include <cstdlib>
#include <system_error>
#include <utility>

#include "app/picture/picture_text.h"
#include "app/session/model.h"
#include "app/session/script.h"
#include "ui/frame.h"

namespace geotherm::ui {
namespace {

namespace fs = std::filesystem;

std::string in_small_letters(std::string text) {
  for (char& c : text) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c + 32);
  }
  return text;
}

bool comes_first(const FolderEntry& a, const FolderEntry& b) {
  if (a.is_folder != b.is_folder) return a.is_folder;
  const std::string x = in_small_letters(a.name), y = in_small_letters(b.name);
  return x != y ? x < y : a.name < b.name;
}

}  // namespace

bool has_extension(const fs::path& file, std::span<const std::string_view> extensions) {
  constexpr std::string_view kPacked = ".gz";
  const std::string extension = in_small_letters(file.extension().string());
  const auto is_known = [&](std::string_view text) {
    return std::find(extensions.begin(), extensions.end(), text) != extensions.end();
  };
  if (extension == kPacked && is_known(kPacked)) {
    return is_known(in_small_letters(file.stem().extension().string()));
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

}  // namespace

const FileTask& file_task(FilePurpose purpose) {
  static const FileTask kTasks[] = {
      {FilePurpose::kOpenModel, "Open a model", "Open", false, app::model_extensions()},
      {FilePurpose::kOpenSession, "Open a session", "Open", false, kScripts},
      {FilePurpose::kSavePicture, "Save the picture", "Save", true, kPictures},
      {FilePurpose::kSaveDistances, "Save the distances", "Save", true, kDistances},
      {FilePurpose::kSaveSession, "Save the session", "Save", true, kSessions},
      {FilePurpose::kSaveLog, "Save the log of commands", "Save", true, kSessions},
      {FilePurpose::kSaveFigures, "Save the report", "Save", true, kFigures},
      {FilePurpose::kSaveMesh, "Save the mesh", "Save", true, kMeshes},
      {FilePurpose::kOpenSequence, "Open a sequence", "Open", false, kSequences},
  };
  return kTasks[static_cast<std::size_t>(purpose)];  // in the order of the enumeration
}

std::string suggested_name(const std::string& model, const FileTask& task) {
  std::string name = std::filesystem::path(model).stem().string();
  if (name.empty()) name = "geotherm";
  if (task.purpose == FilePurpose::kSaveLog) name += "-log";
  if (task.purpose == FilePurpose::kSaveMesh) name += "-sculpted";
  return name + std::string(task.extensions.front());
}

namespace fs = std::filesystem;

void FileDialog::ask(FilePurpose purpose, const app::ViewerState& state) {
  purpose_ = purpose;
  asked_ = true;
  question_ = all_files_ = false;
  take_focus_ = true;
  error_.clear();
  const FileTask& task = file_task(purpose);
  name_ = task.saves ? suggested_name(state.model, task) : "";
  if (as_shown_ || !app::parse_size(size_)) size_ = app::size_text(state.picture);
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

bool FileDialog::is_sized() const { return purpose_ == FilePurpose::kSavePicture && !as_shown_; }

bool FileDialog::is_of_pixels() const {
  return !has_extension(name_, std::span(file_task(purpose_).extensions).subspan(1));
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
  if (is_sized()) {
    app::PictureSettings picture = frame.state().picture;
    const auto size = app::parse_size(size_);
    const auto fits = size ? app::set_size(picture, *size) : size.error();
    if (!fits) {
      error_ = sentence(fits.error());
      return;
    }
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
    case FilePurpose::kSavePicture: {
      command::SavePicture save{path, {}, panels_ && is_of_pixels()};
      if (is_sized()) save.size = *parse_size(size_);
      frame.send(std::move(save));
      break;
    }
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
    case FilePurpose::kSaveMesh:
      frame.send(command::SaveMesh{path});
      break;
    case FilePurpose::kOpenSequence:
      frame.send(command::ShowSequence{path});
      break;
  }
  folder_ = file.parent_path();
  done_ = true;
}

}  // namespace geotherm::ui
