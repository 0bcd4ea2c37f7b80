#include "session/session_subject.hpp"

#include <spdlog/fmt/chrono.h>

#include <algorithm>
#include <ctime>

#include "plan/traced_effects.hpp"
#include "platform/folders.hpp"
#include "platform/machine.hpp"
#include "scene/fingerprint.hpp"
#include "session/frame_cost.hpp"
#include "session/version.hpp"
#include "settings/setting_fields.hpp"

namespace speculum {

namespace {

namespace fs = std::filesystem;

constexpr double secondsBetweenFrames = 1.0 / 30.0;

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

}  // namespace

void SessionSubject::drawEarlierFrame(int framesBefore, bool capture, bool whole) {
  session_.draw(time_ - framesBefore * secondsBetweenFrames, capture, [&] { return whole; });
  session_.finish();
}

std::vector<Image8> SessionSubject::pictures(const Settings& settings) {
  session_.setSettings(settings);
  const int interval = mostAsked(session_.scene(), settings).updateInterval;
  std::vector<Image8> pictures;
  // After one interval mirrors become due in turn, so n frames in a row show each mirror at every age.
  for (int last = interval > 1 ? interval : 0; last < (interval > 1 ? 2 * interval : 1); ++last) {
    session_.restart();
    for (int frame = 0; frame <= last; ++frame) {
      drawEarlierFrame(last - frame, frame == last, true);
    }
    pictures.push_back(session_.picture());
  }
  return pictures;
}

std::string SessionSubject::work() const {
  const DrawnFrame& frame = session_.lastFrame();
  FrameWork work = workOf(frame.plan, session_.scene(), frame.state, frame.settings);
  work.mirrorSamples *= work.mirrorPasses > 0.0;
  Fingerprint fingerprint;
  fingerprint.add(std::as_bytes(std::span(&work, 1)));
  fingerprint.add(frame.pictures);
  return fingerprint.hex();
}

FrameCost SessionSubject::cost(const Settings& settings) {
  session_.renderer().setTimerDetail(TimerDetail::frame);
  Settings measured = settings;
  measured.reflection.skipUnchanged = false;
  session_.setSettings(measured);
  session_.restart();
  const int counted = mostAsked(session_.scene(), settings).updateInterval;
  FrameCost cost;
  for (int frame = 2 * counted - 1; frame >= 0; --frame) {
    const bool counts = frame < counted;
    drawEarlierFrame(counted == 1 ? 0 : frame, false, counts);
    if (counts) {
      cost.gpuMs += session_.lastFrame().gpuMs / counted;
      cost.cpuMs += session_.lastFrame().cpuMs / counted;
      cost.frameMs += session_.lastFrame().frameMs / counted;
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
