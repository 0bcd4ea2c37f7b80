#include "scene_text.hpp"

#include <cmath>
#include <fstream>
#include <numbers>
#include <sstream>

#include "picture_support.hpp"
#include "test_paths.hpp"

namespace speculum::testing_support {

const std::string wallScene = R"(
[environment] background = [0.2, 0.3, 0.4], ambient = [0.3, 0.3, 0.3]
[camera] position = [0, 1, 4], target = [0, 1, 0]
[settings] "view.samples" = 1, "reflection.samples" = 1
[[object]] name = "ball", model = "MODELS/sphere.obj", position = [0.9, 1, 0]
[[light]] position = [0, 3, 3], intensity = 10
[[mirror]] name = "wall", position = [0, 1, -2], size = [5, 3]
)";

const std::string corridorNodes = R"(
[[object]] name = "ball", model = "MODELS/sphere.obj", position = [0.3, 1, 0.5], scale = 0.2
[[light]] name = "lamp", position = [-0.5, 1.5, 0], radius = 0.05, intensity = 4
)";

std::string corridorScene(const std::string& nodes) {
  return R"(
[environment] background = [0.2, 0.3, 0.4], ambient = [0.3, 0.3, 0.3]
[camera] position = [0, 1, 1.5], target = [0, 1, -2]
[settings] "view.samples" = 1, "reflection.samples" = 1
)" + nodes +
         R"(# In front of the eye.
[[mirror]] name = "ahead", position = [0, 1, -2], size = [3, 2]
[[mirror]] name = "behind", position = [0, 1, 2], rotation = [0, 180, 0], size = [3, 2]
)";
}

std::string plainScene(unsigned seed, PlainMirrors mirrors, const std::string& mirrorKeys) {
  Random random(seed);
  const auto color = [&](double low, double high) {
    const double r = random.uniform(low, high);
    const double g = random.uniform(low, high);
    return text(glm::dvec3(r, g, random.uniform(low, high)));
  };
  std::string toml = "[environment]\nambient = [1, 1, 1]\nbackground = " + color(0.1, 1.0) + "\n" +
                     cameraText({0, 0, random.uniform(-0.3, 0.3)}, {random.uniform(-0.2, 0.2), 0.1, -2});
  for (int i = 0; i < 4; ++i) {
    const glm::dvec3 at(random.uniform(-1.6, 1.6), random.uniform(-0.9, 0.9), i % 2 == 0 ? -0.6 : 0.8);
    toml += "[[object]]\nmodel = \"quad.obj\"\nposition = " + text(at) + "\nscale = " + text(random.uniform(0.2, 0.5)) +
            "\ncolor = " + color(0.05, 1.0) + "\n";
  }
  const auto mirror = [&](const glm::dvec3& position, double turned) {
    return "[[mirror]]\n" + rectangleText(position, {0, turned, 0}, 30, 30) + "reflectance = " + color(0.8, 0.98) +
           "\n" + mirrorKeys;
  };
  toml += mirror({0, 0, -1}, 0);
  return toml + (mirrors == PlainMirrors::facing ? mirror({0, 0, 1}, 180) : mirror({-1.2, 0, 0}, 90));
}

// Breaks lines after the header of a table and at commas between its keys.
static std::string keyPerLine(const std::string& text) {
  std::string lines;
  int depth = 0;   // of brackets
  char until = 0;  // ends the string or comment that is read
  for (const char c : text) {
    if (until != 0) {
      until = c == until ? 0 : until;
      lines += c;
      continue;
    }
    until = c == '"' || c == '\'' ? c : c == '#' ? '\n' : 0;
    depth += (c == '[' || c == '{') - (c == ']' || c == '}');
    const bool afterHeader = c == ' ' && lines.ends_with(']') && lines[lines.rfind('\n') + 1] == '[';
    if (depth == 0 && (c == ',' || afterHeader)) {
      lines += '\n';
    } else if (c != ' ' || !lines.ends_with('\n')) {
      lines += c;
    }
  }
  return lines;
}

std::string tomlOf(const std::string& text) {
  std::string file = keyPerLine(text);
  const std::string models = (sourceDir() / "models").string() + "/";
  for (size_t at = file.find("MODELS/"); at != std::string::npos; at = file.find("MODELS/", at)) {
    file.replace(at, 7, models);
  }
  return file;
}

std::string text(double value) {
  std::ostringstream out;
  out.precision(17);
  out << std::showpoint << value;
  return out.str();
}

std::string text(const glm::dvec3& v) {
  return "[" + text(v.x) + ", " + text(v.y) + ", " + text(v.z) + "]";
}

std::string cameraText(const glm::dvec3& position, const glm::dvec3& target, const glm::dvec3& up) {
  return "[camera]\nposition = " + text(position) + "\ntarget = " + text(target) + "\nup = " + text(up) + "\n";
}

std::string objectText(const std::string& model, const glm::dvec3& position, const glm::dvec3& rotation, double scale,
                       const glm::dvec3& color) {
  return "[[object]]\nmodel = \"" + model + "\"\nposition = " + text(position) + "\nrotation = " + text(rotation) +
         "\nscale = " + text(scale) + "\ncolor = " + text(color) + "\n";
}

std::string rectangleText(const glm::dvec3& position, const glm::dvec3& rotation, double width, double height) {
  return "position = " + text(position) + "\nrotation = " + text(rotation) + "\nsize = [" + text(width) + ", " +
         text(height) + "]\n";
}

std::string polygonText(const std::vector<glm::dvec3>& corners) {
  std::string out = "polygon = [";
  for (const glm::dvec3& p : corners) {
    out += text(p) + ", ";
  }
  return out + "]\n";
}

void writeModel(const std::string& file, const std::string& obj) {
  std::ofstream(sceneDirectory() / file) << obj;
}

void writeQuad() {
  writeModel("quad.obj", "v -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nf 1 2 3 4\n");
}

std::string writeRandomMesh(unsigned seed) {
  Random random(seed + 1000);
  constexpr int rings = 14;
  constexpr int sectors = 20;
  const double waves = std::floor(random.uniform(1, 6));
  const double depth = random.uniform(0.05, 0.35);
  std::ostringstream out;
  const auto vector = [&](const char* key, const glm::dvec3& v) {
    out << key << ' ' << v.x << ' ' << v.y << ' ' << v.z << '\n';
  };
  for (int i = 0; i <= rings; ++i) {
    for (int j = 0; j < sectors; ++j) {
      const double theta = std::numbers::pi * i / rings;
      const double phi = 2.0 * std::numbers::pi * j / sectors;
      const glm::dvec3 n(std::sin(theta) * std::cos(phi), std::cos(theta), std::sin(theta) * std::sin(phi));
      const glm::dvec3 p = (0.5 + depth * std::sin(waves * theta) * std::cos(waves * phi)) * n;
      if (seed % 3 == 0) {
        out << "v " << p.x << ' ' << p.y << ' ' << p.z << ' ' << random.uniform(0, 1) << " 0.5 " << random.uniform(0, 1)
            << '\n';
      } else {
        vector("v", p);
      }
      vector("vn", n);
    }
  }
  const auto corner = [&](int i, int j) {
    const std::string index = std::to_string(i * sectors + j % sectors + 1);
    return ' ' + (seed % 2 == 0 ? index + "//" + index : index);
  };
  for (int i = 0; i < rings; ++i) {
    out << "s " << (seed % 4 == 1 ? i / 4 : 0) << '\n';
    for (int j = 0; j < sectors; ++j) {
      out << 'f' << corner(i, j) << corner(i, j + 1) << corner(i + 1, j + 1) << corner(i + 1, j) << '\n';
    }
  }
  const std::string name = "lump_" + std::to_string(seed) + ".obj";
  writeModel(name, out.str());
  return (sceneDirectory() / name).string();
}

std::string randomObjectText(Random& random, unsigned seed, double size, const glm::dvec2& stretch,
                             const std::function<std::string()>& position) {
  static constexpr std::array<const char*, 6> models = {"teapot", "torus_knot", "sphere", "vase", "queen", "gem"};
  const std::string model = random.chance(0.4) ? writeRandomMesh(seed) : "MODELS/" + random.pick(models) + ".obj";
  const double side = random.uniform(0.3, size);
  std::ostringstream out;
  out << "[[object]]\nmodel = \"" << model << "\"\nposition = " << position()
      << "\nrotation = " << random.vec(-180, 180) << "\nscale = [" << (random.chance(0.3) ? -side : side) << ", "
      << side * random.uniform(stretch.x, stretch.y) << ", " << side << "]\n";
  if (random.chance(0.5)) {
    out << "color = " << random.vec(0, 1) << "\nspecular = " << random.vec(0, 0.3)
        << "\nshininess = " << std::pow(10.0, random.uniform(0, 3)) << "\n";
  }
  return out.str();
}

std::string randomLightText(Random& random, const std::string& position) {
  std::ostringstream out;
  out << "[[light]]\nposition = " << position << "\ncolor = " << random.vec(0.2, 1)
      << "\nintensity = " << random.uniform(3, 15) << "\nradius = " << random.uniform(0.02, 0.2) << "\n";
  return out.str();
}

}  // namespace speculum::testing_support
