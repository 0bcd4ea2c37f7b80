#version 450
#extension GL_GOOGLE_include_directive : require
#define SURFACES sampler2D
#include "collect_surfaces.glsl"
