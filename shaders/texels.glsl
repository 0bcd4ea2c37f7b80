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
