#include "systems/scene_targets.hpp"

#include <algorithm>

#include "plan/target_memory.hpp"
#include "scene/scene.hpp"
#include "systems/gpu_conversion.hpp"

namespace speculum {

namespace {

constexpr uint64_t wasteAllowed = 4;  // largest area of a target, in times the requested area

// Returns the next odd multiple of 32 texels, at least 96: steps of 64, so that a mirror that moves a little keeps its
// target, and no powers of two, because lavapipe compiles each shader once more for textures of such sizes.
uint32_t roundedUp(uint32_t size) {
  constexpr uint32_t half = 32;
  return (std::max(size, half + 1) + half - 1) / (2 * half) * (2 * half) + half;
}

}  // namespace

uint64_t ImagePool::bytes() const {
  uint64_t sum = 0;
  for (const Entry& entry : entries_) {
    sum += entry.target->bytes();
  }
  return sum;
}

OffScreen& ImagePool::acquire(VkExtent2D extent, RetireQueue& retired) {
  Entry* best = nullptr;
  const VkExtent2D rounded{roundedUp(extent.width), roundedUp(extent.height)};
  for (Entry& entry : entries_) {
    const VkExtent2D has = entry.target->extent();
    if (!entry.taken && has.width >= extent.width && has.height >= extent.height &&
        areaOf(has) <= wasteAllowed * areaOf(rounded) && (!best || areaOf(has) < areaOf(best->target->extent()))) {
      best = &entry;
    }
  }
  if (!best) {
    best = &entries_.emplace_back();
    const OffScreenDesc desc{.name = name_ + " " + std::to_string(made_++),
                             .extent = rounded,
                             .multisampledOutput = true,
                             .shared = &depth_};
    best->target = std::make_unique<OffScreen>(device_, desc, retired);
  }
  best->taken = true;
  best->idleFrames = 0;
  return *best->target;
}

std::vector<ImagePool::Entry>::iterator ImagePool::entryOf(const OffScreen& target) {
  return std::ranges::find(entries_, &target, [](const Entry& entry) { return entry.target.get(); });
}

void ImagePool::release(const OffScreen& target) {
  if (const auto entry = entryOf(target); entry != entries_.end()) {
    entry->taken = false;
  }
}

std::unique_ptr<OffScreen> ImagePool::remove(const OffScreen& target) {
  const auto entry = entryOf(target);
  std::unique_ptr<OffScreen> removed = std::move(entry->target);
  entries_.erase(entry);
  return removed;
}

void ImagePool::endFrame(RetireQueue& retired) {
  for (Entry& entry : entries_) {
    if (!entry.taken && ++entry.idleFrames > framesKept) {
      retired.take(entry.target);
    }
  }
  std::erase_if(entries_, [](const Entry& entry) { return !entry.target; });
}

static_assert(bytesOfTexel(colorFormat) == colorBytes && bytesOfTexel(depthFormat) == depthBytes);

namespace {

VkFrontFace frontFace(const View& view) {
  return view.mirrored() ? VK_FRONT_FACE_CLOCKWISE : VK_FRONT_FACE_COUNTER_CLOCKWISE;
}

}  // namespace

void EnvironmentTargets::restart() {
  targets_.clear();
  restart_ = true;
}

void EnvironmentTargets::release(RetireQueue& retired) {
  retired.take(pool_);
  retired.take(depth_);
}

void EnvironmentTargets::prepare(const FramePlan& plan, RetireQueue& retired) {
  const std::span<const Cube> maps = cubesOf(plan.cubes, PassKind::environment);
  targets_ = ImagePool::reused(maps, std::move(targets_), [&](const OffScreen& unused) { pool_->release(unused); });
  if (std::exchange(restart_, false)) {
    release(retired);
  }
  for (size_t i = 0; i < maps.size(); ++i) {
    if (targets_[i]) {
      continue;
    }
    if (!depth_) {
      depth_ = std::make_unique<SharedDepth>(device_, VK_SAMPLE_COUNT_1_BIT, "environment maps");
      pool_ = std::make_unique<ImagePool>(device_, *depth_, "environment map");
    }
    const auto size = static_cast<uint32_t>(maps[i].size);
    targets_[i] = &pool_->acquire({3 * size, 2 * size}, retired);
  }
}

std::span<const VkDescriptorSet> EnvironmentTargets::bind(const Frame& frame, const FramePlan& plan,
                                                          VkDescriptorSetLayout layout) {
  sets_.assign(shadowMaps(plan), VK_NULL_HANDLE);
  for (const OffScreen* target : targets_) {
    sets_.push_back(frame.descriptors->allocate(layout));
    DescriptorWriter().image(0, target->descriptor()).update(device_, sets_.back());
  }
  return sets_;
}

void EnvironmentTargets::endFrame(RetireQueue& retired) {
  if (pool_) {
    pool_->endFrame(retired);
    if (pool_->empty()) {
      release(retired);
    }
  }
}

glm::vec3 storedBackground(const Environment& environment, const View& view, int picture) {
  const float turn = halfTurn(view.path.size(), picture);
  const auto stored = [&](double value) { return storedRadiance(value, picture, turn); };
  const glm::dvec3& color = environment.background;
  return {stored(color.r), stored(color.g), stored(color.b)};
}

Viewport viewportOf(const View& view) {
  const glm::dvec2 size = overscan(view) * view.pictureSize;
  const glm::dvec2 corner = 0.5 * (view.pictureSize - size) - glm::dvec2(view.rect.x, view.rect.y);
  return {static_cast<float>(corner.x), static_cast<float>(corner.y), static_cast<float>(size.x),
          static_cast<float>(size.y)};
}

PassDesc scenePass(const FrameInfo& info, const Pass& pass, const PassTargets& targets, const VkRect2D& area,
                   const Viewport& viewport) {
  const glm::vec3 background = storedBackground(info.environment, pass.view, info.plan.picture);
  return {.name = passName(info.scene, info.plan, pass),
          .targets = targets,
          .renderArea = area,
          .viewport = viewport,
          .scissor = area,
          .frontFace = frontFace(pass.view),
          .clearColor = {background.r, background.g, background.b, 0.0f},  // disparity 0: infinitely far
          .collectStatistics = true};
}

}  // namespace speculum
