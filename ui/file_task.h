// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "ui/file_dialog.h"

namespace geotherm::ui {

/// What a file dialog is opened for.
struct FileTask {
  FilePurpose purpose;
  const char* title;
  const char* verb;  ///< on the button
  bool saves;
  std::span<const std::string_view> extensions;  ///< the default first
};
const FileTask& file_task(FilePurpose purpose);

/// A name for a new file, after the model's.
std::string suggested_name(const std::string& model, const FileTask& task);

}  // namespace geotherm::ui
