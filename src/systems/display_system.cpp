#include "systems/display_system.hpp"

#include <algorithm>
#include <glm/gtc/packing.hpp>

#include "shaders/gpu_data.h"
#include "systems/gpu_conversion.hpp"

namespace speculum {

namespace {

// Area in which a target is shown, and its lookup: texel = display pixel * xy + zw.
struct Placement {
  VkRect2D area;
  glm::vec4 lookup;
};

std::optional<Placement> placementOf(const VkExtent2D& display, const glm::dvec2& image, const TargetDisplay& debug) {
  const glm::ivec2 end(display.width, display.height);
  PixelRect area = intersect(debug.area, {0, 0, end.x, end.y});
  glm::dvec2 corner(debug.area.x, debug.area.y);  // of texel 0, 0, in pixels of the display
  double zoom = debug.zoom;
  if (zoom > 0.0) {
    corner -= zoom * debug.origin;
  } else {
    zoom = std::min(debug.area.width / image.x, debug.area.height / image.y);
    corner += 0.5 * (glm::dvec2(debug.area.width, debug.area.height) - zoom * image);
  }
  const glm::dvec2 last = corner + zoom * image;
  const glm::ivec2 low(glm::ceil(glm::max(corner - 0.5, glm::dvec2(-1.0))));
  const glm::ivec2 high(glm::floor(glm::min(last, glm::dvec2(end) + 1.0)));
  area = intersect(area, {low.x, low.y, high.x - low.x, high.y - low.y});
  if (area.empty()) {
    return std::nullopt;
  }
  return Placement{{{area.x, area.y}, extentOf(area.width, area.height)},
                   glm::vec4(glm::dvec4(1.0 / zoom, 1.0 / zoom, -corner / zoom))};
}

// Returns what the display shows of a picture of one color that a shader need not draw; nothing for other pictures.
std::optional<VkClearColorValue> flatColor(const DisplayedPicture& picture) {
  return picture.flat ? displayColor(*picture.flat, picture.curve) : std::nullopt;
}

}  // namespace

std::optional<VkClearColorValue> displayColor(const glm::vec3& radiance, const DisplayCurve& curve) {
  constexpr double closest = 1.0 / 256.0;  // steps; the shader's curve is off by less than 1/4000
  VkClearColorValue color{.float32 = {0.0f, 0.0f, 0.0f, 1.0f}};
  for (int channel = 0; channel < 3; ++channel) {
    const double steps = 255.0 * displayValue(radiance[channel], curve) + 0.5;
    if (std::abs(steps - std::round(steps)) < closest) {
      return std::nullopt;
    }
    color.float32[channel] = static_cast<float>(std::floor(steps)) / 255.0f;
  }
  return color;
}

DisplaySystem::DisplaySystem(Renderer& renderer) : renderer_(renderer), pipelines_(renderer.pipelines()) {
  layout_ = descriptorSetLayout(renderer.device(), {VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER},
                                VK_SHADER_STAGE_FRAGMENT_BIT, "display");
  linearSampler_ = createSampler(renderer.device(), {}, "display");
}

void DisplaySystem::draw(const Frame& frame, const PassScope& scope, Variant variant,
                         const VkDescriptorImageInfo& image, const auto& constants) {
  variant.format = variant.mean ? colorFormat : renderer_.displayFormat();
  const Pipeline& pipeline = pipelines_.get(variant, [&] {
    const char* color = variant.mean           ? "sample_mean.frag"
                        : variant.multisampled ? "display_average.frag"
                        : variant.enlarged     ? "display_enlarge.frag"
                                               : "display.frag";
    const char* depth = variant.multisampled ? "display_depth_samples.frag" : "display_depth.frag";
    return GraphicsPipelineDesc{.name = variant.depth ? "display depth" : "display",
                                .vert = "full_screen.vert",
                                .frag = variant.depth ? depth : color,
                                .constants = {{gpu::constantEncoding, encodingOf(variant.toneMap)},
                                              {gpu::constantShrunk, variant.shrunk},
                                              {gpu::constantSampled, variant.sampled}},
                                .setLayouts = {layout_},
                                .pushConstantBytes = sizeof constants,
                                .color = variant.format,
                                .depth = VK_FORMAT_UNDEFINED};
  });
  const VkDescriptorSet set = frame.descriptors->allocate(layout_);
  DescriptorWriter().image(0, image).update(renderer_.device(), set);
  pipeline.bind(scope.commands(), set, constants);
  vkCmdDraw(scope.commands(), 3, 1, 0, 0);
}

DisplayedPicture DisplaySystem::covered(const DisplayedPicture& picture) const {
  return cover_ ? DisplayedPicture{.image = cover_.descriptor(linearSampler_.get()),
                                   .size = cover_.extent(),
                                   .stretches = false}
                : picture;
}

RecordedPass DisplaySystem::record(Frame& frame, std::span<const DisplayedPicture> pictures) {
  const glm::vec4 cornerOnly(0.0f, 0.0f, 0.5f, 0.5f);  // each pixel looks up the first texel
  PassDesc desc = fullPass("display", renderer_.displayTargets(frame));
  if (const std::optional<VkClearColorValue> color = flatColor(pictures[0])) {
    std::ranges::copy(color->float32, desc.clearColor.begin());
  }
  const PassScope scope = renderer_.beginPass(frame, desc);
  uint32_t draws = 0;
  for (const DisplayedPicture& picture : pictures) {
    if (const std::optional<VkClearColorValue> color = flatColor(picture)) {
      if (&picture != &pictures[0] &&
          picture.area.extent.width > 0) {  // the pass is cleared with the first one's color
        const VkClearAttachment clear{.aspectMask = VK_IMAGE_ASPECT_COLOR_BIT, .clearValue = {.color = *color}};
        const VkClearRect area{picture.area, 0, 1};
        vkCmdClearAttachments(scope.commands(), 1, &clear, 1, &area);
      }
      continue;
    }
    const glm::vec2 scale(static_cast<float>(picture.size.width) / static_cast<float>(frame.extent.width),
                          static_cast<float>(picture.size.height) / static_cast<float>(frame.extent.height));
    Variant variant{.toneMap = picture.curve.toneMap};
    variant.enlarged = !picture.flat && picture.stretches && scale != glm::vec2(1.0f);
    variant.sampled = variant.enlarged && picture.filtered && renderer_.device().info().isCpu();
    VkDescriptorImageInfo image = picture.image;
    image.sampler = variant.sampled ? linearSampler_.get() : image.sampler;
    vkCmdSetScissor(scope.commands(), 0, 1, &picture.area);
    draw(frame, scope, variant, image,
         gpu::DisplayConstants{picture.flat ? cornerOnly : glm::vec4(scale, 0.0f, 0.0f),
                               {picture.size.width, picture.size.height},
                               static_cast<float>(picture.curve.exposure)});
    ++draws;
  }
  return {{.kind = PassKind::display}, desc.name, draws};
}

// A depth image is not filtered where it is shrunk, because depth has no mean where surfaces meet.
std::optional<RecordedPass> DisplaySystem::recordTarget(Frame& frame, const WatchedTarget::Target& target,
                                                        const TargetDisplay& debug, const MirrorImage& image,
                                                        const DisplayCurve& curve) {
  const std::optional<Placement> placement = placementOf(frame.extent, target.size, debug);
  if (!placement) {
    return std::nullopt;
  }
  const glm::vec4& lookup = placement->lookup;
  PassDesc desc = fullPass("debug view", renderer_.displayTargets(frame));
  desc.renderArea = desc.scissor = placement->area;
  desc.loadColor = true;
  const PassScope scope = renderer_.beginPass(frame, desc);
  Variant variant{.multisampled = image.samples != VK_SAMPLE_COUNT_1_BIT, .depth = target.kind == TargetKind::depth};
  if (variant.depth) {
    draw(frame, scope, variant, image.descriptor,
         gpu::DepthViewConstants{lookup, static_cast<float>(target.near / debug.halfDistance)});
  } else {
    variant.toneMap = curve.toneMap;
    variant.shrunk = lookup.x > 1.0f;
    draw(frame, scope, variant, image.descriptor,
         gpu::DisplayConstants{lookup, target.size, static_cast<float>(curve.exposure)});
  }
  return RecordedPass{{.kind = PassKind::targetDisplay}, desc.name, 1};
}

std::optional<RecordedPass> DisplaySystem::recordMean(Frame& frame, OffScreen& target, int picture) {
  if (!target.samplesImage()) {
    pipelines_.dropIf([](const Variant& variant) { return variant.mean; });
    return std::nullopt;
  }
  constexpr size_t beyondMirrors = 64;  // in whose place this pass reads the main view
  const PassTargets mean{.color = &target.color(), .role = TargetRole::main};
  const PassDesc desc = fullPass(target.desc().name, mean);
  draw(frame, renderer_.beginPass(frame, desc), {.mean = true}, target.samplesDescriptor(),
       gpu::MeanConstants{halfTurn(beyondMirrors, picture), picture > 0 ? 1.0f : 0.0f});
  return RecordedPass{{.kind = PassKind::main}, desc.name, 1};
}

void DisplaySystem::releaseView() {
  pipelines_.dropIf([](const Variant& variant) { return variant.multisampled || variant.shrunk || variant.depth; });
}

void DisplaySystem::countPipelines(EffectLedger& ledger) const {
  pipelines_.forEach(
      [&](const Variant& variant) { ledger.pipeline(EffectKind::toneMap, variant.toneMap == ToneMap::aces); });
}

void DisplaySystem::setCover(const Image8& picture) {
  renderer_.retired().take(cover_);
  if (picture.width < 1) {
    return;
  }
  std::vector<uint64_t> texels(static_cast<size_t>(picture.width) * picture.height);
  for (size_t i = 0; i < texels.size(); ++i) {
    glm::vec4 linear(1.0f);
    for (int channel = 0; channel < 3; ++channel) {
      linear[channel] = static_cast<float>(srgbDecode(picture.rgba[4 * i + channel] / 255.0));
    }
    texels[i] = glm::packHalf4x16(linear);
  }
  // Waits for frames in flight: validation layer 1.3.239 forgets their fences when it sees the wait for an upload's
  // fence.
  renderer_.waitIdle();
  cover_ = renderer_.uploader().image(std::as_bytes(std::span(texels)), extentOf(picture.width, picture.height),
                                      colorFormat, false, "cover");
}

}  // namespace speculum
