#version 450
#extension GL_GOOGLE_include_directive : require
#define COVERED
#define SHADOW_MAPS
#include "scene_shading.glsl"
