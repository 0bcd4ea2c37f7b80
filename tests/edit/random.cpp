// Random edits of a scene file that uses every notation: the saved file reads back exactly, and undoing everything
// restores the file.
#include <rapidcheck.h>

#include "edit/support.hpp"
#include "scene/scene_fields.hpp"

namespace speculum {
namespace {

using Kind = Selection::Kind;

constexpr const char* editedText =
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

template <Described Node>
void editField(Node& node);

// Keeps mirrors near the origin for their size, as the loader requires.
template <typename Owner>
glm::dvec3 pointOf(const Range& range) {
  const glm::dvec3 any = std::is_same_v<Owner, Mirror> ? color() : point();
  return glm::clamp(any, glm::dvec3(range.low), glm::dvec3(range.high));
}

// Returns a random value that the field may have.
template <typename Field, typename Value>
void randomize(const Field& field, Value& value) {
  if constexpr (Described<Value>) {
    editField(value);
  } else if constexpr (IsOptional<Value>::value) {
    auto inner = value.value_or(field.start.value_or(typename Value::value_type{}));
    randomize(field, inner);
    value = whole(0, 3) == 0 ? std::nullopt : Value(inner);
  } else if constexpr (std::is_same_v<Value, bool>) {
    value = !value;
  } else if constexpr (std::is_same_v<Value, int>) {
    value = field.range.powersOfTwo ? 1 << whole(0, 4) : whole(1, 4);
  } else if constexpr (std::is_same_v<Value, double>) {
    const Range& range = field.range;
    value = range.high <= 1e6 ? range.low + (range.high - range.low) * share()
            : range.low == 0.0
                ? positive()
                : std::clamp(number(), std::max(range.low, field.floor), std::min(range.high, field.ceiling));
  } else if constexpr (std::is_same_v<Value, std::string>) {
    value = name();
  } else if constexpr (std::is_enum_v<Value>) {
    value = static_cast<Value>(whole(0, static_cast<int>(choicesOf(value).size())));
  } else if constexpr (std::is_same_v<Value, glm::dvec2>) {
    value = {share() + 0.25, share() + 0.25};
  } else if constexpr (std::is_same_v<Value, glm::dvec3>) {
    const bool uniform = whole(0, 2) == 0;
    value = field.color           ? color()
            : field.uniform       ? (uniform ? glm::dvec3(share() + 0.1) : glm::dvec3(1.0, share() + 0.1, 2.0))
            : field.key == "axis" ? glm::dvec3(share(), 1.0, share())
            : whole(0, 2) == 0    ? glm::dvec3(value.x, value.y, std::clamp(share(), field.range.low, field.range.high))
                                  : pointOf<typename Field::Owner>(field.range);
  }
}

template <Described Node>
void editField(Node& node) {
  const int chosen = whole(0, static_cast<int>(fieldCount<Node>));
  int index = 0;
  forEachField<Node>([&](const auto& field) {
    if (index++ == chosen && field.appliesTo(node) && field.key != "model" && field.key != "reflectance_map") {
      randomize(field, node.*field.member);
    }
  });
}

void editMirror(Mirror& mirror) {
  const int what = whole(0, 8);
  if (what > 1) {
    editField(mirror);
    return;
  }
  mirror = Mirror{.name = mirror.name};
  if (what == 0) {
    mirror.position = color();
    mirror.size = {share() + 0.25, share() + 0.25};
  }
  for (int i = 0; what == 1 && i < 24; ++i) {
    const double turn = i * 0.2617993877991494;
    mirror.polygon.push_back({std::cos(turn), std::sin(turn), 0.0});
  }
}

void editScene(SceneDocument& document) {
  document.change("edit", {}, [&](Scene& scene) {
    const int what = whole(0, 6);
    if (what == 0) {
      editField(scene.environment);
    } else if (what == 1) {
      scene.camera.position = {share(), 5.0 + share(), share()};
      scene.camera.target = {1.0 + share(), share(), 2.0};
      scene.camera.verticalFov = 1.0 + 100.0 * share();
    } else if (what <= 3 && !scene.objects.empty()) {
      editField(scene.objects[whole(0, static_cast<int>(scene.objects.size()))]);
    } else if (what == 4 && !scene.lights.empty()) {
      editField(scene.lights[whole(0, static_cast<int>(scene.lights.size()))]);
    } else if (!scene.mirrors.empty()) {
      editMirror(scene.mirrors[whole(0, static_cast<int>(scene.mirrors.size()))]);
    }
  });
}

// Selects one of the nodes; none if there are none.
Selection anything(const Scene& scene) {
  const std::array counts{scene.objects.size(), scene.lights.size(), scene.mirrors.size()};  // by Kind
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
      if (const Selection node = anything(scene)) {
        document.duplicate({&node, 1});
      }
      break;
    case 4:
    case 5:
      if (const Selection node = anything(scene)) {
        document.remove({node});
      }
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
    default:
      editScene(document);
  }
}

TEST(RandomEdits, ReadBackAndUndoToTheBytes) {
  TextScene text(editedText);
  const std::filesystem::path other = text.folder / "other.toml";
  EXPECT_TRUE(rc::check("random edits", [&] {
    Scene scene = text.scene;
    SceneDocument document(scene);
    const int steps = whole(1, 25);
    for (int i = 0; i < steps; ++i) {
      step(document);
    }
    document.save(other, {}, true);
    expectSameContent(loadScene(other), scene, "after " + std::to_string(steps) + " steps:\n" + readText(other));
    RC_ASSERT(!testing::Test::HasFailure());
    while (document.canUndo()) {
      document.undo();
    }
    RC_ASSERT(document.text(other, {}) == editedText);
  }));
}

}  // namespace
}  // namespace speculum
