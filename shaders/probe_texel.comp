#version 450
#extension GL_GOOGLE_include_directive : require
#define PROBED_IMAGE sampler2D
#include "probe_texel.glsl"
