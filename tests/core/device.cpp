#include <array>
#include <atomic>
#include <cctype>
#include <cstring>
#include <memory>
#include <thread>

#include "core/fixture.hpp"
#include "error_message.hpp"
#include "platform/process.hpp"

namespace speculum::test {
namespace {

std::string errorOf(const DeviceOptions& options) {
  return messageOf([&] { const Device device(options); });
}

TEST(Device, NeedsNoWindowSystem) {
  unsetenv("DISPLAY");
  unsetenv("WAYLAND_DISPLAY");
  const Device device(validated());
  EXPECT_EQ(device.surface(), VkSurfaceKHR{VK_NULL_HANDLE});
  EXPECT_FALSE(device.info().name.empty());
  EXPECT_FALSE(device.info().driver.empty());
  EXPECT_FALSE(device.info().missing);
  EXPECT_EQ(device.validationMessages(), 0);
}

TEST(Device, IsChosenByIndexOrName) {
  const std::vector<DeviceInfo> gpus = Device::list();
  ASSERT_FALSE(gpus.empty());
  for (const DeviceInfo& gpu : gpus) {
    if (gpu.missing) {
      continue;
    }
    EXPECT_EQ(Device({.gpu = std::to_string(gpu.index)}).info().index, gpu.index);
    std::string part = gpu.name.substr(0, 8);
    for (char& c : part) {
      c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
    }
    EXPECT_TRUE(contains(Device({.gpu = part}).info().name, gpu.name.substr(0, 8)));
  }
}

TEST(Device, UnknownGpuIsRefusedWithAList) {
  for (const char* wanted : {"99", "no such card", "-1"}) {
    const std::string error = errorOf({.gpu = wanted});
    EXPECT_TRUE(contains(error, std::string("'") + wanted + "'"));
    EXPECT_TRUE(contains(error, Device::list().front().name));
  }
}

TEST(Device, SampleCountIsTheNextLowerOne) {
  Device device({});
  for (int wanted = 1; wanted <= 64; wanted *= 2) {
    int expected = 1;
    for (int count = 1; count <= wanted; count *= 2) {
      if (device.caps().sampleCounts & count) {
        expected = count;
      }
    }
    EXPECT_EQ(device.sampleCount(wanted), expected) << wanted;
  }
  EXPECT_EQ(device.sampleCount(3), device.sampleCount(2));
  EXPECT_EQ(device.sampleCount(0), 1);
}

TEST_F(GpuTest, CountsItsMemory) {
  {
    const Buffer buffer(device_, 100000, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, BufferMemory::host, "test");
    EXPECT_GE(device_.allocatedBytes(), 100000u);
    EXPECT_LT(device_.allocatedBytes(), 200000u);
    EXPECT_EQ(device_.allocations(), 1u);
    EXPECT_EQ(Device({}).allocations(), 0u);
  }
  EXPECT_EQ(device_.allocatedBytes(), 0u);
  EXPECT_EQ(device_.allocations(), 1u) << "an empty block is kept";
  EXPECT_GT(device_.memoryBudget().budgetBytes, 0u);
}

TEST_F(GpuTest, BufferRefusesAWritePastItsEnd) {
  const Buffer buffer(device_, 16, VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT, BufferMemory::host, "test");
  const std::array<std::byte, 16> data{};
  buffer.write(data);
  EXPECT_THROW(buffer.write(data, 1), std::out_of_range);
}

TEST(Device, RenderPathNames) {
  for (const RenderPath path : {RenderPath::automatic, RenderPath::dynamic, RenderPath::renderPass}) {
    EXPECT_EQ(renderPathFromName(renderPathName(path)), path);
  }
  EXPECT_EQ(renderPathFromName("fast"), std::nullopt);
}

// The loader keeps one list of all devices, which it walks to name an object, and frees entries of it without a lock
// that the naming thread holds.
TEST(Device, ThreadsHaveDevicesOfTheirOwn) {
  std::atomic<bool> done = false;
  const auto device = std::make_unique<Device>(validated());
  std::string error;
  std::jthread other([&] {
    error = messageOf([] {
      for (int i = 0; i < 20; ++i) {
        const Device device(validated());
      }
    });
    done = true;
  });
  while (!done) {
    const FenceHandle fence = device->create(vkCreateFence, {.sType = VK_STRUCTURE_TYPE_FENCE_CREATE_INFO}, "named");
  }
  other.join();
  EXPECT_EQ(error, "nothing was thrown");
  EXPECT_EQ(device->validationMessages(), 0);
}

TEST(Device, MissingDriverSaysHowToMendIt) {
  const std::string old = environment("VK_DRIVER_FILES");
  setEnvironment("VK_DRIVER_FILES", "/nonexistent.json");
  const std::string error = errorOf({});
  old.empty() ? static_cast<void>(unsetenv("VK_DRIVER_FILES")) : setEnvironment("VK_DRIVER_FILES", old);
  EXPECT_TRUE(contains(error, "install"));
}

TEST_F(GpuTest, UploadedFloatsAreReadBack) {
  Uploader uploader(device_);
  const std::array<uint16_t, 8> halves = {0x0000, 0x3c00, 0xbc00, 0x7bff, 0x3800, 0x4000, 0x3400, 0x0001};
  Image image(device_,
              {.extent = {2, 1},
               .usage = VK_IMAGE_USAGE_TRANSFER_SRC_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT | VK_IMAGE_USAGE_SAMPLED_BIT,
               .name = "test"});
  const Buffer staging = uploader.buffer(halves, VK_BUFFER_USAGE_TRANSFER_SRC_BIT, "test");
  uploader.run([&](VkCommandBuffer commands) {
    Barriers::uploadToCopy(commands, image);
    const VkBufferImageCopy region{.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1}, .imageExtent = {2, 1, 1}};
    vkCmdCopyBufferToImage(commands, staging.get(), image.get(), image.layout(), 1, &region);
    device_.barriers().record(commands, BarrierKind::uploadToRead, image);
  });
  const std::vector<float> expected = {0.0f, 1.0f, -1.0f, 65504.0f, 0.5f, 2.0f, 0.25f, 5.9604645e-8f};
  EXPECT_EQ(uploader.readFloats(image), expected);
}

TEST_F(GpuTest, BuffersAreWrittenInPieces) {
  Uploader uploader(device_);
  constexpr VkDeviceSize piece = Uploader::stagingBytes;
  std::vector<uint8_t> values(2 * piece + 3);
  for (size_t i = 0; i < values.size(); ++i) {
    values[i] = static_cast<uint8_t>(i * 2654435761u >> 24);
  }
  const std::span<const std::byte> all = std::as_bytes(std::span(values));
  for (const VkDeviceSize bytes : {VkDeviceSize{0}, VkDeviceSize{1}, piece - 1, piece, 2 * piece, 2 * piece + 3}) {
    BufferWriter writer(uploader, bytes, VK_BUFFER_USAGE_TRANSFER_SRC_BIT, "test");
    writer.write(all.first(std::min<size_t>(bytes, 1)));
    if (bytes > 1) {
      EXPECT_THROW(writer.finish(), std::logic_error) << bytes;
      writer.write(all.first(bytes).subspan(1));
    }
    EXPECT_THROW(writer.add(uint8_t{0}), std::out_of_range) << bytes;
    const Buffer buffer = writer.finish();
    const Buffer copy(device_, bytes, VK_BUFFER_USAGE_TRANSFER_DST_BIT, BufferMemory::host, "copy");
    uploader.run([&](VkCommandBuffer commands) {
      const VkBufferCopy region{.size = buffer.bytes()};
      vkCmdCopyBuffer(commands, buffer.get(), copy.get(), 1, &region);
      Barriers::copyToHost(commands);
    });
    EXPECT_EQ(std::memcmp(copy.mapped(), values.data(), bytes), 0) << bytes;
  }
}

}  // namespace
}  // namespace speculum::test
