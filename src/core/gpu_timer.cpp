#include "core/gpu_timer.hpp"

#include <array>
#include <utility>

namespace speculum {

namespace {

QueryPoolHandle createPool(Device& device, VkQueryType type, uint32_t count, VkQueryPipelineStatisticFlags statistics,
                           const std::string& name) {
  return device.create(vkCreateQueryPool,
                       {.sType = VK_STRUCTURE_TYPE_QUERY_POOL_CREATE_INFO,
                        .queryType = type,
                        .queryCount = count,
                        .pipelineStatistics = statistics},
                       name);
}

}  // namespace

PassTiming& PassTiming::operator+=(const PassTiming& other) {
  name = other.name;
  gpuMs += other.gpuMs;
  hasStatistics = hasStatistics || other.hasStatistics;
  triangles += other.triangles;
  fragments += other.fragments;
  hasSamples = hasSamples || other.hasSamples;
  samples += other.samples;
  return *this;
}

GpuTimer::GpuTimer(Device& device, const std::string& name) : device_(device) {
  if (device.caps().timestampValidBits > 0) {
    stamps_ = createPool(device, VK_QUERY_TYPE_TIMESTAMP, 2 * maxPasses, 0, name + " timestamps");
  }
  if (device.caps().pipelineStatistics) {
    statistics_ = createPool(device, VK_QUERY_TYPE_PIPELINE_STATISTICS, maxPasses,
                             VK_QUERY_PIPELINE_STATISTIC_CLIPPING_PRIMITIVES_BIT |
                                 VK_QUERY_PIPELINE_STATISTIC_FRAGMENT_SHADER_INVOCATIONS_BIT,
                             name + " statistics");
  }
  if (device.caps().countsSamples) {
    samples_ = createPool(device, VK_QUERY_TYPE_OCCLUSION, maxPasses, 0, name + " samples");
  }
}

void GpuTimer::reset(uint64_t frame, TimerDetail detail) {
  frame_ = frame;
  detail_ = detail;
  earlier_ = {};
  forgetPasses();
}

void GpuTimer::resume() {
  earlier_ = read();
  forgetPasses();
}

void GpuTimer::forgetPasses() {
  stamped_ = 0;
  passes_.clear();
}

// Resets queries in batches, each before the first pass that uses it. The validation layer follows every query that a
// command buffer resets: all of them would take it longer than the rest of a small frame.
void GpuTimer::resetQueries(VkCommandBuffer commands, uint32_t slot) {
  constexpr uint32_t batch = 16;
  static_assert(maxPasses % batch == 0);
  if (slot % batch != 0) {
    return;
  }
  for (const auto& [pool, queries] : {std::pair(&stamps_, 2u), std::pair(&statistics_, 1u), std::pair(&samples_, 1u)}) {
    if (*pool) {
      vkCmdResetQueryPool(commands, pool->get(), queries * slot, queries * batch);
    }
  }
}

void GpuTimer::stamp(VkCommandBuffer commands, uint32_t query) {
  if (stamps_) {
    vkCmdWriteTimestamp(commands, VK_PIPELINE_STAGE_BOTTOM_OF_PIPE_BIT, stamps_.get(), query);
    ++stamped_;
  }
}

void GpuTimer::finish(VkCommandBuffer commands) {
  if (detail_ == TimerDetail::frame && stamped_ > 0) {
    stamp(commands, 1);
  }
}

int GpuTimer::begin(VkCommandBuffer commands, const std::string& pass, bool statistics) {
  if (detail_ == TimerDetail::frame) {
    if (stamped_ == 0) {
      resetQueries(commands, 0);
      stamp(commands, 0);
    }
    return -1;
  }
  const auto slot = static_cast<uint32_t>(passes_.size());
  passes_.push_back({.name = pass, .hasStatistics = statistics && statistics_ && slot < maxPasses});
  if (slot >= maxPasses) {
    return -1;
  }
  resetQueries(commands, slot);
  stamp(commands, 2 * slot);
  if (passes_.back().hasStatistics) {
    vkCmdBeginQuery(commands, statistics_.get(), slot, 0);
    countsStatistics_ = true;
  }
  return static_cast<int>(slot);
}

void GpuTimer::endStatistics(VkCommandBuffer commands, int slot) {
  if (std::exchange(countsStatistics_, false)) {
    vkCmdEndQuery(commands, statistics_.get(), static_cast<uint32_t>(slot));
  }
}

void GpuTimer::end(VkCommandBuffer commands, int slot) {
  if (slot >= 0) {
    stamp(commands, 2 * static_cast<uint32_t>(slot) + 1);
  }
}

void GpuTimer::beginSamples(VkCommandBuffer commands, int slot) {
  if (samples_ && slot >= 0 && detail_ == TimerDetail::samples) {
    passes_[slot].hasSamples = true;
    countsSamples_ = true;
    vkCmdBeginQuery(commands, samples_.get(), static_cast<uint32_t>(slot), VK_QUERY_CONTROL_PRECISE_BIT);
  }
}

void GpuTimer::endSamples(VkCommandBuffer commands, int slot) {
  if (std::exchange(countsSamples_, false)) {
    vkCmdEndQuery(commands, samples_.get(), static_cast<uint32_t>(slot));
  }
}

FrameTimings GpuTimer::read() const {
  FrameTimings timings{.frame = frame_, .passes = passes_};
  const uint32_t count = std::min(static_cast<uint32_t>(passes_.size()), maxPasses);
  if (stamped_ > 0) {
    std::vector<uint64_t> ticks(stamped_);
    check(vkGetQueryPoolResults(device_.get(), stamps_.get(), 0, stamped_, ticks.size() * sizeof(uint64_t),
                                ticks.data(), sizeof(uint64_t), VK_QUERY_RESULT_64_BIT),
          "read timestamps");
    const uint32_t bits = device_.caps().timestampValidBits;
    const uint64_t mask = bits >= 64 ? ~uint64_t{0} : (uint64_t{1} << bits) - 1;
    const auto milliseconds = [&](uint64_t from, uint64_t to) {
      return static_cast<double>((to - from) & mask) * device_.limits().timestampPeriod * 1e-6;
    };
    for (uint32_t i = 0; i < count; ++i) {
      timings.passes[i].gpuMs = milliseconds(ticks[2 * i], ticks[2 * i + 1]);
    }
    timings.gpuMs = milliseconds(ticks.front(), ticks.back());
  }
  for (uint32_t i = 0; i < count; ++i) {
    if (passes_[i].hasStatistics) {
      std::array<uint64_t, 2> values{};  // triangles, fragments: in the order of the statistics' bits
      check(vkGetQueryPoolResults(device_.get(), statistics_.get(), i, 1, sizeof values, values.data(), sizeof values,
                                  VK_QUERY_RESULT_64_BIT),
            "read pipeline statistics");
      timings.passes[i].triangles = values[0];
      timings.passes[i].fragments = values[1];
    }
    if (passes_[i].hasSamples) {
      check(vkGetQueryPoolResults(device_.get(), samples_.get(), i, 1, sizeof(uint64_t), &timings.passes[i].samples,
                                  sizeof(uint64_t), VK_QUERY_RESULT_64_BIT),
            "read sample counts");
    }
  }
  timings.gpuMs += earlier_.gpuMs;
  timings.passes.insert(timings.passes.begin(), earlier_.passes.begin(), earlier_.passes.end());
  return timings;
}

}  // namespace speculum
