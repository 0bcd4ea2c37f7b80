#version 450
#extension GL_GOOGLE_include_directive : require
#include "../common/display.glsl"
#include "../common/naive.glsl"

layout(set = 0, binding = 1) uniform sampler2D image;  // linear radiance

layout(push_constant) uniform MirrorPush {
  mat4 worldFromMirror;
  vec4 reflectance;
  uint naive;
} mirror;

layout(location = 0) in vec2 uv;

// A point of the mirror has the same pixel in both views, so the texel there is what the mirror shows at this point.
void main() {
  // An image of one pixel is the background: every fragment fetches that pixel.
  ivec2 texel = min(ivec2(gl_FragCoord.xy), textureSize(image, 0) - 1);
  vec3 reflected = mirror.naive != 0 ? stretched(image, uv) : texelFetch(image, texel, 0).rgb;
  show(mirror.reflectance.rgb * reflected);
}
