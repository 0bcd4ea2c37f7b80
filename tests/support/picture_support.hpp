#pragma once

#include <filesystem>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <vector>

#include "compare/picture_agreement.hpp"
#include "image/image.hpp"
#include "session/session.hpp"

namespace speculum::testing_support {

// Keys and values, as --set takes them.
using SettingList = std::vector<std::pair<std::string, std::string>>;

// Expects 99.9 % of the pixels within the tolerance and no 3x3 block wholly over it, else writes the evidence. If
// `counts` is not empty, only pixels count for which it is set.
void expectAlike(const Image8& actual, const Image8& expected, int tolerance, const std::string& name,
                 const std::vector<bool>& counts = {});

// Writes NAME-actual.png, NAME-expected.png and NAME-difference.png below the build tree and says where.
void writeEvidence(const Image8& actual, const Image8& expected, const std::string& name);

// Options for a headless picture with validation and debug.check_finite on, and further settings.
Options headless(const std::filesystem::path& scene, PictureSize size = {640, 360}, const SettingList& settings = {});

// Adds settings to those of the options.
void set(Options& options, const SettingList& settings);

// Changes settings of the session.
void set(Session& session, const SettingList& settings);

// Draws so many frames at one time and waits for each, without reading them back.
void runFrames(Session& session, int frames = 1, double time = 0.0);

// Fails for a validation message and for a value in a target that is not finite or out of range.
void expectQuiet(Session& session);

// Returns the device of all pictures of a process that are drawn by this render path, so that pipelines are made once:
// that takes longer than most pictures. It stays to the end, because the driver ends its threads before static objects
// go.
Device& sharedDevice(RenderPath path);

// A session that calls expectQuiet() at its end. Unless it is given a device, it draws with the shared one, or with one
// of its own if its options ask for what others must not meet.
struct QuietSession : Session {
  explicit QuietSession(const Options& options, Device* device = nullptr);
  ~QuietSession() { expectQuiet(*this); }
};

// Draws one picture and expects what expectQuiet() expects.
Image8 draw(const Options& options, double time = 0.0);

// Draw a picture with the session, wait for it and return it, or its radiance.
Image8 draw(Session& session, double time = 0.0);
LinearImage drawRadiance(Session& session, double time = 0.0);

// Records and submits one frame of a plan. The picture is read back.
void recordFrame(Session& session, const SceneState& state, const Settings& settings, const FramePlan& plan,
                 const std::optional<TargetDisplay>& debug = {});

// Returns the root mean square difference in radiance of the pixels whose `counts` is set, by default of all.
double rootMeanSquare(const LinearImage& a, const LinearImage& b, const std::vector<bool>& counts = {});

// Says of each pixel whether it is black.
std::vector<bool> blackPixels(const Image8& image);

// Returns a temporary directory of the running test's own: tests run side by side and may use the same names.
std::filesystem::path sceneDirectory();

// Writes a scene, as tomlOf() takes it, into sceneDirectory().
std::filesystem::path writeScene(const std::string& name, const std::string& toml);

// Writes one of the program's shaders with `code` at the end of its main(), and the shaders that include it, for
// Options::shaderDir.
void writeShaders(const std::filesystem::path& directory, const std::string& shader, const std::string& code);

std::filesystem::path sourceFile(const std::string& relative);

// Returns the file of a scene that ships, such as "gallery" or "hard/corner".
std::filesystem::path sceneFile(const std::string& name);

// Returns the names of the scenes that ship, such as "gallery"; with a prefix such as "hard/" those of that folder,
// such as "hard/corner".
std::vector<std::string> sceneNames(const std::string& prefix = "");

}  // namespace speculum::testing_support
