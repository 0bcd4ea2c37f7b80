// What the window's panels are given beside the figures of a frame.
#include <spdlog/spdlog.h>

#include <algorithm>

#include "app/demo.hpp"
#include "edit/outline.hpp"
#include "image/picture_files.hpp"

namespace speculum {

namespace {

std::string kindName(VkPhysicalDeviceType type) {
  switch (type) {
    case VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU:
      return "discrete GPU";
    case VK_PHYSICAL_DEVICE_TYPE_INTEGRATED_GPU:
      return "integrated GPU";
    case VK_PHYSICAL_DEVICE_TYPE_VIRTUAL_GPU:
      return "virtual GPU";
    case VK_PHYSICAL_DEVICE_TYPE_CPU:
      return "CPU";
    default:
      return "other";
  }
}

}  // namespace

// Titles and pictures of the scenes that were found.
void Demo::showGallery() {
  std::vector<Image8> pictures;
  for (const std::filesystem::path& file : sceneFiles_) {
    const std::filesystem::path picture = file.parent_path() / "thumbnails" / (file.stem().string() + ".jpg");
    std::error_code none;
    Image8 thumbnail;
    try {
      thumbnail = std::filesystem::exists(picture, none) ? readImage8(picture) : Image8();
    } catch (const std::runtime_error& error) {
      spdlog::warn("{}", error.what());
    }
    // Of the size that scripts/thumbnails makes: a large one would take the texture that the fonts need.
    pictures.push_back(thumbnail.width <= 192 && thumbnail.height <= 192 ? std::move(thumbnail) : Image8());
  }
  ui_->setThumbnails(std::move(pictures));
}

// Of the frame that was just recorded; the GPU's figures are of the last one that has finished.
void Demo::noteTimes(uint64_t frame, double cpuMs) {
  model_.history.add(frame, sinceLast_, cpuMs);
  const FrameTimings& timings = renderer_.timings();
  std::vector<std::pair<std::string, double>> passes;
  for (const PassTiming& pass : timings.passes) {
    passes.emplace_back(pass.name, pass.gpuMs);
  }
  if (timings.frame > 0) {
    model_.history.addGpu(timings.frame, timings.gpuMs, passes);
  }
}

void Demo::showDevice() {
  const DeviceInfo& info = device_.info();
  const DeviceCaps& caps = device_.caps();
  UiDevice& device = model_.device;
  device.name = info.name;
  device.kind = kindName(info.type);
  device.driver = info.driver;
  device.vulkan = std::to_string(VK_API_VERSION_MAJOR(info.apiVersion)) + "." +
                  std::to_string(VK_API_VERSION_MINOR(info.apiVersion)) + "." +
                  std::to_string(VK_API_VERSION_PATCH(info.apiVersion));
  device.renderPath = renderPathName(device_.renderPath());
  for (int count = 1; count <= 64; count *= 2) {
    device.samples += caps.sampleCounts & static_cast<VkSampleCountFlags>(count) ? std::to_string(count) + " " : "";
  }
  device.features = {
      {"dynamic rendering", caps.dynamicRendering, caps.dynamicRendering ? "" : "render passes are used"},
      {"timestamps", caps.timestampValidBits > 0, caps.timestampValidBits > 0 ? "" : "no times of passes"},
      {"pipeline statistics", caps.pipelineStatistics, caps.pipelineStatistics ? "" : "no triangles and fragments"},
      {"precise occlusion", caps.countsSamples, caps.countsSamples ? "" : "samples drawn are not counted"},
      {"geometryShader", caps.primitiveId, caps.primitiveId ? "" : "nothing that traces rays is drawn"},
      {"sampleRateShading", caps.sampleRateShading, caps.sampleRateShading ? "" : "samples share a shading"},
      {"depthClamp", caps.depthClamp, caps.depthClamp ? "" : "the near plane cuts"},
      {"fillModeNonSolid", caps.fillModeNonSolid, caps.fillModeNonSolid ? "" : "no wireframe"},
      {"memory budget", caps.memoryBudget, caps.memoryBudget ? "" : "the heaps' size stands for it"}};
  for (UiFeature& feature : device.features) {
    feature.about = feature.present ? "yes" : feature.about;
  }
  for (const PresentMode mode : renderer_.presentModes()) {
    model_.presentModes.emplace_back(presentModeName(mode));
  }
  const std::vector<PresentMode> modes = renderer_.presentModes();
  model_.presentMode = static_cast<int>(std::find(modes.begin(), modes.end(), renderer_.presentMode()) - modes.begin());
  shownPresentMode_ = model_.presentMode;
}

// Of the skipped mirror that is pointed at, seen as what it would be seen in is.
void Demo::outlineSkipped(const FramePlan& plan, const SceneState& state) {
  model_.outlinedSkipped.clear();
  model_.skippedOutline.clear();
  const auto hovered = static_cast<size_t>(model_.hoveredSkipped);
  if (hovered >= model_.skipped.size()) {
    return;
  }
  const std::vector<int>& path = model_.skipped[hovered].mirrors;
  // The list is the last frame's: an edit may have taken mirrors away since.
  const auto isGone = [&](int mirror) { return static_cast<size_t>(mirror) >= state.mirrors.size(); };
  if (std::any_of(path.begin(), path.end(), isGone)) {
    return;
  }
  const PictureView picture(state.camera, plan.width, plan.height);
  if (const auto image = picture.through(loaded_->scene, state, std::span(path).first(path.size() - 1))) {
    model_.outlinedSkipped = path;
    model_.skippedOutline = outlineOf(loaded_->scene, state, {Selection::Kind::mirror, path.back()}, *image, {});
  }
}

void Demo::showMemory() {
  const MemoryBudget budget = device_.memoryBudget();
  model_.device.budgetBytes = budget.budgetBytes;
  model_.device.usedBytes = budget.usedBytes;
}

void Demo::applyPresentMode() {
  if (model_.presentMode != shownPresentMode_) {
    shownPresentMode_ = model_.presentMode;
    renderer_.setPresentMode(renderer_.presentModes().at(static_cast<size_t>(model_.presentMode)));
  }
}

}  // namespace speculum
