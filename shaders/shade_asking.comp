#version 450
#extension GL_GOOGLE_include_directive : require
#define ASKS
#include "shade.glsl"
