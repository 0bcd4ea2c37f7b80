#include "core/device_memory.hpp"

#include <cstring>

#include "core/barriers.hpp"
#include "core/fixture.hpp"

namespace speculum::test {
namespace {

constexpr VkDeviceSize mebibyte = VkDeviceSize{1} << 20;

struct Taken {
  VkDeviceSize offset = 0;
  VkDeviceSize bytes = 0;
};

// Says whether the range lies in the block and meets none that is taken.
bool isFree(const std::vector<Taken>& taken, const Taken& range, VkDeviceSize blockBytes) {
  return range.offset + range.bytes <= blockBytes && std::ranges::none_of(taken, [&](const Taken& other) {
           return range.offset < other.offset + other.bytes && other.offset < range.offset + range.bytes;
         });
}

TEST(FreeRanges, RandomRangesNeverMeetAndAllComeBack) {
  for (uint32_t seed = 0; seed < 50; ++seed) {
    std::mt19937 random(seed);
    const VkDeviceSize blockBytes = 1000 + random() % 5000;
    FreeRanges free(blockBytes);
    std::vector<Taken> taken;
    for (int step = 0; step < 1000; ++step) {
      if (random() % 5 < 3) {
        const VkDeviceSize bytes = 1 + random() % 400;
        const VkDeviceSize alignment = VkDeviceSize{1} << random() % 9;
        if (const auto offset = free.take(bytes, alignment)) {
          EXPECT_EQ(*offset % alignment, 0u);
          ASSERT_TRUE(isFree(taken, {*offset, bytes}, blockBytes)) << seed << " " << step;
          taken.push_back({*offset, bytes});
        } else {
          for (VkDeviceSize at = 0; at + bytes <= blockBytes; at += alignment) {
            ASSERT_FALSE(isFree(taken, {at, bytes}, blockBytes)) << "there is room at " << at;
          }
        }
      } else if (!taken.empty()) {
        std::swap(taken[random() % taken.size()], taken.back());
        free.give(taken.back().offset, taken.back().bytes);
        taken.pop_back();
      }
      EXPECT_EQ(free.nothingTaken(), taken.empty());
    }
    for (const Taken& range : taken) {
      free.give(range.offset, range.bytes);
    }
    EXPECT_TRUE(free.nothingTaken());
    EXPECT_EQ(free.take(blockBytes, 1), 0u) << "one range again";
  }
}

// The types of a usual GPU, and one that only a feature allows.
TEST(MemoryTypes, AreTriedInOrder) {
  constexpr VkMemoryPropertyFlags local = VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT;
  constexpr VkMemoryPropertyFlags host = VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;
  VkPhysicalDeviceMemoryProperties memory{.memoryTypeCount = 6};
  memory.memoryTypes[1].propertyFlags = local;
  memory.memoryTypes[2].propertyFlags = host;
  memory.memoryTypes[3].propertyFlags = host | VK_MEMORY_PROPERTY_HOST_CACHED_BIT;
  memory.memoryTypes[4].propertyFlags = local | host;
  memory.memoryTypes[5].propertyFlags = local | VK_MEMORY_PROPERTY_LAZILY_ALLOCATED_BIT;
  EXPECT_EQ(memoryTypes(memory, 0x3f, local), (std::vector<uint32_t>{1, 4, 0, 2, 3}));
  EXPECT_EQ(memoryTypes(memory, 0x3f, host), (std::vector<uint32_t>{2, 3, 4}));
  EXPECT_EQ(memoryTypes(memory, 0x0a, local), (std::vector<uint32_t>{1, 3}));
  EXPECT_TRUE(memoryTypes(memory, 0x22, host).empty());
}

class BlocksTest : public GpuTest {
 protected:
  Buffer buffer(VkDeviceSize bytes, BufferMemory memory = BufferMemory::device) {
    return {device_, bytes, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, memory, "test"};
  }
  Image image(uint32_t side) {
    return {device_, {.extent = {side, side}, .usage = VK_IMAGE_USAGE_SAMPLED_BIT, .name = "test"}};
  }
};

TEST_F(BlocksTest, HoldManySmallResources) {
  std::vector<Image> images;
  std::vector<Buffer> buffers;
  for (int i = 0; i < 1000; ++i) {
    images.push_back(image(64));
    buffers.push_back(buffer(1000 + i));
  }
  EXPECT_GE(device_.allocations(), 2u) << "images and buffers lie apart";
  EXPECT_LE(device_.allocations(), 8u);
  EXPECT_LE(device_.memory().bytes(), 2 * device_.allocatedBytes() + 2 * MemoryBlocks::smallestBlock);
  images.clear();
  buffers.clear();
  EXPECT_EQ(device_.allocatedBytes(), 0u);
  EXPECT_LE(device_.allocations(), 4u) << "small ones are kept";
  EXPECT_EQ(device_.memory().bytes(), device_.allocations() * MemoryBlocks::smallestBlock);
}

TEST_F(BlocksTest, LargeResourcesLieApart) {
  const Buffer small = buffer(1000);
  {
    const Buffer large = buffer(40 * mebibyte);
    EXPECT_EQ(device_.allocations(), 2u);
    EXPECT_LT(device_.memory().bytes(), 45 * mebibyte);
  }
  EXPECT_EQ(device_.allocations(), 1u) << "it is freed at once";
}

TEST_F(BlocksTest, DoNotGrowWithLargeResources) {
  const Buffer large = buffer(40 * mebibyte);
  const Buffer small = buffer(1000);
  EXPECT_EQ(device_.allocations(), 2u);
  EXPECT_LT(device_.memory().bytes(), 45 * mebibyte);
}

TEST_F(BlocksTest, MappedBuffersKeepTheirBytes) {
  std::mt19937 random(1);
  struct Filled {
    Buffer buffer;
    std::byte value{};
  };
  std::vector<Filled> all;
  for (int i = 0; i < 2000; ++i) {
    if (all.size() > 100) {
      std::swap(all[random() % all.size()], all.back());
      all.pop_back();
    }
    Filled& filled = all.emplace_back(Filled{buffer(1 + random() % 100'000, BufferMemory::host), std::byte(i)});
    std::memset(filled.buffer.mapped(), i & 0xff, filled.buffer.bytes());
    const Filled& other = all[random() % all.size()];
    EXPECT_EQ(std::count(other.buffer.mapped(), other.buffer.mapped() + other.buffer.bytes(), other.value),
              static_cast<ptrdiff_t>(other.buffer.bytes()));
  }
}

// Images that together take several staging buffers, and one that is larger than it.
TEST_F(BlocksTest, UploadsTogetherArriveWhole) {
  Uploader uploader(device_);
  const auto texelsOf = [](uint32_t side, uint32_t seed) {
    std::mt19937 random(seed);
    std::vector<uint32_t> texels(size_t{side} * side);
    std::ranges::generate(texels, std::ref(random));
    return texels;
  };
  const std::vector<uint32_t> sides = {512, 1, 700, 1500, 3, 900, 512};
  std::vector<Image> images;
  std::vector<Buffer> buffers;
  std::vector<std::vector<uint32_t>> values;  // of the buffers
  uploader.together([&] {
    for (const uint32_t side : sides) {
      images.push_back(uploader.image(std::as_bytes(std::span<const uint32_t>(texelsOf(side, side))), {side, side},
                                      VK_FORMAT_R8G8B8A8_UNORM, false, "test"));
      values.push_back(texelsOf(100, side));
      buffers.push_back(uploader.buffer(values.back(), VK_BUFFER_USAGE_TRANSFER_SRC_BIT, "test"));
    }
  });
  for (size_t i = 0; i < sides.size(); ++i) {
    const std::vector<uint32_t> expected = texelsOf(sides[i], sides[i]);
    const std::vector<std::byte> read = uploader.read(images[i]);
    EXPECT_TRUE(std::ranges::equal(read, std::as_bytes(std::span(expected)))) << sides[i];
    const Buffer copy(device_, buffers[i].bytes(), VK_BUFFER_USAGE_TRANSFER_DST_BIT, BufferMemory::host, "copy");
    uploader.run([&](VkCommandBuffer commands) {
      const VkBufferCopy region{.size = copy.bytes()};
      vkCmdCopyBuffer(commands, buffers[i].get(), copy.get(), 1, &region);
      Barriers::copyToHost(commands);
    });
    EXPECT_EQ(std::memcmp(copy.mapped(), values[i].data(), copy.bytes()), 0) << sides[i];
  }
  EXPECT_THROW(uploader.together([&] {
    const Image lost = uploader.image(std::as_bytes(std::span<const uint32_t>(texelsOf(3, 1))), {3, 3},
                                      VK_FORMAT_R8G8B8A8_UNORM, false, "lost");
    throw std::runtime_error("test");
  }),
               std::runtime_error);
  const std::vector<uint32_t> again = texelsOf(5, 5);
  Image after = uploader.image(std::as_bytes(std::span(again)), {5, 5}, VK_FORMAT_R8G8B8A8_UNORM, false, "after");
  EXPECT_TRUE(std::ranges::equal(uploader.read(after), std::as_bytes(std::span(again))));
}

}  // namespace
}  // namespace speculum::test
