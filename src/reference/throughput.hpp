#pragma once

#include <cstdint>

namespace speculum {

// Speed of the tracer's closest-hit queries on a generated mesh, on one thread.
struct RayThroughput {
  int64_t triangles = 0;
  int64_t rays = 0;
  double hitFraction = 0.0;   // of the rays
  double seconds = 0.0;       // of processor time
  double buildSeconds = 0.0;  // of processor time, to build the mesh's bounding volume hierarchy

  double raysPerSecond() const { return static_cast<double>(rays) / seconds; }
};

// Measures a bumpy sphere of about `triangles` triangles and rays from random origins around the sphere to random
// points near the sphere, in no order that would help a cache. The rays are the same in every run.
RayThroughput measureRayThroughput(int64_t triangles, int64_t rays);

}  // namespace speculum
