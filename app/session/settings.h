// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "app/session/state.h"
#include "geotherm/error.h"
#include "geotherm/names.h"
#include "solver/core/text.h"

// The one table of settings. An entry makes the command-line option, its line of help, the command
// of scripts and its completion, the row of the panel, the JSON and the texts of pictures.
namespace geotherm::app {

/// What a setting is about; the heading of its options in the help.
enum class SettingGroup { kModel, kMethod, kCheck, kPicture, kFigure, kCamera };

/// How a setting is written in JSON and drawn in a panel.
enum class SettingKind {
  kWord,
  kNumber,
  kSwitch,  ///< "on" or "off"
};

struct Setting {
  std::string_view name;  ///< of the command and, behind two dashes, of the option
  SettingGroup group = SettingGroup::kMethod;
  SettingKind kind = SettingKind::kWord;
  bool of_heat = false;          ///< only the heat method uses it
  bool usual = false;            ///< many change it: panels show it at once, others on request
  std::string_view option = {};  ///< spellings of the option where they are others
  std::string_view bare = {};    ///< what the option stands for by itself; empty: it takes a value
  std::string_view value_name = {};  ///< of the option's value in the help, such as "M"
  std::string_view help = {};        ///< a phrase
  std::string_view forms = {};       ///< of the values, where `values` has examples of them
  std::string_view detail = {};      ///< what the values mean, in sentences; may be empty
  std::string (*get)(const ViewerState& state) = nullptr;
  /// Errors: kBadInput or kNotAvailable, with the text and what is expected.
  Result<void> (*set)(ViewerState& state, const std::string& text) = nullptr;
  /// The values there are, or examples; empty where there are too many to list.
  std::vector<std::string> (*values)() = nullptr;

  /// Whether it changes the answer, not only the picture.
  bool of_method() const { return group == SettingGroup::kMethod || group == SettingGroup::kModel; }
  bool of_picture() const {
    return group == SettingGroup::kPicture || group == SettingGroup::kFigure ||
           group == SettingGroup::kCamera;
  }
};

/// All of them, in the order of panels and help.
std::span<const Setting> settings();
/// Null when there is no such name.
const Setting* find_setting(std::string_view name);

/// One more setting for as long as this lives, for tests. Not to be made beside other threads.
class ExtraSetting {
 public:
  explicit ExtraSetting(const Setting& setting);
  ~ExtraSetting();
  ExtraSetting(const ExtraSetting&) = delete;
  ExtraSetting& operator=(const ExtraSetting&) = delete;
};

/// Stores a value, or hands on why there is none.
template <class Value, class Into>
Result<void> store(Result<Value> parsed, Into& into) {
  if (!parsed) return parsed.error();
  into = *std::move(parsed);
  return {};
}

/// A member of the state, of its options, its picture or its camera.
template <class Value, class Part>
auto& member_of(auto& state, Value Part::*member) {
  if constexpr (std::is_base_of_v<Part, MethodOptions>) {
    return state.options.*member;
  } else if constexpr (std::is_base_of_v<Part, PictureSettings>) {
    return state.picture.*member;
  } else if constexpr (std::is_same_v<Part, ModelReading>) {
    return state.reading.*member;
  } else if constexpr (std::is_same_v<Part, CameraSettings>) {
    return state.picture.camera.*member;
  } else {
    return state.*member;
  }
}

/// A setting that is one of the names of an enum (geotherm/names.h).
template <auto kMember>
Setting choice(Setting setting) {
  using Value = std::remove_cvref_t<decltype(member_of(std::declval<ViewerState&>(), kMember))>;
  setting.get = [](const ViewerState& s) { return geotherm::to_text(member_of(s, kMember)); };
  setting.set = [](ViewerState& s, const std::string& text) {
    return store(parse<Value>(text), member_of(s, kMember));
  };
  setting.values = all_names<Value>;
  return setting;
}

/// A setting that is a number, whole or not, as `kParse` reads it.
template <auto kMember, auto kParse>
Setting number(Setting setting) {
  setting.kind = SettingKind::kNumber;
  setting.get = [](const ViewerState& s) {
    if constexpr (std::is_integral_v<std::remove_cvref_t<decltype(member_of(s, kMember))>>) {
      return std::to_string(member_of(s, kMember));
    } else {
      return number_text(member_of(s, kMember));
    }
  };
  setting.set = [](ViewerState& s, const std::string& text) {
    return store(kParse(text), member_of(s, kMember));
  };
  return setting;
}

/// Groups of the table, which settings() joins with those of models and checks.
std::vector<Setting> method_settings();
std::vector<Setting> figure_settings_table();
std::vector<Setting> picture_settings_table();

}  // namespace geotherm::app
