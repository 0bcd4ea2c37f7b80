// Reads one texel of an image that is looked at. PROBED_IMAGE is its type.
#include "texels.glsl"

layout(local_size_x = 1) in;

layout(set = 0, binding = 0) uniform PROBED_IMAGE probedImage;

layout(set = 0, binding = 1, std430) writeonly buffer Probed {
  vec4 mean;   // of the samples
  vec4 first;  // sample: depth has no mean
}
probed;

layout(push_constant) uniform ProbeConstants {
  ivec2 texel;
};

void main() {
  probed.mean = texelMean(probedImage, texel);
  probed.first = texelFetch(probedImage, texel, 0);
}
