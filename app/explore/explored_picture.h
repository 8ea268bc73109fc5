// SPDX-License-Identifier: MIT
#pragma once

#include "app/explore/explored.h"
#include "app/picture/picture_settings.h"

namespace geotherm::app {

/// Whether a view shows the vector fields of an answer.
bool shows_arrows(View view);

/// Whether a view needs u (QueryOptions::fields).
bool needs_fields(View view);

/// Sets everything of a picture but the mesh: values, sources, fields, caption. `data` holds the
/// model's base or has been set before.
void set_explored(PictureData& data, const Explored& explored, Shown shown, View view);

/// The whole picture. Precondition: a model is open.
PictureData picture_of(const Explored& explored, Shown shown, View view);

}  // namespace geotherm::app
