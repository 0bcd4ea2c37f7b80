// Radiance and disparity that shade.glsl computed: half floats, of each sample of each pixel of the area that the pass
// draws, row by row.

const uint notShaded = 0xffffffff;  // the sample's color is no identifier

uint shadedIndex(uvec2 pixel, uint width, uint samples, uint i) { return (pixel.y * width + pixel.x) * samples + i; }
