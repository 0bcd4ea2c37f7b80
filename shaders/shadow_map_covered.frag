#version 450
#extension GL_GOOGLE_include_directive : require
#include "shadow_map_covered.glsl"
