#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>

namespace speculum {

// The structures of shaders/interface.glsl (std430), where their members are described.

struct ViewData {
  glm::mat4 clipFromRelative;
  glm::vec4 rayX;
  glm::vec4 rayY;
  glm::vec4 rayOrigin;
  glm::vec4 clipPlane;
  glm::vec4 ambient;
  glm::vec4 background;
  glm::vec4 zenith;
  glm::vec4 horizon;
  glm::vec4 ground;
  glm::vec4 traceOffset;
  glm::vec4 throughput;
  uint32_t firstLight;
  uint32_t lightCount;
  uint32_t depth;
  uint32_t maxDepth;
};
static_assert(offsetof(ViewData, rayX) == 64 && offsetof(ViewData, clipPlane) == 112 &&
              offsetof(ViewData, background) == 144 && offsetof(ViewData, traceOffset) == 208 &&
              offsetof(ViewData, firstLight) == 240 && sizeof(ViewData) == 256);

struct LightData {
  glm::vec4 position;
  glm::vec4 irradiance;
  glm::vec4 glow;
};
static_assert(offsetof(LightData, glow) == 32 && sizeof(LightData) == 48);

struct InstanceData {
  glm::mat4 clipFromMesh;
  glm::vec4 relativeFromMesh[3];
  glm::vec4 normalFromMesh[3];
  glm::vec4 clipPlane;
  glm::vec4 diffuse;
  glm::vec4 specular;
  glm::vec4 shininess;
};
static_assert(offsetof(InstanceData, relativeFromMesh) == 64 && offsetof(InstanceData, normalFromMesh) == 112 &&
              offsetof(InstanceData, clipPlane) == 160 && offsetof(InstanceData, shininess) == 208 &&
              sizeof(InstanceData) == 224);

struct MaterialData {
  glm::vec4 diffuse;
  glm::vec4 specular;
  glm::vec4 emission;
};
static_assert(offsetof(MaterialData, emission) == 32 && sizeof(MaterialData) == 48);

struct MirrorData {
  glm::vec4 plane;
  glm::vec4 reflectance;
  glm::vec4 baseColor;
  glm::vec4 lookup;
  glm::ivec4 image;
  glm::vec4 reproject[3];
};
static_assert(offsetof(MirrorData, lookup) == 48 && offsetof(MirrorData, image) == 64 &&
              offsetof(MirrorData, reproject) == 80 && sizeof(MirrorData) == 128);

enum class MirrorShows { image, background, back };
enum class Lookup { fetch, bilinear, box };

struct DrawConstants {
  uint32_t viewIndex;
  uint32_t drawIndex;
  uint32_t firstTriangle;
};

// Of display.frag.
struct DisplayConstants {
  glm::vec4 lookup;  // texel = pixel * xy + zw
  float exposure;
};

// Of check_finite.glsl.
struct CheckSearch {
  uint32_t pixel;
  uint32_t count;
  uint32_t any;
};

struct CheckFound {
  glm::vec4 value;
  uint32_t sample;
  uint32_t pad[3];
};
static_assert(offsetof(CheckFound, sample) == 16 && sizeof(CheckFound) == 32);

struct CheckConstants {
  uint32_t width;
  uint32_t height;
};

// What probe_texel.glsl writes and is told.
struct ProbedTexel {
  glm::vec4 mean;
  glm::vec4 first;
};

struct ProbeConstants {
  int32_t x;
  int32_t y;
};

// Vertex buffer layout; locations 0, 1, 2 of scene.vert.
struct GpuVertex {
  glm::vec3 position;
  glm::vec3 normal;
  glm::vec2 uv;
};
static_assert(offsetof(GpuVertex, normal) == 12 && offsetof(GpuVertex, uv) == 24 && sizeof(GpuVertex) == 32);

}  // namespace speculum
