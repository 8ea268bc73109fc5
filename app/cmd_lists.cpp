// SPDX-License-Identifier: MIT
#include "app/cmd_lists.h"

#include "app/text.h"
#include "app/text_table.h"
#include "solver/linear/backend.h"
#include "solver/mesh/generate.h"

namespace geotherm::app {

std::string list_backends() {
  TextTable table({{"", TextTable::Align::kLeft}, {"", TextTable::Align::kLeft}});
  for (const std::string& name : backend_names()) {
    const auto backend = find_backend(name);
    table.add_row({name, backend ? std::string((*backend)->description()) : ""});
  }
  return table.text();
}

std::string list_models() {
  TextTable table({{"", TextTable::Align::kLeft},
                   {"", TextTable::Align::kRight},
                   {"", TextTable::Align::kLeft}});
  for (const BundledModel& model : bundled_models()) {
    table.add_row(
        {std::string(model.name), grouped(model.faces) + " faces", std::string(model.description)});
  }
  return table.text();
}

}  // namespace geotherm::app
