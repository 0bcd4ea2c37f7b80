#version 450
#extension GL_GOOGLE_include_directive : require
#define PROBED_IMAGE sampler2DMS
#include "probe_texel.glsl"
