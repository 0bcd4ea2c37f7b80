#pragma once

#include <functional>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "plan/frame_plan.hpp"
#include "scene/scene_state.hpp"
#include "shaders/gpu_data.h"

// The polygons to draw for the mirrors of a pass.

namespace speculum {

// Conversions from the scene's and the plan's doubles to the buffers of a frame.

// Returns row `r` of a matrix with `w` as fourth component.
glm::vec4 row(const glm::dmat3& m, int r, double w);
// Rounds a product of radiances to floats, at most radianceRange.high.
glm::vec3 radiance(const glm::dvec3& product);
// Gives `take` the texels of each level in order, with color and opacity, from the first, in parts, down to one texel.
// Halving an odd size leaves out the last row or column.
void forLevels(const Texture& texture, const std::function<void(std::span<const glm::vec4>)>& take);
// Appends all levels but the first `skipped` texels, RGBA as half floats.
void appendLevels(const Texture& texture, std::vector<uint64_t>& texels, uint64_t skipped = 0);
// Returns the part of a step, 0 .. 1, by which the noise of nearestHalf() (shaders/shading.glsl) is moved in picture
// `picture` of a mean, for views behind `depth` mirrors. Pictures differ, and so do views that show each other's
// images.
float halfTurn(size_t depth, int picture);
// Returns a radiance of at most 65504 as a target can store it: at the nearest half float or, in the later pictures of
// a mean, above or below by `turn`. How devices round a clear color is not specified.
float storedRadiance(double value, int picture, float turn);
// Returns the environment with its radiances times `scale`.
Environment scaled(Environment environment, double scale);
// Returns the constant of shaders/gpu_data.h that chooses the filter.
uint32_t textureLookup(TextureFilter filter);
// Returns the colors that replace those of the object's material.
gpu::MaterialChange materialChange(const Object& object);
// Returns the constants for drawing a part of an object; the caller sets firstTriangle.
gpu::DrawConstants drawConstants(const Material& material, const Object& object, float handedness);
// Returns the normal matrix of a linear map, scaled so that its longest column has length 1: unscaled it may overflow a
// float. The scale does not matter, because shaders normalise normals.
glm::dmat3 unitNormalMatrix(const glm::dmat3& linear);

struct RippleConstants {
  float waveNumber;  // 1/m
  float slope;       // of the steepest point of a wave
  glm::vec2 phases;  // of both trains of waves, radians
};
// Returns the constants of ripples at a time in seconds, about a point in the mirror's local coordinates.
RippleConstants rippleConstants(const Ripple& ripple, double time, const glm::dvec2& point);

// Returns the distance from the eye to the far end of the instance, metres, at most 1e6.
double reachOf(const InstanceState& instance, const glm::dvec3& eye);
// Returns the sign of the determinant of the instance's transform, 1 or -1.
float handednessOf(const InstanceState& instance);

// Returns the data of an instance in a view. `clipFromRelative` takes world space minus the view's eye to clip space.
gpu::InstanceData instanceData(const InstanceState& instance, const View& view, const glm::dmat4& clipFromRelative);

// Returns the triangle of a mesh's instance in the space of points relative to the eye.
gpu::RepeatingTriangle repeatingTriangle(const Mesh& mesh, uint32_t triangle, const InstanceState& instance,
                                         const glm::dvec3& eye);

// Returns the projection of a view under reflection.clip: `common`, or its oblique variant for a mirror's view. The
// unit square of its clip space is `overscan(view)` times the picture.
glm::dmat4 viewProjection(const Projection& common, const View& view, ClipMethod clip);

// Returns clip plane, rays and background of a view whose rectangle begins at pixel `target` of its target; the caller
// sets the other members.
gpu::ViewData viewData(const View& view, const Projection& projection, const glm::ivec2& target,
                       const Environment& environment);

// Returns the data of a mirror in a view; `image` is the view that its image was drawn with, null without one.
gpu::MirrorData mirrorData(const MirrorDraw& draw, const MirrorOptics& optics, const SceneState& state,
                           const EffectSettings& effects, const View& view, const View* image);

using ClipPolygon = std::vector<glm::dvec4>;  // convex, in clip space

// Returns the polygons of each of pass.mirrors, several for a mirror that is not convex. `projection` takes view space
// to clip space.
std::vector<std::vector<ClipPolygon>> mirrorPolygons(const Pass& pass, const glm::dmat4& projection);

// Returns the polygons to draw for pass.mirrors[index]; `polygons` are those of mirrorPolygons(). Depth cannot order
// mirrors of one plane, because it is rounded in each triangle in its own way, so the parts that other mirrors cover
// are cut away. The whole mirror is drawn behind its parts: it fills gaps of one sample between them, and stands for
// parts that would be too many. `cuts` counts the cuts of all mirrors of the pass, whose number is limited.
std::vector<ClipPolygon> partsToDraw(const Pass& pass, const SceneState& state,
                                     std::span<const std::vector<ClipPolygon>> polygons, size_t index, size_t& cuts);

// Adds the triangles of a convex polygon in clip space.
void addFan(std::vector<glm::vec4>& vertices, std::span<const glm::dvec4> polygon);

// Adds a fringe around the polygon that is seen only instead of the background. Where mirrors share an edge, or end at
// a body, rounding may leave a gap of one sample; the fringe of one mirror fills the gap. Widening the mirror itself
// would be worse: it would hide the body it ends at, and its image has nothing to show beyond its edge. `size` is the
// viewport's, in pixels.
void addFringe(std::vector<glm::vec4>& vertices, std::span<const glm::dvec4> clip, const glm::dvec2& size);

}  // namespace speculum
