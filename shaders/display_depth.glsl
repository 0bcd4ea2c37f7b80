// A depth image made readable: 0 is infinitely far and black, `halfDepth` is shown half bright, the eye white. Of a texel with
// several samples the first one: depth has no mean where surfaces meet.
layout(set = 0, binding = 0) uniform DISPLAY_IMAGE depth;

layout(push_constant) uniform DisplayConstants {
  vec4 lookup;      // texel = pixel * xy + zw
  float halfDepth;  // depth shown half bright
};

layout(location = 0) out vec4 color;

void main() {
  float d = texelFetch(depth, ivec2(gl_FragCoord.xy * lookup.xy + lookup.zw), 0).r;
  color = vec4(vec3(d / (d + halfDepth)), 1.0);
}
