#include "app/session_subject.hpp"

namespace speculum {

constexpr double secondsBetweenFrames = 1.0 / 30.0;

void SessionSubject::drawEarlierFrame(int framesBefore, bool capture, bool whole) {
  session_.draw(time_ - framesBefore * secondsBetweenFrames, capture, [&] { return whole; });
  session_.finish();
}

std::vector<Image8> SessionSubject::pictures(const Settings& settings) {
  session_.setSettings(settings);
  const int interval = settings.reflection.updateInterval;
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

FrameCost SessionSubject::cost(const Settings& settings) {
  session_.renderer().setTimerDetail(TimerDetail::frame);
  Settings measured = settings;
  measured.reflection.skipUnchanged = false;
  session_.setSettings(measured);
  session_.restart();
  const int counted = settings.reflection.updateInterval;
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

}  // namespace speculum
