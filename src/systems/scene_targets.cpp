#include "systems/scene_targets.hpp"

#include <algorithm>
#include <climits>

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
  std::ranges::for_each(free_, [&](const auto& entry) { sum += entry.second.target->bytes(); });
  std::ranges::for_each(taken_, [&](const auto& entry) { sum += entry.second.target->bytes(); });
  return sum;
}

OffScreen& ImagePool::acquire(VkExtent2D extent, RetireQueue& retired) {
  const VkExtent2D rounded{roundedUp(extent.width), roundedUp(extent.height)};
  const auto end = free_.upper_bound({wasteAllowed * areaOf(rounded), INT_MAX});
  const auto found = std::find_if(free_.lower_bound({areaOf(extent), 0}), end, [&](const auto& entry) {
    const VkExtent2D has = entry.second.target->extent();
    return has.width >= extent.width && has.height >= extent.height;
  });
  if (found != end) {
    OffScreen& target = *found->second.target;
    taken_[&target] = std::move(found->second);
    free_.erase(found);
    return target;
  }
  const OffScreenDesc desc{
      .name = name_ + " " + std::to_string(made_), .extent = rounded, .multisampledOutput = true, .shared = &depth_};
  auto made = std::make_unique<OffScreen>(device_, desc, retired);
  OffScreen& target = *made;
  taken_[&target] = {std::move(made), made_++};
  return target;
}

void ImagePool::release(const OffScreen& target) {
  if (const auto taken = taken_.find(&target); taken != taken_.end()) {
    Entry& place = free_[{areaOf(target.extent()), taken->second.number}];
    place = {std::move(taken->second.target), taken->second.number};
    taken_.erase(taken);
  }
}

std::unique_ptr<OffScreen> ImagePool::remove(const OffScreen& target) {
  return std::move(taken_.extract(&target).mapped().target);
}

void ImagePool::endFrame(RetireQueue& retired) {
  for (auto entry = free_.begin(); entry != free_.end();) {
    const auto here = entry++;
    if (++here->second.idleFrames > framesKept) {
      retired.take(here->second.target);
      free_.erase(here);
    }
  }
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
