// What the window's panels are given beside the figures of a frame.
#include <spdlog/spdlog.h>

#include "app/demo.hpp"

namespace speculum {

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

}  // namespace speculum
