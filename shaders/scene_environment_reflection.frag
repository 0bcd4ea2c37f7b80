#version 450
#extension GL_GOOGLE_include_directive : require
#define ENVIRONMENT
#define REFLECTION_ONLY
#include "scene_shading.glsl"
