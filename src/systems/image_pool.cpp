#include "systems/image_pool.hpp"

#include <algorithm>
#include <utility>

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

}  // namespace speculum
