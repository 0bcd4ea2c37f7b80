// The window's images hold sRGB, an OffScreen holds linear radiance: light is added up and mirrored before it is encoded.
layout(constant_id = 0) const bool toWindow = false;

layout(location = 0) out vec4 color;

void show(vec3 radiance) {
  vec3 clamped = clamp(radiance, 0.0, 1.0);
  vec3 encoded = mix(1.055 * pow(clamped, vec3(1.0 / 2.4)) - 0.055, 12.92 * clamped, lessThanEqual(clamped, vec3(0.0031308)));
  color = vec4(toWindow ? encoded : radiance, 1.0);
}
