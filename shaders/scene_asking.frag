#version 450
#extension GL_GOOGLE_include_directive : require
#define SHADOW_MAPS
#define ASKS
#include "scene_shading.glsl"
