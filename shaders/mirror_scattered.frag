#version 450
#extension GL_GOOGLE_include_directive : require
#include "interface.glsl"
#include "shading.glsl"
#include "trace.glsl"
#include "traced_light.glsl"
#include "traced_path.glsl"

layout(location = 0) out vec4 color;

// A mirror that no image of a plane can show. Where the pixel's ray meets it is as in mirror_shading.glsl.
void main() {
  MirrorData mirror = mirrors[draw.drawIndex];
  ViewData view = views[draw.viewIndex];
  vec3 ray = rayThrough(view, gl_FragCoord.xy);
  float inward = min(dot(mirror.plane.xyz, ray), -1e-7 * length(ray));
  vec3 position = ray * (-mirror.plane.w / inward);
  Bounce bounce =
      mirrorBounce(view, uint(mirror.image.w), position + view.traceOffset.xyz, safeNormalize(ray));
  color = storable(tracedRadiance(view, bounce, safeNormalize(ray)), inward / min(-mirror.plane.w, -1e-30));
}
