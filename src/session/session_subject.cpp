#include "session/session_subject.hpp"

#include <spdlog/fmt/chrono.h>

#include <algorithm>
#include <ctime>

#include "plan/traced_effects.hpp"
#include "platform/folders.hpp"
#include "platform/machine.hpp"
#include "platform/process.hpp"
#include "scene/fingerprint.hpp"
#include "session/frame_cost.hpp"
#include "session/version.hpp"
#include "settings/setting_fields.hpp"

namespace speculum {

namespace {

namespace fs = std::filesystem;

void addFile(Fingerprint& fingerprint, const fs::path& file) {
  if (const std::optional<std::vector<uint8_t>> bytes = readFileIfAny(file)) {
    fingerprint.add(std::as_bytes(std::span(*bytes)));
  }
}

void addFolder(Fingerprint& fingerprint, const fs::path& folder) {
  std::vector<fs::path> files;
  std::error_code none;
  for (const auto& entry : fs::directory_iterator(folder, none)) {
    files.push_back(entry.path());
  }
  std::ranges::sort(files);
  for (const fs::path& file : files) {
    addFile(fingerprint, file);
  }
}

// Returns a text that describes the work for the session's last frame.
std::string workOf(Session& session) {
  const DrawnFrame& frame = session.lastFrame();
  FrameWork work = workOf(frame.plan, session.scene(), frame.state, frame.settings);
  work.mirrorSamples *= work.mirrorPasses > 0.0;
  Fingerprint fingerprint;
  fingerprint.add(std::as_bytes(std::span(&work, 1)));
  fingerprint.add(frame.pictures);
  return fingerprint.hex();
}

void addTo(FrameCost& cost, const DrawnFrame& frame, double share) {
  cost.gpuMs += share * frame.gpuMs;
  cost.cpuMs += share * frame.cpuMs;
  cost.frameMs += share * frame.frameMs;
}

}  // namespace

void SessionSubject::drawFrame(int frame, bool capture, bool whole) {
  if (!path_.cameras.empty()) {
    session_.setCamera(path_.cameras[std::max(0, frame)]);
  }
  session_.draw(path_.timeOf(frame), capture, [&] { return whole; });
  session_.finish();
}

void SessionSubject::follow(const Settings& settings, bool capture, const std::function<void()>& drawn) {
  session_.setSettings(settings);
  session_.restart();
  const int interval = mostAsked(session_.scene(), settings).updateInterval;
  // Without pictures, one frame before the first makes the targets and maps that later frames use.
  const int before = interval > 1 ? interval : capture ? 0 : 1;
  for (int frame = -before; frame < path_.frames; ++frame) {
    drawFrame(frame, capture && frame >= 0, true);
    if (interruptRequested()) {
      throw SweepCancelled();
    }
    if (drawn && frame >= 0) {
      drawn();
    }
  }
}

std::vector<Image8> SessionSubject::pictures(const Settings& settings) {
  if (path_.frames == 1) {
    std::vector<Image8> pictures = stillPictures(settings);
    work_ = workOf(session_);
    return pictures;
  }
  std::vector<Image8> pictures;
  Fingerprint work;
  follow(settings, true, [&] {
    pictures.push_back(session_.picture());
    work.add(workOf(session_));
  });
  work_ = work.hex();
  return pictures;
}

std::vector<Image8> SessionSubject::stillPictures(const Settings& settings) {
  session_.setSettings(settings);
  const int interval = mostAsked(session_.scene(), settings).updateInterval;
  std::vector<Image8> pictures;
  // After one interval mirrors become due in turn, so n frames in a row show each mirror at every age.
  for (int last = interval > 1 ? interval : 0; last < (interval > 1 ? 2 * interval : 1); ++last) {
    session_.restart();
    for (int frame = 0; frame <= last; ++frame) {
      drawFrame(frame - last, frame == last, true);
    }
    pictures.push_back(session_.picture());
  }
  return pictures;
}

FrameCost SessionSubject::cost(const Settings& settings) {
  session_.renderer().setTimerDetail(TimerDetail::frame);
  FrameCost cost;
  if (path_.frames > 1) {
    follow(settings, false, [&] { addTo(cost, session_.lastFrame(), 1.0 / path_.frames); });
    return cost;
  }
  Settings measured = settings;
  measured.reflection.skipUnchanged = false;
  session_.setSettings(measured);
  session_.restart();
  const int counted = mostAsked(session_.scene(), settings).updateInterval;
  for (int frame = 2 * counted - 1; frame >= 0; --frame) {
    const bool counts = frame < counted;
    drawFrame(counted == 1 ? 0 : -frame, false, counts);
    if (counts) {
      addTo(cost, session_.lastFrame(), 1.0 / counted);
    }
  }
  return cost;
}

std::vector<int> sampleCountsOf(const Device& device) {
  std::vector<int> counts;
  for (const int count : {1, 2, 4, 8}) {
    if ((device.caps().sampleCounts & static_cast<VkSampleCountFlags>(count)) != 0) {
      counts.push_back(count);
    }
  }
  return counts;
}

std::string utcNow() {
  return fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(std::time(nullptr)));
}

SweepContext sweepContext(Session& session) {
  const AskedEffects asked = askedEffects(session.scene());
  SweepContext context{.base = session.settings(),
                       .sampleCounts = sampleCountsOf(session.device()),
                       .mirrors = session.scene().mirrorCount() > 0,
                       .animated = moves(session.scene()),
                       .rough = asked.rough,
                       .interval = mostAsked(session.scene(), session.settings()).updateInterval};
  for (const auto& [key, wanted] :
       {std::pair("effects.shadows", asked.shadows), std::pair("effects.roughness", asked.rough),
        std::pair("effects.ripple", asked.ripple), std::pair("effects.casts_light", asked.castsLight),
        std::pair("effects.curved", asked.curved),
        std::pair("effects.transparency", std::ranges::any_of(session.scene().meshes, &Mesh::isTransparent))}) {
    if (wanted) {
      context.effects.emplace_back(key);
    }
  }
  return context;
}

// The text changes with build, shaders, driver and what is measured, so that old figures are not reused.
std::string sweepIdentity(Session& session, const Options& options) {
  Fingerprint fingerprint;
  addFile(fingerprint, executablePath());
  addFolder(fingerprint, dataDirectory("shaders"));
  if (!options.shaderDir.empty()) {
    addFolder(fingerprint, options.shaderDir);
  }
  fingerprint.add(options.validation);
  addScene(fingerprint, session.scene());
  const Device& device = session.device();
  for (const std::string& text : {device.info().name, device.info().driver, machineDescription(),
                                  std::string(renderPathName(device.renderPath()))}) {
    fingerprint.add(text);
  }
  fingerprint.add(session.size().width);
  fingerprint.add(session.size().height);
  fingerprint.add(options.time);
  if (!options.motion.empty()) {
    fingerprint.add(options.motion);
    addFile(fingerprint, options.motion);
    fingerprint.add(options.frames);
    fingerprint.add(options.fps);
  }
  return fingerprint.hex();
}

SweepResults describeSweep(Session& session, const SweepPlan& plan, double time) {
  const Device& device = session.device();
  SweepResults results{.scene = session.scene().file.filename().string(),
                       .title = session.scene().title,
                       .sweep = plan.name,
                       .time = time,
                       .device = device.info().name,
                       .driver = device.info().driver,
                       .renderPath = std::string(renderPathName(device.renderPath())),
                       .machine = machineDescription(),
                       .version = versionString,
                       .date = utcNow()};
  for (const SettingField& field : settingFields()) {
    const std::string value = settingValue(session.settings(), field.key);
    if (!value.empty()) {
      results.base.push_back({std::string(field.key), value});
    }
  }
  return results;
}

}  // namespace speculum
