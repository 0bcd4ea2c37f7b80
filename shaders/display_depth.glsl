// Shows a depth image by distance: black infinitely far away, half bright at halfDepth, white at the eye. A texel with
// several samples shows the first one, because depth has no mean where surfaces meet.
#include "gpu_data.h"

layout(set = 0, binding = 0) uniform DISPLAY_IMAGE depth;

layout(push_constant) uniform Constants { DepthViewConstants display; };

layout(location = 0) out vec4 color;

void main() {
  float d = texelFetch(depth, ivec2(gl_FragCoord.xy * display.lookup.xy + display.lookup.zw), 0).r;
  color = vec4(vec3(d / (d + display.halfDepth)), 1.0);
}
