#version 450
#extension GL_GOOGLE_include_directive : require
#include "shadow_plane.glsl"

void main() { storePlane(); }
