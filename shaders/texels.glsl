// Lookups in images with one sample or several: a multisampled texel stands for the mean of its samples. Images hold
// radiance in rgb, disparity in a.

vec4 texelMean(sampler2D image, ivec2 texel) { return texelFetch(image, texel, 0); }

vec4 texelMean(sampler2DMS image, ivec2 texel) {
  int count = textureSamples(image);
  vec4 sum = vec4(0.0);
  for (int i = 0; i < count; ++i) {
    sum += texelFetch(image, texel, i);
  }
  return sum / float(count);
}
