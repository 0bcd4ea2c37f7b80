#ifndef SPECULUM_CUBE_FACE
#define SPECULUM_CUBE_FACE
// The six images about a point, the faces of an environment map or a shadow map: src/plan/cube_face.hpp.

// The face that shows a direction.
struct FaceDirection {
  int axis;
  float side;   // 1 towards the positive axis, else -1
  float along;  // component of the direction along the face's axis
};

FaceDirection cubeFace(vec3 d) {
  vec3 a = abs(d);
  int axis = a.x >= a.y && a.x >= a.z ? 0 : a.y >= a.z ? 1 : 2;
  float component = axis == 0 ? d.x : axis == 1 ? d.y : d.z;
  return FaceDirection(axis, component < 0.0 ? -1.0 : 1.0, abs(component));
}

// Returns the face with this index, for a direction that it shows.
FaceDirection faceOf(uint index, vec3 d) {
  int axis = int(index / 2);
  return FaceDirection(axis, index % 2 == 0 ? 1.0 : -1.0, abs(d[axis]));
}

int indexOf(FaceDirection face) { return 2 * face.axis + (face.side < 0.0 ? 1 : 0); }

// Returns the components of a vector to the right and down in the face. FaceAxes has the axes.
vec2 inFace(FaceDirection face, vec3 v) {
  return vec2(face.side * (face.axis == 0 ? v.z : face.axis == 1 ? v.x : -v.x), face.axis == 1 ? -v.z : -v.y);
}
#endif
