// EXR files whose header, table and chunks disagree.
#include <climits>

#include "error_message.hpp"
#include "image/image.hpp"
#include "image/picture_files.hpp"
#include "platform/files.hpp"
#include "temporary_folder.hpp"
#include "test_headers.hpp"

namespace speculum {
namespace {

template <typename T>
void append(std::string& bytes, T value) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

struct Chunk {
  std::vector<int> where;  // row, or column and row of tile and twice the level
  int pixels = 0;          // that it has data for
  int64_t offsetError = 0;
};

// An uncompressed file of one channel whose pixels count from 1.
struct ExrFile {
  std::array<int, 4> window{0, 0, 3, 4};  // left, top, right, bottom
  int compression = 0;
  int lineOrder = 0;
  std::optional<int> chunkCount;
  bool emptyTable = false;
  std::optional<std::array<int, 3>> tiles;  // width, height, mode
  std::vector<Chunk> chunks;

  int width() const { return window[2] - window[0] + 1; }
  int height() const { return window[3] - window[1] + 1; }

  void cutIntoRows() {
    for (int y = 0; y < height(); ++y) {
      chunks.push_back({{window[1] + y}, width()});
    }
  }
  void cutIntoTiles() {
    const auto [tileWidth, tileHeight, mode] = *tiles;
    for (int level = 0; level == 0 || (mode == 1 && std::max(width(), height()) >> level > 0); ++level) {
      const int levelWidth = std::max(width() >> level, 1);
      const int levelHeight = std::max(height() >> level, 1);
      for (int y = 0; y * tileHeight < levelHeight; ++y) {
        for (int x = 0; x * tileWidth < levelWidth; ++x) {
          chunks.push_back(
              {{x, y, level, level},
               std::min(tileWidth, levelWidth - x * tileWidth) * std::min(tileHeight, levelHeight - y * tileHeight)});
        }
      }
    }
  }

  std::string bytes() const {
    std::string file("\x76\x2f\x31\x01\x02", 5);
    file += std::string(tiles ? "\x02" : "\0", 1) + std::string(2, '\0');
    const auto attribute = [&](const char* name, const char* type, const std::string& value) {
      file += name + std::string(1, '\0') + type + std::string(1, '\0');
      append(file, static_cast<uint32_t>(value.size()));
      file += value;
    };
    std::string channel("Y\0", 2);
    for (const int part : {2, 0, 1, 1}) {
      append(channel, part);
    }
    std::string box;
    for (const int side : window) {
      append(box, side);
    }
    attribute("channels", "chlist", channel + '\0');
    attribute("compression", "compression", std::string(1, static_cast<char>(compression)));
    attribute("dataWindow", "box2i", box);
    attribute("displayWindow", "box2i", box);
    attribute("lineOrder", "lineOrder", std::string(1, static_cast<char>(lineOrder)));
    attribute("pixelAspectRatio", "float", std::string("\0\0\x80\x3f", 4));
    attribute("screenWindowCenter", "v2f", std::string(8, '\0'));
    attribute("screenWindowWidth", "float", std::string("\0\0\x80\x3f", 4));
    if (chunkCount) {
      std::string count;
      append(count, *chunkCount);
      attribute("chunkCount", "int", count);
    }
    if (tiles) {
      std::string tile;
      append(tile, (*tiles)[0]);
      append(tile, (*tiles)[1]);
      attribute("tiles", "tiledesc", tile + static_cast<char>((*tiles)[2]));
    }
    file += '\0';
    std::string data;
    float next = 1.0f;
    const size_t begin = file.size() + 8 * chunks.size();
    for (const Chunk& chunk : chunks) {
      const int64_t offset = static_cast<int64_t>(begin + data.size()) + chunk.offsetError;
      append(file, emptyTable ? uint64_t{0} : static_cast<uint64_t>(offset));
      for (const int part : chunk.where) {
        append(data, part);
      }
      append(data, 4 * chunk.pixels);
      for (int i = 0; i < chunk.pixels; ++i) {
        append(data, next++);
      }
    }
    return file + data;
  }
};

class ExrLayout : public ::testing::Test {
 protected:
  LinearImage read(const std::string& bytes) { return readExr(folder_.write("a.exr", bytes)); }
  bool refuses(const std::string& bytes) {
    return messageOf([&] { read(bytes); }) != "nothing was thrown";
  }
  TemporaryFolder folder_;
};

ExrFile rows(int height = 5) {
  ExrFile file;
  file.window = {-2, -3, 1, height - 4};
  file.cutIntoRows();
  return file;
}

ExrFile tiles(int mode) {
  ExrFile file;
  file.window = {0, 0, 4, 6};
  file.tiles = {{3, 2, mode}};
  file.cutIntoTiles();
  return file;
}

TEST_F(ExrLayout, RowsStandWhereTheirChunksSay) {
  for (const int lineOrder : {0, 1}) {
    ExrFile file = rows();
    file.lineOrder = lineOrder;
    file.chunkCount = 5;
    const LinearImage image = read(file.bytes());
    ASSERT_EQ(image.pixels.size(), 20u);
    for (size_t i = 0; i < 20; ++i) {
      EXPECT_EQ(image.pixels[i], glm::vec3(1.0f + static_cast<float>(i))) << "line order " << lineOrder;
    }
  }
}

TEST_F(ExrLayout, TablesThatWereNeverWrittenAreRebuilt) {
  std::mt19937 random(1);
  for (int height = 1; height < 40; ++height) {
    ExrFile file = rows(height);
    const LinearImage expected = read(file.bytes());
    file.emptyTable = true;
    EXPECT_EQ(read(file.bytes()).pixels, expected.pixels) << height << " rows";
    std::ranges::shuffle(file.chunks, random);
    const LinearImage shuffled = read(file.bytes());
    for (int i = 0; i < height; ++i) {
      EXPECT_EQ(shuffled.at(0, file.chunks[i].where[0] - file.window[1]).x, 1.0f + 4.0f * static_cast<float>(i));
    }
    std::string bytes = file.bytes();
    bytes.resize(bytes.size() - 1);
    EXPECT_TRUE(refuses(bytes)) << "cut off";
    file.chunks.back().where[0] = 1000;
    EXPECT_TRUE(refuses(file.bytes())) << "a row that is not there";
    file.chunks.back().where[0] = file.chunks.front().where[0];
    EXPECT_TRUE(refuses(file.bytes())) << "a row that stands there twice";
  }
}

TEST_F(ExrLayout, TilesWithAndWithoutLevelsAreRead) {
  for (const int mode : {0, 1}) {
    const LinearImage image = read(tiles(mode).bytes());
    ASSERT_EQ(image.width, 5);
    ASSERT_EQ(image.height, 7);
    EXPECT_EQ(image.at(2, 1).x, 6.0f);
    EXPECT_EQ(image.at(3, 0).x, 7.0f) << "first of the second tile";
    EXPECT_EQ(image.at(4, 6).x, 35.0f) << "last of a tile of one row";
  }
}

TEST_F(ExrLayout, ChunkCountMustFitTheRows) {
  for (int height = 1; height <= 40; height += 3) {
    for (const int count : {1, height - 1, height + 1, 2 * height, 1 << 20, -1}) {
      if (count != height) {
        ExrFile file = rows(height);
        file.chunkCount = count;
        EXPECT_TRUE(refuses(file.bytes())) << count << " chunks of " << height << " rows";
        file.chunks.resize(static_cast<size_t>(std::clamp(count, 0, height)));
        EXPECT_TRUE(refuses(file.bytes())) << count << " chunks of " << height << " rows, as many in the file";
      }
    }
  }
}

TEST_F(ExrLayout, EveryChunkNeedsItsOwnPlace) {
  for (const bool tiled : {false, true}) {
    const ExrFile good = tiled ? tiles(0) : rows();
    for (size_t chunk = 0; chunk < good.chunks.size(); ++chunk) {
      for (size_t part = 0; part < good.chunks[chunk].where.size(); ++part) {
        for (const int off : {-1000000, -5, -1, 1, 5, 1000000}) {
          ExrFile file = good;
          file.chunks[chunk].where[part] += off;
          EXPECT_TRUE(refuses(file.bytes())) << tiled << chunk << part << off;
        }
      }
      for (const int64_t off : {int64_t{-100000}, int64_t{-1}, int64_t{4}, int64_t{1} << 40, INT64_MIN}) {
        ExrFile file = good;
        file.chunks[chunk].offsetError = off;
        EXPECT_TRUE(refuses(file.bytes())) << tiled << chunk << off;
      }
      for (const int pixels : {0, good.chunks[chunk].pixels - 1, good.chunks[chunk].pixels + 1}) {
        ExrFile file = good;
        file.chunks[chunk].pixels = pixels;
        EXPECT_TRUE(refuses(file.bytes())) << tiled << chunk << pixels;
      }
    }
  }
}

TEST_F(ExrLayout, WindowsMustFitTheChunks) {
  for (const std::array<int, 4> window :
       {std::array{-2, -3, 1, 2}, std::array{-2, -3, 2, 1}, std::array{-2, -4, 1, 1}, std::array{-2, -3, -3, 1},
        std::array{-2, -3, 1, -4}, std::array{INT_MIN, -3, INT_MAX, 1}, std::array{-2, INT_MIN, 1, INT_MAX},
        std::array{0, 0, 1 << 14, 1 << 14}}) {
    ExrFile file = rows();
    file.window = window;
    EXPECT_TRUE(refuses(file.bytes())) << window[0] << " " << window[1] << " " << window[2] << " " << window[3];
  }
}

TEST_F(ExrLayout, TilesAreReadOrRefused) {
  for (const int size : {-1, 0, 1, 2, 4, 1 << 13, 1 << 20, INT_MAX}) {
    for (const int mode : {0, 1, 2, 16, 17, 33, 255}) {
      ExrFile file = tiles(0);
      file.tiles = {{size, 2, mode}};
      EXPECT_TRUE(refuses(file.bytes())) << size << " " << mode;
    }
  }
}

TEST_F(ExrLayout, PackedRowsMustBeComplete) {
  for (const int compression : {1, 2, 3, 4}) {
    ExrFile file = rows();
    file.compression = compression;
    file.chunks.front().pixels = 3;
    EXPECT_TRUE(refuses(file.bytes())) << compression;
  }
  // 3 rows of 100 pixels; the last bytes are left out of what zlib unpacks.
  LinearImage image(100, 3);
  writeExr(folder_ / "a.exr", image);
  std::vector<uint8_t> bytes = readFile(folder_ / "a.exr");
  const std::string good(bytes.begin(), bytes.end());
  EXPECT_FALSE(refuses(good));
  std::string taller = good;
  const size_t window = taller.find("dataWindow") + 11 + 6 + 4;
  taller[window + 12] = 9;  // the last row: more than were packed
  EXPECT_TRUE(refuses(taller));
  taller[window + 12] = 1;
  EXPECT_TRUE(refuses(taller));
}

// Damage leads to an exception and to nothing that a sanitizer reports.
TEST_F(ExrLayout, DamagedBytesAreReadOrRefused) {
  writeExr(folder_ / "zip.exr", LinearImage(20, 40));
  const std::vector<uint8_t> zip = readFile(folder_ / "zip.exr");
  const std::vector<std::string> files = {rows().bytes(), tiles(0).bytes(), tiles(1).bytes(), {zip.begin(), zip.end()}};
  std::mt19937 engine(4);
  int refused = 0;
  for (int round = 0; round < 2000; ++round) {
    std::string bytes = files[engine() % files.size()];
    for (size_t i = engine() % 3 + 1; i > 0; --i) {
      bytes[8 + engine() % (bytes.size() - 8)] = static_cast<char>(engine());
    }
    refused += refuses(bytes);
  }
  EXPECT_GT(refused, 500);
}

}  // namespace
}  // namespace speculum
