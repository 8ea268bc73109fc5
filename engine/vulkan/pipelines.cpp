// SPDX-License-Identifier: MIT
#include "engine/vulkan/pipelines.h"

#include <array>

#include "embedded/arrow_frag.h"
#include "embedded/arrow_vert.h"
#include "embedded/line_frag.h"
#include "embedded/line_vert.h"
#include "embedded/marker_frag.h"
#include "embedded/marker_vert.h"
#include "embedded/overlay_frag.h"
#include "embedded/overlay_vert.h"
#include "embedded/panel_vert.h"
#include "embedded/surface_frag.h"
#include "embedded/surface_vert.h"
#include "engine/overlay/overlay.h"
#include "engine/renderer.h"
#include "engine/scene/arrows.h"
#include "engine/scene/draw_mesh.h"
#include "engine/scene/line_set.h"
#include "shaders/shared.h"

namespace geotherm::engine {
namespace {

using Code = std::span<const unsigned char>;

vk::raii::DescriptorSetLayout make_set_layout(const vk::raii::Device& device) {
  using Shader = vk::ShaderStageFlagBits;
  const std::array bindings = {
      vk::DescriptorSetLayoutBinding(shared::kFrameBinding, vk::DescriptorType::eUniformBuffer, 1,
                                     Shader::eVertex | Shader::eFragment),
      vk::DescriptorSetLayoutBinding(shared::kColoursBinding,
                                     vk::DescriptorType::eUniformTexelBuffer, 1, Shader::eFragment),
      vk::DescriptorSetLayoutBinding(
          shared::kAtlasBinding, vk::DescriptorType::eCombinedImageSampler, 1, Shader::eFragment),
  };
  return {device, {{}, bindings}};
}

vk::raii::PipelineLayout make_layout(const vk::raii::Device& device,
                                     const vk::DescriptorSetLayout& set) {
  const vk::PushConstantRange push(Pipelines::kPushStages, 0, sizeof(shared::LinePush));
  return {device, {{}, set, push}};
}

vk::raii::ShaderModule make_module(const vk::raii::Device& device, Code code) {
  return {device, {{}, code.size(), reinterpret_cast<const std::uint32_t*>(code.data())}};
}

vk::PipelineColorBlendAttachmentState blending(bool on) {
  using Factor = vk::BlendFactor;
  using Channel = vk::ColorComponentFlagBits;
  return {on,
          Factor::eOne,
          Factor::eOneMinusSrcAlpha,
          vk::BlendOp::eAdd,
          Factor::eOne,
          Factor::eOneMinusSrcAlpha,
          vk::BlendOp::eAdd,
          Channel::eR | Channel::eG | Channel::eB | Channel::eA};
}

constexpr auto kPerVertex = vk::VertexInputRate::eVertex;
constexpr auto kPerInstance = vk::VertexInputRate::eInstance;
constexpr auto kFloat3 = vk::Format::eR32G32B32Sfloat;

}  // namespace

/// The properties in which the pipelines differ.
struct Pipelines::Plan {
  Code vertex, fragment;
  std::vector<vk::VertexInputBindingDescription> bindings;
  std::vector<vk::VertexInputAttributeDescription> attributes;
  vk::PrimitiveTopology topology = vk::PrimitiveTopology::eTriangleList;
  std::uint32_t features = 0;
  bool blend = false;
  bool scene = true;  ///< within the scene: its samples and its depth
  bool write_depth = false;
  vk::CompareOp depth_test = vk::CompareOp::eGreaterOrEqual;  // depth is reversed
};

Pipelines::Pipelines(std::shared_ptr<Device::State> device)
    : device_(std::move(device)),
      set_layout_(make_set_layout(device_->device)),
      layout_(make_layout(device_->device, *set_layout_)) {}

void Pipelines::use(vk::Format format, vk::SampleCountFlagBits samples) {
  format_ = format;
  samples_ = samples;
}

vk::Pipeline Pipelines::made(std::uint32_t kind, const Plan& plan) {
  const auto samples = plan.scene ? samples_ : vk::SampleCountFlagBits::e1;
  const Key key(format_, samples, kind);
  const auto known = pipelines_.find(key);
  if (known != pipelines_.end()) return *known->second;

  const auto vertex = make_module(device_->device, plan.vertex);
  const auto fragment = make_module(device_->device, plan.fragment);
  const vk::SpecializationMapEntry entry(0, 0, sizeof(plan.features));
  const vk::SpecializationInfo constants(1, &entry, sizeof(plan.features), &plan.features);
  using Shader = vk::ShaderStageFlagBits;
  const std::array stages = {
      vk::PipelineShaderStageCreateInfo({}, Shader::eVertex, *vertex, "main", &constants),
      vk::PipelineShaderStageCreateInfo({}, Shader::eFragment, *fragment, "main", &constants)};
  const vk::PipelineVertexInputStateCreateInfo input({}, plan.bindings, plan.attributes);
  const vk::PipelineInputAssemblyStateCreateInfo assembly({}, plan.topology);
  const vk::PipelineViewportStateCreateInfo viewport({}, 1, nullptr, 1, nullptr);
  vk::PipelineRasterizationStateCreateInfo raster;
  // Seen from outside, what runs counter-clockwise is in front; y points down on screen.
  raster.setFrontFace(vk::FrontFace::eCounterClockwise).setLineWidth(1);
  const vk::PipelineMultisampleStateCreateInfo multisample({}, samples);
  const vk::PipelineDepthStencilStateCreateInfo depth({}, plan.scene, plan.write_depth,
                                                      plan.depth_test);
  const auto attachment = blending(plan.blend);
  const vk::PipelineColorBlendStateCreateInfo blend({}, false, {}, attachment);
  constexpr std::array kDynamic = {vk::DynamicState::eViewport, vk::DynamicState::eScissor};
  const vk::PipelineDynamicStateCreateInfo dynamic({}, kDynamic);
  vk::PipelineRenderingCreateInfo rendering({}, format_);
  if (plan.scene) rendering.setDepthAttachmentFormat(kDepthFormat);

  vk::GraphicsPipelineCreateInfo info({}, stages, &input, &assembly, nullptr, &viewport, &raster,
                                      &multisample, &depth, &blend, &dynamic, *layout_);
  info.setPNext(&rendering);
  vk::raii::Pipeline pipeline(device_->device, device_->pipelines, info);
  return *pipelines_.emplace(key, std::move(pipeline)).first->second;
}

vk::Pipeline Pipelines::surface(std::uint32_t features) {
  using Vertex = DrawMesh::Vertex;
  // Without regions there are values alone; the shader reads 0 for the rest.
  const bool regions = (features & shared::kRegions) != 0;
  const auto values = regions ? kFloat3 : vk::Format::eR32Sfloat;
  const std::uint32_t values_size = regions ? sizeof(glm::vec3) : sizeof(float);
  Plan plan{
      .vertex = embedded::surface_vert(),
      .fragment = embedded::surface_frag(),
      .bindings = {{0, sizeof(Vertex), kPerVertex}, {1, values_size, kPerVertex}},
      .attributes = {{0, 0, kFloat3, offsetof(Vertex, position)},
                     {1, 0, vk::Format::eR16G16B16A16Snorm, offsetof(Vertex, normal_and_label)},
                     {2, 1, values, 0},
                     {3, 0, vk::Format::eR8G8Unorm, offsetof(Vertex, openness)}}};
  plan.features = features;
  plan.write_depth = true;
  return made(features, plan);
}

vk::Pipeline Pipelines::arrows() {
  return made(1U << 16,
              {.vertex = embedded::arrow_vert(),
               .fragment = embedded::arrow_frag(),
               .bindings = {{0, sizeof(ArrowInstance), kPerInstance}},
               .attributes = {{0, 0, kFloat3, offsetof(ArrowInstance, tail)},
                              {1, 0, kFloat3, offsetof(ArrowInstance, along)},
                              {2, 0, kFloat3, offsetof(ArrowInstance, normal)},
                              {3, 0, vk::Format::eR32Sfloat, offsetof(ArrowInstance, full)}},
               .write_depth = true});
}

vk::Pipeline Pipelines::lines(bool hidden) {
  return made((hidden ? 7U : 6U) << 16,
              {.vertex = embedded::line_vert(),
               .fragment = embedded::line_frag(),
               .bindings = {{0, sizeof(LinePiece), kPerInstance}},
               .attributes = {{0, 0, kFloat3, offsetof(LinePiece, before)},
                              {1, 0, kFloat3, offsetof(LinePiece, from)},
                              {2, 0, kFloat3, offsetof(LinePiece, to)},
                              {3, 0, kFloat3, offsetof(LinePiece, after)},
                              {4, 0, vk::Format::eR32Sfloat, offsetof(LinePiece, at_from)}},
               .topology = vk::PrimitiveTopology::eTriangleStrip,
               .blend = true,
               .depth_test = hidden ? vk::CompareOp::eLess : vk::CompareOp::eGreaterOrEqual});
}

vk::Pipeline Pipelines::markers(bool hidden) {
  return made((hidden ? 3U : 2U) << 16,
              {.vertex = embedded::marker_vert(),
               .fragment = embedded::marker_frag(),
               .bindings = {{0, sizeof(Marker), kPerInstance}},
               .attributes = {{0, 0, kFloat3, offsetof(Marker, from)},
                              {1, 0, kFloat3, offsetof(Marker, to)},
                              {2, 0, vk::Format::eR32G32B32A32Sfloat, offsetof(Marker, outward)}},
               .topology = vk::PrimitiveTopology::eTriangleStrip,
               .blend = true,
               .depth_test = hidden ? vk::CompareOp::eLess : vk::CompareOp::eGreaterOrEqual});
}

vk::Pipeline Pipelines::overlay() {
  using Vertex = Overlay::Vertex;
  return made(4U << 16,
              {.vertex = embedded::overlay_vert(),
               .fragment = embedded::overlay_frag(),
               .bindings = {{0, sizeof(Vertex), kPerVertex}},
               .attributes = {{0, 0, vk::Format::eR32G32Sfloat, offsetof(Vertex, position)},
                              {1, 0, vk::Format::eR32G32Sfloat, offsetof(Vertex, uv)},
                              {2, 0, vk::Format::eR32G32B32A32Sfloat, offsetof(Vertex, colour)}},
               .blend = true,
               .scene = false});
}

vk::Pipeline Pipelines::panels() {
  using Vertex = PanelDraw::Vertex;
  return made(5U << 16,
              {.vertex = embedded::panel_vert(),
               .fragment = embedded::overlay_frag(),
               .bindings = {{0, sizeof(Vertex), kPerVertex}},
               .attributes = {{0, 0, vk::Format::eR32G32Sfloat, offsetof(Vertex, position)},
                              {1, 0, vk::Format::eR32G32Sfloat, offsetof(Vertex, uv)},
                              {2, 0, vk::Format::eR8G8B8A8Unorm, offsetof(Vertex, colour)}},
               .blend = true,
               .scene = false});
}

}  // namespace geotherm::engine
