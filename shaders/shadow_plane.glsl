// Stores the plane that a light sees: its disparity from the light, in 1/m, and the growth of the disparity to the next
// texel on the right and below, as the upper halves of two floats.

layout(location = 0) out uvec2 plane;

void storePlane() {
  float disparity = gl_FragCoord.w;
  uvec2 rise = floatBitsToUint(clamp(vec2(dFdx(disparity), dFdy(disparity)), -1e37, 1e37)) + 0x8000u;
  plane = uvec2(floatBitsToUint(disparity), (rise.x & 0xffff0000u) | rise.y >> 16);
}

#ifdef OBJECT
// Says whether the light lies in the triangle's plane, as far as rounding tells. Such a triangle hides nothing, but
// rounding may put it before all that lies on one of its sides. The plane is that of the points x with m.x = 1, whose
// distance from the light is 1 / |m|. It is seen along `ray` at the disparity m.ray.
bool holdsLight() {
  vec3 ray = rayThrough(gl_FragCoord.xy);
  vec3 m = view.rayX * (dFdx(gl_FragCoord.w) / dot(view.rayX, view.rayX)) +
           view.rayY.xyz * (dFdy(gl_FragCoord.w) / dot(view.rayY.xyz, view.rayY.xyz));
  float forward = gl_FragCoord.w - dot(m, ray);
  float height = inversesqrt(dot(m, m) + forward * forward);
  return !(height >= leastHeight * uintBitsToFloat(indexAndReach.y));  // where it is not a number as well
}
#endif
