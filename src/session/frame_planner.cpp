#include "session/frame_planner.hpp"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <utility>

#include "session/options.hpp"
#include "systems/trace_frame.hpp"

namespace speculum {

FramePlanner::FramePlanner(const Device& device, bool keepsPicture) : device_(device) {
  // Leaves a quarter for meshes, textures and other programs. Reads the budget only once, so that plans of equal frames
  // are equal.
  budgetBytes_ = limits_.budgetBytes = device.memoryBudget().budgetBytes / 4 * 3;
  limits_.largestSide =
      static_cast<int>(std::min({device.limits().maxImageDimension2D, device.limits().maxViewportDimensions[0],
                                 device.limits().maxViewportDimensions[1]}));
  limits_.cpu = device.info().isCpu();
  limits_.keepsPicture = keepsPicture;
  limits_.hybridShadows = device.caps().fillModeNonSolid && device.caps().sampleRateShading;
}

void FramePlanner::begin(bool rendersMirrors, bool leavesOutTextures, unsigned planners) {
  limits_.budgetBytes = budgetBytes_ / planners;
  rendersMirrors_ = rendersMirrors;
  leavesOutTextures_ = leavesOutTextures;
}

FittedPlan FramePlanner::plan(const FrameRequest& request) {
  if (std::max(request.size.x, request.size.y) > limits_.largestSide) {
    throw UsageError("--size: " + std::to_string(request.size.x) + "x" + std::to_string(request.size.y) +
                     " is larger than the device draws (at most " + std::to_string(limits_.largestSide) +
                     " pixels a side)");
  }
  FrameRequest asked = request;
  if (rendersMirrors_) {
    asked.settings.reflection.skipUnchanged = false;
    asked.settings.reflection.updateInterval = asked.settings.limit.mostInterval = 1;
  }
  asked_ = asked.settings;
  if (refused_ && !leavesOutTextures_ && refused_->settings != asked_) {
    retried_ = refused_->problem;
    refused_.reset();
  }
  asked.settings.effects.textures = asked_.effects.textures && !refused_;
  if (!device_.caps().primitiveId && std::exchange(asked.settings.effects.transparency, false) &&
      std::ranges::any_of(request.scene.meshes, &Mesh::isTransparent) && !std::exchange(warnedOfCoverage_, true)) {
    spdlog::warn("transparent materials are drawn opaque, because the device has no geometry shaders");
  }
  const bool tracesRays =
      device_.caps().primitiveId && device_.limits().maxPerStageDescriptorStorageBuffers >= TraceFrame::storageBuffers;
  limits_.whyNoRays = tracesRays ? traceRoomProblem(request.scene, request.state.instances.size(), device_.limits())
                                 : fmt::format("the device lacks geometryShader or {} storage buffers a stage",
                                               TraceFrame::storageBuffers);
  FittedPlan fitted = planWithin(limits_, asked);
  if (!fitted.message.empty() && lowered_.empty()) {
    spdlog::warn("{}", fitted.message);
  }
  lowered_ = fitted.message;
  return fitted;
}

void FramePlanner::leaveOutTextures(const std::string& why) {
  if (refused_) {
    throw;
  }
  refused_ = {asked_, "drawn without textures until a setting is changed: " + why};
  if (refused_->problem != retried_) {
    spdlog::warn("{}", refused_->problem);
  }
  retried_.clear();
}

std::string FramePlanner::message() const {
  const std::string refused = refused_ ? refused_->problem : "";
  return refused + (refused.empty() || lowered_.empty() ? "" : "; ") + lowered_;
}

}  // namespace speculum
