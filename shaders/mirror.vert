#version 450
#extension GL_GOOGLE_include_directive : require
#define VERTEX
#define HANDED out
#include "interface.glsl"
#include "mirror_values.glsl"

// A reflection that is added to a base passes the test for equal depth only if both draws have the same positions.
invariant gl_Position;

// The polygon is cut at the pass's clip plane and brought to clip space in double on the CPU.
void main() {
  gl_Position = mirrorVertices[gl_VertexIndex];
  handOnPass();
  handedNormal = vec4(drawnMirror.normal, drawnMirror.eyeDistance);
  handedReflectance = vec4(drawnMirror.reflectance, drawnMirror.schlick);
  handedBaseColor = drawnMirror.baseColor;
  handedLookup = vec4(drawnMirror.lookupScale, drawnMirror.lookupOffset);
  handedRayX = vec4(view.rayX, drawnMirror.imageSize.x);
  handedRayY = vec4(view.rayY.xyz, drawnMirror.imageSize.y);
  handedRayOrigin = view.rayOrigin.xyz;
}
