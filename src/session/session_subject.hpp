#pragma once

#include <string>
#include <vector>

#include "accuracy/sweep.hpp"
#include "accuracy/sweep_planner.hpp"
#include "scene/scene_state.hpp"
#include "session/options.hpp"
#include "session/session.hpp"

namespace speculum {

// The movement that `speculum accuracy --motion` measures, or a single frame.
struct MotionPath {
  double start = 0.0;  // seconds of animation of the first frame
  double fps = 30.0;   // frames per second of animation
  int frames = 1;
  std::vector<CameraPose> cameras{};  // by frame; none: the session's camera

  double timeOf(int frame) const { return start + frame / fps; }  // seconds of animation
};

// Returns the movement of --motion, --time, --frames and --fps: the scene's animation, seen by its own camera or by one
// that goes straight from view to view of a file. Throws InputError with FILE:LINE for a wrong file, UsageError for a
// scene that stands still or for more pixels than a sweep holds.
MotionPath motionPath(const Options& options, const Scene& scene);

// Returns the scene at a frame.
SceneState stateOf(const Scene& scene, const MotionPath& path, int frame);

// A session's scene at one time or along a path, for a sweep to measure.
class SessionSubject : public SweepSubject {
 public:
  // Keeps a reference to the session.
  SessionSubject(Session& session, MotionPath path) : session_(session), path_(std::move(path)) { session_.showOnly(); }
  SessionSubject(Session& session, double time) : SessionSubject(session, MotionPath{.start = time}) {}

  // With an update interval, frames of a still picture are 1/30 s apart, and the last one is at the sweep's time.
  std::vector<Image8> pictures(const Settings& settings) override;
  std::string work() const override { return work_; }
  FrameCost cost(const Settings& settings) override;

 protected:
  // Draws a frame of the path, where negative ones come before it: the `whole` mean, or only its first picture.
  virtual void drawFrame(int frame, bool capture, bool whole);
  // Draws the frames of the path, each with the images of the one before, as a moving window does. Calls `drawn` after
  // each. Frames before the path see that mirrors are due in turn. Throws SweepCancelled after Ctrl-C.
  void follow(const Settings& settings, bool capture, const std::function<void()>& drawn = {});

  Session& session_;
  MotionPath path_;

 private:
  std::vector<Image8> stillPictures(const Settings& settings);

  std::string work_;
};

// Returns the sample counts among 1, 2, 4 and 8 that the device has.
std::vector<int> sampleCountsOf(const Device& device);

// Returns the settings that a sweep over the session's scene can vary.
SweepContext sweepContext(Session& session);

// Returns results without measurements: scene, machine, device, date, base settings.
SweepResults describeSweep(Session& session, const SweepPlan& plan, double time);

// Returns a fingerprint of everything that pictures and times depend on, except the settings: this build with its
// shaders, scene, device, machine, size, time or movement, validation.
std::string sweepIdentity(Session& session, const Options& options);

std::string utcNow();  // ISO 8601, with seconds

}  // namespace speculum
