// The scene edited by pointer and commands.
#include "window/support.hpp"

namespace speculum {
namespace {

using namespace testing_support;

class Editing : public WorkspaceTest {
 protected:
  std::string text() const { return workspace_->document().text(options_.scene, {}); }
  const Scene& saved() {
    send(Save{});
    saved_ = onDisk();
    return saved_;
  }
  static void expectNear(const glm::dvec3& a, const glm::dvec3& b) {
    EXPECT_LT(glm::distance(a, b), 1e-3) << a.x << " " << a.y << " " << a.z;
  }

  const glm::dvec2 ballAt_ = pixel({0.3, 1.0, 0.5});
  const glm::dvec2 lampAt_ = pixel({-0.5, 1.5, 0.0});
  const glm::dvec2 imageAt_ = pixel({0.3, 1.0, -4.5}) + glm::dvec2(4.0, 0.0);
  Scene saved_;
};

TEST_F(Editing, ClickSelectsDirectlyAndInMirrors) {
  clickBall();
  EXPECT_EQ(edit().selected, ball);
  EXPECT_TRUE(edit().through.empty());
  EXPECT_TRUE(host_.inspector);
  click(imageAt_);
  EXPECT_EQ(edit().selected, ball);
  EXPECT_EQ(edit().through, MirrorPath{0});
  EXPECT_TRUE(contains(status(), "A click at the same place selects the mirror that shows it.")) << status();
  click(pixel({0.3, 1.0, -7.5}) - glm::dvec2(4.0, 0.0));
  EXPECT_EQ(edit().selected, ball);
  EXPECT_EQ(edit().through, (MirrorPath{0, 1}));
  click(lampAt_);
  EXPECT_EQ(edit().selected, lamp);
  click({width - 5, 5});
  EXPECT_FALSE(edit().selected) << "the background";
}

TEST_F(Editing, NodesAreSelectedWithoutTheInspector) {
  send(SelectNode{ball, false});
  EXPECT_EQ(edit().selected, ball);
  EXPECT_FALSE(host_.inspector);
}

TEST_F(Editing, InspectorNeverCoversWhatWasClicked) {
  host_.inspectorFrom = ballAt_.x - 20.0;
  clickBall();
  EXPECT_EQ(edit().selected, ball);
  EXPECT_FALSE(host_.inspector);
  EXPECT_EQ(status(), "Selected object 'ball'. Drag its handles (G: move, rotate, scale). F2 opens the inspector.");
  send(Escape{});
  EXPECT_EQ(status(), "") << "it is no longer selected";
  clickBall();
  click(lampAt_);
  EXPECT_TRUE(host_.inspector);
}

TEST_F(Editing, UndoStaysInTheMirrorImage) {
  click(imageAt_);
  const glm::dvec3 before = scene().objects[0].position;
  send(SetGizmoMode{GizmoMode::move});
  frame();
  drag(imageAt_ - glm::dvec2(4.0, 0.0), {30.0, 0.0});
  EXPECT_GT(glm::distance(scene().objects[0].position, before), 0.01);
  for (const Command& command : {Command(Undo{}), Command(Redo{}), Command(Undo{})}) {
    send(command);
    EXPECT_EQ(edit().selected, ball);
    EXPECT_EQ(edit().through, MirrorPath{0});
  }
  expectNear(scene().objects[0].position, before);
  clickBall();
  send(Redo{});
  EXPECT_TRUE(edit().through.empty()) << "it is selected itself";
  click(imageAt_);
  send(DuplicateSelected{});
  click(imageAt_);
  send(Undo{});
  EXPECT_TRUE(edit().through.empty()) << "indices have changed";
}

TEST_F(Editing, FurtherClicksGoOutwards) {
  const glm::dvec2 at = pixel({0.3, 1.0, -7.5}) - glm::dvec2(4.0, 0.0);
  click(at);
  EXPECT_EQ(edit().selected, ball);
  click(at + glm::dvec2(1.0, 0.0));
  EXPECT_EQ(edit().selected, behind);
  EXPECT_EQ(edit().through, MirrorPath{0});
  click(at);
  EXPECT_EQ(edit().selected, ahead);
  EXPECT_TRUE(edit().through.empty());
  click(at);
  EXPECT_EQ(edit().selected, ball) << "and round";
}

TEST_F(Editing, DraggedAxisFollowsThePixels) {
  const std::string before = text();
  clickBall();
  constexpr double by = 80.0;
  drag(ballAt_ + glm::dvec2(60.0, 0.0), {by, 0.0});
  EXPECT_NEAR(object().position.x, 0.3 + by / focalPixels, 2e-4) << "one metre from the eye";
  EXPECT_EQ(object().position.y, 1.0);
  EXPECT_EQ(object().position.z, 0.5);
  EXPECT_EQ(edit().undo, "move object 'ball'");
  drag(ballAt_ + glm::dvec2(by, -60.0), {0.0, -50.0});
  EXPECT_NEAR(object().position.y, 1.0 + 50.0 / focalPixels, 2e-4);
  const std::string moved = text();
  send(Undo{});
  EXPECT_EQ(status(), "Undone: move object 'ball'");
  send(Undo{});
  EXPECT_EQ(text(), before);
  send(Redo{});
  send(Redo{});
  EXPECT_EQ(text(), moved);
  EXPECT_EQ(edit().redo, "");
  send(Redo{});
  EXPECT_EQ(status(), "Nothing to redo");
}

// The mean of still pictures begins anew with each change of the picture.
TEST_F(Editing, NamesAndBookmarksChangeNoPicture) {
  const uint64_t revision = workspace_->pictureRevision();
  Object object = scene().objects.at(0);
  object.name = "renamed";
  send(EditNode{ball, object, false});
  send(AddBookmark{});
  ASSERT_EQ(scene().objects.at(0).name, "renamed");
  ASSERT_FALSE(scene().bookmarks.empty());
  EXPECT_EQ(workspace_->pictureRevision(), revision);
  object.position.x += 0.1;
  send(EditNode{ball, object, false});
  EXPECT_GT(workspace_->pictureRevision(), revision);
}

TEST_F(Editing, LongNamesLeaveShortTexts) {
  Object named = scene().objects.at(0);
  named.name = std::string(20'000, 'n');
  send(EditNode{ball, named, false});
  send(SelectNode{ball});
  send(RemoveSelected{});
  send(Undo{});
  EXPECT_TRUE(startsWith(status(), "Undone: remove object 'nnn")) << status();
  EXPECT_LE(status().size(), 1000u);
}

TEST_F(Editing, RingsRotateAndSnap) {
  clickBall();
  send(NextGizmoMode{});
  EXPECT_EQ(edit().mode, GizmoMode::turn);
  // Drags along a little more than a quarter of the ring that faces the eye.
  dragRing(ballAt_, {-40.0, -10.0, 20.0, 53.0}, true);
  EXPECT_EQ(object().rotation, glm::dvec3(0.0, 0.0, 90.0)) << "93 degrees in steps of 15";
  EXPECT_EQ(edit().undo, "rotate object 'ball'");
}

TEST_F(Editing, BoxesScaleAlongTheNodesOwnAxes) {
  const glm::dvec3 before = std::get<Object>(nodeOf(scene(), ball)).scale;
  clickBall();
  send(SetGizmoMode{GizmoMode::scale});
  drag(ballAt_ + glm::dvec2(92.0, 0.0), {46.0, 0.0});
  expectNear(object().scale, before * glm::dvec3(1.5, 1.0, 1.0));
  EXPECT_EQ(object().position, glm::dvec3(0.3, 1.0, 0.5));
  EXPECT_EQ(edit().undo, "scale object 'ball'");
  drag(ballAt_, {0.0, -92.0});
  expectNear(object().scale, before * glm::dvec3(3.0, 2.0, 2.0));
  drag(ballAt_, {-500.0, 0.0});
  EXPECT_GT(object().scale.x, 0.0) << "never zero, which is no scale";
  for (int i = 0; i < 3; ++i) {
    send(Undo{});
  }
  EXPECT_EQ(object().scale, before);
  click(lampAt_);
  const double radius = std::get<PointLight>(nodeOf(scene(), lamp)).radius;
  drag(lampAt_, {92.0, 0.0});
  EXPECT_NEAR(std::get<PointLight>(nodeOf(scene(), lamp)).radius, 2.0 * radius, 1e-9);
}

TEST_F(Editing, OtherButtonsDoNotDisturbADrag) {
  clickBall();
  moveTo(ballAt_ + glm::dvec2(60.0, 0.0));
  press(true);
  moveTo(ballAt_ + glm::dvec2(80.0, 0.0));
  press(true, false, MouseButton::right);
  press(false, false, MouseButton::right);
  moveTo(ballAt_ + glm::dvec2(93.0, 0.0));
  press(false);
  EXPECT_NEAR(object().position.x, 0.3 + 33.0 / focalPixels, 2e-4);
  drag(ballAt_ + glm::dvec2(93.0, 0.0), {20.0, 0.0});
  EXPECT_NEAR(object().position.x, 0.3 + 53.0 / focalPixels, 3e-4) << "the pointer is free again";
}

TEST_F(Editing, ClickOnAHandleChangesNothing) {
  Scene scene = onDisk();
  int changes = 0;
  SceneDocument document(scene);
  SceneEditor editor(document, {}, [&] { ++changes; });
  const SceneState state = evaluate(scene, 0.0);
  const PointedScene view{.state = state, .picture = PictureView(state.camera, width, height)};
  editor.select(ball);
  ASSERT_TRUE(editor.press(view, ballAt_ + glm::dvec2(60.0, 0.0)));
  editor.cancelDrag();
  EXPECT_EQ(changes, 0);
  ASSERT_TRUE(editor.press(view, ballAt_ + glm::dvec2(60.0, 0.0)));
  editor.drag(ballAt_ + glm::dvec2(120.0, 0.0), false);
  EXPECT_EQ(changes, 1);
  editor.cancelDrag();
  EXPECT_EQ(changes, 2) << "back";
}

TEST_F(Editing, EscapeCancelsTheDragThenDeselects) {
  clickBall();
  EXPECT_TRUE(host_.inspector);
  moveTo(ballAt_ + glm::dvec2(60.0, 0.0));
  press(true);
  moveTo(ballAt_ + glm::dvec2(120.0, 0.0));
  EXPECT_GT(object().position.x, 0.35);
  send(Escape{});
  EXPECT_EQ(object().position.x, 0.3);
  press(false);
  EXPECT_EQ(edit().selected, ball);
  send(Escape{});
  EXPECT_FALSE(edit().selected);
  EXPECT_EQ(edit().undo, "");
  send(Escape{});
  EXPECT_TRUE(host_.inspector) << "panels stay";
  host_.inspector = false;
  send(SelectNode{ball});
  EXPECT_TRUE(host_.inspector) << "a row of another panel leads to what it stands for";
  host_.popup = true;
  send(Escape{});
  EXPECT_FALSE(host_.popup);
  EXPECT_EQ(edit().selected, ball) << "one thing at a time";
  send(Escape{});
  send(Escape{});
  send(Escape{});
  EXPECT_FALSE(host_.closed);
  send(Quit{});
  EXPECT_TRUE(host_.closed) << "nothing was changed";
}

TEST_F(Editing, DuplicatesAndFramesStayBetweenPanels) {
  clickBall();
  const double x = object().position.x;
  host_.free = PixelRect{0, 0, static_cast<int>(pixel({x, 1.0, 0.5}).x) + 5, height};
  send(DuplicateSelected{});
  EXPECT_LT(object().position.x, x) << "the other side would be behind a panel";
  const Selection copy = edit().selected;
  send(SelectNode{ball});
  send(ToggleNode{copy});
  send(DuplicateSelected{});
  EXPECT_LT(object().position.x, x) << "several";
  send(Undo{});
  send(SelectNode{copy});
  host_.free = PixelRect{0, 0, width / 2, height};
  send(FrameSelection{});
  const CameraPose pose = camera();
  const glm::dvec3 seen = pose.worldToView * (object().position - pose.eye);
  EXPECT_NEAR(focalPixels * seen.x / -seen.z, -width / 4.0, 30.0);
}

TEST_F(Editing, CameraIsEditedUndoneAndSaved) {
  const CameraSpec before = scene().camera;
  CameraSpec edited = before;
  for (int i = 1; i <= 3; ++i) {
    edited.position.x += 0.25;
    edited.verticalFov += 5.0;
    send(EditCamera{edited, true});
  }
  send(EndEdit{});
  EXPECT_EQ(scene().camera, edited);
  EXPECT_EQ(camera().eye, edited.position) << "the window shows it";
  EXPECT_EQ(edit().undo, "edit the camera");
  EXPECT_EQ(saved().camera, edited);
  send(Undo{});
  EXPECT_EQ(scene().camera, before);
  EXPECT_EQ(camera().eye, before.position);
  send(Redo{});
  EXPECT_EQ(camera().eye, edited.position);
  EXPECT_EQ(camera().verticalFov, glm::radians(edited.verticalFov));
}

TEST_F(Editing, CameraTakesTheView) {
  workspace_->view().camera.move({1.0, 0.5, -0.25}, {}, 0.5);
  frame();
  const CameraPose moved = camera();
  ASSERT_NE(moved.eye, scene().camera.position);
  send(TakeView{});
  EXPECT_EQ(scene().camera.position, moved.eye);
  send(ResetCamera{});
  expectNear(camera().eye, moved.eye);
  expectNear(glm::dvec3(glm::transpose(camera().worldToView)[2]), glm::dvec3(glm::transpose(moved.worldToView)[2]));
  expectNear(saved().camera.position, moved.eye);
}

TEST_F(Editing, ContinuedEditsAreOneStep) {
  clickBall();
  Object edited = object();
  for (int i = 1; i <= 3; ++i) {
    edited.position.x += 0.1;
    send(EditNode{edit().selected, edited, true});
  }
  send(EndEdit{});
  EXPECT_NEAR(object().position.x, 0.6, 1e-12);
  EXPECT_EQ(edit().undo, "edit object 'ball'");
  edited.color = glm::dvec3(0.6);
  send(EditNode{edit().selected, edited, false});
  send(Undo{});
  EXPECT_FALSE(object().color);
  EXPECT_NEAR(object().position.x, 0.6, 1e-12);
  send(Undo{});
  EXPECT_EQ(object().position.x, 0.3) << "the whole drag is one step";
  EXPECT_EQ(edit().undo, "");
}

TEST_F(Editing, AxisOfAnOrbitKeepsADirection) {
  send(AddLight{});
  PointLight light = std::get<PointLight>(nodeOf(scene(), edit().selected));
  light.orbit = Orbit{.axis = {0, 0, 1}};
  send(EditNode{edit().selected, light});
  light.orbit->axis = {0, 0, 0};
  send(EditNode{edit().selected, light});
  EXPECT_EQ(std::get<PointLight>(nodeOf(scene(), edit().selected)).orbit->axis, glm::dvec3(0, 0, 1));
  light.orbit->axis = {0, 1, 1};
  send(EditNode{edit().selected, light, true});
  light.orbit->axis = {0, 0, 0};
  send(EditNode{edit().selected, light});
  light.orbit->axis = {1, 0, 0};
  send(EditNode{edit().selected, light});
  send(Undo{});
  EXPECT_EQ(std::get<PointLight>(nodeOf(scene(), edit().selected)).orbit->axis, glm::dvec3(0, 1, 1)) << "a step ended";
}

TEST_F(Editing, FirstCopiesStandBesideEachOther) {
  clickBall();
  Object many = object();
  many.copies.count = 3;
  send(EditNode{edit().selected, many});
  const double width = object().copies.step.x;
  EXPECT_GT(width, 0.1);
  many.copies = {.count = 4, .step = glm::dvec3(0.0)};
  send(EditNode{edit().selected, many});
  EXPECT_EQ(object().copies.step, glm::dvec3(0.0)) << "typed";
  send(Undo{});
  send(Undo{});
  EXPECT_EQ(object().copies, Copies());
}

TEST_F(Editing, NodesAreAddedAndSelectedInOrder) {
  send(AddMirror{});
  const glm::dvec3 place = 1000.0 * scene().mirrors.back().position;
  EXPECT_LT(glm::length(place - glm::round(place)), 1e-6) << "as a person would type it";
  EXPECT_EQ(status(), "Added mirror 'mirror'. The inspector (F2) changes it.");
  send(AddLight{});
  send(AddObject{edit().models.front()});
  EXPECT_EQ(scene().mirrors.size() + scene().lights.size() + scene().objects.size(), 7u);
  EXPECT_EQ(edit().selected, (Selection{Selection::Kind::object, 1}));
  send(SelectNode{behind});
  send(SelectNext{-1});
  EXPECT_EQ(edit().selected, ahead);
  for (int i = 0; i < 3; ++i) {
    send(Undo{});
  }
  EXPECT_EQ(allNodes(scene()).size(), 4u);
  EXPECT_FALSE(edit().unsaved);
  host_.size = {0, 0};
  send(AddMirror{});
  EXPECT_EQ(scene().mirrors.size(), 2u) << "there is nothing to be seen";
}

TEST_F(Editing, PictureDragTurnsTheCamera) {
  const glm::dvec3 before = eye();
  moveTo({700, 500});
  press(true);
  moveTo({702, 502});
  EXPECT_EQ(eye(), before) << "it may still become a click";
  moveTo({760, 500});
  press(false);
  EXPECT_NE(eye(), before);
  EXPECT_FALSE(edit().selected);
  const glm::dvec3 turned = eye();
  moveTo({700, 500});
  press(true, false, MouseButton::left, true);
  moveTo({760, 500});
  press(false, false, MouseButton::left, true);
  EXPECT_EQ(eye(), turned) << "it belongs to a panel";
}

TEST_F(Editing, ReusedImagesAreDroppedAfterEdits) {
  const int drops = host_.drops;
  clickBall();
  drag(ballAt_ + glm::dvec2(60.0, 0.0), {33.0, 0.0});
  EXPECT_EQ(host_.drops, drops) << "images are compared with what they show";
  changeSettings([](Settings& settings) { settings.reflection.updateInterval = 8; });
  drag(ballAt_ + glm::dvec2(93.0, 0.0), {-33.0, 0.0});
  EXPECT_GT(host_.drops, drops);
}

TEST_F(Editing, FiguresOfTheSceneBeforeAreDropped) {
  FrameHistory& history = workspace_->report().history();
  const auto measure = [&] {
    history.add(1, 20.0, 1.0);
    frame();
    return history.frames();
  };
  EXPECT_EQ(measure(), 1u);
  Mirror mirror = scene().mirrors[0];
  mirror.quality.scale = 0.25;
  send(EditNode{{Selection::Kind::mirror, 0}, mirror, false});
  EXPECT_EQ(history.frames(), 0u) << "they would hide that the mirror is cheaper";
  EXPECT_EQ(measure(), 1u);
  send(Undo{});
  EXPECT_EQ(history.frames(), 0u);
  clickBall();
  EXPECT_EQ(measure(), 1u) << "a selection changes nothing";
  moveTo(ballAt_ + glm::dvec2(60.0, 0.0));
  press(true);
  moveTo(ballAt_ + glm::dvec2(93.0, 0.0));
  frame();
  EXPECT_NE(object().position.x, 0.3);
  EXPECT_EQ(history.frames(), 1u) << "it is being dragged";
  press(false);
}

TEST_F(Editing, ShiftAddsAndTakesOut) {
  click(ballAt_, true);
  EXPECT_EQ(edit().selected, ball);
  click(lampAt_, true);
  EXPECT_EQ(edit().others, std::vector<Selection>{lamp});
  EXPECT_FALSE(edit().overlay.outline.empty());
  click(imageAt_, true);
  EXPECT_EQ(edit().others, (std::vector<Selection>{lamp, ahead})) << "the mirror stands there";
  click(lampAt_, true);
  EXPECT_EQ(edit().others, std::vector<Selection>{ahead});
  click(ballAt_ + glm::dvec2(0.0, 20.0), true);
  EXPECT_EQ(edit().selected, ahead);
  EXPECT_TRUE(edit().others.empty());
  click({width - 5, 5}, true);
  EXPECT_EQ(edit().selected, ahead) << "the background";
  click(ballAt_, true);
  host_.inspector = false;
  send(Escape{});
  EXPECT_FALSE(edit().selected);
  EXPECT_TRUE(edit().others.empty());
}

TEST_F(Editing, ShiftCountsWhereTheButtonGoesDown) {
  clickBall();
  moveTo(lampAt_);
  press(true, true);
  press(false, false);
  frame();
  EXPECT_EQ(edit().selected, ball);
  EXPECT_EQ(edit().others, std::vector<Selection>{lamp});
  press(true, false);
  press(false, true);
  frame();
  EXPECT_EQ(edit().selected, lamp);
  EXPECT_TRUE(edit().others.empty());
}

TEST_F(Editing, SelectedNodesMoveTogetherInOneStep) {
  const std::string before = text();
  clickBall();
  click(lampAt_, true);
  drag(ballAt_ + glm::dvec2(60.0, 0.0), {33.0, 0.0});
  EXPECT_TRUE(startsWith(edit().undo, "move 2 "));
  const double by = 33.0 / focalPixels;
  expectNear(saved().objects[0].position, {0.3 + by, 1.0, 0.5});
  expectNear(saved_.lights[0].position, {-0.5 + by, 1.5, 0.0});
  send(Undo{});
  EXPECT_EQ(edit().undo, "");
  EXPECT_EQ(edit().others, std::vector<Selection>{lamp}) << "still selected";
  EXPECT_EQ(text(), before);
  moveTo(ballAt_ + glm::dvec2(60.0, 0.0));
  press(true);
  moveTo(ballAt_ + glm::dvec2(120.0, 0.0));
  EXPECT_GT(object().position.x, 0.35);
  send(Escape{});
  press(false);
  EXPECT_EQ(edit().undo, "");
  EXPECT_EQ(text(), before) << "Escape takes all of them back";
}

TEST_F(Editing, SelectedNodesRotateAboutTheFirst) {
  send(SelectNext{});
  ASSERT_EQ(edit().selected, ahead);
  click(ballAt_, true);
  click(lampAt_, true);
  ASSERT_EQ(edit().others.size(), 2u);
  send(SetGizmoMode{GizmoMode::turn});
  dragRing({width / 2.0, height / 2.0}, {-40.0, -10.0, 20.0, 53.0}, true);
  EXPECT_TRUE(startsWith(edit().undo, "rotate 3 "));
  saved();
  // The drag turns by 90 degrees about the mirror's middle, (0, 1, -2).
  expectNear(saved_.mirrors[0].position, {0.0, 1.0, -2.0});
  expectNear(saved_.mirrors[0].rotation, {0.0, 0.0, 90.0});
  expectNear(saved_.objects[0].position, {0.0, 1.3, 0.5});
  expectNear(saved_.objects[0].rotation, {0.0, 0.0, 90.0});
  expectNear(saved_.lights[0].position, {-0.5, 0.5, 0.0});
  EXPECT_EQ(saved_.mirrors[1].rotation, glm::dvec3(0.0, 180.0, 0.0)) << "not selected";
}

TEST_F(Editing, SelectedNodesAreCopiedAndDeletedTogether) {
  const std::string before = text();
  send(SelectNode{behind});
  send(ToggleNode{ball});
  send(ToggleNode{ahead});
  send(DuplicateSelected{});
  EXPECT_TRUE(startsWith(edit().undo, "duplicate 3 "));
  EXPECT_EQ(status(), "Added 3 nodes. The inspector (F2) changes it.");
  EXPECT_EQ(edit().selected, (Selection{Selection::Kind::mirror, 2}));
  EXPECT_EQ(edit().others, (std::vector<Selection>{{Selection::Kind::object, 1}, {Selection::Kind::mirror, 3}}));
  EXPECT_EQ(saved().mirrors.size(), 4u);
  EXPECT_EQ(saved_.mirrors[2].rotation, saved_.mirrors[1].rotation);
  const int drops = host_.drops;
  send(RemoveSelected{});
  EXPECT_GT(host_.drops, drops) << "cached images are of other mirrors now";
  EXPECT_FALSE(edit().selected);
  EXPECT_TRUE(startsWith(edit().undo, "remove 3 "));
  EXPECT_EQ(status(), "Deleted 3 nodes. Ctrl+Z takes this back.");
  EXPECT_EQ(saved().mirrors.size(), 2u);
  send(Undo{});
  send(Undo{});
  EXPECT_EQ(edit().undo, "");
  EXPECT_TRUE(edit().others.empty()) << "the copies are gone";
  EXPECT_EQ(text(), before);
}

TEST_F(Editing, ModelsAreAddedFromAnyFile) {
  const std::string before = text();
  const std::filesystem::path folder = std::filesystem::path(options_.scene).parent_path();
  ASSERT_EQ(edit().models.front().stem(), "sphere") << "the scene's first";
  const auto count = [&](const char* name) {
    const auto models = edit().models;
    return std::ranges::count_if(models, [&](const auto& model) { return model.stem() == name; });
  };
  EXPECT_EQ(count("sphere"), 1);
  send(AskWhatToAdd{});
  EXPECT_EQ(edit().prompt, Prompt::addObject);
  send(AddObject{dataDirectory("scenes").parent_path() / "models" / "vase.obj"});
  EXPECT_EQ(edit().prompt, Prompt::none);
  ASSERT_EQ(edit().undo, "add object 'vase'") << edit().note;
  EXPECT_EQ(host_.scenesUsed, 1);
  const Object vase = object();
  send(AddObject{"nowhere.obj"});
  EXPECT_EQ(edit().note,
            (folder / "nowhere.obj").string() + ": there is no such file (name a Wavefront OBJ or glTF 2.0 file)");
  EXPECT_EQ(status(), edit().note);
  std::ofstream(folder / "empty.obj") << "v 0 0 0\n";
  send(AddObject{"empty.obj"});
  EXPECT_TRUE(contains(edit().note, "empty.obj:1: f: the model has no face"));
  EXPECT_FALSE(contains(edit().note, "\n"));
  EXPECT_EQ(edit().undo, "add object 'vase'") << "nothing is lost";
  std::ofstream(folder / "flag.obj") << "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
  host_.failsNext = true;
  send(AddObject{"flag.obj"});
  EXPECT_EQ(edit().note, "no memory");
  EXPECT_EQ(scene().meshes.size(), 2u) << "the scene is as before";
  send(AddObject{"flag.obj"});
  ASSERT_EQ(edit().undo, "add object 'flag'") << edit().note;
  const std::string added = text();
  send(Undo{});
  send(Undo{});
  EXPECT_EQ(text(), before);
  send(Redo{});
  send(Redo{});
  EXPECT_EQ(text(), added);
  saved();
  ASSERT_EQ(saved_.objects.size(), 3u) << edit().note;
  EXPECT_EQ(saved_.objects[1].position, vase.position);
  EXPECT_TRUE(std::filesystem::path(saved_.objects[1].model).is_relative()) << saved_.objects[1].model;
  EXPECT_EQ(saved_.objects[2].model, "flag.obj");
}

TEST_F(Editing, DeletedMirrorIsNotLookedFrom) {
  send(LookFromMirror{MirrorSide::back});
  while (!allNodes(scene()).empty()) {
    send(SelectNext{});
    send(RemoveSelected{});
  }
  const glm::dvec3 before = eye();
  send(LookFromMirror{MirrorSide::back});
  EXPECT_EQ(eye(), before);
  EXPECT_TRUE(contains(status(), "no mirror")) << status();
}

}  // namespace
}  // namespace speculum
