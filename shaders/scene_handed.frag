#version 450
#extension GL_GOOGLE_include_directive : require
#define HANDS_ON
#include "scene_shading.glsl"
