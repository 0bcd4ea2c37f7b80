#version 450
#extension GL_GOOGLE_include_directive : require
#define DISPLAY_IMAGE sampler2D
#define DISPLAY_ENLARGED
#include "display.glsl"
