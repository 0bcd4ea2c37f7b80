#version 450
#extension GL_GOOGLE_include_directive : require
#define HANDS_ON
#define SHADOW_MAPS
#include "scene_shading.glsl"
