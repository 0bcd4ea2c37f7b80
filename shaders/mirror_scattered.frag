#version 450
#extension GL_GOOGLE_include_directive : require
#include "interface.glsl"
#include "shading.glsl"
#include "trace.glsl"
#include "traced_light.glsl"
#include "microfacet.glsl"
#include "traced_path.glsl"

layout(location = 0) out vec4 color;

// A mirror that no image of a plane can show. Where the pixel's ray meets it is as in mirror_shading.glsl.
void main() {
  MirrorData mirror = mirrors[draw.mirrorIndex];
  ViewData view = views[draw.viewIndex];
  vec3 ray = rayThrough(view, gl_FragCoord.xy);
  float inward = min(dot(mirror.normal, ray), -1e-7 * length(ray));
  vec3 position = ray * (-mirror.eyeDistance / inward);
  uint index = mirror.traceMirror;
  // The plane is turned to the eye in double; at the horizon the ray itself may not tell.
  bool front = dot(traceMirrors[index].normal, mirror.normal) > 0.0;
  Bounce bounce = mirrorBounce(view, index, position + view.traceOffset.xyz, safeNormalize(ray), front);
  color = storable(tracedRadiance(view, bounce, safeNormalize(ray)), inward / min(-mirror.eyeDistance, -1e-30));
}
