#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_ray_query : require
#define RAY_QUERY
#define MIRROR_IMAGE sampler2D
#define TRACED
#include "mirror_shading.glsl"
