#pragma once

#include <array>
#include <memory>
#include <string>

#include "core/renderer.hpp"
#include "example.hpp"
#include "shader_objects.hpp"

namespace speculum::examples {

// A vertex and a fragment shader with the state around them, for both kinds of target: an OffScreen, which holds linear
// radiance, and the window, which holds sRGB. The shaders' constant 0 tells which. Either kind is a Pipeline, or with
// --shaders objects a pair of shader objects.
class ShaderPair {
 public:
  // NAME.vert and NAME.frag; `desc` says the rest, except for the color's format.
  ShaderPair(Renderer& renderer, const Options& options, const std::string& name, GraphicsPipelineDesc desc);

  void bind(const PassScope& pass, VkDescriptorSet set) const;
  template <typename T>
  void push(const PassScope& pass, const T& constants) const {
    const Kind& kind = of(pass);
    kind.pipeline ? kind.pipeline->push(pass.commands(), constants)
                  : kind.objects->push(pass, &constants, sizeof constants);
  }

 private:
  struct Kind {
    std::unique_ptr<Pipeline> pipeline;
    std::unique_ptr<ShaderObjects> objects;
  };
  const Kind& of(const PassScope& pass) const { return kinds_[pass.desc().targets.role == TargetRole::swapchain]; }

  std::array<Kind, 2> kinds_;
};

}  // namespace speculum::examples
