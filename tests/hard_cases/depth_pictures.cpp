// Pictures of hard cases of depth and clipping: the order of two surfaces, and the cut at a mirror's plane.
#include "geometry/affine.hpp"
#include "scene_text.hpp"
#include "truth_support.hpp"

namespace speculum {
namespace {

using namespace testing_support;

constexpr PictureSize size{641, 361};  // odd: the middle of a pixel looks at the target

std::string environment(const glm::dvec3& background) {
  return "[environment]\nbackground = " + text(background) + "\nambient = [1, 1, 1]\n";
}

// A square of that half side about a point; the rotation turns it from facing +z.
std::string quad(const glm::dvec3& center, const glm::dvec3& rotation, double half, const glm::dvec3& color) {
  return objectText("quad.obj", center, rotation, half, color);
}

const glm::dvec3 red(1, 0, 0);
const glm::dvec3 green(0, 1, 0);
const glm::dvec3 blue(0, 0, 1);

struct Count {
  int red = 0;
  int green = 0;
  int all = 0;
};

Count countColors(const Image8& picture) {
  Count count;
  for (size_t i = 0; i < picture.rgba.size(); i += 4) {
    count.red += picture.rgba[i] > 0;
    count.green += picture.rgba[i + 1] > 0;
    ++count.all;
  }
  return count;
}

Image8 drawWith(const std::string& name, const std::string& scene, const std::string& clip,
                PictureSize pictureSize = size) {
  writeQuad();
  Options options = truthOptions(writeScene(name, scene), pictureSize, 1);
  options.settings.emplace_back("reflection.clip", clip);
  return draw(options);
}

// Draws a red square before a green one of the same shape, a gap apart along the line of sight, seen as in `prefix`.
// Tries both orders of drawing: at equal depths the square that is drawn first stays.
Count orderOf(const std::string& name, const std::string& prefix, const std::string& redQuad,
              const std::string& greenQuad, const std::string& clip = "clip_distance") {
  const Count a = countColors(drawWith(name, prefix + redQuad + greenQuad, clip));
  const Count b = countColors(drawWith(name, prefix + greenQuad + redQuad, clip));
  return {std::min(a.red, b.red), std::max(a.green, b.green), a.all};
}

// The squares 50 m behind an eye `h` before a mirror that covers its view, where the reflected line of sight leads.
Count orderInMirror(double h, double angle, double gap, const std::string& clip = "clip_distance") {
  const double a = glm::radians(angle);
  const glm::dvec3 eye(0, 0, h);
  const std::string prefix = environment({0, 0, 0}) +
                             cameraText(eye, eye + glm::dvec3(std::sin(a), 0.0, -std::cos(a))) +
                             "[[mirror]]\nposition = [0, 0, 0]\nsize = [1e4, 1e4]\nreflectance = [1, 1, 1]\n";
  const glm::dvec3 toPair(std::sin(a), 0.0, std::cos(a));
  const glm::dvec3 rotation(0, 180 + angle, 0);
  return orderOf("near_mirror", prefix, quad(50.0 * toPair - eye, rotation, 40, red),
                 quad((50.0 + gap) * toPair - eye, rotation, 40, green), clip);
}

TEST(EyeAMicrometreFromTheMirror, OrderIsKeptFiftyMetresAway) {
  for (const double angle : {0.0, 45.0}) {
    const Count count = orderInMirror(1e-6, angle, 5e-5);
    EXPECT_GT(count.red, count.all / 3) << "too little to judge by";
    EXPECT_EQ(count.green, 0) << "the farther square shows, view at " << angle << " degrees";
  }
}

TEST(EyeAMicrometreFromTheMirror, ObliqueDepthLosesIt) {
  EXPECT_EQ(orderInMirror(1.0, 45.0, 5e-3, "oblique").green, 0) << "an ordinary distance is no problem";
  const Count count = orderInMirror(1e-6, 45.0, 5e-5, "oblique");
  EXPECT_GT(count.green, count.all / 10) << "the naive way should fail";
  EXPECT_GT(orderInMirror(1e-6, 45.0, 4.0, "oblique").green, 0) << "even metres apart";
}

// Two parallel squares, their normal turned by `angle` from the line of sight, a gap apart along that line.
Count orderAtAngle(double angle, double relativeGap) {
  const glm::dvec3 rotation(-angle, 0, 0);
  const double half = angle < 70 ? 20.0 : 40.0;
  const std::string prefix = environment({0, 0, 0}) + cameraText({0, 0, 0}, {0, 0, -50});
  return orderOf("grazing", prefix, quad({0, 0, -50}, rotation, half, red),
                 quad({0, 0, -50.0 * (1.0 + relativeGap)}, rotation, half, green));
}

TEST(SurfacesAtGrazingAngles, OrderIsKeptFiftyMetresAway) {
  // Degrees from facing, gap relative to the distance.
  for (const auto& [angle, gap] : {std::pair(60.0, 1e-6), std::pair(89.0, 1e-5), std::pair(89.9, 1e-4)}) {
    const Count count = orderAtAngle(angle, gap);
    EXPECT_GT(count.red, 1000) << "too little to judge by";
    EXPECT_EQ(count.green, 0) << "at " << angle << " degrees from facing";
  }
}

std::string nearPlaneScene(double near, double distance, const std::string& mirror) {
  return environment(red) + "[camera]\nposition = [0, 1, " + text(distance) +
         "]\ntarget = [0.05, 1.02, -1]\nnear = " + text(near) +
         "\n[[mirror]]\nposition = [0, 1, 0]\nsize = [20, 20]\n" + mirror;
}

TEST(EyeNearerThanTheNearPlane, MirrorCoversTheView) {
  for (const auto& [near, distance] : {std::pair(0.1, 0.01), std::pair(10.0, 0.01), std::pair(0.1, 1e-5)}) {
    const Image8 black = draw(
        truthOptions(writeScene("near_plane", nearPlaneScene(near, distance, "reflectance = [0, 0, 0]\n")), size, 4));
    EXPECT_EQ(countColors(black).red, 0) << "a hole: near " << near << ", " << distance << " m from the mirror";
  }
}

TEST(EyeNearerThanTheNearPlane, ReflectionIsRight) {
  const std::filesystem::path file = writeScene("near_plane_truth", nearPlaneScene(0.1, 0.01, R"(
[[object]] model = "MODELS/torus_knot.obj", position = [0.3, 1, 2]
[[object]] model = "MODELS/teapot.obj", position = [-1.2, 0.6, 4]
[[light]] position = [0, 3, 1], intensity = 20
)"));
  expectTruth(file, size, 2, trace(file, size, 2));
}

// A plate through a mirror's plane. Seen from behind the mirror, without it, one ray meets the plate once: this side of
// the plane, where the mirror does not hide it, or beyond it, where the mirror's image shows it.
constexpr PictureSize tileSize{640, 360};  // even: turned left to right, pixel centres meet
const glm::dvec3 plateAngles(-70, 25, 10);

std::string plateScene(double side, const std::string& mirror) {
  return environment(blue) + cameraText({side * 1.6, 0.5, 0.3}, {-side, 0.12, 0.05}) +
         quad({0.02, -0.3, 0.1}, plateAngles, 3, red) +
         (mirror.empty() ? ""
                         : "[[mirror]]\npolygon = [[0, -99, 99], [0, -99, -99], [0, 99, -99], [0, 99, 99]]\n" + mirror);
}

// Returns the distance from the mirror's plane at which a pixel's ray meets the plate, relative to that from the eye.
double distanceFromSeam(int x, int y) {
  const CameraPose pose = lookAt({-1.6, 0.5, 0.3}, {1, 0.12, 0.05}, {0, 1, 0}, 60.0, 0.001);
  const Projection f(pose.verticalFov, 16.0 / 9.0, 0.001);
  const glm::dvec3 view((2.0 * (x + 0.5) / tileSize.width - 1.0) * f.aspect / f.focal,
                        (1.0 - 2.0 * (y + 0.5) / tileSize.height) / f.focal, -1.0);
  const glm::dvec3 ray = glm::transpose(pose.worldToView) * view;
  const glm::dvec3 n = rotationFromDegrees(plateAngles)[2];
  const double t = glm::dot(n, glm::dvec3(0.02, -0.3, 0.1) - pose.eye) / glm::dot(n, ray);
  return std::abs(pose.eye.x + t * ray.x) / (t * glm::length(ray));
}

// The image that the mirror looks up, also where something stands before the mirror.
Image8 plateInMirror(const std::string& clip) {
  writeQuad();
  Options options = truthOptions(writeScene("plate_mirrored", plateScene(1, "reflectance = [1, 1, 1]\n")), tileSize, 1);
  options.settings.emplace_back("reflection.clip", clip);
  QuietSession session(options);
  const DrawnFrame first = session.draw(0.0, false);
  EXPECT_EQ(first.plan.drawnMirrors()[0].view.rect, (PixelRect{0, 0, tileSize.width, tileSize.height}));
  recordFrame(session, first.state, session.settings(), first.plan,
              TargetDisplay{.pass = 0, .area = {0, 0, tileSize.width, tileSize.height}});
  return session.picture();
}

struct Tiling {
  int beyond = 0;  // pixels that show the plate in the mirror's image
  int before = 0;  // on this side of the mirror
  int wrong = 0;   // in both or in neither
};

Tiling tilingWith(const std::string& clip) {
  const Image8 mirrored = plateInMirror(clip);
  const Image8 behind = drawWith("plate_behind", plateScene(-1, "back_color = [0, 0, 0]\n"), clip, tileSize);
  const Image8 whole = drawWith("plate_whole", plateScene(-1, ""), clip, tileSize);
  const auto isRed = [](const Image8& image, int x, int y) {
    return image.rgba[4 * (static_cast<size_t>(y) * image.width + x)] > 0;
  };
  Tiling tiling;
  for (int y = 0; y < tileSize.height; ++y) {
    for (int x = 0; x < tileSize.width; ++x) {
      const int turned = tileSize.width - 1 - x;
      const bool beyond = isRed(mirrored, x, y);
      const bool before = isRed(behind, turned, y);
      tiling.beyond += beyond;
      tiling.before += before;
      tiling.wrong += beyond + before != isRed(whole, turned, y) && distanceFromSeam(turned, y) > 1e-6;
    }
  }
  return tiling;
}

TEST(ObjectAcrossTheMirrorPlane, CutAndComplementTileThePicture) {
  const Tiling tiling = tilingWith("clip_distance");
  EXPECT_GT(tiling.beyond, 5000);
  EXPECT_GT(tiling.before, 5000);
  EXPECT_EQ(tiling.wrong, 0);
  EXPECT_GT(tilingWith("none").wrong, 1000) << "the naive way, no cut, should leak";
}

}  // namespace
}  // namespace speculum
