// Stores the plane that a light sees: its disparity from the light, in 1/m, and the growth of the disparity to the next
// texel on the right and below, as the upper halves of two floats.

layout(location = 0) out uvec2 plane;

void storePlane() {
  float disparity = gl_FragCoord.w;
  uvec2 rise = floatBitsToUint(clamp(vec2(dFdx(disparity), dFdy(disparity)), -1e37, 1e37)) + 0x8000u;
  plane = uvec2(floatBitsToUint(disparity), (rise.x & 0xffff0000u) | rise.y >> 16);
}
