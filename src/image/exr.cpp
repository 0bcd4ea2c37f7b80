#include "image/picture_files.hpp"

#include <tinyexr.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstdlib>
#include <cstring>
#include <map>
#include <memory>
#include <set>
#include <span>
#include <stdexcept>
#include <string>

#include "image/stb_decoder.hpp"
#include "platform/files.hpp"

namespace speculum {

namespace {

std::string takeMessage(const char* message) {
  if (message == nullptr) {
    return "unknown fault";
  }
  std::string text(message);
  FreeEXRErrorMessage(message);
  return text.substr(0, text.find('\n'));
}

// Encodes in memory, because SaveEXR() returns success even if the disk is too full for a file's last bytes.
std::vector<uint8_t> encodeExr(const std::filesystem::path& file, const LinearImage& image) {
  // Readers expect the channels in alphabetical order.
  std::array<EXRChannelInfo, 3> channels{};
  std::array<std::vector<float>, 3> planes;
  std::array<unsigned char*, 3> planePointers{};
  for (int c = 0; c < 3; ++c) {
    channels[c].name[0] = "BGR"[c];
    planes[c].reserve(image.pixels.size());
    for (const glm::vec3& pixel : image.pixels) {
      planes[c].push_back(pixel[2 - c]);
    }
    planePointers[c] = reinterpret_cast<unsigned char*>(planes[c].data());
  }
  std::array<int, 3> pixelTypes;
  pixelTypes.fill(TINYEXR_PIXELTYPE_FLOAT);
  // Header and image borrow these arrays: FreeEXRHeader() and FreeEXRImage() must not see them.
  EXRHeader header;
  InitEXRHeader(&header);
  header.compression_type = TINYEXR_COMPRESSIONTYPE_ZIP;
  header.num_channels = 3;
  header.channels = channels.data();
  header.pixel_types = pixelTypes.data();
  header.requested_pixel_types = pixelTypes.data();
  EXRImage source;
  InitEXRImage(&source);
  source.num_channels = 3;
  source.width = image.width;
  source.height = image.height;
  source.images = planePointers.data();
  unsigned char* memory = nullptr;
  const char* message = nullptr;
  const size_t size = SaveEXRImageToMemory(&source, &header, &memory, &message);
  const std::unique_ptr<unsigned char, decltype(&std::free)> owner(memory, &std::free);
  if (size == 0) {
    throw FileError(file, "cannot be encoded as EXR: " + takeMessage(message), "a smaller picture is needed");
  }
  return {memory, memory + size};
}

using Bytes = std::span<const uint8_t>;

constexpr int64_t mostPixels = int64_t{1} << 26;
constexpr int64_t mostValues = int64_t{1} << 28;
constexpr int64_t mostCoordinate = int64_t{1} << 20;  // tinyexr refuses rows beyond this
constexpr size_t mostAttributes = 1000;               // tinyexr stops reading at 1024
constexpr int64_t mostPerByte = 1032;                 // bytes that deflate unpacks from one; RLE and PIZ unpack fewer

enum Compression : uint8_t { none, rle, zips, zip, piz };

void require(bool holds, const std::string& fault) {
  if (!holds) {
    throw std::runtime_error(fault);
  }
}

// Reads little-endian values, as the format and every supported machine have them.
class Cursor {
 public:
  explicit Cursor(Bytes bytes, uint64_t at = 0) : bytes_(bytes) { take(at); }

  Bytes take(uint64_t size) {
    require(size <= bytes_.size(), "it ends early");
    const Bytes taken = bytes_.first(size);
    bytes_ = bytes_.subspan(size);
    return taken;
  }
  template <typename T>
  T value() {
    T value;
    std::memcpy(&value, take(sizeof(T)).data(), sizeof(T));
    return value;
  }
  std::string text() {
    const auto end = std::ranges::find(bytes_, uint8_t{0});
    const Bytes taken = take(static_cast<size_t>(end - bytes_.begin()));
    take(1);
    return {taken.begin(), taken.end()};
  }
  size_t left() const { return bytes_.size(); }

 private:
  Bytes bytes_;
};

class ExrLayout {
 public:
  explicit ExrLayout(Bytes file) : file_(file) { readHeader(); }

  void checkChunks(std::vector<uint8_t>& bytes) {
    if (tiled_) {
      checkTiles();
    } else {
      completeTable(bytes);
      checkRows();
    }
  }

  size_t lineOrderOffset() const { return static_cast<size_t>(attribute("lineOrder", 1).data() - file_.data()); }

 private:
  // Fills the table from the chunks, which follow each other, if the writer left the table empty because it was
  // interrupted or does not seek.
  void completeTable(std::vector<uint8_t>& bytes) const {
    const int64_t rows = rowsOfChunk();
    const auto chunks = static_cast<uint64_t>((height_ + rows - 1) / rows);
    Cursor table(file_, table_);
    const Bytes entries = table.take(8 * chunks);
    if (std::ranges::any_of(entries, [](uint8_t byte) { return byte != 0; })) {
      return;
    }
    uint64_t at = table_ + 8 * chunks;
    for (uint64_t i = 0; i < chunks; ++i) {
      Cursor chunk(file_, at);
      const int64_t index = (int64_t{chunk.value<int32_t>()} - top_) / rows;
      const auto size = chunk.value<int32_t>();
      require(index >= 0 && index < static_cast<int64_t>(chunks) && size >= 1, "its table of chunks is unfinished");
      std::memcpy(&bytes[table_ + 8 * static_cast<uint64_t>(index)], &at, sizeof at);
      at += 8 + static_cast<uint64_t>(size);
    }
  }

  void readHeader() {
    Cursor header(file_);
    require(header.value<uint32_t>() == 20000630, "it does not begin like one");
    const auto version = header.value<uint32_t>();
    require((version & 0xff) == 2 && (version & 0x1800) == 0, "it has several parts, deep pixels or another version");
    tiled_ = (version & 0x200) != 0;
    for (std::string name = header.text(); !name.empty(); name = header.text()) {
      header.text();  // type
      const auto size = header.value<uint32_t>();
      require(attributes_.emplace(name, header.take(size)).second, "its attribute " + name + " stands there twice");
      require(attributes_.size() <= mostAttributes, "it has too many attributes");
    }
    table_ = file_.size() - header.left();
    compression_ = attribute("compression", 1)[0];
    require(compression_ <= piz, "its compression is none of NONE, RLE, ZIPS, ZIP and PIZ");
    readWindow();
    readChannels();
  }

  Bytes attribute(const std::string& name, size_t size) const {
    const auto found = attributes_.find(name);
    require(found != attributes_.end() && found->second.size() >= size, "its attribute " + name + " is missing");
    return found->second;
  }

  void readWindow() {
    Cursor window(attribute("dataWindow", 16));
    const int64_t left = window.value<int32_t>();
    top_ = window.value<int32_t>();
    width_ = window.value<int32_t>() - left + 1;
    height_ = window.value<int32_t>() - top_ + 1;
    require(width_ >= 1 && height_ >= 1, "its data window is empty");
    require(std::max(std::abs(top_), std::abs(top_ + height_)) <= mostCoordinate, "its data window is too far off");
    countPixels(width_, height_);
  }

  void readChannels() {
    Cursor channels(attribute("channels", 1));
    std::set<std::string> names;
    for (std::string name = channels.text(); !name.empty(); name = channels.text()) {
      const auto type = channels.value<uint32_t>();
      channels.take(4);  // perceptually linear or not
      const auto x = channels.value<int32_t>();
      const auto y = channels.value<int32_t>();
      require(type <= 2 && x == 1 && y == 1, "its channel " + name + " is subsampled or of an unknown type");
      require(names.insert(name).second, "its channel " + name + " stands there twice");
      pixelSize_ += type == 1 ? 2 : 4;
    }
    channels_ = static_cast<int64_t>(names.size());
    countPixels(0, 0);
  }

  // Adds to the number of pixels that need memory, and throws if there are too many.
  void countPixels(int64_t width, int64_t height) {
    covered_ += width * height;
    require(covered_ <= mostPixels && covered_ * std::max<int64_t>(channels_, 1) <= mostValues,
            "it has more than 2^26 pixels or 2^28 values");
  }

  void checkCount(int64_t chunks) const {
    const auto found = attributes_.find("chunkCount");
    if (found != attributes_.end()) {
      require(Cursor(found->second).value<int32_t>() == chunks, "its chunkCount disagrees with its data window");
    }
  }

  // Returns the chunk that the next entry of the table points to.
  Cursor chunk(Cursor& table, int64_t chunks) const {
    const auto offset = table.value<uint64_t>();
    require(offset >= table_ + 8 * static_cast<uint64_t>(chunks), "its table of chunks is damaged or unfinished");
    return Cursor(file_, offset);
  }

  int64_t rowsOfChunk() const { return compression_ == zip ? 16 : compression_ == piz ? 32 : 1; }

  void checkRows() {
    const int64_t rows = rowsOfChunk();
    const int64_t chunks = (height_ + rows - 1) / rows;
    checkCount(chunks);
    Cursor table(file_, table_);
    for (int64_t first = 0; first < height_; first += rows) {
      Cursor data = chunk(table, chunks);
      require(data.value<int32_t>() == top_ + first, "a chunk holds other rows than the table says");
      checkData(data, width_ * std::min(rows, height_ - first));
    }
  }

  void checkTiles() {
    Cursor tiles(attribute("tiles", 9));
    const int64_t width = tiles.value<uint32_t>();
    const int64_t height = tiles.value<uint32_t>();
    const auto mode = tiles.value<uint8_t>();
    require(width >= 1 && height >= 1 && std::max(width, height) <= mostPixels, "its tiles have no good size");
    require((mode & 0xf) <= 1 && mode >> 4 <= 1, "its levels are neither one nor those of a mipmap");
    const int64_t roundUp = mode >> 4 != 0 ? 1 : 0;
    const int64_t longest = std::max(width_, height_);
    const int levels =
        (mode & 0xf) == 0 ? 1 : static_cast<int>(std::bit_width(static_cast<uint64_t>(longest - roundUp)) + roundUp);
    const auto levelSize = [&](int64_t size, int level) {
      return std::max<int64_t>((size + (roundUp << level) - roundUp) >> level, 1);
    };
    int64_t chunks = 0;
    covered_ = 0;
    for (int level = 0; level < levels; ++level) {
      const int64_t columns = (levelSize(width_, level) + width - 1) / width;
      const int64_t rows = (levelSize(height_, level) + height - 1) / height;
      countPixels(columns * width, rows * height);
      chunks += columns * rows;
    }
    checkCount(chunks);
    Cursor table(file_, table_);
    for (int level = 0; level < levels; ++level) {
      const int64_t levelWidth = levelSize(width_, level);
      const int64_t levelHeight = levelSize(height_, level);
      for (int64_t y = 0; y * height < levelHeight; ++y) {
        for (int64_t x = 0; x * width < levelWidth; ++x) {
          Cursor data = chunk(table, chunks);
          for (const int64_t expected : {x, y, int64_t{level}, int64_t{level}}) {
            require(data.value<int32_t>() == expected, "a chunk holds another tile than the table says");
          }
          checkData(data, std::min(width, levelWidth - x * width) * std::min(height, levelHeight - y * height));
        }
      }
    }
  }

  // Checks a chunk's data. `data` stands at the chunk's size; data as large as the pixels is not compressed.
  void checkData(Cursor data, int64_t pixels) const {
    const int64_t needed = pixels * pixelSize_;
    const auto size = data.value<int32_t>();
    require(size >= 1, "a chunk is empty");
    const Bytes packed = data.take(static_cast<uint64_t>(size));
    const bool isZip = compression_ == zip || compression_ == zips;
    if (size != needed) {
      require(
          compression_ != none && needed <= mostPerByte * size && (!isZip || unpackedSize(packed, needed) == needed),
          "a chunk has not as much data as its pixels need");
    }
  }

  static int64_t unpackedSize(Bytes packed, int64_t most) {
    std::vector<char> unpacked(static_cast<size_t>(most));
    return unpackZlib({reinterpret_cast<const char*>(packed.data()), packed.size()}, unpacked);
  }

  Bytes file_;
  std::map<std::string, Bytes> attributes_;
  bool tiled_ = false;
  uint8_t compression_ = none;
  size_t table_ = 0;  // offset of the table of chunks
  int64_t top_ = 0;
  int64_t width_ = 0;
  int64_t height_ = 0;
  int64_t channels_ = 0;
  int64_t pixelSize_ = 0;  // bytes of a pixel in all channels
  int64_t covered_ = 0;    // pixels that need memory
};

}  // namespace

LinearImage readExr(const std::filesystem::path& file) {
  std::vector<uint8_t> bytes = readFile(file);
  const auto refuse = [&](const std::string& fault) {
    throw FileError(file, "is not an EXR that can be read: " + fault, "a single-part RGB, RGBA or Y file is needed");
  };
  try {
    checkExrLayout(bytes);
  } catch (const std::runtime_error& fault) {
    refuse(fault.what());
  }
  float* rgba = nullptr;
  int width = 0;
  int height = 0;
  const char* message = nullptr;
  const int result = LoadEXRFromMemory(&rgba, &width, &height, bytes.data(), bytes.size(), &message);
  const std::unique_ptr<float, decltype(&std::free)> owner(rgba, &std::free);
  if (result != TINYEXR_SUCCESS) {
    refuse(takeMessage(message));
  }
  LinearImage image(width, height);
  for (size_t i = 0; i < image.pixels.size(); ++i) {
    image.pixels[i] = glm::vec3(rgba[i * 4], rgba[i * 4 + 1], rgba[i * 4 + 2]);
  }
  return image;
}

void writeExr(const std::filesystem::path& file, const LinearImage& image) {
  if (image.width < 1 || image.height < 1) {
    throw FileError(file, "the picture has no pixels", "width and height of 1 or more are needed");
  }
  replaceFile(file, encodeExr(file, image));
}

void checkExrLayout(std::vector<uint8_t>& bytes) {
  ExrLayout layout(bytes);
  layout.checkChunks(bytes);
  bytes[layout.lineOrderOffset()] = 0;
}

}  // namespace speculum
