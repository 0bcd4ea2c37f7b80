#version 450
#extension GL_GOOGLE_include_directive : require
#define SHADOW_MAPS
#define MIRROR_IMAGE sampler2DMS
#include "mirror_shading.glsl"
