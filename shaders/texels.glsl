// Reads of an image that are the same for images with one sample and with several: a multisampled texel stands for the
// mean of its samples. Radiance in rgb, disparity in a.

vec4 texelMean(sampler2D image, ivec2 texel) { return texelFetch(image, texel, 0); }

vec4 texelMean(sampler2DMS image, ivec2 texel) {
  int count = textureSamples(image);
  vec4 sum = vec4(0.0);
  for (int i = 0; i < count; ++i) {
    sum += texelFetch(image, texel, i);
  }
  return sum / float(count);
}

// At `position` in texels, which lies half a texel or more inside the part of the image that is used.
vec4 bilinearMean(sampler2D image, vec2 position) {
  return textureLod(image, position / vec2(textureSize(image, 0)), 0.0);
}

vec4 bilinearMean(sampler2DMS image, vec2 position) {
  vec2 corner = floor(position - 0.5);
  vec2 weight = position - 0.5 - corner;
  ivec2 low = ivec2(corner);
  ivec2 high = ivec2(ceil(position - 0.5));
  vec4 top = mix(texelMean(image, low), texelMean(image, ivec2(high.x, low.y)), weight.x);
  vec4 bottom = mix(texelMean(image, ivec2(low.x, high.y)), texelMean(image, high), weight.x);
  return mix(top, bottom, weight.y);
}
