#version 450
#extension GL_GOOGLE_include_directive : require
#define VERTEX_COLORS
#define REPEATING
#define SHADOW_MAPS
#define ASKS
#include "scene_shading.glsl"
