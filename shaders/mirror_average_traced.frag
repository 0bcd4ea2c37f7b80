#version 450
#extension GL_GOOGLE_include_directive : require
#define MIRROR_IMAGE sampler2DMS
#define TRACED
#include "mirror_shading.glsl"
