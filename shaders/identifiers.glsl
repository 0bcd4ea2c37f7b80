// Identifiers of surfaces whose radiance takes rays. A pass draws them into its color target in the place of radiance;
// the sign of red tells the two apart. shade.glsl computes the radiance afterwards.

struct Identifier {
  bool mirror;     // a planar mirror, else a triangle of an object
  bool baseOnly;  // without the reflection, which is added later
  uint index;      // into instances, or MirrorData::index; less than 2^28
  uint triangle;   // of the mesh; less than 2^28
};

// Half-float targets keep the bits of normal numbers. From the least normal number on, 2^14 patterns are finite.
const uint leastNormal = 0x0400;
const uint fieldBits = 14;
const uint fieldMask = 0x3fff;

vec2 encoded(uint number) {
  return unpackHalf2x16((leastNormal + (number & fieldMask)) | (leastNormal + (number >> fieldBits)) << 16);
}

uint decoded(vec2 halfs) {
  uint bits = packHalf2x16(abs(halfs));
  return ((bits & 0xffff) - leastNormal) | ((bits >> 16) - leastNormal) << fieldBits;
}

// Replaces the disparity of samples to which a triangle's reflection will be added. The mark depends on the triangle,
// so that hardly any other triangle at the same depth adds its reflection too. Below zero and exact in a half float.
float reflectionMark(Identifier id) { return -1.0 - float((id.index * 0x9e3779b9u + id.triangle * 0x85ebca6bu) >> 21); }

vec4 encoded(Identifier id) {
  vec2 index = encoded(id.index);
  vec2 triangle = encoded(id.triangle);
  return vec4(-index.x, id.mirror ? -index.y : index.y, id.baseOnly ? -triangle.x : triangle.x, triangle.y);
}

bool isIdentifier(vec4 color) { return color.r < 0.0; }

Identifier decoded(vec4 color) {
  return Identifier(color.g < 0.0, color.b < 0.0, decoded(color.rg), decoded(color.ba));
}
