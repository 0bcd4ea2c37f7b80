#pragma once

#include <optional>
#include <string>
#include <vector>

#include "compare/image_metrics.hpp"
#include "settings/settings.hpp"

namespace speculum {

// Returns "key=value key=value"; empty for no change.
std::string settingsText(const std::vector<SettingChange>& changes);

// One configuration of a sweep: its error against the reference and its price.
struct SweepPoint {
  std::string name;                    // unique within the sweep
  std::vector<SettingChange> changes;  // settings that differ from the sweep's base
  ImageMetrics whole;  // display picture; means over the phases of reflection.update_interval, or over frames
  std::optional<ImageMetrics> mirrors;  // over the inside of mirrors (GroundTruth::mirrors), if any is in view
  std::optional<double> flicker;        // ErrorFigures::flicker
  Spread gpuMs;                         // milliseconds a frame
  Spread cpuMs;
  Spread frameMs;
  bool onFront = false;               // front of mean FLIP against gpuMs; see pareto.hpp
  std::string picture;                // PNG, relative to the results' folder
  std::string heatMap;                // PNG of the FLIP error, relative to the results' folder
  std::vector<std::string> frames{};  // PNGs of a movement's first frames, relative to the results' folder
};

// Points that differ in one setting, in ascending order of it.
struct SweepSeries {
  enum class Axis { logarithmic, linear };  // axis of the setting; the axis of the error is logarithmic

  std::string key;   // setting
  std::string name;  // title
  Axis axis = Axis::logarithmic;
  std::vector<double> x;    // values of the setting
  std::vector<int> points;  // indices into SweepResults::points, one for each value
  std::string note;         // shown with the plot
};

// The movement of a sweep.
struct SweepMotion {
  std::string path;  // "scene" or a file
  int frames = 0;
  double fps = 0.0;

  bool operator==(const SweepMotion&) const = default;
};

// A sweep over one scene, one size, one time or movement, one machine.
struct SweepResults {
  std::string scene;  // file name
  std::string title;
  std::string sweep;  // "quick", "full" or a file
  int width = 0;      // pixels
  int height = 0;
  double time = 0.0;  // seconds of animation, of the first frame
  std::optional<SweepMotion> motion;
  std::string device;
  std::string driver;
  std::string renderPath;
  std::string machine;              // processor and operating system
  std::string version;              // version of Speculum
  std::string date;                 // UTC, ISO 8601
  std::vector<SettingChange> base;  // every setting that a point's changes are relative to

  // The reference: traced with so many samples a pixel, depth 64, throughput 0.
  int truthSamples = 256;
  double truthMs = 0.0;  // wall clock, a frame
  int truthThreads = 0;
  ErrorFigures floor;                    // error of about as many other samples: smaller errors mean nothing
  std::string truthPicture;              // PNG, relative to the results' folder
  std::vector<std::string> truthFrames;  // PNGs of a movement's first frames

  std::vector<SweepPoint> points;
  std::vector<SweepSeries> series;
  int leftOut = 0;  // configurations without a point, because they draw what another does. Not in results.json
};

// Returns a header line, then a line for each point: RFC 4180.
std::string sweepCsv(const SweepResults& results);

}  // namespace speculum
