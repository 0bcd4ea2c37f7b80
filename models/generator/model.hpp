#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <glm/glm.hpp>
#include <numbers>
#include <string>
#include <vector>

#include "geometry/affine.hpp"

namespace speculum::generator {

inline constexpr double kPi = std::numbers::pi;

// Metres, model space right-handed with +Y up; normals point outwards; v up.
struct Corner {
  glm::dvec3 position{0.0};
  glm::dvec3 normal{0.0};
  glm::dvec2 uv{0.0};
};

// One `newmtl`: linear RGB; `map` is a picture beside the model, or empty.
struct Paint {
  std::string name;
  glm::dvec3 diffuse{0.6};
  glm::dvec3 specular{0.0};
  double shininess = 1.0;
  glm::dvec3 emission{0.0};
  std::string map;
};

// A triangle soup with materials, written as OBJ + MTL.
class Model {
 public:
  // The material of all faces that follow.
  void paint(const Paint& paint);

  // Wound so that the geometric normal agrees with the corners' normals, whatever the order given. A triangle whose
  // 2 area / longest edge^2 is below 1e-5 is left out.
  void triangle(Corner a, Corner b, Corner c);

  // Corners in ring order, one normal for all.
  void quad(const Corner& a, const Corner& b, const Corner& c, const Corner& d);
  void quad(const std::array<glm::dvec3, 4>& ring, const glm::dvec3& normal, const std::array<glm::dvec2, 4>& uv);

  // (u, v) -> corner for u, v in 0..1 on a grid of nu x nv cells; each cell becomes two triangles.
  void surface(int nu, int nv, const std::function<Corner(double u, double v)>& at);

  // The other model's triangles and materials, placed. `place` must not mirror.
  void append(const Model& other, const Affine& place);

  // Closes each opening by a fan about the mean of its edge's corners, with the paint beside it. Whoever draws the
  // model can then leave out the backs of its triangles. An opening must be about flat, and the fan must not fold.
  Model& close();

  size_t triangleCount() const { return triangles_.size(); }

  // DIR/name.obj and DIR/name.mtl. Positions in 0.1 mm, normals and uv in 0.001; uv are left out
  // where no picture needs them. Throws std::runtime_error.
  void write(const std::filesystem::path& directory, const std::string& name) const;

 private:
  struct Triangle {
    int paint = 0;
    std::array<Corner, 3> corners;
  };
  std::vector<Paint> paints_;
  int current_ = -1;
  std::vector<Triangle> triangles_;
};

// Translation and rotation (degrees, R = Ry Rx Rz) with uniform scale.
Affine place(const glm::dvec3& position, const glm::dvec3& pitchYawRoll = glm::dvec3(0.0), double scale = 1.0);

}  // namespace speculum::generator
