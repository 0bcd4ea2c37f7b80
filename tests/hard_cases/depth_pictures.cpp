// Hard cases of depth and clipping, drawn: which of two surfaces is in front, where a mirror cuts what it shows.
#include <gtest/gtest.h>

#include <cmath>

#include "optics/affine.hpp"
#include "optics/reflection.hpp"
#include "scene_text.hpp"
#include "truth_support.hpp"

namespace speculum {
namespace {

using namespace hard_cases;
using namespace testing_support;

constexpr PictureSize size{641, 361};  // odd: the middle of a pixel looks at the target

std::string environment(const glm::dvec3& background) {
  return "[environment]\nbackground = " + text(background) + "\nambient = [1, 1, 1]\n";
}

std::string camera(const glm::dvec3& eye, const glm::dvec3& target, const glm::dvec3& up = {0, 1, 0}) {
  return "[camera]\nposition = " + text(eye) + "\ntarget = " + text(target) + "\nup = " + text(up) + "\n";
}

// A square of that half side about a point; the rotation turns it from facing +z.
std::string quad(const glm::dvec3& center, const glm::dvec3& rotation, double half, const glm::dvec3& color) {
  return "[[object]]\nmodel = \"quad.obj\"\nposition = " + text(center) + "\nrotation = " + text(rotation) +
         "\nscale = " + text(half) + "\ncolor = " + text(color) + "\n";
}

const glm::dvec3 red(1, 0, 0);
const glm::dvec3 green(0, 1, 0);
const glm::dvec3 blue(0, 0, 1);

struct Count {
  int red = 0;
  int green = 0;
  int blue = 0;
  int all = 0;
};

Count countColors(const Image8& picture) {
  Count count;
  for (size_t i = 0; i < picture.rgba.size(); i += 4) {
    count.red += picture.rgba[i] > 0;
    count.green += picture.rgba[i + 1] > 0;
    count.blue += picture.rgba[i + 2] > 0;
    ++count.all;
  }
  return count;
}

Image8 drawWith(const std::string& name, const std::string& scene, const std::string& clip = "clip_distance") {
  writeQuad();
  Options options = truthOptions(writeScene(name, scene), size, 1);
  options.settings.emplace_back("reflection.clip", clip);
  return draw(options);
}

// A red square before a green one of the same shape, a gap apart along the line of sight, as `prefix` sees them.
// Both orders of drawing: with equal depths the one that is drawn first stays.
Count orderOf(const std::string& name, const std::string& prefix, const std::string& redQuad,
              const std::string& greenQuad, const std::string& clip = "clip_distance") {
  const Count a = countColors(drawWith(name, prefix + redQuad + greenQuad, clip));
  const Count b = countColors(drawWith(name, prefix + greenQuad + redQuad, clip));
  return {std::min(a.red, b.red), std::max(a.green, b.green), std::max(a.blue, b.blue), a.all};
}

// A mirror in the plane z = 0 that covers the view of an eye `h` before it, and the pair of squares 50 m behind the eye
// where the reflected line of sight leads.
struct NearMirror {
  std::string prefix;
  glm::dvec3 eye;
  glm::dvec3 toPair;
  glm::dvec3 rotation;
};

NearMirror nearMirror(double h, double angleDegrees) {
  const double a = glm::radians(angleDegrees);
  NearMirror view;
  view.eye = {0, 0, h};
  view.toPair = {std::sin(a), 0.0, std::cos(a)};
  view.rotation = {0, 180 + angleDegrees, 0};
  view.prefix = environment({0, 0, 0}) + camera(view.eye, view.eye + glm::dvec3(std::sin(a), 0.0, -std::cos(a))) +
                "[[mirror]]\nposition = [0, 0, 0]\nsize = [1e4, 1e4]\nreflectance = [1, 1, 1]\n";
  return view;
}

Count orderInMirror(double h, double angle, double gap, const std::string& clip = "clip_distance") {
  const NearMirror view = nearMirror(h, angle);
  const glm::dvec3 image(view.eye.x, view.eye.y, -h);
  return orderOf("near_mirror", view.prefix, quad(image + 50.0 * view.toPair, view.rotation, 40, red),
                 quad(image + (50.0 + gap) * view.toPair, view.rotation, 40, green), clip);
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
  const double a = glm::radians(angle);
  const double gap = 50.0 * relativeGap;
  const glm::dvec3 eye(0, 0, 0);
  // The pitch that turns +z into (0, sin a, cos a).
  const glm::dvec3 rotation(-angle, 0, 0);
  const double half = angle < 70 ? 20.0 : 40.0;
  const std::string prefix = environment({0, 0, 0}) + camera(eye, {0, 0, -50});
  (void)a;
  return orderOf("grazing", prefix, quad({0, 0, -50}, rotation, half, red),
                 quad({0, 0, -50 - gap}, rotation, half, green));
}

TEST(SurfacesAtGrazingAngles, OrderIsKeptFiftyMetresAway) {
  const std::array<std::pair<double, double>, 3> cases = {{{60.0, 1e-6}, {89.0, 1e-5}, {89.9, 1e-4}}};
  for (const auto& [angle, gap] : cases) {
    for (const double g : {gap, gap * 3, gap * 10, gap * 0.3, gap * 0.1}) {
      const Count count = orderAtAngle(angle, g);
      std::printf("%g gap %g: red %d green %d of %d\n", angle, g, count.red, count.green, count.all);
    }
    const Count count = orderAtAngle(angle, gap);
    EXPECT_GT(count.red, 500) << "too little to judge by";
    EXPECT_EQ(count.green, 0) << "at " << angle << " degrees from facing";
  }
}

}  // namespace
}  // namespace speculum
