// Objects of any model and the vertices of polygon mirrors, in the inspector.
#include <fstream>

#include "demo_edit_support.hpp"

namespace speculum {
namespace {

using namespace testing_support;

class EditModels : public EditWindow {
 protected:
  void typeModel(const std::string& file) {
    if (edit().model != static_cast<int>(edit().models.size())) {
      click("edit.model");
      click("edit.model.file");
      run(3);
    }
    click("edit.model_file");
    for (const auto& [action, key] : {std::pair("keydown", "Control_L"), std::pair("keydown", "a"),
                                      std::pair("keyup", "a"), std::pair("keyup", "Control_L")}) {
      xdotool({action, "--window", windowId(), key});
      run(2);
    }
    xdotool({"type", "--window", windowId(), file});
    run(5);
    EXPECT_EQ(edit().modelFile, file);
    click("edit.add_object");
    run(3);
  }
  std::filesystem::path folder() const { return std::filesystem::path(options_.scene).parent_path(); }
};

TEST_F(EditModels, ObjectsOfAnyModelAreAddedAndSaved) {
  const std::vector<uint8_t> before = bare();
  press("Tab");
  press("F2");
  EXPECT_EQ(edit().models.front(), "sphere") << "the scene's first";
  EXPECT_EQ(std::count(edit().models.begin(), edit().models.end(), "sphere"), 1);
  click("edit.model");
  click("edit.model.vase");
  click("edit.add_object");
  ASSERT_EQ(edit().undo, "add object 'vase'") << edit().note;
  EXPECT_EQ(edit().models[static_cast<size_t>(edit().model)], "vase");
  const Object vase = object();
  typeModel("nowhere.obj");
  EXPECT_EQ(edit().note, (folder() / "nowhere.obj").string() + ": there is no such file (name a Wavefront OBJ file)");
  EXPECT_EQ(demo_->model().status.text, edit().note) << "it is said";
  std::ofstream(folder() / "empty.obj") << "v 0 0 0\n";
  typeModel("empty.obj");
  EXPECT_NE(edit().note.find("empty.obj:1: f: the model has no triangle"), std::string::npos) << edit().note;
  EXPECT_EQ(edit().note.find('\n'), std::string::npos);
  EXPECT_EQ(edit().undo, "add object 'vase'") << "nothing is lost";
  std::ofstream(folder() / "flag.obj") << "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
  typeModel("flag.obj");
  ASSERT_EQ(edit().undo, "add object 'flag'") << edit().note;
  press("Tab");
  const std::vector<uint8_t> added = bare();
  EXPECT_NE(before, added);
  press("ctrl+z");
  press("ctrl+z");
  EXPECT_EQ(before, bare());
  press("ctrl+y");
  press("ctrl+y");
  EXPECT_EQ(added, bare());
  press("ctrl+s");
  EXPECT_FALSE(edit().unsaved) << edit().note;
  const Scene saved = onDisk();
  ASSERT_EQ(saved.objects.size(), 3u);
  EXPECT_EQ(saved.objects[1].position, vase.position);
  EXPECT_TRUE(std::filesystem::path(saved.objects[1].model).is_relative()) << saved.objects[1].model;
  EXPECT_EQ(saved.objects[2].model, "flag.obj");
  expectQuiet();
  demo_.reset();
  start();
  press("Tab");
  EXPECT_EQ(added, bare());
  expectQuiet();
}

class EditPolygon : public EditWindow {
 protected:
  EditPolygon() : EditWindow(withPolygon) {}

  static inline const std::string withPolygon = corridor + R"(
[[mirror]]
name = "sail"
polygon = [[-0.8, 0.5, -1], [0.8, 0.5, -1], [0.8, 1.6, -1], [-0.8, 1.6, -1]]
)";

  std::vector<glm::dvec3> polygon() const { return std::get<Mirror>(edit().thing).polygon; }
  // One of the three numbers of a vertex.
  void typeNumber(int vertex, int part, const std::string& number) {
    const PixelRect rect = widget("edit.polygon." + std::to_string(vertex));
    moveTo(rect.x + rect.width * (2 * part + 1) / 6, rect.y + rect.height / 2);
    xdotool({"keydown", "--window", windowId(), "Control_L"});
    xdotool({"mousedown", "1"});
    run(2);
    xdotool({"mouseup", "1"});
    xdotool({"keyup", "--window", windowId(), "Control_L"});
    run(3);
    press("ctrl+a");
    xdotool({"type", "--window", windowId(), "--", number});
    run(3);
    xdotool({"keydown", "--window", windowId(), "Return"});
    run(2);
    xdotool({"keyup", "--window", windowId(), "Return"});
    run(3);
  }
  // With the pointer where no handle is.
  std::vector<uint8_t> withoutPanel() {
    press("Tab");
    moveTo(width - 3, height - 3);
    waitFor([&] { return demo_->model().status.text.empty(); });
    const std::vector<uint8_t> shown = picture().rgba;
    press("Tab");
    return shown;
  }
};

TEST_F(EditPolygon, VerticesAreNumbersThatASceneFileCouldSay) {
  press("Tab");
  press("F2");
  for (int i = 0; i < 3; ++i) {
    press("n");
  }
  ASSERT_EQ(polygon().size(), 4u);
  const std::vector<glm::dvec3> loaded = polygon();
  const std::vector<uint8_t> before = withoutPanel();
  typeNumber(2, 0, "0.55");
  EXPECT_EQ(polygon()[2], glm::dvec3(0.55, 1.6, -1.0)) << edit().polygon.problem;
  EXPECT_EQ(edit().undo, "edit mirror 'sail'");
  const std::vector<glm::dvec3> narrowed = polygon();
  typeNumber(2, 2, "-0.5");
  EXPECT_EQ(polygon(), narrowed);
  EXPECT_EQ(edit().polygon.problem.find("polygon: is not planar (a planar, convex polygon"), 0u)
      << edit().polygon.problem;
  typeNumber(3, 2, "-0.5");
  ASSERT_EQ(edit().polygon.problem, "") << "both upper vertices are nearer now";
  EXPECT_EQ(polygon()[2], glm::dvec3(0.55, 1.6, -0.5));
  EXPECT_EQ(polygon()[3], glm::dvec3(-0.8, 1.6, -0.5));
  typeNumber(1, 0, "-2");
  EXPECT_EQ(edit().polygon.problem.find("polygon: is not convex"), 0u) << edit().polygon.problem;
  click("edit.polygon.reset");
  EXPECT_EQ(edit().polygon.problem, "");
  click("edit.polygon.1.add");
  ASSERT_EQ(polygon().size(), 5u);
  EXPECT_EQ(polygon()[2], 0.5 * (polygon()[1] + polygon()[3]));
  click("edit.polygon.0.remove");
  ASSERT_EQ(polygon().size(), 4u);
  press("ctrl+s");
  const Scene saved = onDisk();
  EXPECT_EQ(saved.mirrors[2].polygon, polygon());
  for (int i = 0; i < 4; ++i) {
    press("ctrl+z");
  }
  EXPECT_EQ(polygon(), loaded);
  EXPECT_EQ(edit().polygon.vertices, loaded);
  EXPECT_TRUE(before == withoutPanel());
  expectQuiet();
}

}  // namespace
}  // namespace speculum
