// Requests of deferred shading: the surfaces to shade. Needs shaded.glsl.

const uint requestsPerGroup = 128;

// A request is a pixel's number, above a bit for each sample that sees the surface.
layout(set = SHADED_SET, binding = 2, std430) buffer Requests {
  uint requestGroups;  // of the dispatch that shades, in x
  uint oneGroup[2];    // in y and z
  uint requestCount;
  uint requests[];
};
