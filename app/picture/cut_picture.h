// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "app/picture/picture_data.h"
#include "app/picture/picture_settings.h"

namespace geotherm::app {

/// A picture of a model that is cut open. Its first V vertices are the model's; points on the cut
/// follow, with values between those of the ends of their edges. Arrows, and
/// values of a view about tets, are those of the tets; values of faces are those of the faces that
/// are left, and the inside has none. Sources and paths beyond a slice are left
/// out.
struct CutPicture {
  PictureData data;
  std::vector<Index> origin;  ///< of each face: the model's face, kNoIndex inside
};

/// Whether the settings leave less than the whole model. Without values nothing is peeled off.
bool is_cut(const PictureData& data, const PictureDataSettings& settings);

/// What PictureDataSettings::slice and peel leave of a model: of a volume a body with its inside,
/// of a surface some of its faces. There may be nothing left. Cost: O(V + F + T); 2 ms for 100,000
/// tets, where some are peeled off 9 ms.
CutPicture cut_picture(const PictureData& whole, const PictureDataSettings& settings);

}  // namespace geotherm::app
