#pragma once

#include <functional>
#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "random.hpp"

// Scene files as text, and models that tests write beside the scenes of writeScene().
namespace speculum::testing_support {

// Returns the TOML of a text in which a table may stand on one line, as "[[light]] position = [0, 1, 0], glow = 0"
// does. MODELS/ is the project's models/.
std::string tomlOf(const std::string& text);

// A ball before the eye, behind it a wall with a mirror.
extern const std::string wallScene;

// A ball and a light for corridorScene().
extern const std::string corridorNodes;

// The eye between two mirrors that face each other, and `nodes` between them.
std::string corridorScene(const std::string& nodes = corridorNodes);

// Flat colors in the light from all sides, seen in two large mirrors. Few edges, no texture, so that rounding is most
// of what is wrong with a picture. writeQuad() writes its model.
enum class PlainMirrors { facing, corner };
std::string plainScene(unsigned seed, PlainMirrors mirrors, const std::string& mirrorKeys = "");

// Return numbers with all their digits.
std::string text(double value);
std::string text(const glm::dvec3& v);

// The table [camera].
std::string cameraText(const glm::dvec3& position, const glm::dvec3& target, const glm::dvec3& up = {0, 1, 0});

// The table [[object]] of a matt model in that color.
std::string objectText(const std::string& model, const glm::dvec3& position, const glm::dvec3& rotation, double scale,
                       const glm::dvec3& color);

// Keys of [[mirror]]: a rectangle, a polygon.
std::string rectangleText(const glm::dvec3& position, const glm::dvec3& rotation, double width, double height);
std::string polygonText(const std::vector<glm::dvec3>& corners);

// Writes a model beside the scenes, which name it by its file name.
void writeModel(const std::string& file, const std::string& obj);

// Writes quad.obj: 2 x 2 m in the plane z = 0 about the origin, facing +z.
void writeQuad();

// Writes a lumpy sphere about the origin, at most 0.85 m in radius. Odd seeds have no normals, half of these have
// smoothing groups; a third of all seeds has vertex colors. Returns the file.
std::string writeRandomMesh(unsigned seed);

// The table [[object]] of a shipped model or a random mesh: at most `size` m along x, and along y that times a factor
// within `stretch`. Some are turned inside out; half have a material of their own. `position` is called once, when its
// random numbers are due.
std::string randomObjectText(Random& random, unsigned seed, double size, const glm::dvec2& stretch,
                             const std::function<std::string()>& position);

// The table [[light]].
std::string randomLightText(Random& random, const std::string& position);

}  // namespace speculum::testing_support
