// SPDX-License-Identifier: MIT
#include "ui/file_task.h"

namespace geotherm::ui {
namespace {

constexpr std::string_view kModels[] = {".obj", ".ply", ".off", ".stl"};
constexpr std::string_view kPictures[] = {".png"};
constexpr std::string_view kDistances[] = {".csv", ".npy", ".ply", ".vtp"};
constexpr std::string_view kSessions[] = {kSessionExtension};
constexpr std::string_view kScripts[] = {kSessionExtension, ".txt"};
constexpr std::string_view kFigures[] = {".json"};

constexpr FileTask kTasks[] = {
    {FilePurpose::kOpenModel, "Open a model", "Open", false, kModels},
    {FilePurpose::kOpenSession, "Open a session", "Open", false, kScripts},
    {FilePurpose::kSavePicture, "Save the picture", "Save", true, kPictures},
    {FilePurpose::kSaveDistances, "Save the distances", "Save", true, kDistances},
    {FilePurpose::kSaveSession, "Save the session", "Save", true, kSessions},
    {FilePurpose::kSaveLog, "Save the log of commands", "Save", true, kSessions},
    {FilePurpose::kSaveFigures, "Save the figures", "Save", true, kFigures},
};

}  // namespace

const FileTask& file_task(FilePurpose purpose) {
  return kTasks[static_cast<std::size_t>(purpose)];  // in the order of the enumeration
}

std::string suggested_name(const std::string& model, const FileTask& task) {
  std::string name = std::filesystem::path(model).stem().string();
  if (name.empty()) name = "geotherm";
  if (task.purpose == FilePurpose::kSaveLog) name += "-log";
  return name + std::string(task.extensions.front());
}

}  // namespace geotherm::ui
