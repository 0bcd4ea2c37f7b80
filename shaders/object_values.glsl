// Values that the vertex shader of objects hands on: HANDED is `out` there and `in` in fragment shaders. lavapipe of Mesa 22.3
// stores all inputs of a fragment shader for each triangle, four components at a time, even if none is used.
layout(location = 0) centroid HANDED vec4 positionAndU;  // relative
layout(location = 1) centroid HANDED vec4 normalAndV;    // relative, of any length
layout(location = 2) flat HANDED uvec2 indexAndReach;    // of the instance; bits of a float, metres
#ifdef VERTEX_COLORS
layout(location = 3) centroid HANDED vec4 vertexColor;
#endif
#ifdef HANDS_ON
#include "handed_values.glsl"
layout(location = 4) flat HANDED vec4 handedDiffuse;  // w: shininess
layout(location = 5) flat HANDED vec4 handedSpecular;  // w: handedness
layout(location = 6) flat HANDED vec3 handedEmission;
#endif
