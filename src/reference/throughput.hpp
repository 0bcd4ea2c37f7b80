#pragma once

#include <cstdint>

namespace speculum {

// How fast the tracer's rays are: closest hits on a generated mesh, by one thread.
struct RayThroughput {
  int64_t triangles = 0;
  int64_t rays = 0;
  double hitFraction = 0.0;   // of the rays
  double seconds = 0.0;       // of processor time
  double buildSeconds = 0.0;  // of processor time, for the mesh's hierarchy

  double raysPerSecond() const { return static_cast<double>(rays) / seconds; }
};

// A bumpy sphere of about that many triangles, and rays with random origins around it towards random points near it,
// in no order that would help a cache. The rays are the same in every run.
RayThroughput measureRayThroughput(int64_t triangles, int64_t rays);

}  // namespace speculum
