// The fragment shader of mirrors whose reflections rays show.
#include "interface.glsl"
#include "shading.glsl"
#include "mirror_plane.glsl"
#include "trace.glsl"
#include "traced_light.glsl"
#include "microfacet.glsl"
#include "traced_path.glsl"

layout(location = 0) out vec4 color;

void main() {
  PlaneHit hit = planeHit();
  vec3 direction = safeNormalize(hit.ray);
  // The CPU turned the normal to the eye in double; near the horizon the ray does not determine the side in float.
  bool front = dot(traceMirrors[mirror.traceMirror].normal, mirror.normal) > 0.0;
  Bounce bounce = mirrorBounce(mirror.traceMirror, hit.position + view.traceOffset.xyz, direction, front);
  color = storable(tracedRadiance(bounce, direction), hit.disparity);
}
