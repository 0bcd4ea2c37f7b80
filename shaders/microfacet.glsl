// Normals of rippled mirrors, and random directions of rough ones, the same on every run. Needs shading.glsl.

#include "random.glsl"

// Returns a shift for recurrencePoint() that continues the sequence of a seed at point number `first`. Whole numbers
// keep it exact.
vec2 recurrenceShift(uint seed, uint first) {
  uvec2 step = first * uvec2(3242174889u, 2447445414u);  // of recurrencePoint, times 2^32
  return vec2(unitInterval(seed), unitInterval(mixedBits(seed + 1))) + vec2(unitInterval(step.x), unitInterval(step.y));
}

// Returns a point of the additive recurrence of the plastic number: Roberts, "The Unreasonable Effectiveness of
// Quasirandom Sequences" (2018).
vec2 recurrencePoint(vec2 shift, int index) {
  return fract(shift + float(index) * vec2(0.7548776662466927, 0.5698402909980532));
}

// `count` points that cover the unit square evenly: the lattice (i / count, i * golden ratio), moved as a whole by a
// shift within one of its cells. If shifts are uniform in the cell, the points together are uniform in the square,
// while point i stays in a cell of its own: the rays of point i in neighbouring pixels go about the same way, and the
// pixels take the same branches.
struct Lattice {
  vec2 shift;
  int count;
};

const float golden = 0.6180339887498949;

// Returns a lattice that is shifted to `place` in the cell, 0 .. 1 along each side.
Lattice latticeOf(vec2 place, int count) {
  // Two successive vectors of a Fibonacci sequence span a cell. They grow in x and shrink in y; the loop ends where
  // both sides of the cell are about equally long.
  vec2 a = vec2(0.0, -1.0);
  vec2 b = vec2(1.0 / float(count), golden);
  while (b.x < abs(b.y)) {
    vec2 next = a + b;
    a = b;
    b = next;
  }
  return Lattice(place.x * a + place.y * b, count);
}

// Returns point number `index`, 0 .. count - 1. A point that the shift moves across a side in x comes back as the point
// `count` numbers away.
vec2 latticePoint(Lattice lattice, int index) {
  float x = lattice.shift.x + float(index) / float(lattice.count);
  float sides = floor(x);
  return vec2(x - sides, fract(lattice.shift.y + (float(index) - sides * float(lattice.count)) * golden));
}

// Samples a normal of GGX with density D(m)(n.m) about n: Walter et al., "Microfacet Models for Refraction through
// Rough Surfaces" (2007), equations 35 and 36. Computed from the cosine, the sine would be lost below an alpha of 2e-4.
vec3 microfacet(vec3 n, float alpha, vec2 u) {
  vec2 squares = vec2(1.0 - u.x, alpha * alpha * u.x);  // of cosine and sine, times their sum
  vec2 turn = sqrt(squares / (squares.x + squares.y));
  float angle = 2.0 * pi * u.y;
  vec3 x = safeNormalize(cross(abs(n.x) < 0.5 ? vec3(1.0, 0.0, 0.0) : vec3(0.0, 1.0, 0.0), n));
  vec3 y = cross(n, x);
  return turn.y * (cos(angle) * x + sin(angle) * y) + turn.x * n;
}

// Says whether m faces the viewer, who looks along `direction`, and mirrors the direction to the plane's own side.
bool staysAbove(vec3 direction, vec3 m, vec3 planeNormal) {
  return dot(m, direction) < 0.0 && dot(direction - 2.0 * dot(direction, m) * m, planeNormal) > 0.0;
}

// Returns the normal of a mirror whose ripples rise along `normal`. `local` is relative to the point at which the two
// trains of waves have these phases.
vec3 rippledNormal(vec3 normal, vec3 axisX, vec3 axisY, vec3 local, float waveNumber, float slope, vec2 phases) {
  float x = dot(local, axisX);
  float y = dot(local, axisY);
  vec3 first = slope * cos(waveNumber * x + phases.x) * axisX;
  vec3 second = slope * cos(waveNumber * (0.6 * x + 0.8 * y) + phases.y) * (0.6 * axisX + 0.8 * axisY);
  return safeNormalize(normal - first - second);
}
