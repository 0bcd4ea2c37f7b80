#version 450
#extension GL_GOOGLE_include_directive : require
#define DISPLAY_IMAGE sampler2DMS
#include "display_depth.glsl"
