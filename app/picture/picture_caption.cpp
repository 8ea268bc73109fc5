// SPDX-License-Identifier: MIT
#include "app/picture/picture_caption.h"

#include <cmath>

#include "app/text.h"

namespace geotherm::app {

std::string method_caption(const HeatMethod& method) {
  const double t = method.t();
  const bool is_double = std::isnormal(t);  // a model of size 1e200 or 1e-200 has another t
  return (is_double ? "t = " + significant(t) + ", " : "") + method.options().backend;
}

std::string picture_caption(const std::string& model, Index faces, const HeatMethod* method) {
  const std::string text = one_line(model) + ", " + counted(faces, "face", "faces");
  return method == nullptr ? text : text + ", " + method_caption(*method);
}

}  // namespace geotherm::app
