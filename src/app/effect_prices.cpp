#include "app/effect_prices.hpp"

#include "accuracy/sweep_planner.hpp"
#include "platform/process.hpp"

namespace speculum {

namespace {

double gpuMs(Session& session, const Settings& settings, double time) {
  session.setSettings(settings);
  session.draw(time, false, [] { return !interruptRequested(); });
  session.finish();
  return session.lastFrame().timings.gpuMs;
}

}  // namespace

std::vector<EffectPrice> effectPrices(Session& session, double time, int pairs) {
  const Settings all = session.settings();
  session.renderer().setTimerDetail(TimerDetail::frame);
  const DrawnFrame& frame = session.lastFrame();
  const std::vector<Effect> effects = effectsOf(session.scene(), frame.state, frame.settings, frame.plan);
  std::vector<EffectPrice> prices(effects.size());
  for (size_t i = 0; i < effects.size(); ++i) {
    if (!effects[i].calledFor) {
      continue;
    }
    const Settings without = settingsWith(all, settingsWithout(static_cast<EffectKind>(i)));
    for (int pair = 0; pair <= pairs && !interruptRequested(); ++pair) {
      const double with = gpuMs(session, all, time);
      const double rest = gpuMs(session, without, time);
      if (pair > 0) {
        prices[i].push_back(with - rest);
      }
    }
  }
  session.renderer().setTimerDetail(TimerDetail::passes);
  session.setSettings(all);
  return prices;
}

}  // namespace speculum
