// What the CPU writes every frame; src/systems/gpu_types.hpp declares the same and asserts the same offsets.
// "Relative" is world space minus the eye of the pass's view: small numbers near the eye wherever the scene lies.

struct ViewData {
  mat4 clipFromRelative;
  vec4 rayX;  // direction of the ray through a pixel: rayX * x + rayY * y + rayOrigin, relative, not normalised
  vec4 rayY;
  vec4 rayOrigin;
  vec4 clipPlane;  // (n, h): a point p (relative) is drawn where n.p + h >= 0
  vec4 ambient;
  vec4 background;  // w: 1 with a sky, else 0
  vec4 zenith;
  vec4 horizon;
  vec4 ground;
  vec4 traceOffset;  // from relative to trace space (trace.glsl)
  vec4 throughput;   // of the mirrors up to this view; w: that below which a bounce is dropped
  uint firstLight;
  uint lightCount;
  uint depth;     // of the mirrors seen in this view
  uint maxDepth;  // mirrors of this depth show the background
};

struct LightData {
  vec4 position;    // relative; w: radius in metres
  vec4 irradiance;  // at 1 m, facing the light; w: 1 casts shadows
  vec4 glow;        // radiance of the glyph; w: 1 unless there is none
};

struct InstanceData {
  mat4 clipFromMesh;
  vec4 relativeFromMesh[3];  // rows
  vec4 normalFromMesh[3];    // rows; w of the first: sign of the transform's determinant
  vec4 clipPlane;            // in mesh space
  vec4 diffuse;              // w: 1 replaces the material's
  vec4 specular;             // w: 1 replaces the material's
  vec4 shininess;            // x: 0 keeps the material's; y: index into traceInstances; z: of a curved mirror with an
                             // environment map, into mirrors
};

struct MaterialData {
  vec4 diffuse;   // w: 0, or 1 + the index of its texture
  vec4 specular;  // w: shininess
  vec4 emission;
};

struct MirrorData {
  vec4 plane;        // (n, h): facing the eye, h > 0 is the eye's distance
  vec4 reflectance;  // w: 1 for Schlick's Fresnel
  vec4 baseColor;    // of the diffuse layer or of the back
  vec4 lookup;       // texel of the image = pixel of the pass * xy + zw
  ivec4 image;       // width and height of the image's used part in texels; w: index into traceMirrors
  vec4 reproject[3]; // columns 0, 1, 2 of a matrix and in their w a vector: homogeneous texel of an image of an earlier
                     // frame = matrix * (pixel of the pass, 1) + vector * disparity;
                     // or of a rough mirror: alpha of GGX and number of look-ups in the first one
};

// Of a curved mirror with an environment map: plane is the map's centre, relative, w: 0 shows the background in its place;
// reflectance and baseColor as above; lookup is the low corner of the box around it, from the centre, w: 0 without a box;
// reproject[0] the high corner; image.x the texels of a side of a face.

const int showsImage = 0;
const int showsBackground = 1;
const int showsBack = 2;
const int lookupFetch = 0;
const int lookupBilinear = 1;
const int lookupBox = 2;

layout(set = 0, binding = 0, std430) readonly buffer Views { ViewData views[]; };
layout(set = 0, binding = 1, std430) readonly buffer Lights { LightData lights[]; };
layout(set = 0, binding = 2, std430) readonly buffer Instances { InstanceData instances[]; };
layout(set = 0, binding = 3, std430) readonly buffer Materials { MaterialData materials[]; };
layout(set = 0, binding = 4, std430) readonly buffer Mirrors { MirrorData mirrors[]; };
layout(set = 0, binding = 5, std430) readonly buffer MirrorVertices { vec4 mirrorVertices[]; };  // clip space

layout(push_constant) uniform DrawConstants {
  uint viewIndex;
  uint drawIndex;      // material or mirror
  uint firstTriangle;  // of the draw, in its mesh
}
draw;

vec3 rayThrough(ViewData view, vec2 pixel) {
  return view.rayX.xyz * pixel.x + view.rayY.xyz * pixel.y + view.rayOrigin.xyz;
}
