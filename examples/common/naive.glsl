// Does what most demos do: stretches a picture over the mirror, flips it, and blurs it a little.
vec3 stretched(sampler2D image, vec2 uv) {
  vec3 sum = vec3(0.0);
  for (int i = 0; i < 9; ++i) {
    vec2 offset = vec2(i % 3 - 1, i / 3 - 1) / vec2(textureSize(image, 0));
    sum += texture(image, vec2(1.0 - uv.x, 1.0 - uv.y) + offset).rgb;
  }
  return sum / 9.0;
}
