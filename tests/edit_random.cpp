// Random edits of a scene that is written in every way at once: what is saved reads back exactly, and undone to the
// beginning it is the file as it was.
#include <rapidcheck.h>

#include <cmath>

#include "edit_support.hpp"

namespace speculum {
namespace {

using Kind = Selection::Kind;

constexpr const char* kText =
    "\xef\xbb\xbf# Jeder Weg, etwas zu sagen\r\n"
    "title = 'Größe' # µ\r\n"
    "environment.ambient = [0.1, 0.1, 0.1]\r\n"
    "environment.sky.zenith = [1, 1, 1]\r\n"
    "environment.sky.horizon = [1, 1, 1]\r\n"
    "environment.sky.ground = [1, 1, 1]\r\n"
    "bookmark = [ { name = 'a', position = [0, 0, 1], target = [0, 0, 0] }, # first\r\n"
    "  { name = 'b', position = [0, 0, 2], target = [0, 0, 0] } ]\r\n"
    "[camera]\r\nposition = [0, 1, 4]\r\ntarget   = [0, 0, 0]\r\n"
    "# triangles\r\n[[object]]\r\nmodel = \"triangle.obj\"\r\nscale = [1, 1, 1]\r\n"
    "\"copies\".'count' = 2 # two\r\n"
    "[object.mirror] # bent\r\nreflectance = [0.5, 0.5, 0.5]\r\n\r\n"
    "[[object]]\r\nname = '''x'''\r\nmodel = 'triangle.obj'\r\nmirror = {}\r\n\r\n"
    "[[light]] # lamp\r\nposition = [\r\n  0, # x\r\n  1,\r\n  2, # z\r\n]\r\n"
    "orbit = { speed = 1.0, axis = [0, 1, 0] }\r\n"
    "[[mirror]]\r\nsize = [1, 1]\r\nripple = { amplitude = 0.1 }\r\n"
    "[[light]]\r\nposition = [0, 0, 0]\r\n"
    "[[mirror]]\r\npolygon = [[0, 0, 0], [1, 0, 0], [0, 1, 0]]\r\n"
    "[mirror.ripple]\r\namplitude = 0.1";

int whole(int low, int high) {
  return *rc::gen::resize(rc::kNominalSize, rc::gen::inRange(low, high));
}

double number() {
  const double size = std::pow(10.0, whole(-16, 3)) * whole(0, 1 << 30) / 7.0;
  return std::array{0.0, 1.0, size, -size}[whole(0, 4)];
}

double positive() {
  return std::abs(number()) + 0.25;
}

double share() {
  return whole(0, 1001) / 1000.0;
}

glm::dvec3 point() {
  const double x = number();
  const double y = number();
  return {x, y, number()};
}

glm::dvec3 color() {
  const double r = share();
  const double g = share();
  return {r, g, share()};
}

std::string name() {
  return std::array<std::string, 6>{"", "a", "ä \"b\"", "c\\d\n", "#[x]", "'''"}[whole(0, 6)];
}

void editObject(Object& object) {
  switch (whole(0, 9)) {
    case 0:
      object.name = name();
      break;
    case 1:
      object.position = point();
      break;
    case 2:
      object.rotation[whole(0, 3)] = number();
      break;
    case 3:
      object.scale = whole(0, 2) == 0 ? glm::dvec3(share() + 0.1) : glm::dvec3(1.0, share() + 0.1, 2.0);
      break;
    case 4:
      object.color = whole(0, 2) == 0 ? std::optional<glm::dvec3>() : color();
      break;
    case 5:
      object.shininess = whole(0, 2) == 0 ? std::optional<double>() : 1.0 + share();
      break;
    case 6:
      object.copies = {whole(1, 4), whole(0, 2) == 0 ? glm::dvec3(0.0) : point()};
      break;
    case 7:
      object.mirror.reset();
      break;
    default:
      object.mirror = ObjectMirror{color(), whole(0, 2) == 0 ? Fresnel::none : Fresnel::schlick, color()};
  }
}

void editLight(PointLight& light) {
  switch (whole(0, 8)) {
    case 0:
      light.name = name();
      break;
    case 1:
      light.position = point();
      break;
    case 2:
      light.position.z = number();
      break;
    case 3:
      light.intensity = positive();
      break;
    case 4:
      light.radius = positive();
      break;
    case 5:
      light.castsShadow = !light.castsShadow;
      break;
    case 6:
      light.orbit.reset();
      break;
    default:
      light.orbit = Orbit{point(), {share(), 1.0, share()}, number() / 1e12};
  }
}

void editMirror(Mirror& mirror) {
  switch (whole(0, 8)) {
    case 0:
      mirror.name = name();
      break;
    case 1:
      mirror.reflectance = color();
      break;
    case 2:
      mirror.twoSided = !mirror.twoSided;
      break;
    case 3:
      mirror.fresnel = mirror.fresnel == Fresnel::none ? Fresnel::schlick : Fresnel::none;
      break;
    case 4:
      mirror.ripple.reset();
      break;
    case 5:
      mirror.ripple = Ripple{share() + 0.001, share() + 0.001, number()};
      break;
    case 6:
      mirror = Mirror{.name = mirror.name, .position = color(), .size = {share() + 0.25, share() + 0.25}};
      break;
    default:
      mirror = Mirror{.name = mirror.name};
      for (int i = 0; i < 24; ++i) {
        const double turn = i * 0.2617993877991494;
        mirror.polygon.push_back({std::cos(turn), std::sin(turn), 0.0});
      }
  }
}

void editScene(SceneDocument& document) {
  document.change("edit", {}, [&](Scene& scene) {
    const int what = whole(0, 6);
    if (what == 0) {
      scene.environment.background = color();
      scene.environment.ambient = color();
      scene.environment.sky = whole(0, 2) == 0 ? std::optional<Sky>() : Sky{color(), color(), color()};
    } else if (what == 1) {
      scene.camera.position = {share(), 5.0 + share(), share()};
      scene.camera.target = {1.0 + share(), share(), 2.0};
      scene.camera.verticalFov = 1.0 + 100.0 * share();
    } else if (what <= 3 && !scene.objects.empty()) {
      editObject(scene.objects[whole(0, static_cast<int>(scene.objects.size()))]);
    } else if (what == 4 && !scene.lights.empty()) {
      editLight(scene.lights[whole(0, static_cast<int>(scene.lights.size()))]);
    } else if (!scene.mirrors.empty()) {
      editMirror(scene.mirrors[whole(0, static_cast<int>(scene.mirrors.size()))]);
    }
  });
}

// One of the things that there are; nothing if there are none.
Selection anything(const Scene& scene) {
  const std::array counts{scene.objects.size(), scene.mirrors.size(), scene.lights.size()};
  const int kind = whole(0, 3);
  const auto count = static_cast<int>(counts[kind]);
  return count == 0 ? Selection() : Selection{static_cast<Kind>(kind + 1), whole(0, count)};
}

void step(SceneDocument& document) {
  const Scene& scene = document.scene();
  switch (whole(0, 16)) {
    case 0:
      document.addMirror(color(), point());
      break;
    case 1:
      document.addLight(color(), color());
      break;
    case 2:
      document.addObject(0, point());
      break;
    case 3:
      document.duplicate(anything(scene));
      break;
    case 4:
    case 5:
      document.remove(anything(scene));
      break;
    case 6:
      document.undo();
      break;
    case 7:
      document.redo();
      break;
    case 8:
      document.addBookmark({.name = name(), .position = {0, 0, 9}, .target = color()});
      break;
    case 9:
      if (!scene.bookmarks.empty()) {
        document.removeBookmark(whole(0, static_cast<int>(scene.bookmarks.size())));
      }
      break;
    case 10:
      if (!scene.bookmarks.empty()) {
        document.renameBookmark(0, name());
      }
      break;
    default:
      editScene(document);
  }
}

TEST(RandomEdits, ReadBackExactlyAndAreUndoneToTheBytes) {
  TextScene text(kText);
  const std::filesystem::path other = text.folder / "other.toml";
  EXPECT_TRUE(rc::check("random edits", [&] {
    Scene scene = text.scene;
    SceneDocument document(scene);
    const int steps = whole(1, 25);
    for (int i = 0; i < steps; ++i) {
      step(document);
    }
    document.save(other, {}, true);
    expectSameContent(loadScene(other), scene, "after " + std::to_string(steps) + " steps:\n" + contentOfFile(other));
    RC_ASSERT(!testing::Test::HasFailure());
    while (document.canUndo()) {
      document.undo();
    }
    RC_ASSERT(document.text(other, {}) == kText);
  }));
}

}  // namespace
}  // namespace speculum
