#version 450
#extension GL_GOOGLE_include_directive : require
#define COVERED
#include "scene_shading.glsl"
