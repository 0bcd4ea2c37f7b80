#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_ray_query : require
#define ASKS
#define RAY_QUERY
#include "shade.glsl"
