// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "app/picture/picture_data.h"
#include "app/picture/picture_settings.h"
#include "geotherm/quality_fields.h"

// Views that paint every face in a colour of its own.
namespace geotherm::app {

/// What such a view shows; nothing for the others.
std::optional<QualityField> face_field(View view);

/// Whether what a view shows depends on distances; the mesh alone has the rest.
bool needs_distances(View view);

/// Sets the values of a view on the faces, the end of their scale and its title, or takes away what
/// was there. `answer`: null without a solve; then, and where it lacks u although the view is about
/// that, a view that needs it has no values. Cost: O(F), nothing where what only the mesh decides
/// is there. Precondition: values that are there belong to this mesh.
void set_face_values(PictureData& data, const TriangleMesh& mesh, View view,
                     const DistanceResult* answer);

/// Between the marks of a scale of whole numbers; absent: any will do.
std::optional<double> face_tick_step(View view);

}  // namespace geotherm::app
