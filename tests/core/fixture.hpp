#pragma once

#include "core/renderer.hpp"
#include "sampling.hpp"
#include "test_headers.hpp"

namespace speculum::test {

DeviceOptions validated(RenderPath path = RenderPath::automatic);
RendererOptions headless(VkExtent2D extent);

// Number of resizes in which a leak shows.
inline int manyResizes() {
  return testing_support::fullTests() ? 200 : 50;
}

// push_constant block of triangle.vert.
struct TrianglePush {
  float offset[2] = {0.0f, 0.0f};  // clip space
  float depth = 0.5f;              // reversed Z
  float brightness = 1.0f;
};

// A device with validation; a test that ends with a message of the layer fails.
class GpuTest : public testing::Test {
 protected:
  void TearDown() override { EXPECT_EQ(device_.validationMessages(), 0); }

  Device device_{validated()};
};

// Adds a renderer that draws into an image of smallExtent.
inline constexpr VkExtent2D smallExtent{64, 48};
class RendererTest : public GpuTest {
 protected:
  Renderer renderer_{device_, headless(smallExtent)};
};

// A layout with one binding, at 0.
VkDescriptorSetLayout oneBinding(Device& device, VkDescriptorType type, uint32_t count = 1);

// A small frame with every kind of target: two triangles into an OffScreen, its image and a third triangle into a main
// target, the main target onto the display image, an empty overlay.
class SmallScene {
 public:
  SmallScene(Renderer& renderer, VkExtent2D extent, int samples);

  void draw(Frame& frame);
  // Draws and submits one frame; false when the renderer gave none.
  bool frame(bool capture = false);
  // Draws so many frames and waits for them.
  void frames(int count);
  void resize(VkExtent2D extent);

  OffScreen& mirror() { return mirror_; }
  OffScreen& main() { return main_; }

 private:
  void drawTriangles(Frame& frame, OffScreen& target, const std::string& name, std::span<const TrianglePush> triangles);
  void copy(Frame& frame, VkCommandBuffer commands, const Pipeline& pipeline, OffScreen& source);

  Renderer& renderer_;
  SharedDepth shared_;
  OffScreen mirror_;
  OffScreen main_;
  VkDescriptorSetLayout layout_ = VK_NULL_HANDLE;
  Pipeline triangle_;
  Pipeline copyToMain_;
  Pipeline display_;
  IdleGuard idle_;
};

}  // namespace speculum::test
