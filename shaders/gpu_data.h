// Structures that C++ and the shaders share; both include this file. Members lie at the same offsets in std430 and, for
// structures of uniform blocks, in std140: a vec3 starts at a multiple of 16 bytes, so a scalar or padding follows each
// vec3, and structures of uniform blocks have no arrays of scalars.
// Relative space: world space minus the eye of the pass's view, for small numbers near the eye wherever the scene lies.
// Trace space: world space minus the eye of the main view, the same for all views of a frame.
#ifndef SPECULUM_GPU_DATA_H
#define SPECULUM_GPU_DATA_H

#ifdef __cplusplus
#include <cstddef>
#include <glm/glm.hpp>

namespace speculum::gpu {

using glm::ivec2;
using glm::mat4;
using glm::uint;
using glm::uvec2;
using glm::vec2;
using glm::vec3;
using glm::vec4;
#endif

// A pass's view, its background and its lights.
struct ViewData {
  mat4 clipFromRelative;
  vec3 rayX;  // relative direction of the ray through a pixel: rayX * x + rayY * y + rayOrigin, not normalised
  uint checksFinite;  // debug.check_finite
  vec4 rayY;       // w: halfTurn() of this view
  vec4 rayOrigin;  // w: 1 in the later pictures of a mean, whose stored radiance is dithered; else 0
  vec4 clipPlane;  // (n, h): a relative point p is drawn where n.p + h >= 0
  vec3 ambient;
  uint picture;  // index in a mean of pictures; seeds random numbers
  vec3 background;
  uint hasSky;  // the background is a gradient of the next three colors
  vec4 zenith;  // w: twice the mean share that the device takes away from sums when it rounds them down; else 0
  vec4 horizon;  // w: exposure of the picture, times radiance as it is stored
  vec3 ground;
  uint inMap;  // 1: the view is a face of an environment map
  vec3 traceOffset;     // added to a relative point gives one in trace space
  uint lightsPerGroup;  // at least 1
  vec3 throughput;      // product of the reflectances of the mirrors up to this view
  float minThroughput;  // below this throughput a mirror shows the background
  uint firstLight;      // in the buffer of lights
  uint lightCount;
  uint depth;     // recursion depth of the mirrors seen in this view
  uint maxDepth;  // mirrors of this depth show the background
};

struct LightData {
  vec3 position;  // relative
  float radius;   // metres
  vec3 irradiance;  // at 1 m, facing the light
  float height;     // of the point that shadow rays lead to, from the nearest plane of a mirror; below 0: no shadow
  vec3 glow;        // radiance of the glyph
  uint hasGlyph;  // for reflected rays
  vec3 clearance;  // from the light to the point that shadow rays lead to
  uint shadowMap;  // index into shadowMaps; noShadowMap: none
};

// A box around the lights of a group.
struct LightGroup {
  vec3 center;  // relative
  uint padding;
  vec3 halfExtent;
  uint padding2;
};

// Metres. The alpha of color targets is the disparity disparityLength / w, with w of clip space, 0 at infinity. A half
// float then holds the disparity from 1 um on; beyond 1 km it has fewer digits than a reprojection needs.
const float disparityLength = 0.0625;

const uint noShadowMap = 0xffffffffu;
const uint mostShadowMaps = 16;

// Stands for the index of a face where the scene lies in several faces of a shadow map.
const uint anyShadowFace = 6;

// Windows of a shadow map's faces. The point (x, y) of the plane one metre before the light, in metres right and down,
// has the texel (x, y) * face.xy + face.zw in the target.
struct ShadowMapData {
  vec4 faces[6];
};

// Number of lights up to which shaders read a pass's lights at addresses that are known when they are compiled.
// lavapipe reads any other address once for each pixel.
const uint fixedLights = 16;

// Number of groups of a pass's lights. A group is a run of ViewData::lightsPerGroup lights; only the last may have fewer.
const uint mostLightGroups = 32;

struct MaterialData {
  vec3 diffuse;
  uint texture;  // index into traceTextures; noTexture: none
  vec3 specular;
  float shininess;
  vec3 emission;
  uint clamps;  // its textures do, instead of repeating
  uint firstColor;  // number of the color of its mesh's first vertex, see TraceScene::firstColorsOf(); noColors: none
  float opacity;
  float cutoff;         // Material::leastOpacity()
  uint opacityTexture;  // as `texture`
};

const uint noTexture = 0xffffffffu;
const uint noColors = 0xffffffffu;

// Colors of an object that replace those of its material.
struct MaterialChange {
  vec3 diffuse;
  uint replacesDiffuse;
  vec3 specular;
  uint replacesSpecular;
  vec3 emission;
  uint replacesEmission;
};

struct InstanceData {
  mat4 clipFromMesh;
  vec4 relativeFromMesh[3];  // rows
  vec4 normalFromMesh[3];    // rows, xyz; all w: metres from the eye to the far end of the instance
  vec4 clipPlane;            // in mesh space
  uint traceInstance;        // index into traceInstances
  uint curvedMirror;         // index into curvedMirrors, for a curved mirror that looks up a map
  uint repeats;              // index into repeatingTriangles - number of the triangle in its mesh
  uint padding;
};

// A triangle whose texture repeats so often that floats of its coordinates lose digits. Instead it has linear functions
// of a point in trace space, computed in double and reduced to small numbers near the eye.
struct RepeatingTriangle {
  vec4 u;
  vec4 v;
  vec4 height;  // above its plane
};

// A mirror in one view.
struct MirrorData {
  vec3 normal;        // of its plane, relative, towards the eye
  float eyeDistance;  // from the plane, above 0
  vec3 reflectance;
  uint schlick;    // reflectance is that at normal incidence
  vec3 baseColor;  // or color of the back
  uint traceMirror;   // index into traceMirrors; of a mirror in several pieces, of the first
  vec2 lookupScale;   // texel of the image = pixel of the pass * lookupScale + lookupOffset
  vec2 lookupOffset;
  ivec2 imageSize;  // texels of the image's used part
  float alpha;      // of GGX, where the image is blurred
  int blurSamples;  // lookups of a blurred image
  // Reprojection: rows of the matrix from (pixel of the pass, 1, disparity) to a homogeneous texel.
  vec4 texelFromPixel[3];
  vec3 axisX;         // of its ripples
  float waveNumber;   // 1/m
  vec3 axisY;
  float rippleSlope;  // steepest; below 0 if waves rise against `normal`
  vec3 rippleOrigin;  // relative
  float firstPhase;   // of its two trains of waves at that point, radians
  float secondPhase;
  uint index;         // of this mirror among the frame's mirrors
  uint showsRipples;  // 1: ripples displace its image
  uint padding;
  // Coordinates of its reflectance map at the relative point p: (mapU.xyz.p + mapU.w, mapV.xyz.p + mapV.w).
  vec4 mapU;
  vec4 mapV;
};

// A mirror at a dynamic offset of a uniform buffer. No device requires offsets to be multiples of more than 256 bytes.
struct MirrorBlock {
  MirrorData mirror;
  vec4 padding[2];
};

// A curved mirror in one view, with the environment map that it looks up.
struct CurvedMirrorData {
  vec3 center;  // of the map, relative
  uint hasMap;  // 0: the background is shown instead
  vec3 low;     // corners of the box around the map's centre, relative to the centre
  uint hasBox;
  vec3 high;
  int faceSize;  // texels of a face's side
  vec3 reflectance;
  uint schlick;
  vec3 baseColor;
  uint padding;
};

// Push constants of a draw of objects, which share a material.
struct DrawConstants {
  vec3 diffuse;
  float shininess;
  vec3 specular;
  float handedness;  // sign of the determinant of the instances' transforms
  vec3 emission;
  uint firstTriangle;  // of the draw, in its mesh
};

// Push constants of a draw of objects whose material has coverage.
struct CoverageConstants {
  DrawConstants draw;
  float opacity;
  float cutoff;  // Material::leastOpacity()
};

// Numbers of specialisation constants. Each has one meaning, in whatever shader it stands.
const uint constantDiffuseLookup = 0;
const uint constantGlossy = 1;
const uint constantBaseOnly = 2;
const uint constantReprojects = 3;
const uint constantAdded = 4;
const uint constantBlurs = 5;
const uint constantRipples = 6;
const uint constantShows = 7;
const uint constantLookup = 8;
const uint constantColored = 9;
const uint constantLightCount = 10;
const uint constantOnlyShadowFace = 11;
const uint constantShadowedLights = 12;
const uint constantClipAtMirror = 13;
const uint constantSamples = 14;
const uint constantPerSample = 15;
const uint constantTextureFilter = 16;
const uint constantRough = 17;
const uint constantRepeating = 18;
const uint constantShadows = 19;
const uint constantCastsLight = 20;
const uint constantEncoding = 21;
const uint constantShrunk = 22;
const uint constantSampled = 23;
const uint constantVertexColors = 24;
const uint constantMapped = 25;
const uint constantTransparency = 26;
const uint constantClamps = 27;
const uint constantBranches = 28;
const uint constantLightGroups = 29;
const uint constantVertexAlpha = 30;
const uint constantWholePixel = 31;

// Stored in the place of a plane's growth in a shadow map: a caster's edge is seen (shadow_edge.frag).
const uint shadowEdge = 0xffffffffu;

// Values of specialisation constants: texture of an object, number of lights, content of a mirror and lookup of its
// image, and what a pass draws: linear radiance, or colors of the display with a tone curve.
const uint textureNone = 0;
const uint textureBilinear = 1;  // of the first level, exact
const uint textureTrilinear = 2;
const uint textureNearest = 3;
const uint textureAnisotropic = 4;
const int mostAnisotropy = 16;  // lookups along the longer side of a pixel's footprint
const uint manyLights = 0xffffffffu;  // more than fixedLights
const uint showsImage = 0;
const uint showsBackground = 1;
const uint showsBack = 2;
const uint lookupFetch = 0;     // one texel at the pixel's own position
const uint lookupInside = 1;    // likewise, but image and pass differ in their samples, so it may lie outside the mirror
const uint lookupBilinear = 2;
const uint lookupBox = 3;
const uint encodingNone = 0;
const uint encodingClamp = 1;
const uint encodingAces = 2;

// A hierarchy's nodes are stored depth first, in one copy for each octant of ray directions, the nearer child first. A
// ray that meets a node's box goes on to the next node; a ray that misses the box goes to `link`, the node after the
// subtree. A leaf's `link` is traceLeaf plus what the leaf holds. Rays of the octant enter a box at its `near` sides.

// A box of the hierarchy over instances and mirrors.
struct TraceTopNode {
  vec3 near;  // trace space
  uint link;  // leaf: index of an instance, plus itemUnreflected if no mirror shows it, or of a mirror plus itemMirror
  vec3 far;
  uint padding;
};

// A box of a mesh's hierarchy.
struct TraceNode {
  uint sides[3];  // x, y and z on the mesh's grid, near + 65536 * far
  uint link;      // leaf: 8 * first triangle + count
};

struct TraceTriangle {
  vec3 a;         // mesh space
  uint triangle;  // number of the triangle in the mesh
  vec3 b;
  uint coverage;  // 1 + index into materials, if the material has coverage; 0: opaque
  vec3 c;
  uint padding2;
};

// A triangle of a mesh, by its number.
struct TraceFace {
  uint vertices[3];  // of its mesh
  uint material;
};

struct TraceVertex {
  vec3 position;  // mesh space
  float u;
  vec3 normal;
  float v;
};

// A level of a texture; the next one, half as wide and high, follows it.
struct TraceTexture {
  uint firstTexel;
  uint width;
  uint height;
};

struct TraceInstance {
  vec4 meshFromTrace[3];  // rows
  vec3 gridLow;           // grid of the boxes = (mesh space - gridLow) * gridScale
  uint root;              // node
  vec3 gridScale;
  uint nodes;  // of an octant
  vec4 normalFromMesh[3];  // rows, xyz; all w: metres from the main view's eye to the far end of the instance
  MaterialChange change;
  vec3 reflectance;  // of a curved mirror
  uint curved;       // one of the curved* constants
  vec3 baseColor;    // of a curved mirror
  float shininess;   // 0: the material's
  uint firstTriangle;  // of its mesh, in traceFaces
  uint firstVertex;    // of its mesh
  uint firstRepeating;  // number, in its mesh, of the first triangle in repeatingTriangles
  uint repeats;         // see InstanceData::repeats
};
const uint traceInstanceTexelCount = 14;

const uint curvedNone = 0;
const uint curvedConstant = 1;
const uint curvedSchlick = 2;

// A convex piece of a planar mirror in trace space, read as texels of 16 bytes.
struct TraceMirror {
  vec3 origin;  // its point near the eye, from which local coordinates are measured
  uint firstVertex;
  vec3 normal;  // unit, to the front
  uint vertexCount;
  vec3 axisX;
  float waveNumber;  // of its ripples, 1/m
  vec3 axisY;
  float rippleSlope;
  vec3 reflectance;
  uint schlick;
  vec3 baseColor;
  uint twoSided;
  vec3 backColor;
  float alpha;        // of GGX; 0: smooth
  float firstPhase;   // of its ripples' two trains of waves at the origin, radians
  uint hasRipple;
  uint plane;   // MirrorState::plane
  uint layers;  // MirrorState::frontLayer and, in the upper half, backLayer
  vec4 mapBox;  // of its reflectance map: 1 / size, -low / size, along the axes
  uint map;     // index into traceTextures; noMap: none
  float secondPhase;
  uint padding[2];
};
const uint traceMirrorTexelCount = 10;
const uint noMap = 0xffffffffu;

// A light's image in a mirror that casts light, in trace space.
struct LightPath {
  vec3 image;
  float radius;
  vec3 irradiance;  // at 1 m, facing the light
  float height;     // as LightData::height
  vec3 light;       // position of the light itself
  uint mirror;      // index into traceMirrors
  float side;       // of the mirror that reflects: 1 the front, -1 the back
  uint padding[3];
};

// Stands before the light paths in their buffer.
struct TraceCounts {
  uint lightPaths;
  uint topNodes;  // of an octant
  uint roughSamples;  // effects.rough_samples
  uint padding;
};

const uint traceLeaf = 0x80000000u;   // bits of a link
const uint itemMirror = 0x40000000u;
const uint itemUnreflected = 0x20000000u;

// Bits of the masks of ray queries: what reflected rays meet, and what rays to lights meet.
const uint maskReflected = 1;
const uint maskShadows = 2;

// Push constants of deferred shading: pixels of the target that a pass drew.
struct ShadeConstants {
  ivec2 corner;
  uvec2 size;
};

// Push constants of a draw of objects whose reflection is added to a base.
struct ReflectionConstants {
  DrawConstants draw;
  ShadeConstants area;
};

// Push constants of the display pass. Texel of the picture = pixel * lookup.xy + lookup.zw.
struct DisplayConstants {
  vec4 lookup;
  uvec2 size;  // texels
  float exposure;
};

// Push constants of the pass that averages the samples of a target.
struct MeanConstants {
  float turn;    // as ViewData::rayY.w
  float dither;  // as ViewData::rayOrigin.w
};

// Push constants of the pass that adds a picture to a sum.
struct AccumulateConstants {
  uint begins;    // the picture is the first
  uint columns;   // tiles in a row of those that are refined; 0: the whole picture was drawn
  uint tileSide;  // texels
};

// Push constants of the pass that shows a depth image.
struct DepthViewConstants {
  vec4 lookup;      // as in DisplayConstants
  float halfDepth;  // depth shown half bright
};

// Finding of debug.check_finite in an image: result of the search, and the value looked up afterwards.
struct CheckSearch {
  uint pixel;  // y * width + x of the first finding; all bits are set at the start
  uint count;  // samples with such a value
  uint any;    // 1 if there are any. Set by a plain store: validation layer 1.3.239 does not take atomics for writes.
};

struct CheckFound {
  vec4 value;
  uint sampleIndex;
  uint padding[3];
};

struct CheckConstants {
  uvec2 size;  // pixels of the part that is in use
};

// A texel that is read back.
struct ProbedTexel {
  vec4 mean;   // of the samples
  vec4 first;  // first sample, for depth, which has no mean
};

struct ProbeConstants {
  ivec2 texel;
};

#ifdef __cplusplus
static_assert(offsetof(ViewData, clipPlane) == 112 && offsetof(ViewData, hasSky) == 156 &&
              offsetof(ViewData, traceOffset) == 208 && offsetof(ViewData, firstLight) == 240 && sizeof(ViewData) == 256);
static_assert(offsetof(LightData, irradiance) == 16 && offsetof(LightData, clearance) == 48 && sizeof(LightData) == 64);
static_assert(sizeof(ShadowMapData) == 96);
static_assert(offsetof(MaterialData, specular) == 16 && offsetof(MaterialData, firstColor) == 48 &&
              sizeof(MaterialData) == 64);
static_assert(offsetof(InstanceData, normalFromMesh) == 112 && offsetof(InstanceData, traceInstance) == 176 &&
              sizeof(InstanceData) == 192);
static_assert(offsetof(DrawConstants, handedness) == 28 && sizeof(DrawConstants) == 48);
static_assert(offsetof(MirrorData, lookupScale) == 48 && offsetof(MirrorData, texelFromPixel) == 80 &&
              offsetof(MirrorData, rippleOrigin) == 160 && sizeof(MirrorData) == 224 && sizeof(MirrorBlock) == 256);
static_assert(offsetof(CurvedMirrorData, high) == 32 && sizeof(CurvedMirrorData) == 80);
static_assert(offsetof(TraceTopNode, far) == 16 && sizeof(TraceTopNode) == 32 && sizeof(TraceNode) == 16);
static_assert(offsetof(TraceTriangle, c) == 32 && sizeof(TraceTriangle) == 48 && sizeof(TraceFace) == 16);
static_assert(offsetof(TraceVertex, normal) == 16 && sizeof(TraceVertex) == 32);
static_assert(offsetof(TraceInstance, gridScale) == 64 && offsetof(TraceInstance, change) == 128 &&
              offsetof(TraceInstance, firstTriangle) == 208 && sizeof(TraceInstance) == 16 * traceInstanceTexelCount);
static_assert(offsetof(TraceMirror, reflectance) == 64 && offsetof(TraceMirror, firstPhase) == 112 &&
              sizeof(TraceMirror) == 16 * traceMirrorTexelCount);
static_assert(offsetof(LightPath, light) == 32 && sizeof(LightPath) == 64 && sizeof(TraceCounts) == 16);
static_assert(offsetof(CheckFound, sampleIndex) == 16 && sizeof(CheckFound) == 32);

}  // namespace speculum::gpu
#endif

#endif
