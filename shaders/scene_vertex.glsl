// The vertex shader of objects. With VERTEX_COLORS it hands on the colors of vertices, with HANDS_ON values that the
// fragment shader would read from uniform buffers.
#define VERTEX
#define HANDED out
#include "interface.glsl"

layout(constant_id = constantClipAtMirror) const bool clipAtMirror = false;

layout(location = 0) in vec3 position;  // mesh space
layout(location = 1) in vec3 normal;
layout(location = 2) in vec2 uv;
// Members of the instance's InstanceData. They are attributes, because lavapipe fetches these once for all vertices
// that it shades at a time, but reads a storage buffer anew for each vertex.
layout(location = 3) in mat4 clipFromMesh;
layout(location = 7) in vec4 relativeFromMesh[3];  // rows
layout(location = 10) in vec4 normalFromMesh[3];   // rows
layout(location = 13) in vec4 clipPlane;           // in mesh space
#ifdef VERTEX_COLORS
layout(location = 14) in vec4 color;  // alpha 1 unless the mesh's colors have it
#endif

#include "object_values.glsl"
#ifdef HANDS_ON
layout(push_constant) uniform Draw { DrawConstants draw; };
#endif

out gl_PerVertex {
  vec4 gl_Position;
  float gl_ClipDistance[1];
};

// A reflection that is added to a base passes the test for equal depth only if both draws have the same positions.
invariant gl_Position;

void main() {
  vec4 p = vec4(position, 1.0);
  vec3 relative = vec3(dot(relativeFromMesh[0], p), dot(relativeFromMesh[1], p), dot(relativeFromMesh[2], p));
  positionAndU = vec4(relative, uv.x);
  // Not normalised here: interpolation has to be linear in the mesh's own normals.
  normalAndV = vec4(dot(normalFromMesh[0].xyz, normal), dot(normalFromMesh[1].xyz, normal),
                    dot(normalFromMesh[2].xyz, normal), uv.y);
  indexAndReach = uvec2(gl_InstanceIndex, floatBitsToUint(normalFromMesh[0].w));
#ifdef VERTEX_COLORS
  vertexColor = color;
#endif
#ifdef HANDS_ON
  handOnPass();
  handedDiffuse = vec4(draw.diffuse, draw.shininess);
  handedSpecular = vec4(draw.specular, draw.handedness);
  handedEmission = draw.emission;
#endif
  gl_Position = clipFromMesh * p;
  // A vertex nearer to the eye than its rounding error has no reliable direction; the triangle is clipped there.
  vec3 offset = vec3(relativeFromMesh[0].w, relativeFromMesh[1].w, relativeFromMesh[2].w);
  const float rounding2 = 5.7e-14;  // (2^-22)^2
  bool atEye = dot(relative, relative) <= rounding2 * dot(offset, offset);
  gl_ClipDistance[0] = atEye ? -1e30 : clipAtMirror ? dot(clipPlane, p) : 1.0;
}
