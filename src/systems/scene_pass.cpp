#include "systems/scene_pass.hpp"

#include <array>
#include <utility>

#include "scene/scene.hpp"

namespace speculum {

namespace {

std::array<float, 4> clearColor(const Environment& environment) {
  const glm::vec3 color(glm::min(environment.background, glm::dvec3(65504.0)));
  return {color.r, color.g, color.b, 0.0f};  // infinitely far
}

VkFrontFace frontFace(const View& view) {
  return view.mirrored() ? VK_FRONT_FACE_CLOCKWISE : VK_FRONT_FACE_COUNTER_CLOCKWISE;
}

}  // namespace

Viewport viewportOf(const View& view) {
  const glm::dvec2 size = overscan(view) * view.pictureSize;
  const glm::dvec2 corner = 0.5 * (view.pictureSize - size) - glm::dvec2(view.rect.x, view.rect.y);
  return {static_cast<float>(corner.x), static_cast<float>(corner.y), static_cast<float>(size.x),
          static_cast<float>(size.y)};
}

PassDesc scenePass(std::string name, const PassTargets& targets, const VkRect2D& area, const Viewport& viewport,
                   const View& view, const Environment& environment) {
  return {.name = std::move(name),
          .targets = targets,
          .renderArea = area,
          .viewport = viewport,
          .scissor = area,
          .frontFace = frontFace(view),
          .clearColor = clearColor(environment),
          .collectStatistics = true};
}

}  // namespace speculum
