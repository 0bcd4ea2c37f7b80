#version 450
#extension GL_GOOGLE_include_directive : require
#include "../common/display.glsl"

layout(set = 0, binding = 1) uniform sampler2D image;  // linear radiance

layout(push_constant) uniform Mirror {
  mat4 worldFromMirror;
  vec4 reflectance;
  uint naive;
} mirror;

layout(location = 0) in vec2 uv;

// Most demos stretch a picture over the mirror, flip it, and blur it a little.
vec3 stretched() {
  vec3 sum = vec3(0.0);
  for (int i = 0; i < 9; ++i) {
    vec2 offset = vec2(i % 3 - 1, i / 3 - 1) / vec2(textureSize(image, 0));
    sum += texture(image, vec2(1.0 - uv.x, 1.0 - uv.y) + offset).rgb;
  }
  return sum / 9.0;
}

// A point of the mirror has the same pixel in both views, so the texel there is what the mirror shows at this point.
void main() {
  vec3 reflected = mirror.naive != 0 ? stretched() : texelFetch(image, ivec2(gl_FragCoord.xy), 0).rgb;
  show(mirror.reflectance.rgb * reflected);
}
