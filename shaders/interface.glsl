// Buffers that FrameData (src/systems/frame_data.hpp) fills every frame, except `materials`. Values that are the same
// for all pixels of a draw are in uniform buffers, at the dynamic offset of the pass or of the mirror, because lavapipe
// reads a storage buffer anew for each pixel.
#include "gpu_data.h"

layout(set = 0, binding = 0, std140) uniform Pass {
  ViewData view;
  LightData passLights[fixedLights];
  LightGroup lightGroups[mostLightGroups];
};
layout(set = 0, binding = 1, std140) uniform DrawnMirror { MirrorData drawnMirror; };
layout(set = 0, binding = 2, std430) readonly buffer Lights { LightData lights[]; };  // of all passes
layout(set = 0, binding = 3, std430) readonly buffer Instances { InstanceData instances[]; };
layout(set = 0, binding = 4, std430) readonly buffer CurvedMirrors { CurvedMirrorData curvedMirrors[]; };
layout(set = 0, binding = 5, std430) readonly buffer MirrorVertices { vec4 mirrorVertices[]; };  // clip space
layout(set = 0, binding = 6, std430) readonly buffer Repeating { RepeatingTriangle repeatingTriangles[]; };
layout(set = 0, binding = 7, std430) readonly buffer Materials { MaterialData materials[]; };

vec3 rayThrough(vec2 pixel) { return view.rayX * pixel.x + view.rayY.xyz * pixel.y + view.rayOrigin.xyz; }
