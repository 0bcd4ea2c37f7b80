// Values that the vertex shader of mirrors hands on, as handed_values.glsl does.
#include "handed_values.glsl"
layout(location = 0) flat HANDED vec4 handedNormal;       // of the mirror; w: eyeDistance
layout(location = 1) flat HANDED vec4 handedReflectance;  // w: schlick
layout(location = 2) flat HANDED vec3 handedBaseColor;
layout(location = 3) flat HANDED vec4 handedLookup;  // scale and offset
layout(location = 4) flat HANDED vec4 handedRayX;    // of the pass; w: width of the image
layout(location = 5) flat HANDED vec4 handedRayY;    // w: its height
layout(location = 6) flat HANDED vec3 handedRayOrigin;
