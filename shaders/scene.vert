#version 450
#extension GL_GOOGLE_include_directive : require
#include "interface.glsl"

layout(constant_id = 0) const bool clipAtMirror = false;

layout(location = 0) in vec3 position;  // mesh space
layout(location = 1) in vec3 normal;
layout(location = 2) in vec2 uv;

layout(location = 0) centroid out vec3 relativePosition;
layout(location = 1) centroid out vec3 relativeNormal;
layout(location = 2) centroid out vec2 textureUv;
layout(location = 3) flat out uint instanceIndex;

out gl_PerVertex {
  vec4 gl_Position;
  float gl_ClipDistance[1];
};

void main() {
  vec4 p = vec4(position, 1.0);
  instanceIndex = gl_InstanceIndex;
  vec4 m0 = instances[gl_InstanceIndex].relativeFromMesh[0];
  vec4 m1 = instances[gl_InstanceIndex].relativeFromMesh[1];
  vec4 m2 = instances[gl_InstanceIndex].relativeFromMesh[2];
  vec3 n0 = instances[gl_InstanceIndex].normalFromMesh[0].xyz;
  vec3 n1 = instances[gl_InstanceIndex].normalFromMesh[1].xyz;
  vec3 n2 = instances[gl_InstanceIndex].normalFromMesh[2].xyz;
  relativePosition = vec3(dot(m0, p), dot(m1, p), dot(m2, p));
  // Not normalised here: interpolation has to be linear in the mesh's own normals.
  relativeNormal = vec3(dot(n0, normal), dot(n1, normal), dot(n2, normal));
  textureUv = uv;
  gl_Position = instances[gl_InstanceIndex].clipFromMesh * p;
  gl_ClipDistance[0] = clipAtMirror ? dot(instances[gl_InstanceIndex].clipPlane, p) : 1.0;
}
