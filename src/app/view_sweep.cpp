#include "app/view_sweep.hpp"

#include "app/background_job.hpp"
#include "app/session_subject.hpp"
#include "app/sweep_description.hpp"

namespace speculum {

namespace {

// Enough for errors to be told apart, and done in a fraction of the time of a report's 64.
constexpr int truthSamples = 16;

}  // namespace

SweepResults measureView(const SweepRequest& request, const SweepProgress& progress) {
  Options options = request.options;
  options.settings.clear();
  options.sweepResults.clear();
  Settings base = request.base;
  base.quality = {};
  base.reflection.updateInterval = 1;  // the view stands still
  base.debug.checkFinite = false;      // its time is not the settings'
  Session session(options);
  if (!progress({"starting", 1.0})) {
    return {};
  }
  session.setCamera(request.camera);
  session.setSettings(base);
  SceneState state = evaluate(session.scene(), request.time);
  state.camera = request.camera;
  const SweepPlan plan = viewSweep(sweepContext(session));
  SessionSubject subject(session, request.time);
  SweepStore store;
  const SweepScene scene{.scene = session.scene(),
                         .state = state,
                         .width = options.size.width,
                         .height = options.size.height,
                         .truthSamples = truthSamples};
  SweepResults results = describeSweep(session, plan, request.time);
  const bool finished = inBackground([&] { return runSweep(plan, base, scene, subject, store, results, progress); });
  if (finished && session.device().validationMessages() > 0) {
    throw std::runtime_error("the measurement made validation messages");
  }
  return finished ? results : SweepResults();
}

}  // namespace speculum
