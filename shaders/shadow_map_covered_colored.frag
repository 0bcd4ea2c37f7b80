#version 450
#extension GL_GOOGLE_include_directive : require
#define VERTEX_COLORS
#include "shadow_map_covered.glsl"
