// SPDX-License-Identifier: MIT
#include "app/picture/picture_caption.h"

#include "app/method_words.h"
#include "app/text.h"

namespace geotherm::app {

std::string picture_caption(const std::string& model, Index faces, const DistanceMethod* method) {
  const std::string text = one_line(model) + ", " + counted(faces, "face", "faces");
  return method == nullptr ? text : text + ", " + method_caption(*method);
}

}  // namespace geotherm::app
