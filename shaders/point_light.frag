#version 450
#extension GL_GOOGLE_include_directive : require
#include "interface.glsl"
#include "shading.glsl"

layout(location = 0) flat in uint lightIndex;
layout(location = 0) out vec4 color;

bool visible(vec3 ray, float t) {
  return t > 0.0 && dot(view.clipPlane.xyz, ray * t) + view.clipPlane.w >= 0.0;
}

// Intersects a ray with a sphere. Computes the squared distance of centre and ray directly, because the textbook
// discriminant cancels for small, distant glyphs.
void main() {
  LightData light = lights[lightIndex];
  vec3 ray = safeNormalize(rayThrough(gl_FragCoord.xy));
  float middle = dot(ray, light.position);
  vec3 offset = light.position - middle * ray;
  float halfChord2 = light.radius * light.radius - dot(offset, offset);
  if (halfChord2 < 0.0) {
    discard;
  }
  float halfChord = sqrt(halfChord2);
  float t = visible(ray, middle - halfChord) ? middle - halfChord : middle + halfChord;
  if (!visible(ray, t)) {
    discard;
  }
  vec4 clip = view.clipFromRelative * vec4(ray * t, 1.0);
  gl_FragDepth = clamp(clip.z / clip.w, 0.0, 1.0);
  color = storable(light.glow, disparityLength / max(clip.w, 1e-30), gl_FragCoord.xy);
}
