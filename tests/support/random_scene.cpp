#include "random_scene.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <sstream>

#include "geometry/affine.hpp"
#include "picture_support.hpp"
#include "plan/occluder_shapes.hpp"
#include "scene_text.hpp"

namespace speculum::testing_support {

namespace {

const std::string effectMark = "#effect ";

// Builds a scene in a coordinate frame of its own, in which mirrors are given.
class Builder {
 public:
  explicit Builder(unsigned seed)
      : random(seed),
        shapes_(seed),
        qualities_(seed + 1'000'000),
        visibilities_(seed + 2'000'000),
        panes_(seed + 3'000'000),
        seed_(seed),
        tidy(random.chance(0.4)),
        alike_(random.chance(0.3)),
        effects_(random.chance(0.5)) {
    const double far = random.chance(0.6) ? 0.0 : std::pow(10.0, random.uniform(0, 7));
    origin_ = far * random.inBox(1.0);
    if (!tidy && random.chance(0.7)) {
      frame_ = rotationFromDegrees({random.uniform(-80, 80), random.uniform(-180, 180), random.uniform(-180, 180)});
    }
    material_ = material();
  }

  glm::dvec3 at(const glm::dvec3& p) const { return origin_ + frame_ * p; }
  double number(double low, double high) { return snapped(random.uniform(low, high), 0.25); }
  double angle(double low, double high) { return snapped(random.uniform(low, high), 15.0); }
  int count(int low, int high) { return static_cast<int>(random.uniform(low, high + 1 - 1e-9)); }
  glm::dvec3 point(double halfSide) {
    return {number(-halfSide, halfSide), number(-halfSide, halfSide), number(-halfSide, halfSide)};
  }

  // A convex polygon, counter-clockwise seen from the front.
  void mirror(const std::vector<glm::dvec3>& corners) {
    std::vector<glm::dvec3> placed;
    for (const glm::dvec3& corner : corners) {
      placed.push_back(at(corner));
    }
    out << "[[mirror]]\n" << polygonText(placed) << (alike_ ? material_ : material()) << quality();
    planes_.push_back(corners);
  }
  void mirror(const glm::dvec3& center, const glm::dvec3& rotation, const glm::dvec2& size, int corners = 4) {
    const glm::dmat3 turn = rotationFromDegrees(rotation);
    std::vector<glm::dvec3> polygon;
    for (int i = 0; i < corners; ++i) {
      const double a = 2.0 * std::numbers::pi * (i + 0.5) / corners;
      const double reach = corners == 4 ? std::numbers::sqrt2 : 1.0;
      polygon.push_back(center +
                        turn * glm::dvec3(0.5 * reach * size.x * std::cos(a), 0.5 * reach * size.y * std::sin(a), 0));
    }
    mirror(polygon);
  }
  void anyMirror(double reach, double low, double high) {
    mirror(point(reach), {angle(-90, 90), angle(-180, 180), angle(-90, 90)}, {number(low, high), number(low, high)},
           random.chance(0.7) ? 4 : count(3, 8));
  }

  void objects(int number, double reach, double side) {
    for (int i = 0; i < number; ++i) {
      const auto position = [&] { return text(at(random.inBox(reach))); };
      if (random.chance(0.5)) {
        out << randomObjectText(random, seed_ * 16 + static_cast<unsigned>(i), side, {0.5, 2}, position);
      } else {
        shape(position(), random.uniform(0.2, 0.5) * side);
      }
      if (random.chance(0.2)) {
        out << "copies = { count = " << count(2, 5) << ", step = " << random.vec(-1, 1) << " }\n";
      }
      if (random.chance(0.3)) {
        out << "spin = " << random.vec(-90, 90) << "\n";
      }
      out << visibility() << effect(0.15, "mirror = { reflectance = [0.9, 0.8, 0.7] }");
    }
  }
  // Adds, now and then, an object whose material says mirror: two panes, an L or a ring in one plane, and a smooth
  // fold.
  void panes(double reach) {
    static constexpr std::array<const char*, 3> outlines{"f 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n",
                                                         "f 1 2 6 5\nf 1 5 8 4\n", "f 1 2 6 5\nf 3 4 8 7\n"};
    if (!panes_.chance(0.4)) {
      return;
    }
    const std::string file = "panes" + std::to_string(seed_);
    writeModel(file + ".mtl", "newmtl m\nKd 0.3 0.2 0.1\nKs 0.9 0.7 0.8\nNs 800\nillum 3\n");
    writeModel(file + ".obj", "mtllib " + file +
                                  ".mtl\nv -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nv -0.5 -0.4 0\nv 0.6 -0.4 0\n"
                                  "v 0.6 0.5 0\nv -0.5 0.5 0\nv 1.6 0 0.5\nv 1.7 -1 -0.3\nusemtl m\n" +
                                  panes_.pick(outlines) + (panes_.chance(0.5) ? "s 1\nf 2 9 3\nf 2 10 9\n" : ""));
    const glm::dvec3 place = panes_.inBox(reach);
    const glm::dvec3 angles = panes_.inBox(180.0);
    const glm::dmat3 turn = glm::transpose(frame_) * rotationFromDegrees(angles);
    out << "[[object]]\nmodel = \"" << file << ".obj\"\nposition = " << text(at(place))
        << "\nrotation = " << text(angles) << "\nscale = [" << (panes_.chance(0.3) ? -1 : 1) << ", 0.8, 1]\n";
    planes_.push_back({place, place + turn[0], place + turn[1]});
  }
  void shape(const std::string& position, double scale) {
    const std::string file = "shape" + std::to_string(seed_) + "_" + std::to_string(shapes++) + ".obj";
    writeModel(file, randomShape(shapes_).obj());
    out << "[[object]]\nmodel = \"" << file << "\"\nposition = " << position << "\nrotation = " << random.vec(-180, 180)
        << "\nscale = " << scale << "\ncolor = " << random.vec(0, 1) << "\n";
  }
  void lights(double reach) {
    for (int i = count(1, 3); i > 0; --i) {
      out << randomLightText(random, text(at(random.inBox(reach))));
      if (random.chance(0.3)) {
        out << "orbit = { center = " << text(origin_) << ", axis = " << text(random.direction())
            << ", speed = " << random.uniform(-90, 90) << " }\n";
      }
      out << visibility() << effect(0.3, "casts_shadow = true");
    }
  }
  // Adds a view from `eye` to `target`, or now and then from close to the plane of a mirror.
  void view(glm::dvec3 eye, glm::dvec3 target) {
    if (random.chance(0.3)) {
      const auto& p = planes_[static_cast<size_t>(random.uniform(0, mirrors() - 1e-9))];
      const glm::dvec3 normal = glm::normalize(glm::cross(p[1] - p[0], p[2] - p[0]));
      const double height = std::pow(10.0, random.uniform(-6, -1));
      eye = p[0] + random.uniform(0, 1.5) * (p[1] - p[0]) + random.uniform(0, 1.5) * (p[2] - p[1]) + height * normal;
      // Half of the time it looks along the mirror.
      const double rise = random.chance(0.5) ? std::pow(10.0, random.uniform(-5, -1.5)) : random.uniform(0, 2);
      const glm::dvec3 along = glm::normalize(glm::cross(normal, random.direction()));
      target = eye + along + (random.chance(0.8) ? -rise : rise) * normal;
    }
    if (glm::distance(eye, target) < 0.1) {
      target = eye + random.direction();
    }
    static constexpr std::array<const char*, 6> angles = {"1", "3", "100", "130", "160", "170"};
    glm::dvec3 up(0, 1, 0);
    if (!tidy || glm::length(glm::cross(up, target - eye)) < 0.1) {
      up = glm::cross(target - eye, random.direction());
    }
    const bool camera = views_++ == 0;
    out << (camera ? "[camera]\n" : "[[bookmark]]\nname = \"" + std::to_string(views_) + "\"\n")
        << "position = " << text(at(eye)) << "\ntarget = " << text(at(target)) << "\nup = " << text(frame_ * up)
        << "\nvertical_fov = " << (random.chance(0.2) ? random.pick(angles) : text(random.uniform(40, 90))) << "\n";
  }
  double mirrors() const { return static_cast<double>(planes_.size()); }

  Random random;

 private:
  double snapped(double value, double step) const { return tidy ? std::round(value / step) * step : value; }
  // Returns a line that only the scene with effects has, or nothing.
  std::string effect(double chance, const std::string& line) {
    return effects_ && random.chance(chance) ? effectMark + line + "\n" : "";
  }
  std::string material() {
    std::ostringstream text;
    text << "reflectance = " << random.vec(0.5, 1.0) << "\n";
    if (random.chance(0.4)) {
      text << "base_color = " << random.vec(0, 0.5) << "\n";
    }
    if (random.chance(0.3)) {
      text << "fresnel = \"schlick\"\n";
    }
    if (random.chance(0.3)) {
      text << "two_sided = true\n";
    }
    text << effect(0.2, "roughness = " + std::to_string(random.uniform(0, 0.5)))
         << effect(0.2, "ripple = { amplitude = 0.01, wavelength = 0.4 }") << effect(0.1, "casts_light = true");
    return text.str();
  }

  // Returns the line of an object or light that not every view shows, or nothing.
  std::string visibility() {
    const bool some = visibilities_.chance(0.25);
    return some ? std::string("visible = ") + (visibilities_.chance(0.5) ? "\"eye\"\n" : "\"mirrors\"\n") : "";
  }

  // Returns the line of a mirror with a quality of its own, or nothing.
  std::string quality() {
    static constexpr std::array<const char*, 4> scales{"0.25", "0.5", "1", "2"};
    static constexpr std::array<const char*, 3> samples{"1", "2", "4"};
    static constexpr std::array<const char*, 2> intervals{"1", "3"};
    static constexpr std::array<const char*, 3> methods{"\"raster\"", "\"rays\"", "\"auto\""};
    std::string keys;
    const auto add = [&](double chance, const char* key, const auto& values) {
      if (qualities_.chance(chance)) {
        keys += (keys.empty() ? "" : ", ") + std::string(key) + " = " + qualities_.pick(values);
      }
    };
    if (qualities_.chance(0.4)) {
      add(0.6, "scale", scales);
      add(0.6, "samples", samples);
      add(0.2, "update_interval", intervals);
      add(0.2, "method", methods);
    }
    return keys.empty() ? "" : "quality = { " + keys + " }\n";
  }

  std::mt19937 shapes_;
  Random qualities_;  // of their own, so that a seed's scene is the same without them
  Random visibilities_;
  Random panes_;
  unsigned seed_;

 public:
  const bool tidy;  // coordinates of few digits, so that planes, edges and corners coincide
  std::ostringstream out;
  int shapes = 0;

 private:
  const bool alike_;  // all mirrors are of one material
  const bool effects_;
  glm::dvec3 origin_{0.0};
  glm::dmat3 frame_{1.0};
  std::string material_;
  std::vector<std::vector<glm::dvec3>> planes_;  // polygons of the mirrors
  int views_ = 0;
};

// An eye and what it looks at.
struct Sight {
  glm::dvec3 eye;
  glm::dvec3 target;
};

Sight crossing(Builder& b) {
  for (int i = b.count(2, 6); i > 0; --i) {
    b.anyMirror(1.2, 1.0, 5.0);
  }
  b.objects(4, 2.0, 1.0);
  b.lights(3.0);
  return {{b.number(-3, 3), b.number(-2, 2), b.number(3, 5)}, b.point(0.5)};
}

// Mirror walls around the eye whose edges meet. At angles of 180/n degrees their images fill space without overlap.
Sight prism(Builder& b) {
  const int sides = b.count(3, 8);
  const double radius = b.number(1.0, 3.0);
  const double half = b.number(1.0, 2.0);
  const int missing = b.random.chance(0.4) ? b.count(0, sides - 1) : sides;
  std::vector<glm::dvec3> ring;
  for (int i = 0; i < sides; ++i) {
    const double a = 2.0 * std::numbers::pi * i / sides;
    ring.emplace_back(radius * std::cos(a), 0, radius * std::sin(a));
  }
  const glm::dvec3 up(0, half, 0);
  for (size_t i = 0; i < ring.size(); ++i) {
    const glm::dvec3& next = ring[(i + 1) % ring.size()];
    if (static_cast<int>(i) != missing) {
      b.mirror({ring[i] - up, next - up, next + up, ring[i] + up});
    }
  }
  for (const double side : {-1.0, 1.0}) {
    if (b.random.chance(0.3)) {
      std::vector<glm::dvec3> lid;
      for (const glm::dvec3& corner : ring) {
        lid.push_back(corner + side * up);
      }
      if (side < 0.0) {
        std::ranges::reverse(lid);
      }
      b.mirror(lid);
    }
  }
  b.objects(3, 0.6 * radius, 0.6);
  b.lights(0.8 * radius);
  const double inside = 0.5 * radius;
  return {{b.number(-inside, inside), b.number(-0.5, 0.5), b.number(-inside, inside)}, b.point(inside)};
}

Sight facing(Builder& b) {
  const double distance = b.number(0.5, 3.0);
  const double tilt = b.tidy || b.random.chance(0.5) ? 0.0 : b.random.uniform(-5, 5);
  b.mirror({0, 0, -distance}, {tilt, 0, 0}, {b.number(1, 6), b.number(1, 4)});
  b.mirror({0, 0, distance}, {0, 180, tilt}, {b.number(1, 6), b.number(1, 4)});
  if (b.random.chance(0.4)) {
    b.mirror({0, -1, 0}, {-90, 0, 0}, {4, 2 * distance});
  }
  b.objects(3, 0.8 * distance, 0.5);
  b.lights(distance);
  return {{b.number(-1, 1), b.number(-0.5, 0.5), 0.5 * distance}, {b.number(-1, 1), b.number(-0.5, 0.5), -distance}};
}

// Mirrors that adjoin each other in one plane, and others close to it, in it or before it.
Sight tiles(Builder& b) {
  const int columns = b.count(1, 4);
  const int rows = b.count(1, 3);
  const double side = b.number(0.5, 1.5);
  for (int i = 0; i < columns; ++i) {
    for (int j = 0; j < rows; ++j) {
      if (b.random.chance(0.85)) {
        b.mirror({side * (i - 0.5 * columns), side * (j - 0.5 * rows), 0}, {0, 0, 0}, {side, side});
      }
    }
  }
  for (int i = b.count(1, 4); i > 0; --i) {
    const double gap = b.random.chance(0.3) ? 0.0 : std::pow(10.0, b.random.uniform(-3, 0.5));
    b.mirror({b.number(-2, 2), b.number(-1, 1), gap}, {0, b.random.chance(0.5) ? 180.0 : 0.0, b.angle(-90, 90)},
             {b.number(0.5, 2), b.number(0.5, 2)}, b.count(3, 6));
  }
  b.mirror({0, 0, 5}, {b.angle(-15, 15), 180, 0}, {6, 4});
  b.objects(4, 2.0, 0.8);
  b.lights(3.0);
  return {{b.number(-2, 2), b.number(-1, 1), b.number(2, 4)}, {b.number(-1, 1), b.number(-1, 1), 0}};
}

// Mirrors behind walls, arches and thin bodies.
Sight openings(Builder& b) {
  for (int i = 0; i < 6; ++i) {
    b.shape(text(b.at({1.6 * (i % 3 - 1), 1.6 * (i / 3) - 0.8, b.number(-0.5, 0.5)})), b.number(0.5, 1.25));
  }
  for (int i = b.count(3, 9); i > 0; --i) {
    const bool behind = b.random.chance(0.7);
    b.mirror({b.number(-2, 2), b.number(-1.5, 1.5), behind ? b.number(-3, -1) : 5},
             {b.angle(-15, 15), b.angle(-15, 15) + (behind ? 0 : 180), 0}, {b.number(0.25, 2), b.number(0.25, 2)});
  }
  b.objects(2, 2.0, 0.8);
  b.lights(3.0);
  return {{b.number(-2, 2), b.number(-1, 1), b.number(1.5, 4)}, {b.number(-1, 1), b.number(-1, 1), -1}};
}

// Two mirrors at 180/n degrees or any other angle, whose common edge is seen.
Sight corner(Builder& b) {
  const double degrees = b.random.chance(0.6) ? 180.0 / b.count(2, 8) : b.random.uniform(10, 170);
  const double half = glm::radians(0.5 * degrees);
  const glm::dvec3 left(-4 * std::sin(half), 0, 4 * std::cos(half) - 2);
  const glm::dvec3 right(-left.x, 0, left.z);
  const glm::dvec3 up(0, b.number(0.5, 2), 0);
  const glm::dvec3 edge(0, 0, -2);
  b.mirror({left - up, edge - up, edge + up, left + up});
  b.mirror({edge - up, right - up, right + up, edge + up});
  if (b.random.chance(0.4)) {
    b.mirror({left - up, right - up, edge - up});
  }
  b.objects(3, 1.2, 0.6);
  b.lights(2.0);
  return {{b.number(-0.75, 0.75) + 0.1, b.number(-0.5, 0.5), b.number(1, 4)}, {b.number(-0.5, 0.5), 0, -2}};
}

void writeFiles(RandomScene& scene) {
  std::string text = scene.text;
  scene.file = writeScene(scene.name, text);
  for (size_t mark = text.find(effectMark); mark != std::string::npos; mark = text.find(effectMark)) {
    text.erase(mark, effectMark.size());
  }
  scene.withEffects = text == scene.text ? scene.file : writeScene(scene.name + "_effects", text);
}

}  // namespace

RandomScene randomScene(unsigned seed) {
  Builder b(seed);
  struct Kind {
    const char* name;
    Sight (*build)(Builder&);
  };
  static constexpr std::array kinds{Kind{"crossing", crossing}, Kind{"prism", prism},       Kind{"facing", facing},
                                    Kind{"tiles", tiles},       Kind{"openings", openings}, Kind{"corner", corner}};
  const Kind& kind = kinds[seed % kinds.size()];
  Random& random = b.random;
  b.out << "[environment]\nbackground = " << random.vec(0, 1) << "\nambient = " << random.vec(0.1, 0.4) << "\n";
  if (random.chance(0.4)) {
    b.out << "sky = { zenith = " << random.vec(0, 1) << ", horizon = " << random.vec(0, 1)
          << ", ground = " << random.vec(0, 1) << " }\n";
  }
  const Sight sight = kind.build(b);
  b.panes(1.0);
  for (int i = 0; i < 8; ++i) {
    const double moved = i == 0 ? 0.0 : 0.5;
    b.view(sight.eye + random.inBox(moved), sight.target + random.inBox(moved));
  }
  static constexpr std::array<const char*, 6> scales = {"0.5", "0.7", "1", "1", "1", "2"};
  static constexpr std::array<const char*, 3> samples = {"1", "1", "4"};
  RandomScene scene;
  scene.name = "random_" + std::to_string(seed);
  scene.text = b.out.str();
  writeFiles(scene);
  scene.kind = kind.name;
  // Limits passes to about a hundred if each mirror shows each other.
  scene.maxDepth = b.count(1, std::clamp(static_cast<int>(std::log(100.0) / std::log(b.mirrors() - 0.8)), 1, 32));
  scene.time = random.chance(0.3) ? std::pow(10.0, random.uniform(-1, 5)) : 0.0;
  scene.settings = {{"reflection.scale", random.pick(scales)},
                    {"reflection.samples", random.pick(samples)},
                    {"view.samples", random.pick(samples)},
                    {"view.scale", random.chance(0.2) ? "0.5" : "1"},
                    {"reflection.max_depth", std::to_string(std::min(b.count(1, 3), scene.maxDepth))},
                    {"reflection.max_passes", "1000"},
                    {"effects.rough_lookup", random.chance(0.7) ? "image" : "traced"},
                    {"effects.rough_samples", "4"},
                    {"effects.curved_lookup", random.chance(0.5) ? "environment" : "traced"},
                    {"effects.environment_size", "32"},
                    {"reflection.update_interval", random.chance(0.2) ? "2" : "1"}};
  return scene;
}

RandomScene smallest(RandomScene scene, const std::function<bool(const RandomScene&)>& fails) {
  const std::string whole = scene.text;
  scene.name += "_smallest";
  std::vector<std::string> tables;
  for (size_t begin = 0; begin < whole.size();) {
    const size_t next = std::min(whole.find("\n[", begin), whole.size() - 1) + 1;
    tables.push_back(whole.substr(begin, next - begin));
    begin = next;
  }
  const auto join = [&](const std::vector<std::string>& parts) {
    scene.text.clear();
    for (const std::string& part : parts) {
      scene.text += part;
    }
    writeFiles(scene);
  };
  for (size_t kept = SIZE_MAX; tables.size() < kept;) {
    kept = tables.size();
    for (size_t i = tables.size(); i-- > 0;) {
      std::vector<std::string> without = tables;
      without.erase(without.begin() + static_cast<std::ptrdiff_t>(i));
      join(without);
      if (fails(scene)) {
        tables = std::move(without);
      }
    }
  }
  join(tables);
  return scene;
}

}  // namespace speculum::testing_support
