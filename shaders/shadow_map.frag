#version 450
// Stores the plane that a light sees: its disparity from the light, in 1/m, and how much that grows to the next texel
// on the right and below, as shares of it.

layout(location = 0) out uvec2 plane;

void main() {
  float disparity = gl_FragCoord.w;
  vec2 rise = vec2(dFdx(disparity), dFdy(disparity)) / max(disparity, 1e-37);
  plane = uvec2(floatBitsToUint(disparity), packHalf2x16(clamp(rise, -6e4, 6e4)));
}
