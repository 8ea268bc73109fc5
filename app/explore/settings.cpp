// SPDX-License-Identifier: MIT
#include "app/explore/settings.h"

#include <algorithm>

namespace geotherm::app {
namespace {

std::vector<Setting>& all() {
  static std::vector<Setting> every = [] {
    std::vector<Setting> joined = method_settings();
    const std::vector<Setting> of_pictures = picture_settings_table();
    joined.insert(joined.end(), of_pictures.begin(), of_pictures.end());
    return joined;
  }();
  return every;
}

}  // namespace

std::span<const Setting> settings() { return all(); }

const Setting* find_setting(std::string_view name) {
  const auto found = std::ranges::find(all(), name, &Setting::name);
  return found == all().end() ? nullptr : &*found;
}

ExtraSetting::ExtraSetting(const Setting& setting) { all().push_back(setting); }
ExtraSetting::~ExtraSetting() { all().pop_back(); }

}  // namespace geotherm::app
