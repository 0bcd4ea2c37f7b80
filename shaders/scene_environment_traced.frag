#version 450
#extension GL_GOOGLE_include_directive : require
#define TRACED
#define ENVIRONMENT
#include "scene_shading.glsl"
