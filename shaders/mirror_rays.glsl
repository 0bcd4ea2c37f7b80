// The fragment shader of mirrors whose reflections rays show.
#include "interface.glsl"
#include "shading.glsl"
#include "mirror_plane.glsl"
#include "trace.glsl"
#include "traced_light.glsl"
#include "microfacet.glsl"
#include "traced_path.glsl"

// Invocations of a pixel, one for each sample: a sample may see the mirror where the pixel's centre does not.
layout(constant_id = 1) const uint invocations = 1;

layout(location = 0) out vec4 color;

// Returns the number of this invocation. The standard positions of samples lie in strips of their own, which also a
// device without sampleRateShading can tell apart.
uint invocation() { return uint(fract(gl_FragCoord.y) * float(invocations)); }

void main() {
  PlaneHit hit = planeHit();
  vec3 direction = safeNormalize(hit.ray);
  // The CPU turned the normal to the eye in double; near the horizon the ray does not determine the side in float.
  bool front = dot(traceMirrors[mirror.traceMirror].normal, mirror.normal) > 0.0;
  Bounce bounce = mirrorBounce(mirror.traceMirror, hit.position + view.traceOffset.xyz, direction, front);
  uint seed = seedAt(gl_FragCoord.xy);
  uint before = view.picture;
  uint wanted = 1;
  if (bounce.alpha > 0.0) {
    // The samples share the pixel's points, so that many samples and few are equally smooth.
    seed = pixelSeed();
    wanted = (traceCounts.roughSamples + invocations - 1) / invocations;
    before = (view.picture * invocations + invocation()) * wanted;
  }
  color = storable(tracedRadiance(bounce, direction, seed, before, int(wanted)), hit.disparity);
}
