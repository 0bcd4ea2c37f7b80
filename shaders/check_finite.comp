#version 450
#extension GL_GOOGLE_include_directive : require
#define CHECKED_IMAGE sampler2D
#include "check_finite.glsl"
