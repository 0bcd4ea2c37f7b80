#include "systems/scene_targets.hpp"

#include <gtest/gtest.h>

#include <bit>

namespace speculum::test {
namespace {

TEST(ImagePool, TargetsCoverWithoutPowersOfTwo) {
  Device device({.validation = true});
  {
    RetireQueue retired;
    SharedDepth depth(device, VK_SAMPLE_COUNT_1_BIT, "depth");
    for (const uint32_t side : {1u, 32u, 33u, 64u, 96u, 97u, 128u, 500u, 512u}) {
      ImagePool pool(device, depth, "image");
      const VkExtent2D extent = pool.acquire({side, side}, retired).extent();
      EXPECT_GE(extent.width, side);
      EXPECT_LE(extent.width, std::max(96u, side + 63));
      EXPECT_FALSE(std::has_single_bit(extent.width)) << side;
      EXPECT_EQ(extent.height, extent.width);
    }
  }
  EXPECT_EQ(device.validationMessages(), 0);
}

}  // namespace
}  // namespace speculum::test
