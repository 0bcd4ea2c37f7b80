// Requests of deferred shading: the surfaces to shade. Needs shaded.glsl.

const uint requestsPerGroup = 128;

// A request holds a pixel's number in its upper bits and a bit for each sample that sees the surface in its lower ones.
layout(set = SHADED_SET, binding = 2, std430) buffer Requests {
  uint requestGroups;  // groups of the dispatch that shades, in x
  uint oneGroup[2];    // groups of this dispatch, in y and z
  uint requestCount;
  uint requests[];
};
