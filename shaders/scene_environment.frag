#version 450
#extension GL_GOOGLE_include_directive : require
#define ENVIRONMENT
#include "scene_shading.glsl"
