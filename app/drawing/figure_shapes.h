// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <optional>

#include "app/picture/figure.h"
#include "app/picture/picture_data.h"
#include "engine/overlay/overlay.h"
#include "engine/scene/scene.h"
#include "solver/mesh/ray_tree.h"

namespace geotherm::app {

/// The lines and markers of a picture as shapes, whatever the camera.
class FigureShapes {
 public:
  /// Traces the isolines that `style` asks for on the surface of `data`. Cost: that of
  /// RayTree::build() and of the lines. Errors: those of RayTree::build().
  static Result<FigureShapes> build(const PictureData& data, const engine::SurfaceStyle& style);

  /// All that lies over the surface as the scene's camera sees it: isolines, the paths of the kind
  /// that `settings` ask for and markers, without what the surface hides, or as the renderer draws
  /// that, and the legend. Cost: a ray for each point of the lines.
  Figure of(const PictureData& data, const PictureDataSettings& settings,
            const engine::Scene& scene, const engine::Overlay& overlay) const;

  /// The scene without what the shapes show.
  static engine::Scene rest_of(engine::Scene scene);

 private:
  std::optional<RayTree> tree_;  ///< of the surface, scene space; absent: there is none
  std::vector<std::vector<Vec3>> isolines_;
};

}  // namespace geotherm::app
