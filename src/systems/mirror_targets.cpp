#include "systems/mirror_targets.hpp"

#include <algorithm>
#include <utility>

namespace speculum {

void MirrorTargets::restart() {
  cachedImages_.clear();
  cachedTargets_.clear();
  restart_ = true;
}

// Releases cached images that the plan no longer shows; passes of this frame can use their targets at once, because
// barriers order frames as they do passes.
void MirrorTargets::takeCached(const FramePlan& plan) {
  cachedTargets_ = ImagePool::reused(std::span(plan.cached), std::move(cachedTargets_),
                                     [&](const OffScreen& unused) { poolOf(unused).release(unused); });
  cachedDescriptors_.clear();
  for (const OffScreen* target : cachedTargets_) {
    cachedDescriptors_.push_back(target ? MirrorImage{target->descriptor(), target->samples()} : MirrorImage{});
  }
  cachedImages_.clear();  // an unfinished picture offers none; end() fills the list
}

// Keeps the watched image shown while tiles of the next picture are drawn or the picture is shown again. Takes the
// image out of its pool, which may be retired meanwhile.
void MirrorTargets::takeWatched(const FramePlan& plan, RetireQueue& retired) {
  OffScreen* image = std::exchange(watchedImage_, nullptr);
  const bool stays = plan.tiles || (plan.mainReused() && watched_);
  if (!stays) {
    retired.take(earlierWatched_);
  }
  if (image && stays && !earlierWatched_) {
    earlierWatched_ = poolOf(*image).remove(*image);
  } else if (image) {
    poolOf(*image).release(*image);
  }
}

void MirrorTargets::begin(const FramePlan& plan, std::optional<int> watched, RetireQueue& retired) {
  watched_ = watched;
  takeWatched(plan, retired);
  takeCached(plan);
  for (auto& [samples, pool] : pools_) {
    const auto has = [count = samples](const OffScreen* target) { return target && target->samples() == count; };
    const auto needs = [this, count = samples](const Pass& pass) { return samplesOf(pass) == count; };
    if (restart_ || (std::ranges::none_of(cachedTargets_, has) && std::ranges::none_of(plan.drawnMirrors(), needs))) {
      retired.take(pool.images);
      dropDepth(pool.depths, 0, retired);
    }
  }
  restart_ = false;
  std::erase_if(pools_, [](const auto& entry) { return !entry.second.images; });
  for (const Pass& pass : plan.drawnMirrors()) {
    if (Pool& pool = pools_[samplesOf(pass)]; !pool.images) {
      pool.images = std::make_unique<ImagePool>(device_, depth(samplesOf(pass), 0, {0, 0}), "mirror image");
    }
  }
  targets_.assign(plan.passes.size(), nullptr);
  images_.assign(plan.passes.size(), {});
}

SharedDepth& MirrorTargets::depth(VkSampleCountFlagBits samples, size_t place, VkExtent2D needed) {
  std::vector<Depth>& depths = pools_[samples].depths;
  if (place == depths.size()) {
    const std::string number = place > 0 ? " " + std::to_string(place) : "";
    depths.push_back({std::make_unique<SharedDepth>(device_, samples, "mirror images" + number)});
  }
  Depth& depth = depths[place];
  depth.idleFrames = 0;
  depth.needed = {std::max(depth.needed.width, needed.width), std::max(depth.needed.height, needed.height)};
  return *depth.image;
}

std::vector<PassTargets> MirrorTargets::acquire(const FramePlan& plan, const ConcurrentPasses& range,
                                                RetireQueue& retired) {
  const RecycledVector<size_t> order = largestFirst(plan, range);
  std::vector<PassTargets> targets(order.size());
  std::map<VkSampleCountFlagBits, size_t> places;
  for (const size_t pass : order) {
    const PixelRect& rect = plan.passes[pass].view.rect;
    const VkSampleCountFlagBits samples = samplesOf(plan.passes[pass]);
    OffScreen& target = pools_.at(samples).images->acquire(extentOf(rect.width, rect.height), retired);
    targets_[pass] = &target;
    images_[pass] = {target.descriptor(), target.samples()};
    targets[pass - range.first] = target.targets(depth(samples, places[samples]++, target.extent()), retired);
  }
  return targets;
}

// Says whether a pass's image outlives its use in this frame: because it is watched, or cached for later frames.
bool MirrorTargets::isNeededLater(const FramePlan& plan, int pass) const {
  return pass == watched_ || std::ranges::find(plan.cached, pass, &CachedImage::pass) != plan.cached.end();
}

void MirrorTargets::releaseShown(const FramePlan& plan, const Pass& pass) {
  for (const MirrorDraw& draw : pass.mirrors) {
    if (draw.pass >= 0 && !isNeededLater(plan, draw.pass)) {
      poolOf(*targets_[draw.pass]).release(*targets_[draw.pass]);
    }
  }
}

void MirrorTargets::dropDepth(std::vector<Depth>& depths, size_t from, RetireQueue& retired) {
  for (size_t i = from; i < depths.size(); ++i) {
    retired.take(depths[i].image);
  }
  depths.resize(from);
}

void MirrorTargets::end(const FramePlan& plan, RetireQueue& retired) {
  for (size_t i = 0; i < plan.cached.size(); ++i) {
    if (plan.cached[i].pass >= 0) {
      cachedTargets_[i] = targets_[plan.cached[i].pass];
    }
  }
  if (!plan.mainReused()) {
    if (watched_ && std::ranges::find(cachedTargets_, targets_[*watched_]) == cachedTargets_.end()) {
      watchedImage_ = targets_[*watched_];
    }
    retired.take(earlierWatched_);
  }
  cachedImages_ = plan.cached;
  for (auto& [samples, pool] : pools_) {
    pool.images->endFrame(retired);
    fitDepth(pool.depths, retired);
  }
}

// Shrinks depth images, which otherwise only grow, and drops idle ones. Keeps the first image while there are targets.
void MirrorTargets::fitDepth(std::vector<Depth>& depths, RetireQueue& retired) {
  size_t used = depths.size();
  for (Depth& depth : depths) {
    ++depth.idleFrames;
    if (++depth.frames > ImagePool::framesKept) {
      if (depth.needed.width > 0 && areaOf(depth.image->extent()) > areaOf(depth.needed) * 3 / 2) {
        depth.image->trim(depth.needed, retired);
      }
      depth.needed = {0, 0};
      depth.frames = 0;
    }
  }
  while (used > 1 && depths[used - 1].idleFrames > ImagePool::framesKept) {
    --used;
  }
  dropDepth(depths, used, retired);
}

}  // namespace speculum
