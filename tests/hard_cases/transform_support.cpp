#include "transform_support.hpp"

#include <cmath>
#include <numbers>

namespace speculum::hard_cases {

Mesh pointCloud(int count, unsigned seed) {
  Random random(seed);
  Mesh mesh;
  for (int i = 0; i < count; ++i) {
    mesh.vertices.push_back({random.inBox(1.0), random.direction(), glm::dvec2(0.0)});
  }
  mesh.halfExtent = glm::dvec3(1.0);
  mesh.radius = std::sqrt(3.0);
  return mesh;
}

FramePlan planOf(const Scene& scene, int width, int height, int maxDepth) {
  Settings settings;
  settings.reflection.maxDepth = maxDepth;
  settings.reflection.maxPasses = 1000;
  settings.reflection.minPixels = 0.0;
  settings.reflection.minThroughput = 0.0;
  return planFrame({scene, evaluate(scene, 0.0), settings, {width, height}});
}

glm::vec4 shaderClip(const gpu::InstanceData& data, const Vertex& vertex) {
  return data.clipFromMesh * glm::vec4(glm::vec3(vertex.position), 1.0f);
}

glm::dvec2 toPixel(const glm::dvec4& clip, int width, int height) {
  return {(clip.x / clip.w * 0.5 + 0.5) * width, (clip.y / clip.w * 0.5 + 0.5) * height};
}

Scene moved(Scene scene, const glm::dvec3& offset) {
  scene.camera.position += offset;
  scene.camera.target += offset;
  for (Object& object : scene.objects) {
    object.position += offset;
  }
  for (PointLight& light : scene.lights) {
    light.position += offset;
  }
  for (Mirror& mirror : scene.mirrors) {
    mirror.position += offset;
    for (glm::dvec3& p : mirror.polygon) {
      p += offset;
    }
  }
  return scene;
}

gpu::InstanceData dataIn(const FramePlan& plan, const View& view, const InstanceState& instance) {
  const glm::dmat4 clipFromRelative =
      viewProjection(plan.projection, view, ClipMethod::clipDistance) * glm::dmat4(view.worldToView);
  return instanceData(instance, view, clipFromRelative);
}

LongMat3 longRotation(const glm::dvec3& pitchYawRoll) {
  const auto radians = [](double degrees) {
    return static_cast<long double>(degrees) * std::numbers::pi_v<long double> / 180;
  };
  const auto s = [&](double degrees) { return std::sin(radians(degrees)); };
  const auto c = [&](double degrees) { return std::cos(radians(degrees)); };
  const LongMat3 x(1, 0, 0, 0, c(pitchYawRoll.x), s(pitchYawRoll.x), 0, -s(pitchYawRoll.x), c(pitchYawRoll.x));
  const LongMat3 y(c(pitchYawRoll.y), 0, -s(pitchYawRoll.y), 0, 1, 0, s(pitchYawRoll.y), 0, c(pitchYawRoll.y));
  const LongMat3 z(c(pitchYawRoll.z), s(pitchYawRoll.z), 0, -s(pitchYawRoll.z), c(pitchYawRoll.z), 0, 0, 0, 1);
  return y * x * z;
}

LongMat3 longWorldToView(const CameraSpec& camera) {
  const LongVec3 back = glm::normalize(LongVec3(camera.position) - LongVec3(camera.target));
  const LongVec3 right = glm::normalize(glm::cross(LongVec3(camera.up), back));
  return glm::transpose(LongMat3(right, glm::cross(back, right), back));
}

glm::dvec2 longPixel(const LongMat3& worldToView, const LongVec3& relative, double verticalFovDegrees, int width,
                     int height) {
  const LongVec3 p = worldToView * relative;
  const long double focal =
      1 / std::tan(static_cast<long double>(verticalFovDegrees) * std::numbers::pi_v<long double> / 360);
  const long double x = focal * height / width * p.x / -p.z;
  const long double y = -focal * p.y / -p.z;
  return {static_cast<double>((x * 0.5L + 0.5L) * width), static_cast<double>((y * 0.5L + 0.5L) * height)};
}

}  // namespace speculum::hard_cases
