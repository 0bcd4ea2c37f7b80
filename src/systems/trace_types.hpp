#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>

namespace speculum {

// The structures of shaders/trace.glsl (std430), where their members are described.

struct TraceNode {
  glm::vec3 low;
  uint32_t first;
  glm::vec3 high;
  uint32_t count;
};
static_assert(offsetof(TraceNode, first) == 12 && offsetof(TraceNode, high) == 16 && sizeof(TraceNode) == 32);

struct TraceTriangle {
  glm::vec3 a;
  uint32_t triangle;
  glm::vec3 b;
  uint32_t material;
  glm::vec3 c;
  uint32_t pad;
};
static_assert(offsetof(TraceTriangle, b) == 16 && offsetof(TraceTriangle, c) == 32 && sizeof(TraceTriangle) == 48);

struct TraceVertex {
  glm::vec3 position;
  float u;
  glm::vec3 normal;
  float v;
};
static_assert(offsetof(TraceVertex, normal) == 16 && sizeof(TraceVertex) == 32);

struct TraceInstance {
  glm::vec4 meshFromTrace[3];
  glm::vec4 normalFromMesh[3];
  glm::vec4 diffuse;
  glm::vec4 specular;
  glm::vec4 reflectance;
  glm::vec4 baseColor;
  float shininess;
  uint32_t root;
  uint32_t firstTriangle;
  uint32_t firstVertex;
};
static_assert(offsetof(TraceInstance, normalFromMesh) == 48 && offsetof(TraceInstance, reflectance) == 128 &&
              offsetof(TraceInstance, shininess) == 160 && sizeof(TraceInstance) == 176);

enum class CurvedMirror { none, constant, schlick };

struct TraceMirror {
  glm::vec3 origin;
  uint32_t firstVertex;
  glm::vec3 normal;
  uint32_t vertexCount;
  glm::vec3 axisX;
  uint32_t twoSided;
  glm::vec3 axisY;
  float alpha;
  glm::vec4 reflectance;
  glm::vec4 baseColor;
  glm::vec4 backColor;
  glm::vec4 ripple;
};
static_assert(offsetof(TraceMirror, axisX) == 32 && offsetof(TraceMirror, reflectance) == 64 &&
              offsetof(TraceMirror, ripple) == 112 && sizeof(TraceMirror) == 128);

struct LightPath {
  glm::vec3 image;
  float radius;
  glm::vec3 irradiance;
  uint32_t castsShadow;
  glm::vec3 light;
  uint32_t mirror;
};
static_assert(offsetof(LightPath, irradiance) == 16 && offsetof(LightPath, light) == 32 && sizeof(LightPath) == 48);

// Stands before the light paths in their buffer.
struct LightPathHeader {
  uint32_t count;
  uint32_t itemCount;
  uint32_t roughSamples;
  uint32_t pad;
};

inline constexpr uint32_t itemMirror = 0x80000000u;

}  // namespace speculum
