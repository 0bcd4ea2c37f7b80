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

// Texels of an image that lie outside the mirror have a negative disparity: MaskSystem::markOutside().
bool isOutside(vec4 value) { return value.a < 0.0; }

// Returns the texel's mean of what lies inside the mirror, or outside it if nothing does.
vec4 insideMean(sampler2D image, ivec2 texel) { return texelFetch(image, texel, 0); }

vec4 insideMean(sampler2DMS image, ivec2 texel) {
  vec4 sum = vec4(0.0);
  float count = 0.0;
  for (int i = 0; i < textureSamples(image); ++i) {
    vec4 value = texelFetch(image, texel, i);
    sum += isOutside(value) ? vec4(0.0) : value;
    count += isOutside(value) ? 0.0 : 1.0;
  }
  return count > 0.0 ? sum / count : texelFetch(image, texel, 0);
}
