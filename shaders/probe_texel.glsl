// Reads one texel of an image. PROBED_IMAGE is the image's type.
#include "gpu_data.h"
#include "texels.glsl"

layout(local_size_x = 1) in;

layout(set = 0, binding = 0) uniform PROBED_IMAGE probedImage;

layout(set = 0, binding = 1, std430) writeonly buffer Probed { ProbedTexel probed; };

layout(push_constant) uniform Constants { ProbeConstants probe; };

void main() {
  vec4 mean = insideMean(probedImage, probe.texel);
  probed.mean = vec4(mean.rgb, max(mean.a, 0.0));
  probed.first = texelFetch(probedImage, probe.texel, 0);
}
