#include <malloc.h>
#include <tinyexr.h>

#include <ctime>

#include "file_fault.hpp"
#include "image/image.hpp"
#include "image/picture_files.hpp"
#include "made_pictures.hpp"
#include "platform/files.hpp"
#include "temporary_folder.hpp"
#include "test_headers.hpp"

namespace speculum {
namespace {

namespace fs = std::filesystem;
using namespace testing_support;

Image8 gradient(int width, int height) {
  return madePicture(width, height, [](int x, int y) { return glm::ivec4(7 * x, 11 * y, x * y, 255 - x); });
}

LinearImage ramp(int width, int height) {
  LinearImage image(width, height);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      image.at(x, y) = glm::vec3(0.1f * static_cast<float>(x), 1e-30f * static_cast<float>(y), 1e20f / (1.0f + x + y));
    }
  }
  return image;
}

TEST(Png, KeepsEveryByte) {
  const TemporaryFolder folder;
  for (const auto& [width, height] : {std::pair{1, 1}, std::pair{37, 19}, std::pair{300, 1}}) {
    const Image8 written = gradient(width, height);
    writePng(folder / "a.png", written);
    const Image8 read = readImage8(folder / "a.png");
    EXPECT_EQ(read.width, width);
    EXPECT_EQ(read.height, height);
    EXPECT_EQ(read.rgba, written.rgba);
  }
}

TEST(Png, SameImageGivesSameBytes) {
  const TemporaryFolder folder;
  writePng(folder / "a.png", gradient(40, 40));
  writePng(folder / "b.png", gradient(40, 40));
  EXPECT_EQ(readFile(folder / "a.png"), readFile(folder / "b.png"));
}

TEST(ImageFiles, FoldersAreNoPictures) {
  const TemporaryFolder folder;
  for (const fs::path& file : {folder / "none/a", folder / ""}) {
    const std::string problem = file == folder / "" ? "it is a folder" : "there is no folder";
    expectFileFault([&] { writePng(file, gradient(2, 2)); }, file, problem);
    expectFileFault([&] { writeExr(file, ramp(2, 2)); }, file, problem);
  }
  expectFileFault([&] { readImage8(folder.path()); }, folder.path(), "is a folder");
  expectFileFault([&] { readExr(folder.path()); }, folder.path(), "is a folder");
}

TEST(ImageFiles, EmptyImageIsRefused) {
  const TemporaryFolder folder;
  expectFileFault([&] { writePng(folder / "a.png", Image8()); }, folder / "a.png", "no pixels");
  expectFileFault([&] { writeExr(folder / "a.exr", LinearImage()); }, folder / "a.exr", "no pixels");
}

TEST(ImageFiles, DamagedFilesAreRefused) {
  const TemporaryFolder folder;
  expectFileFault([&] { readImage8(folder / "none.png"); }, folder / "none.png", "cannot be read");
  expectFileFault([&] { readExr(folder / "none.exr"); }, folder / "none.exr", "cannot be read");
  writePng(folder / "cut.png", gradient(64, 64));
  fs::resize_file(folder / "cut.png", fs::file_size(folder / "cut.png") / 2);
  folder.write("head.png", readText(folder / "cut.png").substr(0, 33) + "\x7f\xff\xff\xffIDAT");
  folder.write("cut.jpg", "\xff\xd8\xff\xe0 and no more");
  folder.write("text.png", "hello");
  for (const auto& [file, problem] : {std::pair("text.png", "is not a picture"), std::pair("cut.jpg", "is damaged"),
                                      std::pair("cut.png", "is damaged: a chunk ends beyond the file"),
                                      std::pair("head.png", "is damaged: a chunk ends beyond the file")}) {
    expectFileFault([&, name = file] { readImage8(folder / name); }, folder / file, problem);
  }
  for (const std::string_view content : {std::string_view(""), std::string_view("\x76\x2f\x31\x01 and no more")}) {
    const fs::path exr = folder.write("cut.exr", content);
    expectFileFault([&] { readExr(exr); }, exr, "is not an EXR");
  }
}

// Returns a header alone: 13 bytes of width, height and kind, with a wrong checksum.
std::string pngHeader(uint8_t highByteOfSides) {
  const char high = static_cast<char>(highByteOfSides);
  return std::string("\x89PNG\r\n\x1a\n\0\0\0\rIHDR", 16) + std::string("\0\0", 2) + high + '\0' +
         std::string("\0\0", 2) + high + std::string("\0\x08\x06\0\0\0\0\0\0\0\0\0\0\1IDAT\0\0\0\0\0", 23);
}

TEST(ImageFiles, HugePicturesAreRefused) {
  const TemporaryFolder folder;
  const fs::path file = folder.write("a.png", pngHeader(0x21));
  expectFileFault([&] { readImage8(file); }, file, "the picture has 8448x8448 pixels");
  folder.write("a.png", pngHeader(0x20));
  expectFileFault([&] { readImage8(file); }, file, "is damaged");
}

// A grey progressive JPEG whose codes are all one bit, with scans that hold no data.
std::string jpegOfScans(uint8_t highByteOfSides, int scans, char components = 1) {
  const auto segment = [](char marker, const std::string& data) {
    return std::string("\xff") + marker + '\0' + static_cast<char>(data.size() + 2) + data;
  };
  const auto code = [](char table) { return table + std::string("\1") + std::string(16, '\0'); };
  const std::string side = static_cast<char>(highByteOfSides) + std::string("\0", 1);
  std::string frame = "\x08" + side + side + components;
  for (char i = 1; i <= components; ++i) {
    frame += i + std::string("\x11\0", 2);
  }
  std::string file = "\xff\xd8" + segment('\xdb', std::string("\0", 1) + std::string(64, '\1')) +
                     segment('\xc2', frame) + segment('\xc4', code('\x00')) + segment('\xc4', code('\x10'));
  for (int i = 0; i < scans; ++i) {
    file += segment('\xda', std::string("\1\1\0\1\x3f\0", 6));
  }
  return file + "\xff\xd9";
}

TEST(Jpeg, ScansAreBoundedByTheirPixels) {
  const TemporaryFolder folder;
  EXPECT_EQ(readImage8(folder.write("usual.jpg", jpegOfScans(0x01, 300))).width, 256);
  const fs::path bomb = folder.write("bomb.jpg", jpegOfScans(0x20, 4000));
  const std::clock_t start = std::clock();
  expectFileFault([&] { readImage8(bomb); }, bomb, "has 4000 scans of 8192x8192 pixels");
  EXPECT_LT(std::clock() - start, CLOCKS_PER_SEC);
  // The data of a segment, such as a thumbnail, are no scans.
  std::string thumbnail = "\xff\xe1\x20\x02";
  for (int i = 0; i < 0x1000; ++i) {
    thumbnail += "\xff\xda";
  }
  EXPECT_EQ(readImage8(folder.write("thumbnail.jpg", jpegOfScans(0x08, 2).insert(2, thumbnail))).width, 2048);
}

TEST(Jpeg, FourChannelsNeedAdobesMarker) {
  const TemporaryFolder folder;
  const std::string file = jpegOfScans(0x01, 1, 4);
  const auto marked = [&](const std::string& name, char transform) {
    const std::string marker = std::string("\xff\xee\0\x0e", 4) + name + std::string("\0\x64\0\0\0\0", 6) + transform;
    return folder.write(name + std::to_string(transform) + ".jpg", std::string(file).insert(2, marker));
  };
  for (const fs::path& wrong : {folder.write("unmarked.jpg", file), marked("Other", 2), marked("Adobe", 1)}) {
    expectFileFault([&] { readImage8(wrong); }, wrong, "the picture has four channels, but no Adobe marker");
  }
  EXPECT_EQ(readImage8(marked("Adobe", 2)).width, 256);
}

Image8 smoothPicture(int width, int height) {
  return madePicture(width, height, [&](int x, int y) {
    return glm::ivec4(255 * x / width, 255 * y / height, 128 + 100 * std::sin(0.1 * (x + y)), x);
  });
}

Image8 decoded(const std::vector<uint8_t>& bytes) {
  const TemporaryFolder folder;
  return readImage8(folder.write("a.jpg", {reinterpret_cast<const char*>(bytes.data()), bytes.size()}));
}

double rmsDifference(const Image8& a, const Image8& b) {
  double sum = 0.0;
  for (size_t i = 0; i < a.rgba.size(); ++i) {
    const double difference = i % 4 == 3 ? 0.0 : static_cast<double>(a.rgba[i]) - b.rgba[i];
    sum += difference * difference;
  }
  return std::sqrt(sum / (0.75 * static_cast<double>(a.rgba.size())));
}

// A header with these bytes at these places, and enough behind it.
std::string headerOf(std::string begin, std::initializer_list<std::pair<size_t, int>> bytes) {
  begin.resize(200);
  for (const auto& [at, value] : bytes) {
    begin[at] = static_cast<char>(value);
  }
  return begin;
}

// The decoder calls them damaged, or reads them wrongly.
TEST(ImageFiles, KindsThatAreNotReadAreNamed) {
  const TemporaryFolder folder;
  const std::string tga = tgaFile(gradient(3, 2), 24, 0);
  std::string turned = tga;
  turned[17] |= 0x10;
  const auto psd = [&](int version, int depth, int mode, int compression) {
    return headerOf("8BPS", {{5, version}, {13, 3}, {17, 1}, {21, 1}, {23, depth}, {25, mode}, {39, compression}});
  };
  for (const auto& [name, bytes, kind] :
       {std::tuple("a.bmp", headerOf("BM", {{14, 40}, {30, 1}}), "is a compressed BMP file"),
        std::tuple("v3.bmp", headerOf("BM", {{14, 56}, {30, 3}}), "is a BMP file with an unusual header"),
        std::tuple("shifted.tga", headerOf({}, {{1, 1}, {2, 1}, {3, 10}, {5, 16}, {7, 24}, {12, 2}, {14, 2}, {16, 8}}),
                   "is a TGA file whose palette does not begin at 0"),
        std::tuple("a.psb", psd(2, 8, 3, 0), "is a PSB file"),
        std::tuple("grey.psd", psd(1, 8, 1, 0), "is a PSD file that is not RGB"),
        std::tuple("cmyk.psd", psd(1, 8, 4, 0), "is a PSD file that is not RGB"),
        std::tuple("rle16.psd", psd(1, 16, 3, 1), "is a PSD file that is not RGB"),
        std::tuple("a.tga", turned, "is a TGA file whose rows begin at the right")}) {
    const fs::path file = folder.write(name, bytes);
    expectFileFault([&] { readTexture(file); }, file, kind);
  }
  EXPECT_EQ(readTexture(folder.write("raw16.psd", psd(1, 16, 3, 0))).width, 1);
  EXPECT_EQ(readTexture(folder.write("a.tga", tga)).at(2, 1)[0], 14);
}

TEST(ImageFiles, AlphaIsThatOfTheFile) {
  const TemporaryFolder folder;
  writePng(folder / "a.png", Image8(2, 2));
  EXPECT_TRUE(readTexture(folder / "a.png").hasAlpha);
  const Image8 picture = gradient(2, 2);
  const std::vector<uint8_t> jpeg = encodeJpeg(picture, 95);
  EXPECT_FALSE(readTexture("a.jpg", jpeg).hasAlpha);
  for (const auto& [bits, alphaBits] : {std::pair(24, 0), std::pair(32, 0), std::pair(32, 8)}) {
    const Image8 read = readTexture(folder.write("a.tga", tgaFile(picture, bits, alphaBits)));
    EXPECT_EQ(read.hasAlpha, alphaBits == 8) << bits;
    EXPECT_EQ(read.at(1, 1)[3], alphaBits == 8 ? 254 : 255) << bits;
  }
}

// Red and opaque, green and transparent, blue twice and opaque, without and with runs.
TEST(ImageFiles, TgaOfSixteenBitsHasAlpha) {
  const TemporaryFolder folder;
  const std::string red("\0\xfc", 2);
  const std::string green("\xe0\x03", 2);
  const std::string blue("\x1f\x80", 2);
  for (const auto& [kind, alphaBits, pixels] :
       {std::tuple(2, 1, red + green + blue + blue), std::tuple(10, 1, '\1' + red + green + '\x81' + blue),
        std::tuple(2, 0, red + green + blue + blue)}) {
    const std::string name("name");  // stands before the pixels
    const std::string header =
        headerOf({}, {{0, 4}, {2, kind}, {12, 4}, {14, 1}, {16, 16}, {17, 0x20 | alphaBits}}).substr(0, 18);
    const Image8 read = readTexture(folder.write("a.tga", header + name + pixels));
    EXPECT_EQ(read.hasAlpha, alphaBits == 1) << kind;
    const uint8_t clear = alphaBits == 1 ? 0 : 255;
    EXPECT_EQ(read.rgba, (std::vector<uint8_t>{255, 0, 0, 255, 0, 255, 0, clear, 0, 0, 255, 255, 0, 0, 255, 255}))
        << kind;
  }
}

TEST(Jpeg, KeepsSizeAndColorAndDropsAlpha) {
  for (const auto& [width, height] : {std::pair{1, 1}, std::pair{37, 19}, std::pair{160, 90}, std::pair{300, 1}}) {
    const Image8 image = smoothPicture(width, height);
    const Image8 read = decoded(encodeJpeg(image, 95));
    ASSERT_EQ(read.width, width);
    ASSERT_EQ(read.height, height);
    EXPECT_LT(rmsDifference(image, read), 3.0) << width << "x" << height;
    EXPECT_EQ(read.at(0, 0)[3], 255);
  }
}

TEST(Jpeg, QualityIsPaidForInBytes) {
  const Image8 image = smoothPicture(160, 90);
  const std::vector<uint8_t> low = encodeJpeg(image, 40);
  const std::vector<uint8_t> high = encodeJpeg(image, 95);
  EXPECT_LT(low.size(), high.size());
  EXPECT_GT(rmsDifference(image, decoded(low)), rmsDifference(image, decoded(high)));
  EXPECT_EQ(high, encodeJpeg(image, 95));
}

TEST(Jpeg, RefusesImpossibleSizesAndQualities) {
  EXPECT_THROW(encodeJpeg(Image8(), 88), std::runtime_error);
  EXPECT_THROW(encodeJpeg(Image8(65536, 1), 88), std::runtime_error);
  EXPECT_THROW(encodeJpeg(Image8(8, 8), 0), std::runtime_error);
  EXPECT_THROW(encodeJpeg(Image8(8, 8), 101), std::runtime_error);
}

// Deflate packs it as small as it can.
TEST(Exr, PicturesOfOneColorAreRead) {
  const TemporaryFolder folder;
  writeExr(folder / "black.exr", LinearImage(8192, 64));
  EXPECT_LT(fs::file_size(folder / "black.exr"), 10'000u);
  EXPECT_EQ(readExr(folder / "black.exr").pixels, LinearImage(8192, 64).pixels);
}

TEST(Exr, KeepsEveryFloat) {
  const TemporaryFolder folder;
  for (const auto& [width, height] : {std::pair{1, 1}, std::pair{15, 3}, std::pair{67, 33}}) {
    LinearImage written = ramp(width, height);
    written.at(0, 0) =
        glm::vec3(-1.5f, std::numeric_limits<float>::infinity(), std::numeric_limits<float>::denorm_min());
    writeExr(folder / "a.exr", written);
    const LinearImage read = readExr(folder / "a.exr");
    ASSERT_EQ(read.width, width);
    ASSERT_EQ(read.height, height);
    EXPECT_EQ(read.pixels, written.pixels);
  }
}

TEST(Exr, FullDiskIsAnError) {
  const fs::path full = "/dev/full";
  if (!fs::exists(full)) {
    GTEST_SKIP() << "needs /dev/full";
  }
  for (const int size : {1, 64, 300}) {
    EXPECT_THROW(writeExr(full, ramp(size, size)), std::runtime_error) << size;
  }
}

TEST(Exr, KeepsNaN) {
  const TemporaryFolder folder;
  LinearImage image(2, 1);
  image.at(1, 0).y = std::numeric_limits<float>::quiet_NaN();
  writeExr(folder / "a.exr", image);
  EXPECT_TRUE(std::isnan(readExr(folder / "a.exr").at(1, 0).y));
}

TEST(Exr, ReadsAlphaGreyAndHalf) {
  const TemporaryFolder folder;
  const std::vector<float> values{0.5f, 1.0f, 2.0f, 0.25f, 4.0f, 8.0f, 16.0f, 1.0f};
  for (const int half : {0, 1}) {
    const fs::path file = folder / "a.exr";
    ASSERT_EQ(SaveEXR(values.data(), 2, 1, 4, half, file.c_str(), nullptr), TINYEXR_SUCCESS);
    EXPECT_EQ(readExr(file).at(0, 0), glm::vec3(0.5f, 1.0f, 2.0f));
    EXPECT_EQ(readExr(file).at(1, 0), glm::vec3(4.0f, 8.0f, 16.0f));
    ASSERT_EQ(SaveEXR(values.data(), 2, 1, 1, half, file.c_str(), nullptr), TINYEXR_SUCCESS);
    EXPECT_EQ(readExr(file).at(1, 0), glm::vec3(1.0f));
  }
}

// Zeros, `count` times 258 of them, as deflate packs them best.
std::string packedZeros(size_t count) {
  std::string bytes("\x78\x01", 2);
  unsigned buffer = 0;
  int bits = 0;
  const auto put = [&](unsigned value, int length) {
    buffer |= value << bits;
    for (bits += length; bits >= 8; bits -= 8) {
      bytes += static_cast<char>(buffer);
      buffer >>= 8;
    }
  };
  put(0b011, 3);       // the last block, with fixed codes
  put(0b00001100, 8);  // 0
  for (size_t i = 0; i < count; ++i) {
    put(0b10100011, 8);  // 258 bytes
    put(0, 5);           // as the one before
  }
  put(0, 15);
  return bytes + std::string(4, '\0');  // a checksum, which nothing reads
}

std::string pngOf(unsigned width, unsigned height, const std::string& packed) {
  std::string file("\x89PNG\r\n\x1a\n");
  const auto number = [](size_t value) {
    std::string bytes;
    for (int shift = 24; shift >= 0; shift -= 8) {
      bytes += static_cast<char>(value >> shift);
    }
    return bytes;
  };
  const auto chunk = [&](const std::string& name, const std::string& data) {
    file += number(data.size()) + name + data + number(0);
  };
  chunk("IHDR", number(width) + number(height) + std::string("\x08\x00\x00\x00\x00", 5));
  for (size_t at = 0; at < packed.size(); at += 100'000) {
    chunk("IDAT", packed.substr(at, 100'000));
  }
  chunk("IEND", "");
  return file;
}

TEST(Png, SmallFilesDoNotUnpackToGigabytes) {
  const TemporaryFolder folder;
  EXPECT_EQ(readImage8(folder.write("a.png", pngOf(515, 100, packedZeros(200)))).height, 100);
  EXPECT_EQ(readImage8(folder.write("more.png", pngOf(4, 4, packedZeros(200)))).height, 4) << "a little more";
  const fs::path bomb = folder.write("bomb.png", pngOf(4, 4, packedZeros(1'000'000)));
  expectFileFault([&] { readImage8(bomb); }, bomb, "unpacks to more than its pixels");
  // An iPhone's header stands behind a chunk that others may fill as they like.
  const std::string bare = packedZeros(1'000'000).substr(2);
  const fs::path second = folder.write(
      "second.png", pngOf(4, 4, bare).insert(8, std::string("\0\0\0\4CgBI\x7f\xff\xff\xff\x7f\xff\xff\xff", 16)));
  expectFileFault([&] { readImage8(second); }, second, "is not a picture");
}

TEST(Png, HeadersOfAnySizeNameTheFile) {
  const TemporaryFolder folder;
  const std::vector<unsigned> sides{0, 5, INT32_MAX, UINT32_MAX};
  for (const unsigned width : sides) {
    for (const unsigned height : sides) {
      for (const char bits : {8, 127}) {
        for (const char color : {0, 2, 6, 127}) {
          std::string bytes = pngOf(width, height, packedZeros(1));
          bytes[24] = bits;
          bytes[25] = color;
          const fs::path file = folder.write("a.png", bytes);
          if (width != 5 || height != 5) {
            expectFileFault([&] { readImage8(file); }, file, "the picture ");
          }
        }
      }
    }
  }
}

// A PNG of two colors whose pixels also name others.
std::string pngBeyondItsPalette() {
  const std::string rows("\0\0\1\2\xff\0\1\0\3\0", 10);  // two of four pixels, each after its filter
  const std::string stored = std::string("\x78\1\1\x0a\0\xf5\xff", 7) + rows + "sums";
  std::string png = pngOf(4, 2, stored);
  png[25] = 3;
  return png.insert(33, std::string("\0\0\0\6PLTE\x10\x20\x30\x40\x50\x60sums", 18));
}

TEST(Png, ColorsBeyondThePaletteAreBlack) {
  const TemporaryFolder folder;
  const Image8 picture = readImage8(folder.write("a.png", pngBeyondItsPalette()));
  const auto color = [&](int x, int y) { return std::vector<int>(picture.at(x, y), picture.at(x, y) + 4); };
  EXPECT_EQ(color(1, 0), (std::vector{0x40, 0x50, 0x60, 255}));
  for (const auto& [x, y] : {std::pair(2, 0), std::pair(3, 0), std::pair(2, 1)}) {
    EXPECT_EQ(color(x, y), std::vector(4, 0)) << x << y;
  }
}

// Reads the picture or its error with memory that held other values before; returns whether it was read.
bool readsAlike(const fs::path& file) {
  std::array<std::string, 2> results;
  bool read = false;
  for (size_t i = 0; i < 2; ++i) {
    mallopt(M_PERTURB, i == 0 ? 1 : 254);
    try {
      const Image8 picture = readImage8(file);
      results[i].assign(picture.rgba.begin(), picture.rgba.end());
      read = true;
    } catch (const FileError& error) {
      results[i] = error.what();
    }
  }
  mallopt(M_PERTURB, 1);  // as all tests run
  EXPECT_TRUE(results[0] == results[1]);
  return read;
}

// Changes each byte of the headers of frame and scan.
TEST(DamagedPictures, ShowNoUnwrittenMemory) {
  const TemporaryFolder folder;
  const std::vector<uint8_t> jpeg = encodeJpeg(gradient(64, 48), 80);
  const std::string whole(jpeg.begin(), jpeg.end());
  int read = 0;
  for (const auto& [marker, size] : {std::pair("\xff\xc0", 19), std::pair("\xff\xda", 14)}) {
    const size_t header = whole.find(marker);
    ASSERT_NE(header, std::string::npos);
    for (size_t at = header + 1; at < header + static_cast<size_t>(size); ++at) {
      for (const int value : {0, 1, 2, 3, 0x11, 0x22, 0xc2, 0xff}) {
        std::string bytes = whole;
        bytes[at] = static_cast<char>(value);
        SCOPED_TRACE("byte " + std::to_string(at) + " is " + std::to_string(value));
        read += readsAlike(folder.write("damaged.jpg", bytes)) ? 1 : 0;
        bytes.resize(bytes.size() / 2);
        read += readsAlike(folder.write("damaged.jpg", bytes)) ? 1 : 0;
      }
    }
  }
  EXPECT_GT(read, 50);
}

}  // namespace
}  // namespace speculum
