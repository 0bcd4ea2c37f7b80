#include "shader_pair.hpp"

#include "platform/files.hpp"

namespace speculum::examples {

ShaderPair::ShaderPair(Renderer& renderer, const Options& options, const std::string& name, GraphicsPipelineDesc desc) {
  desc.name = name;
  desc.vert = name + ".vert";
  desc.frag = name + ".frag";
  for (const bool window : {false, true}) {
    desc.color = window ? renderer.displayFormat() : colorFormat;
    desc.constants = {{0, window}};
    if (options.shaderObjects) {
      kinds_[window].objects =
          std::make_unique<ShaderObjects>(renderer.device(), dataDirectory("shaders/" + options.name), desc);
    } else {
      kinds_[window].pipeline = std::make_unique<Pipeline>(renderer.pipelines(), desc);
    }
  }
}

void ShaderPair::bind(const PassScope& pass, VkDescriptorSet set) const {
  const Kind& kind = of(pass);
  if (kind.objects) {
    kind.objects->bind(pass, set);
  } else {
    kind.pipeline->bind(pass.commands());
    kind.pipeline->bindSet(pass.commands(), 0, set);
  }
}

}  // namespace speculum::examples
