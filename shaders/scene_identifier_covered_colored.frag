#version 450
#extension GL_GOOGLE_include_directive : require
#define VERTEX_COLORS
#include "scene_identifier_covered.glsl"
