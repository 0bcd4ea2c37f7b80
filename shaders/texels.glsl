// Reads of an image's radiance that are the same for images with one sample and with several: a multisampled texel
// stands for the mean of its samples.

vec3 texelRadiance(sampler2D image, ivec2 texel) { return texelFetch(image, texel, 0).rgb; }

vec3 texelRadiance(sampler2DMS image, ivec2 texel) {
  int count = textureSamples(image);
  vec3 sum = vec3(0.0);
  for (int i = 0; i < count; ++i) {
    sum += texelFetch(image, texel, i).rgb;
  }
  return sum / float(count);
}

// At `position` in texels, which lies half a texel or more inside the part of the image that is used.
vec3 bilinearRadiance(sampler2D image, vec2 position) {
  return textureLod(image, position / vec2(textureSize(image, 0)), 0.0).rgb;
}

vec3 bilinearRadiance(sampler2DMS image, vec2 position) {
  vec2 corner = floor(position - 0.5);
  vec2 weight = position - 0.5 - corner;
  ivec2 low = ivec2(corner);
  ivec2 high = ivec2(ceil(position - 0.5));
  vec3 top = mix(texelRadiance(image, low), texelRadiance(image, ivec2(high.x, low.y)), weight.x);
  vec3 bottom = mix(texelRadiance(image, ivec2(low.x, high.y)), texelRadiance(image, high), weight.x);
  return mix(top, bottom, weight.y);
}
