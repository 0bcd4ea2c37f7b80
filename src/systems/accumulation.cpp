#include "systems/accumulation.hpp"

#include <chrono>
#include <new>
#include <stdexcept>

#include "plan/target_memory.hpp"
#include "shaders/gpu_data.h"

namespace speculum {

namespace {

constexpr VkFormat sumFormat = VK_FORMAT_R32G32B32A32_SFLOAT;
static_assert(2 * bytesOfTexel(sumFormat) == sumBytes);
constexpr std::array bufferNames{"refined tiles"};

}  // namespace

Accumulation::Accumulation(Renderer& renderer)
    : renderer_(renderer),
      pipelines_(renderer.pipelines()),
      tiles_(renderer.device(), bufferNames, "a smaller --size") {}

void Accumulation::begin(VkExtent2D extent, RetireQueue& retired) {
  Device& device = renderer_.device();
  if (!sampler_) {
    constexpr VkDescriptorType image = VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER;
    layout_ = descriptorSetLayout(device, {image, image, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER},
                                  VK_SHADER_STAGE_FRAGMENT_BIT, "accumulate");
    sampler_ = createSampler(device, nearestSampler, "sum");
  }
  halves_.clear();
  refined_.reset();
  for (Image& image : images_) {
    if (!sameExtent(image.extent(), extent)) {
      retired.take(image);
    }
    if (!image) {
      image = Image(device, {.extent = extent,
                             .format = sumFormat,
                             .usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_SAMPLED_BIT |
                                      VK_IMAGE_USAGE_TRANSFER_SRC_BIT,
                             .name = "sum of pictures"});
    }
  }
}

RecordedPass Accumulation::add(Frame& frame, const VkDescriptorImageInfo& radiance, VkExtent2D extent, int picture,
                               const RefinedTiles* refined) {
  if (picture == 0) {
    begin(extent, *frame.retired);
  } else if (picture != pictures_ || !sameExtent(sum().extent(), extent)) {
    throw std::logic_error("picture " + std::to_string(picture) + " of a mean does not follow " +
                           std::to_string(pictures_) + " others of its size");
  }
  tiles_.write(frame, 0, refined ? refined->tiles : std::vector<uint32_t>{1});
  const VkDescriptorSet set = frame.descriptors->allocate(layout_);
  DescriptorWriter()
      .image(0, radiance)
      .image(1, picture == 0 ? radiance : descriptor())
      .buffer(2, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, tiles_.buffer(frame, 0).descriptor())
      .update(renderer_.device(), set);
  current_ = 1 - current_;
  pictures_ = picture + 1;
  const Pipeline& pipeline = pipelines_.get(true, [&] {
    return GraphicsPipelineDesc{.name = "accumulate",
                                .vert = "full_screen.vert",
                                .frag = "accumulate.frag",
                                .setLayouts = {layout_},
                                .pushConstantBytes = sizeof(gpu::AccumulateConstants),
                                .color = sumFormat,
                                .depth = VK_FORMAT_UNDEFINED};
  });
  const PassDesc desc = fullPass("accumulate", {.color = &sum()});
  const PassScope scope = renderer_.beginPass(frame, desc);
  const auto columns = refined ? static_cast<uint32_t>(refined->grid().x) : 0;
  pipeline.bind(scope.commands(), set, gpu::AccumulateConstants{picture == 0, columns, refinedSide});
  vkCmdDraw(scope.commands(), 3, 1, 0, 0);
  return {{.kind = PassKind::accumulation}, desc.name, 1};
}

std::shared_ptr<const RefinedTiles> Accumulation::refined(const DisplayCurve& curve, const ViewSettings& settings,
                                                          double& waitedMs) {
  const int most = settings.accumulateError > 0.0 ? settings.accumulate : 0;
  const bool decides = pictures_ < most && decidesTiles(pictures_) && halves_.contains(pictures_ / 2);
  const bool starts = 2 * pictures_ < most && startsHalf(pictures_) && !halves_.contains(pictures_);
  if (decides || starts) {
    const auto start = std::chrono::steady_clock::now();
    renderer_.waitIdle();
    try {
      std::vector<float> texels = renderer_.uploader().readFloats(sum());
      if (decides) {
        const glm::ivec2 size(sum().extent().width, sum().extent().height);
        refined_ =
            std::make_shared<RefinedTiles>(refineTiles({pictures_ / 2, halves_.at(pictures_ / 2)}, {pictures_, texels},
                                                       size, curve, settings.accumulateError, refined_.get()));
        halves_.erase(pictures_ / 2);
      }
      if (refined_ && refined_->none()) {
        halves_.clear();
      } else if (starts) {
        halves_[pictures_] = std::move(texels);
      }
    } catch (const OutOfMemoryError&) {
      halves_.clear();  // the mean goes on without an estimate
    } catch (const std::bad_alloc&) {
      halves_.clear();
    }
    waitedMs += std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
  }
  return refined_;
}

void Accumulation::release(RetireQueue& retired) {
  pictures_ = 0;
  halves_.clear();
  refined_.reset();
  tiles_.retire(retired);
  pipelines_.clear();
  for (Image& image : images_) {
    retired.take(image);
  }
  retired.take(sampler_);
}

}  // namespace speculum
