#version 450
#extension GL_GOOGLE_include_directive : require
#define REPEATING
#include "scene_shading.glsl"
