#include "edit/new_nodes.hpp"
#include "edit/support.hpp"

namespace speculum {
namespace {

using Kind = Selection::Kind;

constexpr const char* sceneText = R"([camera]
position = [0, 1, 4]
target = [0, 0, 0]
[[object]]
name = "teapot"
model = "triangle.obj"
scale = 2
copies = { count = 3, step = [0, 0, 1] }
[[light]]
name = "lamp"
position = [0, 2, 0]
orbit = { center = [1, 2, 0], speed = 10 }
[[mirror]]
name = "floor"
rotation = [-90, 0, 0]
size = [4, 4]
)";

const Selection teapot{Kind::object, 0};
const Selection floorMirror{Kind::mirror, 0};
const Selection lampLight{Kind::light, 0};

auto moveTeapot(double x) {
  return [x](Scene& scene) { scene.objects[0].position.x = x; };
}

// A pane whose material says mirror.
TEST(MirrorsFromMaterials, FollowTheDocument) {
  const TemporaryFolder folder;
  folder.write("m.mtl", "newmtl m\nKs 1 1 1\nNs 1000\nillum 3\n");
  folder.write("m.obj", "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl m\nf 1 2 3\n");
  Scene scene = loadScene(
      folder.write("s.toml", "[camera]\nposition = [0, 1, 4]\ntarget = [0, 0, 0]\n[[object]]\nmodel = \"m.obj\"\n"));
  SceneDocument document(scene);
  const uint64_t structure = document.structureRevision();
  ASSERT_EQ(scene.mirrorCount(), 1u);
  document.change("off", teapot, [](Scene& s) { s.objects[0].mirrorsFromMaterials = false; });
  EXPECT_EQ(scene.mirrorCount(), 0u);
  EXPECT_NE(document.structureRevision(), structure);
  document.undo();
  EXPECT_EQ(scene.mirrorCount(), 1u);
  document.duplicate({&teapot, 1});
  EXPECT_EQ(scene.mirrorCount(), 2u);
  EXPECT_EQ(scene.mirrors.size(), 0u) << "they are no nodes of their own";
  EXPECT_EQ(mirrorNode(scene, 1), (Selection{Kind::object, 1}));
  EXPECT_EQ(mirrorNode(scene, 2), Selection());
  document.remove({{Kind::object, 0}});
  EXPECT_EQ(mirrorNode(scene, 0), (Selection{Kind::object, 0}));
  EXPECT_EQ(evaluate(scene, 0.0).mirrors.size(), 1u);
  EXPECT_EQ(document.text(scene.file, {}).find("[[mirror]]"), std::string::npos);
}

class SceneDocumentTest : public testing::Test, protected TextScene {
 protected:
  SceneDocumentTest() : TextScene(sceneText) {}
};

TEST_F(SceneDocumentTest, UndoRedoRestoreContentLabelAndSelection) {
  EXPECT_FALSE(document.canUndo() || document.canRedo() || document.modified());
  document.select(lampLight);
  document.change("move object 'teapot'", teapot, moveTeapot(1));
  document.change("widen mirror 'floor'", floorMirror, [](Scene& scene) { scene.mirrors[0].size.x = 8; });
  EXPECT_EQ(document.undoLabel(), "widen mirror 'floor'");
  EXPECT_EQ(document.selection(), floorMirror);
  document.select({});
  document.undo();
  EXPECT_EQ(document.selection(), floorMirror);
  EXPECT_EQ(scene.mirrors[0].size.x, 4);
  EXPECT_EQ(document.undoLabel(), "move object 'teapot'");
  EXPECT_EQ(document.redoLabel(), "widen mirror 'floor'");
  document.undo();
  EXPECT_EQ(document.selection(), teapot);
  EXPECT_EQ(scene.objects[0].position.x, 0);
  EXPECT_FALSE(document.canUndo() || document.modified());
  document.undo();
  document.redo();
  document.redo();
  document.redo();
  EXPECT_EQ(scene.objects[0].position.x, 1);
  EXPECT_EQ(scene.mirrors[0].size.x, 8);
  EXPECT_FALSE(document.canRedo());
  document.undo();
  document.change("move object 'teapot'", teapot, moveTeapot(2));
  EXPECT_FALSE(document.canRedo()) << "a new step ends what could be redone";
}

TEST_F(SceneDocumentTest, SettingsAreStepsThatLeaveTheScene) {
  document.change("move object 'teapot'", teapot, moveTeapot(1));
  const uint64_t revision = document.revision();
  const Settings before;
  Settings after;
  after.view.exposure = 2.0;
  document.settingsChanged(before, before, false);
  EXPECT_TRUE(document.changesScene(UndoWay::back)) << "nothing has changed";
  document.settingsChanged(before, after, false);
  EXPECT_EQ(document.undoLabel(), "change Exposure");
  EXPECT_FALSE(document.changesScene(UndoWay::back));
  after.view.samples = 1;
  document.settingsChanged(before, after, true);
  EXPECT_EQ(document.undoLabel(), "change settings");
  const std::optional<SettingsStep> step = document.undo();
  ASSERT_TRUE(step);
  EXPECT_EQ(step->before, before);
  EXPECT_EQ(step->after, after);
  EXPECT_EQ(document.revision(), revision);
  EXPECT_TRUE(document.redo());
  document.undo();
  EXPECT_FALSE(document.undo()) << "a step of the scene";
  EXPECT_EQ(scene.objects[0].position.x, 0);
  EXPECT_TRUE(document.changesScene(UndoWay::forward));
}

TEST_F(SceneDocumentTest, RevertedDragOfSettingAddsNoStep) {
  document.change("move object 'teapot'", teapot, moveTeapot(1));
  const Settings before;
  Settings after;
  after.view.exposure = 2.0;
  document.settingsChanged(before, after, false);
  document.settingsChanged(after, before, true);
  EXPECT_EQ(document.undoLabel(), "move object 'teapot'");
  EXPECT_TRUE(document.changesScene(UndoWay::back));
  document.settingsChanged(before, after, true);
  EXPECT_EQ(document.undoLabel(), "change Exposure") << "the drag goes on";
  EXPECT_TRUE(document.undo());
  EXPECT_FALSE(document.undo()) << "a step of the scene";
  EXPECT_EQ(scene.objects[0].position.x, 0);
  EXPECT_FALSE(document.canUndo());
}

TEST_F(SceneDocumentTest, StepsOfHalvesAreForgottenTogether) {
  document.change("move object 'teapot'", teapot, moveTeapot(1));
  const Settings before;
  Settings after;
  after.view.exposure = 2.0;
  document.settingsChanged(before, after, false, 0);
  document.settingsChanged(before, after, true, 1);
  EXPECT_EQ(document.undoLabel(), "change Exposure of B") << "a drag does not go on in the other half";
  EXPECT_EQ(document.undo()->half, 1);
  EXPECT_EQ(document.undoLabel(), "change Exposure of A");
  document.change("move object 'teapot'", teapot, moveTeapot(2));
  document.settingsChanged(before, after, false, 1);
  document.forgetHalves();
  for (const double x : {1.0, 0.0}) {
    EXPECT_EQ(document.undoLabel(), "move object 'teapot'");
    EXPECT_FALSE(document.undo());
    EXPECT_EQ(scene.objects[0].position.x, x);
  }
  EXPECT_FALSE(document.canUndo());
}

TEST_F(SceneDocumentTest, SettingDragContinuesOnlyItsStep) {
  const Settings start;
  Settings samples;
  samples.view.samples = 1;
  Settings dragged = samples;
  dragged.view.exposure = 2.0;
  const auto expectOwnStep = [&](const char* interruption, const std::function<void()>& interrupt) {
    document.settingsChanged(start, samples, false);
    document.settingsChanged(samples, dragged, false);
    interrupt();
    document.settingsChanged(samples, dragged, true);
    EXPECT_EQ(document.undoLabel(), "change Exposure") << interruption;
    const std::optional<SettingsStep> step = document.undo();
    ASSERT_TRUE(step) << interruption;
    EXPECT_TRUE(step->before == samples) << interruption;
  };
  expectOwnStep("undo", [&] { document.undo(); });
  expectOwnStep("undo and redo", [&] {
    document.undo();
    document.undo();
    document.redo();
  });
  expectOwnStep("a step of the scene, undone", [&] {
    document.undo();
    document.change("move object 'teapot'", teapot, moveTeapot(1));
    document.undo();
  });
  expectOwnStep("a drag of a node", [&] {
    document.undo();
    document.beginGesture();
    document.change("move object 'teapot'", teapot, moveTeapot(2));
    document.endGesture();
  });
}

TEST_F(SceneDocumentTest, UnchangedValuesAddNoStep) {
  const uint64_t revision = document.revision();
  document.change("move", teapot, moveTeapot(0));
  EXPECT_FALSE(document.canUndo());
  EXPECT_EQ(document.revision(), revision);
}

TEST_F(SceneDocumentTest, FailedChangeLeavesTheSceneUnchanged) {
  EXPECT_THROW(document.change("move", teapot,
                               [](Scene& scene) {
                                 scene.objects[0].position.x = 5;
                                 throw std::runtime_error("no");
                               }),
               std::runtime_error);
  EXPECT_THROW(document.change("drop", teapot, [](Scene& scene) { scene.lights.clear(); }), std::logic_error);
  EXPECT_EQ(scene.objects[0].position.x, 0);
  EXPECT_EQ(scene.lights.size(), 1u);
  EXPECT_FALSE(document.canUndo() || document.modified());
}

TEST_F(SceneDocumentTest, GestureIsOneStep) {
  document.beginGesture();
  for (int i = 1; i <= 10; ++i) {
    document.change("move object 'teapot'", teapot, moveTeapot(i));
    EXPECT_EQ(scene.objects[0].position.x, i);
  }
  EXPECT_TRUE(document.modified());
  document.endGesture();
  EXPECT_EQ(document.undoLabel(), "move object 'teapot'");
  document.undo();
  EXPECT_EQ(scene.objects[0].position.x, 0);
  EXPECT_FALSE(document.canUndo());
  document.redo();
  EXPECT_EQ(scene.objects[0].position.x, 10);

  document.beginGesture();
  document.change("move object 'teapot'", teapot, moveTeapot(20));
  document.undo();
  EXPECT_EQ(scene.objects[0].position.x, 10) << "undo ends the gesture and takes it back";
  EXPECT_FALSE(document.inGesture());
}

TEST_F(SceneDocumentTest, RevertedOrCancelledGestureAddsNoStep) {
  document.beginGesture();
  document.change("move", teapot, moveTeapot(3));
  document.change("move", teapot, moveTeapot(0));
  document.endGesture();
  EXPECT_FALSE(document.canUndo());
  document.change("move", teapot, moveTeapot(7));
  document.undo();
  document.select(lampLight);
  document.beginGesture();
  document.change("move", teapot, moveTeapot(3));
  const uint64_t revision = document.revision();
  document.cancelGesture();
  EXPECT_EQ(scene.objects[0].position.x, 0);
  EXPECT_EQ(document.selection(), lampLight);
  EXPECT_GT(document.revision(), revision);
  EXPECT_FALSE(document.canUndo());
  EXPECT_TRUE(document.canRedo()) << "what was undone before can still be redone";
}

TEST_F(SceneDocumentTest, StructureRevisionIgnoresValues) {
  const auto rises = [&](const auto& action) {
    const uint64_t revision = document.revision();
    const uint64_t structure = document.structureRevision();
    action();
    EXPECT_GT(document.revision(), revision);
    return document.structureRevision() > structure;
  };
  EXPECT_FALSE(rises([&] { document.change("move", teapot, moveTeapot(1)); }));
  EXPECT_FALSE(rises([&] { document.undo(); }));
  EXPECT_TRUE(
      rises([&] { document.change("copies", teapot, [](Scene& scene) { scene.objects[0].copies.count = 4; }); }));
  EXPECT_TRUE(rises([&] { document.undo(); }));
  EXPECT_TRUE(rises([&] { document.addLight({0, 1, 0}, {0, 1, 5}); }));
  EXPECT_TRUE(rises([&] { document.undo(); }));
  EXPECT_TRUE(rises([&] { document.redo(); }));
  EXPECT_TRUE(rises([&] { document.remove({floorMirror}); }));
  EXPECT_FALSE(rises([&] { document.addBookmark({.position = {1, 1, 1}, .target = {0, 0, 0}}); }));
}

// The box of a model, and whether it is taken for one whose Z axis points up.
TEST_F(SceneDocumentTest, ModelsWithZUpLieOnTheirBacks) {
  const auto lies = [&](const glm::dvec3& low, const glm::dvec3& high) {
    scene.meshes[0].unit = 1.0;
    scene.meshes[0].center = (low + high) / 2.0;
    scene.meshes[0].halfExtent = (high - low) / 2.0;
    return liesOnBack(scene, Object{.mesh = 0});
  };
  EXPECT_TRUE(lies({-1, -1, 0}, {1, 1, 2})) << "origin in the middle of the floor";
  EXPECT_TRUE(lies({-30, -0.96, -0.015}, {30, 59.9, 81.8})) << "origin at an edge";
  EXPECT_TRUE(lies({0, -60, 0}, {30, 0, 80})) << "origin at the other edge";
  EXPECT_FALSE(lies({-1, 0, 0}, {1, 2, 2})) << "stands on both planes";
  EXPECT_FALSE(lies({-1, -1, -1}, {1, 1, 1})) << "stands on neither";
  EXPECT_FALSE(lies({-1, -1, 0}, {1, 1, 0.05})) << "a picture on a wall";
}

TEST_F(SceneDocumentTest, AddedNodesFaceTheViewer) {
  document.select(teapot);
  EXPECT_EQ(document.addMirror({1, 2, 3}, {11, 2, 3}), (Selection{Kind::mirror, 1}));
  const Mirror& mirror = scene.mirrors[1];
  EXPECT_EQ(mirror.position, glm::dvec3(1, 2, 3));
  EXPECT_EQ(mirror.rotation, glm::dvec3(0, 90, 0));
  EXPECT_EQ(mirror.size, glm::dvec2(3, 4));
  document.addMirror({0, 0, 0}, {0, 0, 3.997});
  EXPECT_EQ(scene.mirrors[2].size, glm::dvec2(1.2, 1.6)) << "numbers that a user would type";
  document.undo();
  document.addLight({0, 5, 0}, {0, 5, 2});
  EXPECT_EQ(scene.lights[1].intensity, 4);
  EXPECT_EQ(scene.lights[1].radius, 0.02);
  EXPECT_EQ(document.addObject(0, {7, 1, 0}), (Selection{Kind::object, 1}));
  const Object& object = scene.objects[1];
  // The triangle spans 0 .. 1 in x and y.
  EXPECT_EQ(object.position, glm::dvec3(6.5, 1, 0));
  EXPECT_EQ(object.name, "triangle");
  EXPECT_EQ(object.scale, glm::dvec3(1)) << "the model's own, whatever another object makes of it";
  EXPECT_EQ(object.copies.count, 1);
  document.undo();
  document.undo();
  document.undo();
  EXPECT_EQ(document.selection(), teapot);
  EXPECT_FALSE(document.modified());
}

TEST_F(SceneDocumentTest, DuplicatesGetNamesAndPositions) {
  EXPECT_EQ(document.duplicate({&teapot, 1}).front(), (Selection{Kind::object, 1}));
  EXPECT_EQ(scene.objects[1].name, "teapot 2");
  EXPECT_EQ(scene.objects[1].position, glm::dvec3(2.2, 0, 0));
  EXPECT_EQ(scene.objects[1].copies.count, 3);
  const Selection second = document.selection();
  document.duplicate({&second, 1});
  EXPECT_EQ(scene.objects[2].name, "teapot 3");
  document.duplicate({&floorMirror, 1});
  EXPECT_EQ(scene.mirrors[1].name, "floor 2");
  EXPECT_NEAR(scene.mirrors[1].position.x, 4.4, 1e-12);
  document.duplicate({&lampLight, 1});
  EXPECT_GT(scene.lights[1].position.x, 0);
  EXPECT_EQ(scene.lights[1].orbit->center - scene.lights[1].position, glm::dvec3(1, 0, 0));
  EXPECT_EQ(document.undoLabel(), "duplicate light 'lamp'");
}

TEST_F(SceneDocumentTest, SeveralNodesAreOneStep) {
  document.select(floorMirror);
  const std::vector<Selection> nodes{floorMirror, teapot, lampLight};
  const std::vector<Selection> copies = document.duplicate(nodes);
  EXPECT_EQ(copies, (std::vector<Selection>{{Kind::mirror, 1}, {Kind::object, 1}, {Kind::light, 1}}));
  EXPECT_EQ(document.selection(), copies.front());
  EXPECT_EQ(document.undoLabel(), "duplicate 3 nodes");
  const glm::dvec3 step = scene.mirrors[1].position - scene.mirrors[0].position;
  EXPECT_GT(step.x, 4.0) << "the floor is 4 m wide";
  EXPECT_EQ(glm::dvec2(step.y, step.z), glm::dvec2(0.0));
  EXPECT_NEAR(scene.objects[1].position.x, scene.objects[0].position.x + step.x, 1e-9);
  EXPECT_NEAR(scene.lights[1].position.x, scene.lights[0].position.x + step.x, 1e-3);
  EXPECT_NEAR(scene.lights[1].orbit->center.x, scene.lights[0].orbit->center.x + step.x, 1e-3);
  EXPECT_EQ(scene.objects[1].name, "teapot 2");
  document.remove(std::vector<Selection>{teapot, copies[0], floorMirror, copies[1]});
  EXPECT_EQ(document.undoLabel(), "remove 4 nodes");
  EXPECT_TRUE(scene.objects.empty() && scene.mirrors.empty());
  EXPECT_EQ(scene.lights.size(), 2u);
  EXPECT_FALSE(document.selection());
  document.undo();
  EXPECT_EQ(document.selection(), copies.front());
  document.undo();
  EXPECT_EQ(document.selection(), floorMirror);
  EXPECT_FALSE(document.canUndo() || document.modified());
}

TEST(Duplicate, AvoidsTheRowOfCopies) {
  for (const double step : {3.0, -3.0}) {
    TextScene text(sceneText);
    text.document.change("spread", teapot, [&](Scene& scene) { scene.objects[0].copies.step = {step, 0, 0}; });
    const Selection last{Kind::object, 0, 2};
    const Scene& scene = text.scene;
    // Three triangles of 2 m, the last 6 m from the first.
    text.document.duplicate({&last, 1});
    EXPECT_NEAR(scene.objects[1].position.x, 8.2, 1e-12) << step;
    EXPECT_EQ(scene.objects[1].copies.step.x, step);
    // The lamp is within the row.
    const std::vector<Selection> copies = text.document.duplicate(std::vector<Selection>{last, lampLight});
    ASSERT_EQ(copies[0], (Selection{Kind::object, 2}));
    EXPECT_GT(scene.objects[2].position.x, 8.0) << step;
    EXPECT_LT(scene.objects[2].position.x, 16.0) << step;
    EXPECT_NEAR(scene.lights[1].position.x, scene.objects[2].position.x, 1e-3);
  }
}

TEST_F(SceneDocumentTest, BookmarkNamesStayUnique) {
  const Bookmark view{.position = {1, 1, 1}, .target = {0, 0, 0}};
  EXPECT_EQ(document.addBookmark(view), "view");
  EXPECT_EQ(document.addBookmark(view), "view 2");
  document.removeBookmark(0);
  ASSERT_EQ(scene.bookmarks.size(), 1u);
  EXPECT_EQ(scene.bookmarks[0].name, "view 2");
  EXPECT_THROW(document.removeBookmark(1), std::out_of_range);
}

TEST_F(SceneDocumentTest, DropsTheOldestSteps) {
  for (size_t i = 1; i <= SceneDocument::mostSteps + 5; ++i) {
    document.change("move", teapot, moveTeapot(static_cast<double>(i)));
  }
  size_t steps = 0;
  for (; document.canUndo(); ++steps) {
    document.undo();
  }
  EXPECT_EQ(steps, SceneDocument::mostSteps);
  EXPECT_EQ(scene.objects[0].position.x, 5);
  for (; document.canRedo(); --steps) {
    document.redo();
  }
  EXPECT_EQ(steps, 0u);
  EXPECT_EQ(scene.objects[0].position.x, SceneDocument::mostSteps + 5);
}

TEST(UndoSteps, BeyondTheMemoryLimitAreDropped) {
  std::string many = sceneText;
  for (int i = 0; i < 20000; ++i) {
    many += "[[light]]\nposition = [0, 1, 0]\n";
  }
  TextScene text(many);
  for (int i = 1; i <= 40; ++i) {
    text.document.change("move", teapot, moveTeapot(i));
  }
  const size_t bytes = 20000 * sizeof(PointLight);
  size_t steps = 0;
  for (; text.document.canUndo(); ++steps) {
    text.document.undo();
  }
  EXPECT_GE(steps, 1u);
  EXPECT_LE(steps * bytes, SceneDocument::mostBytes);
}

TEST_F(SceneDocumentTest, ModifiedComparesWithTheSavedContent) {
  document.change("move", teapot, moveTeapot(1));
  EXPECT_TRUE(document.modified());
  document.change("move", teapot, moveTeapot(0));
  EXPECT_FALSE(document.modified()) << "the same values again";
  document.change("move", teapot, moveTeapot(2));
  document.save(file, {});
  EXPECT_FALSE(document.modified());
  document.undo();
  EXPECT_TRUE(document.modified());
  document.redo();
  EXPECT_FALSE(document.modified());
}

}  // namespace
}  // namespace speculum
