#include "cli/stats.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "compare/image_metrics.hpp"
#include "plan/depth_readout.hpp"
#include "plan/mirror_sight.hpp"
#include "platform/process.hpp"
#include "systems/pass_log.hpp"

namespace speculum {

using nlohmann::ordered_json;

ordered_json summary(std::vector<double> values) {
  const Spread spread = spreadOf(values);
  std::ranges::sort(values);
  const double p95 = values[static_cast<size_t>(std::ceil(0.95 * static_cast<double>(values.size() - 1)))];
  return {{"median", spread.median}, {"min", spread.minimum}, {"p95", p95}, {"max", values.back()}};
}

namespace {

// Returns the mirror's name, or its index as a number.
ordered_json mirrorJson(const Scene& scene, int mirror) {
  const std::string& name = scene.mirror(mirror).name;
  return name.empty() ? ordered_json(mirror) : ordered_json(name);
}

ordered_json pathJson(const Scene& scene, const MirrorPath& path) {
  ordered_json json = ordered_json::array();
  for (const int mirror : path) {
    json.push_back(mirrorJson(scene, mirror));
  }
  return json;
}

// Tells mirrors of one name apart.
ordered_json indicesJson(const MirrorPath& path) {
  return ordered_json(std::vector<int>(path.begin(), path.end()));
}

ordered_json metres(const std::optional<double>& value) {
  return value ? ordered_json(*value) : ordered_json(nullptr);
}

// Returns the depth resolution of a mirror pass; null where only the background is seen.
ordered_json depthJson(const Session& session, const Pass* pass) {
  const DrawnFrame& frame = session.lastFrame();
  if (!pass) {
    return nullptr;
  }
  const auto readout = depthReadout(*pass, frame.plan.projection, session.scene(), frame.state);
  if (!readout) {
    return nullptr;
  }
  return {{"distance_m", readout->distance},
          {"in_use_m", metres(gapWith(*readout, frame.settings.reflection.clip))},
          {"clip_distance_m", metres(readout->plain)},
          {"oblique_m", metres(readout->oblique)},
          {"none_m", metres(readout->plain)}};
}

// Returns the index of each pass that draws a view of the picture, by its path.
template <typename Passes>
std::map<MirrorPath, size_t> viewsOf(const Passes& passes) {
  std::map<MirrorPath, size_t> views;
  for (size_t i = 0; i < passes.size(); ++i) {
    if (passes[i].kind == PassKind::mirror || passes[i].kind == PassKind::main) {
      views.emplace(passes[i].path, i);
    }
  }
  return views;
}

// Returns the index of the pass that looks up the image of `pass`; null if none does.
ordered_json parentJson(const std::map<MirrorPath, size_t>& views, const PassId& pass) {
  if (pass.path.empty()) {
    return nullptr;
  }
  const auto parent = views.find(MirrorPath(pass.path.begin(), pass.path.end() - 1));
  return parent == views.end() ? ordered_json(nullptr) : ordered_json(parent->second);
}

ordered_json passesJson(Session& session) {
  ordered_json passes = ordered_json::array();
  const FramePlan& plan = session.lastFrame().plan;
  std::map<MirrorPath, const Pass*> mirrors;
  for (const Pass& pass : plan.shownMirrors()) {
    mirrors.emplace(pass.view.path, &pass);
  }
  const std::vector<TimedPass>& all = session.lastFrame().passes();
  const std::map<MirrorPath, size_t> views = viewsOf(all);
  for (const TimedPass& pass : all) {
    const PassTiming& timing = pass.timing;
    const bool mirror = pass.kind == PassKind::mirror;
    const auto shown = mirrors.find(pass.path);
    const Pass* ofMirror = shown == mirrors.end() ? nullptr : shown->second;
    const Pass* planned = pass.kind == PassKind::main ? &plan.main() : ofMirror;
    const PixelRect rect = planned ? planned->view.rect : PixelRect();
    const int samples = planned ? session.device().sampleCount(planned->quality.samples) : 0;
    passes.push_back({{"name", pass.name},
                      {"mirror", mirror ? mirrorJson(session.scene(), pass.path.back()) : ordered_json(nullptr)},
                      {"path", pathJson(session.scene(), pass.path)},
                      {"path_indices", indicesJson(pass.path)},
                      {"parent", parentJson(views, pass)},
                      {"depth", mirror ? ordered_json(depthOf(pass.path)) : ordered_json(nullptr)},
                      {"gpu_ms", timing.gpuMs},
                      {"draws", pass.draws},
                      {"triangles", timing.hasStatistics ? ordered_json(timing.triangles) : ordered_json(nullptr)},
                      {"fragments", timing.hasStatistics ? ordered_json(timing.fragments) : ordered_json(nullptr)},
                      {"samples_drawn", timing.hasSamples ? ordered_json(timing.samples) : ordered_json(nullptr)},
                      {"area_px", pass.areaPx},
                      {"size", planned ? ordered_json({rect.width, rect.height}) : ordered_json(nullptr)},
                      {"samples", planned ? ordered_json(samples) : ordered_json(nullptr)},
                      {"depth_resolution", depthJson(session, ofMirror)}});
  }
  return passes;
}

ordered_json skippedJson(const Scene& scene, const SceneState& state, const FramePlan& plan) {
  ordered_json skipped = ordered_json::array();
  for (const SkippedMirror& skip : skippedMirrors(scene, state, plan, mostListed)) {
    skipped.push_back({{"mirror", mirrorJson(scene, skip.path.back())},
                       {"path", pathJson(scene, skip.path)},
                       {"path_indices", indicesJson(skip.path)},
                       {"depth", depthOf(skip.path)},
                       {"reason", skipReasonName(skip.reason)},
                       {"detail", std::string_view(skip.detail)}});
  }
  for (const Pass& pass : plan.passes) {
    if (pass.id.kind == PassKind::shadow && !pass.isLayer && !pass.drawn()) {
      const SkipReason reason = pass.source == PassSource::reused ? SkipReason::unchanged : SkipReason::outside;
      skipped.push_back({{"mirror", nullptr},
                         {"path", ordered_json::array()},
                         {"path_indices", ordered_json::array()},
                         {"depth", nullptr},
                         {"reason", skipReasonName(reason)},
                         {"detail", passName(scene, plan, pass)}});
    }
  }
  return skipped;
}

// Leaves gpu_ms empty; only `bench --prices` measures it, by leaving each effect out in turn.
ordered_json effectsJson(Session& session) {
  ordered_json json = ordered_json::array();
  const DrawnFrame& frame = session.lastFrame();
  for (const Effect& effect : effectsOf(session.scene(), frame.state, frame.settings, frame.plan)) {
    const EffectCost& cost = frame.ledger[effect.kind];
    json.push_back({{"name", effect.name},
                    {"called_for", effect.calledFor},
                    {"why", effect.why},
                    {"gpu_ms", nullptr},
                    {"draws", cost.draws},
                    {"bytes", cost.bytes},
                    {"pipelines", cost.pipelines}});
  }
  return json;
}

ordered_json raysJson(const RayUse& rays) {
  return {{"method", !rays.traced ? ordered_json(nullptr) : ordered_json(rays.hardware ? "hardware" : "software")},
          {"why", rays.traced ? rays.why : "nothing visible calls for rays"},
          {"structures", rays.structures},
          {"bytes", rays.structureBytes}};
}

ordered_json mergeObjects(const std::vector<const ordered_json*>& objects) {
  ordered_json merged = ordered_json::object();
  for (const auto& [key, value] : objects.back()->items()) {
    if (key.ends_with("_ms") && value.is_number()) {
      std::vector<double> values;
      for (const ordered_json* object : objects) {
        values.push_back(object->at(key).get<double>());
      }
      merged[key] = summary(std::move(values));
    } else {
      merged[key] = value;
    }
  }
  return merged;
}

// A pass with its figures in the frames in which it ran.
struct GatheredPass : PassId {
  std::vector<const ordered_json*> figures;
};

ordered_json mergePasses(const std::vector<ordered_json>& frames, const std::vector<std::vector<PassId>>& ids) {
  std::vector<GatheredPass> gathered;
  PassIndex<GatheredPass> index(gathered);
  for (size_t f = 0; f < frames.size(); ++f) {
    size_t next = 0;  // index behind the pass before
    for (size_t i = 0; i < ids[f].size(); ++i) {
      const size_t place = index.findOrInsert({ids[f][i], {}}, next);
      gathered[place].figures.push_back(&frames[f].at("passes").at(i));
      next = place + 1;
    }
  }
  ordered_json merged = ordered_json::array();
  const std::map<MirrorPath, size_t> views = viewsOf(gathered);
  for (const GatheredPass& pass : gathered) {
    merged.push_back(mergeObjects(pass.figures));
    merged.back()["parent"] = parentJson(views, pass);
    if (pass.figures.size() < frames.size()) {
      merged.back()["frames"] = pass.figures.size();
    }
  }
  return merged;
}

}  // namespace

ordered_json frameStats(Session& session) {
  Device& device = session.device();
  const DrawnFrame& frame = session.lastFrame();
  ordered_json json;
  json["scene"] = session.scene().file.string();
  json["size"] = {frame.plan.width, frame.plan.height};
  json["device"] = device.info().name;
  json["driver"] = device.info().driver;
  json["render_path"] = renderPathName(device.renderPath());
  json["settings"] = settingsJson(frame.settings);
  json["passes"] = passesJson(session);
  json["skipped"] = skippedJson(session.scene(), frame.state, frame.plan);
  json["effects"] = effectsJson(session);
  json["rays"] = raysJson(frame.ledger.rays);
  if (const std::optional<QualityChoice>& quality = session.quality()) {
    json["quality"] = {{"point", quality->point.name},
                       {"flip", quality->point.whole.flip},
                       {"gpu_ms", costMs(quality->point)},
                       {"met", quality->met},
                       {"why", quality->why}};
  }
  json["totals"] = {{"cpu_ms", frame.cpuMs},
                    {"plan_ms", frame.planMs},
                    {"gpu_ms", frame.gpuMs},
                    {"frame_ms", frame.frameMs},
                    {"pictures", frame.pictures},
                    {"skipped_mirrors", skippedCount(frame.plan)},
                    {"device_bytes", device.allocatedBytes()},
                    {"device_allocations", device.allocations()},
                    {"peak_rss_bytes", peakResidentBytes()},
                    {"pipelines", session.renderer().pipelines().count()},
                    {"validation_messages", device.validationMessages()}};
  if (frame.settings.debug.checkFinite) {
    json["totals"]["non_finite"] = session.sceneRenderer().finiteWatch().count();
  }
  return json;
}

std::vector<PassId> passIds(Session& session) {
  const std::vector<TimedPass>& passes = session.lastFrame().passes();
  return {passes.begin(), passes.end()};
}

ordered_json mergeStats(const std::vector<ordered_json>& frames, const std::vector<std::vector<PassId>>& passes) {
  ordered_json merged = frames.back();
  merged["frames"] = frames.size();
  std::vector<const ordered_json*> totals;
  for (const ordered_json& frame : frames) {
    totals.push_back(&frame.at("totals"));
  }
  merged["totals"] = mergeObjects(totals);
  merged["passes"] = mergePasses(frames, passes);
  return merged;
}

std::FILE* besideOutput(const std::filesystem::path& file) {
  return file == "-" ? stderr : stdout;
}

void writeText(const std::filesystem::path& file, const std::string& text) {
  if (file == "-") {
    std::fputs(text.c_str(), stdout);
    return;
  }
  std::error_code ignored;
  std::filesystem::create_directories(file.parent_path(), ignored);
  replaceFile(file, text);
}

void writeJson(const std::filesystem::path& file, const ordered_json& json) {
  // Names of a scene may hold what moves a terminal's cursor or turns its text around.
  const bool printed = file == "-";
  writeText(file, json.dump(2, ' ', printed, ordered_json::error_handler_t::replace) + "\n");
}

}  // namespace speculum
