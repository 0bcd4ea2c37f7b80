#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "plan/frame_plan.hpp"
#include "random.hpp"
#include "systems/gpu_conversion.hpp"

// Results of the vertex shader for a frame's data, and results computed from the scene's own numbers in extended
// precision.
namespace speculum::hard_cases {

using LongVec3 = glm::vec<3, long double, glm::highp>;
using LongMat3 = glm::mat<3, 3, long double, glm::highp>;

using testing_support::Random;

// Points in the box [-1, 1]^3, as a mesh; only its vertices matter.
Mesh pointCloud(int count, unsigned seed);

// Returns the plan of a frame at time 0, in which only the recursion depth limits the passes.
FramePlan planOf(const Scene& scene, int width, int height, int maxDepth = 1);

// Returns what scene_vertex.glsl writes to gl_Position, in float.
glm::vec4 shaderClip(const gpu::InstanceData& data, const Vertex& vertex);

// Takes clip space to pixels, y down.
glm::dvec2 toPixel(const glm::dvec4& clip, int width, int height);

// Returns the scene with all positions moved.
Scene moved(Scene scene, const glm::dvec3& offset);

// Returns the data of `instance` in a pass's view, as the renderer computes it.
gpu::InstanceData dataIn(const FramePlan& plan, const View& view, const InstanceState& instance);

// Returns R = Ry Rx Rz of angles in degrees.
LongMat3 longRotation(const glm::dvec3& pitchYawRoll);

// Returns the rotation from world to view. Rows: right, up, back.
LongMat3 longWorldToView(const CameraSpec& camera);

// Returns the pixel of a point that is relative to the eye.
glm::dvec2 longPixel(const LongMat3& worldToView, const LongVec3& relative, double verticalFovDegrees, int width,
                     int height);

}  // namespace speculum::hard_cases
