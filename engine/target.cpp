// SPDX-License-Identifier: MIT
#include "engine/target.h"

#include <cassert>
#include <cstring>

#include "engine/vulkan/device_state.h"
#include "engine/vulkan/vulkan.h"

namespace geotherm::engine {
namespace {

constexpr vk::Format kFormat = vk::Format::eR8G8B8A8Unorm;
using Stage = vk::PipelineStageFlagBits2;
using Access = vk::AccessFlagBits2;

/// Colours come premultiplied by their coverage; pictures hold them as they are.
void divide_by_alpha(std::uint8_t* pixel) {
  const unsigned alpha = pixel[3];
  if (alpha == 255 || alpha == 0) return;
  for (int k = 0; k < 3; ++k) {
    const unsigned value = (pixel[k] * 255U + alpha / 2) / alpha;
    pixel[k] = static_cast<std::uint8_t>(value < 255 ? value : 255);
  }
}

}  // namespace

/// Members are destroyed from the last to the first.
struct OffscreenTarget::State {
  State(std::shared_ptr<Device::State> on, glm::ivec2 size)
      : device(std::move(on)),
        extent(size),
        texture(device->memory,
                {static_cast<std::uint32_t>(size.x), static_cast<std::uint32_t>(size.y)}, kFormat,
                vk::ImageUsageFlagBits::eColorAttachment | vk::ImageUsageFlagBits::eTransferSrc |
                    vk::ImageUsageFlagBits::eTransferDst),
        pixels(device->memory, vk::DeviceSize{4} * size.x * size.y,
               vk::BufferUsageFlagBits::eTransferDst, Home::kReadBack),
        commands(device->make_commands()) {}

  std::shared_ptr<Device::State> device;
  glm::ivec2 extent;
  glm::ivec2 origin{0, 0};
  Texture texture;
  Buffer pixels;
  vk::raii::CommandBuffer commands;
};

OffscreenTarget::OffscreenTarget(std::unique_ptr<State> state) : state_(std::move(state)) {}
OffscreenTarget::~OffscreenTarget() = default;

Result<std::unique_ptr<OffscreenTarget>> OffscreenTarget::build(const Device& device,
                                                                glm::ivec2 extent) {
  assert(extent.x > 0 && extent.y > 0);
  return guarded("making a picture", [&]() -> Result<std::unique_ptr<OffscreenTarget>> {
    return std::unique_ptr<OffscreenTarget>(
        new OffscreenTarget(std::make_unique<State>(device.state(), extent)));
  });
}

void OffscreenTarget::set_origin(glm::ivec2 origin) { state_->origin = origin; }

glm::ivec2 OffscreenTarget::extent() const { return state_->extent; }

Result<void> OffscreenTarget::begin(TargetFrame& frame) {
  return guarded("drawing", [&] {
    State& s = *state_;
    s.commands.reset();
    s.commands.begin({vk::CommandBufferUsageFlagBits::eOneTimeSubmit});
    record_transition(s.commands, {*s.texture.image, vk::ImageLayout::eUndefined,
                                   vk::ImageLayout::eColorAttachmentOptimal, Stage::eCopy,
                                   Access::eNone, Stage::eColorAttachmentOutput,
                                   Access::eColorAttachmentWrite | Access::eColorAttachmentRead});
    frame = {&s.commands, *s.texture.image, *s.texture.view, kFormat, s.origin, true};
  });
}

Result<void> OffscreenTarget::end(TargetFrame& /*frame*/) {
  return guarded("drawing", [&] {
    const State& s = *state_;
    record_transition(s.commands,
                      {*s.texture.image, vk::ImageLayout::eColorAttachmentOptimal,
                       vk::ImageLayout::eTransferSrcOptimal, Stage::eColorAttachmentOutput,
                       Access::eColorAttachmentWrite, Stage::eCopy, Access::eTransferRead});
    const vk::Extent2D size = s.texture.extent;
    const vk::BufferImageCopy region(0, 0, 0, {vk::ImageAspectFlagBits::eColor, 0, 0, 1}, {},
                                     {size.width, size.height, 1});
    s.commands.copyImageToBuffer(*s.texture.image, vk::ImageLayout::eTransferSrcOptimal,
                                 *s.pixels.buffer, region);
    const vk::MemoryBarrier2 to_host(Stage::eCopy, Access::eTransferWrite, Stage::eHost,
                                     Access::eHostRead);
    s.commands.pipelineBarrier2(vk::DependencyInfo({}, to_host));
    s.commands.end();
    submit_and_wait(*s.device, s.commands);
  });
}

void OffscreenTarget::read(Image& image, glm::ivec2 at, glm::ivec2 size) const {
  const auto* const pixels = reinterpret_cast<const std::uint8_t*>(state_->pixels.memory.mapped());
  const std::size_t row = 4 * static_cast<std::size_t>(state_->extent.x);
  for (int y = 0; y < size.y; ++y) {
    const std::size_t to = 4 * ((static_cast<std::size_t>(at.y) + y) * image.width + at.x);
    std::memcpy(image.pixels.data() + to, pixels + y * row, 4 * static_cast<std::size_t>(size.x));
    for (int x = 0; x < size.x; ++x) divide_by_alpha(image.pixels.data() + to + 4 * x);
  }
}

}  // namespace geotherm::engine
