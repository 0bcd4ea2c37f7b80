#include "systems/point_light_system.hpp"

namespace speculum {

uint32_t PointLightSystem::record(const PassScope& scope, const FrameInfo& info, const DrawList& pass) {
  if (pass.glyphs.empty()) {
    return 0;
  }
  const PassFormat format = formatOf(scope.desc(), info.settings);
  const Pipeline& pipeline = pipelines_.get(format, [&] {
    return format.describe({.name = "point_light",
                            .vert = "point_light.vert",
                            .frag = "point_light.frag",
                            .setLayouts = {frameLayout_},
                            .sampleShading = scope.samples() != VK_SAMPLE_COUNT_1_BIT});
  });
  info.data.bind(pipeline, scope.commands(), pass);
  scope.cull(VK_CULL_MODE_FRONT_BIT);
  for (const IndexRange& range : pass.glyphs) {
    vkCmdDraw(scope.commands(), 36, range.count, 0, range.first);
    info.ledger.draw(EffectKind::glyphs);
  }
  scope.cull(VK_CULL_MODE_NONE);
  return static_cast<uint32_t>(pass.glyphs.size());
}

}  // namespace speculum
