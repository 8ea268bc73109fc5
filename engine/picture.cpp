// SPDX-License-Identifier: MIT
#include "engine/picture.h"

#include <algorithm>

#include "engine/offscreen_target.h"

namespace geotherm::engine {
namespace {

constexpr int kLargestPicture = 16384;
/// With 4 samples a pixel of colour and depth this is 160 MiB at most.
constexpr int kUsualTile = 2048;

}  // namespace

Result<Image> draw_picture(const Device& device, Renderer& renderer, const Scene& scene,
                           const Overlay& overlay, int largest_tile) {
  const glm::ivec2 size(scene.camera.extent);
  if (size.x < 1 || size.y < 1 || size.x > kLargestPicture || size.y > kLargestPicture) {
    return Error{ErrorCode::kBadInput,
                 "a picture of " + std::to_string(size.x) + "x" + std::to_string(size.y) +
                     " pixels cannot be drawn; sides are 1 to " + std::to_string(kLargestPicture)};
  }
  const int at_once =
      std::min(device.largest_picture(), largest_tile > 0 ? largest_tile : kUsualTile);
  const glm::ivec2 tile = glm::min(size, glm::ivec2(at_once));
  auto target = OffscreenTarget::build(device, tile);
  if (!target) return target.error();
  Image image;
  image.width = size.x;
  image.height = size.y;
  image.pixels.resize(4 * static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y));
  for (int y = 0; y < size.y; y += tile.y) {
    for (int x = 0; x < size.x; x += tile.x) {
      (*target)->set_origin({x, y});
      if (auto drawn = renderer.render(**target, scene, overlay); !drawn) return drawn.error();
      (*target)->read(image, {x, y}, glm::min(tile, size - glm::ivec2(x, y)));
    }
  }
  return image;
}

}  // namespace geotherm::engine
