#ifndef SPECULUM_CUBE_FACE
#define SPECULUM_CUBE_FACE
// The six images about a point: src/frame/cube_face.hpp.

// The face that shows a direction.
struct CubeFace {
  int index;
  vec3 forward;
  vec3 right;
  vec3 down;
  float along;  // component of the direction along `forward`
};

CubeFace cubeFace(vec3 d) {
  vec3 a = abs(d);
  int axis = a.x >= a.y && a.x >= a.z ? 0 : a.y >= a.z ? 1 : 2;
  float side = d[axis] < 0.0 ? -1.0 : 1.0;
  vec3 forward = vec3(0.0);
  forward[axis] = side;
  vec3 up = axis == 1 ? vec3(0.0, 0.0, 1.0) : vec3(0.0, 1.0, 0.0);
  return CubeFace(2 * axis + (side < 0.0 ? 1 : 0), forward, cross(forward, up), -up, a[axis]);
}
#endif
