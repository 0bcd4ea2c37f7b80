#include "systems/main_picture.hpp"

#include <stdexcept>
#include <utility>

#include "plan/pass_mask.hpp"
#include "systems/scene_targets.hpp"

namespace speculum {

namespace {

// Returns the stored radiance of all texels of a main view in which nothing is seen; nothing if it has to be drawn.
std::optional<glm::vec3> flatColor(const FrameInfo& info, bool watched) {
  const FramePlan& plan = info.plan;
  if (info.environment.sky || !plan.showsNothing() || plan.encodes || plan.tiles || info.settings.view.accumulate > 1 ||
      info.settings.debug.checkFinite || watched) {
    return std::nullopt;
  }
  return storedBackground(info.environment, plan.main().view, plan.picture);
}

}  // namespace

void MainPicture::begin(const Settings& settings, const FramePlan& plan, bool displayed, RetireQueue& retired) {
  if (!plan.tiles) {
    retired.take(earlier_);
  } else if (displayed && !unfinished_ && !encoded_ && !earlier_) {
    earlier_ = std::move(drawn_);
  }
  Device& device = renderer_.device();
  const VkExtent2D extent = extentOf(plan.main().view.rect.width, plan.main().view.rect.height);
  const VkSampleCountFlagBits samples = device.sampleCount(settings.view.samples);
  const bool readSamples = (renderer_.roundsSumsDown() || settings.debug.checkFinite || plan.effects.any()) &&
                           samples != VK_SAMPLE_COUNT_1_BIT;
  if (!drawn_ || drawn_->samples() != samples || drawn_->desc().readSamples != readSamples ||
      drawn_->desc().color == plan.encodes) {
    const OffScreenDesc desc{.name = "main view",
                             .extent = extent,
                             .samples = samples,
                             .readSamples = readSamples,
                             .color = !plan.encodes,
                             .role = TargetRole::main};
    std::unique_ptr<OffScreen> before = std::exchange(drawn_, std::make_unique<OffScreen>(device, desc, retired));
    retired.take(before);
  }
  drawn_->resize(extent, retired);
}

void MainPicture::beginFrame(const FrameInfo& info, bool watched) {
  const FramePlan& plan = info.plan;
  size_ = {plan.width, plan.height};
  view_ = info.settings.view;
  if (plan.mainReused()) {
    return;
  }
  if (beginsPicture(plan)) {
    hasGaps_ = plan.refined != nullptr;
  }
  if (endsPicture(plan)) {
    flat_ = flatColor(info, watched);
    encoded_ = plan.encodes;
    hasGaps_ = hasGaps_ || !hasColor();
  }
}

void MainPicture::endFrame(const FrameInfo& info) {
  const FramePlan& plan = info.plan;
  RetireQueue& retired = *info.frame.retired;
  unfinished_ = !endsPicture(plan);
  if (unfinished_) {
    return restart();
  }
  retired.take(earlier_);
  radianceScale_ = view_.radianceScale();
  if (view_.accumulate == 1) {
    mean_.release(retired);
  } else if (const bool again = plan.picture > 0 && plan.picture + 1 == mean_.pictures();
             !plan.mainReused() && !again) {
    info.log.add(mean_.add(info.frame, drawn_->descriptor(), drawn_->extent(), plan.picture, plan.refined.get()));
  }
}

void MainPicture::keep(const FrameInfo& info) {
  reusable_.reset();
  if (!info.plan.mainContent.empty()) {
    reusable_ = MainImage{info.settings, info.plan.mainContent, encoded_};
  }
}

// The sampler does not enlarge a mean: not every device filters its 32-bit floats, and a mean is not drawn in haste.
DisplayedPicture MainPicture::displayed() {
  const int pictures = mean_.pictures();
  return {.image = pictures > 0 ? mean_.descriptor() : shown().descriptor(),
          .size = shown().extent(),
          .curve = scaled(curve(), std::max(pictures, 1)),
          .filtered = pictures == 0,
          .flat = flat_};
}

LinearImage MainPicture::radiance() {
  if (encoded_) {
    throw std::logic_error("radiance of a picture that is shown only (FrameRequest::shownOnly)");
  }
  renderer_.waitIdle();
  const int pictures = mean_.pictures();
  const std::vector<float> texels =
      flat_ ? std::vector<float>() : renderer_.uploader().readFloats(pictures > 0 ? mean_.sum() : shown().color());
  const VkExtent2D extent = shown().extent();
  LinearImage image(static_cast<int>(extent.width), static_cast<int>(extent.height));
  for (size_t i = 0; i < image.pixels.size(); ++i) {
    image.pixels[i] = flat_ ? *flat_ : glm::vec3(texels[4 * i], texels[4 * i + 1], texels[4 * i + 2]);
    image.pixels[i] /= static_cast<float>(std::max(pictures, 1) * radianceScale_);
  }
  return enlarged(image, size_.x, size_.y);
}

}  // namespace speculum
