#include "model.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>
#include <sstream>
#include <stdexcept>
#include <unordered_map>

#include "geometry/convex_mesh.hpp"

namespace speculum::generator {
namespace {

// Shortest form of x rounded to `decimals` places: no trailing zeros, no negative zero.
std::string number(double x, int decimals) {
  const double unit = std::pow(10.0, decimals);
  double rounded = std::round(x * unit) / unit;
  if (rounded == 0.0) rounded = 0.0;
  std::ostringstream out;
  out.precision(decimals);
  out << std::fixed << rounded;
  std::string text = out.str();
  text.erase(text.find_last_not_of('0') + 1);
  if (text.back() == '.') text.pop_back();
  return text;
}

std::string triple(const glm::dvec3& v, int decimals) {
  return number(v.x, decimals) + ' ' + number(v.y, decimals) + ' ' + number(v.z, decimals);
}

// As positions are written: in 0.1 mm. Rounded to 1 nm before, so that both sides of a seam round alike.
glm::dvec3 written(const glm::dvec3& position) {
  return glm::round(glm::round(position * 1e9) / 1e5) / 1e4;
}

// The lines of one kind ("v", "vt", "vn"), each distinct one written once.
class Lines {
 public:
  explicit Lines(std::string keyword) : keyword_(std::move(keyword)) {}
  size_t index(const std::string& line) {
    const auto [entry, isNew] = known_.try_emplace(line, known_.size() + 1);
    if (isNew) text_ += keyword_ + ' ' + line + '\n';
    return entry->second;
  }
  const std::string& text() const { return text_; }

 private:
  std::string keyword_;
  std::string text_;
  std::unordered_map<std::string, size_t> known_;
};

std::string materialText(const Paint& paint) {
  std::string text = "newmtl " + paint.name + "\nKd " + triple(paint.diffuse, 4) + "\nKs " + triple(paint.specular, 4) +
                     "\nNs " + number(paint.shininess, 1) + '\n';
  if (paint.emission != glm::dvec3(0.0)) text += "Ke " + triple(paint.emission, 4) + '\n';
  if (!paint.map.empty()) text += "map_Kd " + paint.map + '\n';
  return text;
}

void writeText(const std::filesystem::path& file, const std::string& text) {
  std::ofstream out(file, std::ios::binary);
  out << text;
  if (!out.flush()) throw std::runtime_error(file.string() + ": cannot be written (a writable folder is needed)");
}

}  // namespace

void Model::paint(const Paint& paint) {
  const auto known = std::find_if(paints_.begin(), paints_.end(), [&](const Paint& p) { return p.name == paint.name; });
  current_ = static_cast<int>(known - paints_.begin());
  if (known == paints_.end()) paints_.push_back(paint);
}

void Model::triangle(Corner a, Corner b, Corner c) {
  if (current_ < 0) throw std::logic_error("paint() comes before the first face");
  const glm::dvec3 ab = b.position - a.position, ac = c.position - a.position, bc = c.position - b.position;
  const glm::dvec3 normal = glm::cross(ab, ac);
  const double longest = std::max({glm::dot(ab, ab), glm::dot(ac, ac), glm::dot(bc, bc)});
  if (!(glm::length(normal) > 1e-5 * longest)) return;
  if (glm::dot(normal, a.normal + b.normal + c.normal) < 0.0) std::swap(b, c);
  triangles_.push_back({current_, {a, b, c}});
}

void Model::quad(const Corner& a, const Corner& b, const Corner& c, const Corner& d) {
  triangle(a, b, c);
  triangle(a, c, d);
}

void Model::quad(const std::array<glm::dvec3, 4>& ring, const glm::dvec3& normal, const std::array<glm::dvec2, 4>& uv) {
  quad({ring[0], normal, uv[0]}, {ring[1], normal, uv[1]}, {ring[2], normal, uv[2]}, {ring[3], normal, uv[3]});
}

void Model::surface(int nu, int nv, const std::function<Corner(double, double)>& at) {
  std::vector<Corner> grid;
  grid.reserve(static_cast<size_t>(nu + 1) * (nv + 1));
  for (int j = 0; j <= nv; ++j)
    for (int i = 0; i <= nu; ++i) grid.push_back(at(static_cast<double>(i) / nu, static_cast<double>(j) / nv));
  for (int j = 0; j < nv; ++j) {
    for (int i = 0; i < nu; ++i) {
      const size_t k = static_cast<size_t>(j) * (nu + 1) + i;
      quad(grid[k], grid[k + 1], grid[k + nu + 2], grid[k + nu + 1]);
    }
  }
}

void Model::append(const Model& other, const Affine& place) {
  const glm::dmat3 normals = normalMatrix(place.linear);
  const int before = current_;
  for (const Triangle& t : other.triangles_) {
    paint(other.paints_[t.paint]);
    Triangle copy{current_, t.corners};
    for (Corner& corner : copy.corners) {
      corner.position = place.point(corner.position);
      corner.normal = glm::normalize(normals * corner.normal);
    }
    triangles_.push_back(copy);
  }
  current_ = before;
}

Model& Model::close() {
  using Point = glm::dvec3;
  struct Edge {
    Point to;
    int paint;
  };
  std::map<Point, std::map<Point, int, PointWelder::Less>, PointWelder::Less> sides;  // paint by start and end
  for (const Triangle& t : triangles_) {
    for (size_t i = 0; i < 3; ++i) {
      const Point from = written(t.corners[i].position), to = written(t.corners[(i + 1) % 3].position);
      if (from != to && sides[to].erase(from) == 0) sides[from][to] = t.paint;
    }
  }
  // What is left runs along openings, in the direction of the triangles beside them.
  std::map<Point, Edge, PointWelder::Less> edges;
  for (const auto& [from, ends] : sides) {
    for (const auto& [to, paint] : ends) {
      if (!edges.try_emplace(from, Edge{to, paint}).second) throw std::logic_error("openings share a corner");
    }
  }
  while (!edges.empty()) {
    std::vector<Point> loop;
    const int paint = edges.begin()->second.paint;
    for (auto edge = edges.begin(); edge != edges.end(); edge = edges.find(loop.back())) {
      loop.push_back(edge->second.to);
      edges.erase(edge);
    }
    Point middle(0.0), normal(0.0);
    for (const Point& p : loop) middle += p / static_cast<double>(loop.size());
    for (size_t i = 0; i < loop.size(); ++i)
      normal -= glm::cross(loop[i] - middle, loop[(i + 1) % loop.size()] - middle);
    normal = glm::normalize(normal);
    const auto corner = [&](const Point& p) { return Corner{p, normal, {p.x, -p.z}}; };
    for (size_t i = 0; i < loop.size(); ++i) {
      triangles_.push_back({paint, {corner(middle), corner(loop[(i + 1) % loop.size()]), corner(loop[i])}});
    }
  }
  return *this;
}

void Model::write(const std::filesystem::path& directory, const std::string& name) const {
  Lines positions("v"), uvs("vt"), normals("vn");
  std::vector<std::string> faces(paints_.size());
  for (const Triangle& t : triangles_) {
    std::string& text = faces[t.paint];
    text += 'f';
    const bool textured = !paints_[t.paint].map.empty();
    for (const Corner& c : t.corners) {
      text += ' ' + std::to_string(positions.index(triple(written(c.position), 4))) + '/';
      if (textured) text += std::to_string(uvs.index(number(c.uv.x, 3) + ' ' + number(c.uv.y, 3)));
      text += '/' + std::to_string(normals.index(triple(glm::normalize(c.normal), 3)));
    }
    text += '\n';
  }
  std::string object = "mtllib " + name + ".mtl\n" + positions.text() + uvs.text() + normals.text();
  std::string library;
  for (size_t i = 0; i < paints_.size(); ++i) {
    object += "usemtl " + paints_[i].name + '\n' + faces[i];
    library += materialText(paints_[i]);
  }
  writeText(directory / (name + ".obj"), object);
  writeText(directory / (name + ".mtl"), library);
}

Affine place(const glm::dvec3& position, const glm::dvec3& pitchYawRoll, double scale) {
  return {rotationFromDegrees(pitchYawRoll) * scale, position};
}

}  // namespace speculum::generator
