#version 450
#extension GL_GOOGLE_include_directive : require
#include "scene_identifier_covered.glsl"
