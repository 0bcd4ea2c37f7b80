#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "geometry/convex_mesh.hpp"

namespace speculum {

// Texels decoded to linear RGB, row 0 at the top of the picture (v = 1).
struct Texture {
  std::filesystem::path source;  // without symbolic links
  bool linear = false;           // the picture's values are linear, not sRGB
  int width = 0;
  int height = 0;
  std::vector<glm::vec3> texels;
  glm::dvec3 mean{1.0};        // of the texels of its picture
  std::vector<float> opacity;  // of the texels, 0 .. 1; empty: opaque
  bool hasAlpha = false;       // its picture has an alpha channel, which may be opaque
  std::string shrinkage;       // says why it has fewer texels than its picture; empty: it has all
  bool isMask = false;         // its texels are white, their opacity is the picture's brightness
};

// Returns color and opacity at (u, v), v up, of the texels interpolated bilinearly. Texel centres are at (i + 0.5) /
// size. The texture repeats or, if it `clamps`, its edge goes on.
glm::dvec4 textureAt(const Texture& texture, const glm::dvec2& uv, bool clamps);

// Returns the texture with fewer texels, each the mean of the texels that it covers.
Texture shrunk(const Texture& texture, int width, int height);

// Phong-Blinn material, linear RGB; see docs/picture.md for the radiance it gives.
struct Material {
  std::string name;
  glm::dvec3 diffuse{0.6};           // Kd
  glm::dvec3 specular{0.0};          // Ks
  glm::dvec3 emission{0.0};          // Ke
  double shininess = 1.0;            // Ns, >= 1
  int diffuseTexture = -1;           // index into Scene::textures, -1: none
  bool clamps = false;               // its textures clamp instead of repeating
  std::optional<glm::dvec3> mirror;  // reflectance, 0 .. 1, of a material that says mirror
  bool twoSided = false;             // planar mirrors of the material reflect on their backs too
  // Coverage: the share of the surface that is there. The rest shows what is behind.
  double opacity = 1.0;      // 0 .. 1
  int opacityTexture = -1;   // index into Scene::textures, whose opacity multiplies `opacity`; -1: none
  double cutoff = -1.0;      // least product that counts as 1, any other as 0; below 0: products count as they are
  bool vertexAlpha = false;  // the alpha of Mesh::colors multiplies `opacity` too, and is somewhere below 1

  // Returns the cutoff, less what a product that equals it may lose: 5e-4 of it in a texture of half floats.
  double leastOpacity() const { return 0.999 * cutoff; }
  bool isTransparent() const { return opacity < 1.0 || opacityTexture >= 0 || cutoff > 1.0 || vertexAlpha; }
};

struct Vertex {
  glm::dvec3 position;  // model space, relative to Mesh::center
  glm::dvec3 normal;    // model space, unit length; zero: the normal of each of its triangles (Mesh::flatVertices)
  glm::dvec2 uv;        // v up
};

// Consecutive indices of triangles.
struct IndexRange {
  uint32_t first = 0;
  uint32_t count = 0;  // a multiple of 3
  bool operator==(const IndexRange&) const = default;
};

struct MeshPart {
  uint32_t firstIndex = 0;
  uint32_t indexCount = 0;  // a multiple of 3
  Material material;
};

// Consecutive triangles of one part and the box around them, relative to Mesh::center.
struct MeshCluster {
  uint32_t firstIndex = 0;
  uint32_t indexCount = 0;
  glm::dvec3 center{0.0};
  glm::dvec3 halfExtent{0.0};
};

// Faces in one plane whose material says mirror.
struct FlatMirror {
  std::vector<std::vector<glm::dvec3>> pieces;  // convex, relative to Mesh::center, counter-clockwise from the front
  std::vector<glm::dvec3> outline;              // the convex hull of the pieces
  bool convex = false;                          // the pieces fill their hull
  Material material;
};

// How a mesh is cut if materials that say mirror make mirrors. The others are indices into Scene::meshes.
struct MirrorParts {
  int rest = -1;                 // what makes no mirror; it may have no triangle
  std::vector<FlatMirror> flat;  // planar mirrors
  std::vector<int> curved;       // curved mirrors
  std::vector<int> flatMeshes;   // `flat` for objects that have no planar mirrors: curved mirrors
};

// Triangles in model space, counter-clockwise seen from outside. Positions are kept in double relative to `center`, so
// that their conversion to float for the GPU loses nothing to a far-off origin. Positions, sizes and radius are
// multiples of `unit`, so that floats can hold them whatever the model's size; only `center` is not.
struct Mesh {
  std::filesystem::path source;
  std::vector<std::filesystem::path> materialFiles;  // without symbolic links
  std::vector<std::filesystem::path> namedFiles;     // materials and textures not found by a whole path: from `source`
  std::vector<std::string> defects;                  // of its files, one line a kind: `FILE:LINE: key: what is wrong`
  double unit = 1.0;                                 // length in model space; a power of two
  glm::dvec3 center{0.0};                            // model space, of the bounding box
  glm::dvec3 halfExtent{0.0};                        // of the bounding box
  double radius = 0.0;                               // of the bounding sphere about `center`
  std::vector<Vertex> vertices;
  std::vector<glm::vec4> colors;  // of the vertices, linear RGB and alpha; they multiply Kd and opacity. Empty: none
  std::vector<uint32_t> indices;
  uint32_t flatVertices = 0;  // whose normals are zero
  uint32_t flatCorners = 0;   // of triangles, at these vertices
  std::vector<MeshPart> parts;
  std::vector<MeshCluster> clusters;  // see clustersOf()
  std::vector<ConvexFace> faces;      // relative to `center`, see convexFaces()
  ConvexMesh convex;                  // relative to `center`, see convexMesh()
  bool solid = false;                 // see isSolid()
  // Number of last triangles, whose texture repeats so often that floats of its coordinates lose digits.
  uint32_t repeats = 0;
  bool curvedMirror = false;               // cut out of another mesh: a curved mirror by the material of its one part
  std::optional<MirrorParts> mirrorParts;  // of a mesh with materials that say mirror

  bool isTransparent() const;                 // some part is
  bool hasVertexAlpha() const;                // some part has
  std::vector<glm::dvec3> positions() const;  // of the vertices
};

// Sets `flatVertices` and `flatCorners`.
void countFlat(Mesh& mesh);

// Returns the unit normals of the corners of a triangle, whose indices begin at `triangle`.
std::array<glm::dvec3, 3> cornerNormals(const Mesh& mesh, const uint32_t* triangle);

// The vertices of a mesh for readers that need a normal in each: first those that have one, then one for each corner at
// a vertex without. For a mesh without flat vertices they are the mesh's own. Refers to the mesh.
class ShadedVertices {
 public:
  explicit ShadedVertices(const Mesh& mesh);

  static size_t countOf(const Mesh& mesh) { return mesh.vertices.size() - mesh.flatVertices + mesh.flatCorners; }
  std::span<const uint32_t> indices() const { return mesh_.flatVertices == 0 ? mesh_.indices : indices_; }
  std::vector<glm::vec4> colors() const;  // none if the mesh has none

  // Calls take(vertex, its index in the mesh) for each, in order.
  template <typename Take>
  void forEach(Take&& take) const {
    for (uint32_t i = 0; i < mesh_.vertices.size(); ++i) {
      if (mesh_.flatVertices == 0 || mesh_.vertices[i].normal != glm::dvec3(0.0)) {
        take(mesh_.vertices[i], i);
      }
    }
    for (size_t first = 0; first < indices_.size(); first += 3) {
      const std::array<glm::dvec3, 3> normals = cornerNormals(mesh_, &mesh_.indices[first]);
      for (size_t k = 0; k < 3; ++k) {
        const uint32_t i = mesh_.indices[first + k];
        if (Vertex vertex = mesh_.vertices[i]; vertex.normal == glm::dvec3(0.0)) {
          vertex.normal = normals[k];
          take(vertex, i);
        }
      }
    }
  }

 private:
  const Mesh& mesh_;
  std::vector<uint32_t> indices_;  // of a mesh with flat vertices
};

// Reorders the triangles of each part along a space-filling curve, by meshoptimizer, so that consecutive ones lie close
// together, and the vertices by their first use: clusters become small, and fewer vertices are shaded twice. A mesh
// that is too small for clusters stays as it is.
void sortIntoClusters(Mesh& mesh);

// Cuts the mesh's triangles in their order into clusters of 64. Returns none for a mesh that is too small to gain by
// clusters.
std::vector<MeshCluster> clustersOf(const Mesh& mesh);

constexpr size_t mostSolidTriangles = 1 << 18;

// Says whether no view from outside the mesh's box can see the back of a triangle, so that backs need not be drawn.
// True for meshes whose components (triangles joined by edges)
// - are closed: at each edge, two triangles run in opposite directions,
// - do not cross or touch themselves, except at shared vertices,
// - are wound counter-clockwise seen from outside.
// Such a component winds once around what is inside it and not at all around what is outside. Components may cross or
// contain each other: winding numbers add up, and where a line of sight first meets a surface, the sum rises from 0.
//
// Vertices at equal positions are one. Parts nearer to each other than 1e-7 of the longest side of the box touch. A
// mesh of more than `mostSolidTriangles` does not count as solid, nor does one for which more than 256 boxes and
// triangles were looked at for each triangle: many lie close together, or more than 65 536 follow each other in an
// order that has nothing to do with their places.
bool isSolid(std::vector<glm::dvec3> positions, std::vector<uint32_t> indices);

}  // namespace speculum
