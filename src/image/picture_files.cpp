#include "image/picture_files.hpp"

#include <stb_image_write.h>

#include <algorithm>
#include <array>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>

#include "image/stb_decoder.hpp"
#include "platform/bytes.hpp"
#include "platform/files.hpp"
#include "platform/text.hpp"

namespace speculum {

namespace {

constexpr const char* completeFile = "a complete PNG or JPEG file is needed";

int64_t numberAt(const std::vector<uint8_t>& bytes, size_t at) {
  return bigEndian(std::span(bytes).subspan(at, 4));
}

enum class PictureFormat { png, jpeg, bmp, gif, psd, tga, unknown };

bool startsWith(const std::vector<uint8_t>& bytes, std::string_view magic, size_t at = 0) {
  return bytes.size() >= at + magic.size() &&
         std::equal(magic.begin(), magic.end(), bytes.begin() + static_cast<std::ptrdiff_t>(at),
                    [](char a, uint8_t b) { return static_cast<uint8_t>(a) == b; });
}

// Finds the format by the signature: stb would also read a PNG in the form of an iPhone, whose header comes second, and
// files without any signature as TGA, so that a TGA needs the extension.
PictureFormat formatOf(const std::filesystem::path& file, const std::vector<uint8_t>& bytes) {
  constexpr std::string_view png("\x89PNG\r\n\x1a\n\0\0\0\x0dIHDR", 16);
  constexpr std::array<std::pair<std::string_view, PictureFormat>, 5> signatures{{{png, PictureFormat::png},
                                                                                  {"\xff\xd8\xff", PictureFormat::jpeg},
                                                                                  {"BM", PictureFormat::bmp},
                                                                                  {"GIF8", PictureFormat::gif},
                                                                                  {"8BPS", PictureFormat::psd}}};
  const auto found = std::ranges::find_if(signatures, [&](const auto& one) { return startsWith(bytes, one.first); });
  return found != signatures.end()                        ? found->second
         : lowerCase(file.extension().string()) == ".tga" ? PictureFormat::tga
                                                          : PictureFormat::unknown;
}

[[noreturn]] void throwUnknown(const std::filesystem::path& file, const std::vector<uint8_t>& bytes) {
  struct Signature {
    std::string_view text;
    const char* format;
    size_t at = 0;
  };
  static constexpr std::array signatures{Signature{"WEBP", "a WebP file", 8},
                                         Signature{"II*", "a TIFF file"},
                                         Signature{{"MM\0*", 4}, "a TIFF file"},
                                         Signature{"DDS ", "a DDS file"},
                                         Signature{"\xabKTX", "a KTX file"},
                                         Signature{"v/1\x01", "an EXR file"},
                                         Signature{"#?R", "an HDR file"},
                                         Signature{"jP  ", "a JPEG 2000 file", 4},
                                         Signature{"\xff\x4f\xff\x51", "a JPEG 2000 file"},
                                         Signature{"JXL ", "a JPEG XL file", 4},
                                         Signature{"ftypavif", "an AVIF file", 4},
                                         Signature{"ftyphei", "a HEIC file", 4},
                                         Signature{"<svg", "an SVG file"},
                                         Signature{"<?xml", "an SVG or another XML file"},
                                         Signature{"version https://git-lfs", "a Git LFS pointer"}};
  const auto known = std::ranges::find_if(
      signatures, [&](const Signature& signature) { return startsWith(bytes, signature.text, signature.at); });
  const std::string format = known == signatures.end() ? "not a picture that can be read" : known->format;
  throw FileError(file, "is " + format, "a PNG or JPEG file is needed");
}

// Returns a byte; 0 behind the end.
int byteAt(const std::vector<uint8_t>& bytes, size_t at) {
  return at < bytes.size() ? bytes[at] : 0;
}

// Says whether a PSD is RGB of a depth that the decoder reads: of 8 bits, or of 16 that are not compressed.
bool isPlainPsd(const std::vector<uint8_t>& bytes) {
  constexpr int rgb = 3;
  size_t at = 26;  // of three sections, each after its size; then stands the compression
  for (int section = 0; section < 3 && at + 4 <= bytes.size(); ++section) {
    at += 4 + static_cast<size_t>(numberAt(bytes, at));
  }
  const int depth = byteAt(bytes, 23);
  return byteAt(bytes, 25) == rgb && (depth == 8 || (depth == 16 && byteAt(bytes, at + 1) == 0));
}

// Refuses valid files of kinds that the decoder calls damaged or reads wrongly.
void checkKind(const std::filesystem::path& file, const std::vector<uint8_t>& bytes, PictureFormat format) {
  constexpr int fromRight = 0x10;
  const bool bmp = format == PictureFormat::bmp && byteAt(bytes, 14) >= 40;  // older headers have no compression
  const int compression = bmp ? byteAt(bytes, 30) : 0;
  const bool indexed = format == PictureFormat::tga && byteAt(bytes, 1) == 1;
  constexpr std::array headers = {12, 40, 56, 108, 124};  // sizes of a BMP's, as far as the decoder reads them
  const char* kind = format == PictureFormat::bmp && (std::ranges::find(headers, byteAt(bytes, 14)) == headers.end() ||
                                                      (byteAt(bytes, 14) == 56 && compression == 3))
                         ? "a BMP file with an unusual header"
                     : indexed && (byteAt(bytes, 3) | byteAt(bytes, 4)) != 0
                         ? "a TGA file whose palette does not begin at 0"
                     : compression != 0 && compression != 3                  ? "a compressed BMP file"
                     : format == PictureFormat::psd && byteAt(bytes, 5) == 2 ? "a PSB file"
                     : format == PictureFormat::psd && bytes.size() > 26 && !isPlainPsd(bytes)
                         ? "a PSD file that is not RGB of 8 bits a channel"
                     : format == PictureFormat::tga && (byteAt(bytes, 17) & fromRight) != 0
                         ? "a TGA file whose rows begin at the right"
                         : nullptr;
  if (kind != nullptr) {
    throw FileError(file, std::string("is ") + kind, "a PNG or JPEG file is needed");
  }
}

// Says whether a decoded picture has an alpha channel. The decoder counts four channels of every GIF and PSD, of BMPs
// with an unused byte in each pixel, and of TGAs whose header says that the bits beside the colors are no alpha.
bool hasAlpha(const std::vector<uint8_t>& bytes, PictureFormat format, int channels, const Image8& image) {
  if (format == PictureFormat::bmp || format == PictureFormat::gif) {
    for (size_t i = 3; i < image.rgba.size(); i += 4) {
      if (image.rgba[i] != 255) {
        return true;
      }
    }
    return false;
  }
  const bool ofPalette = byteAt(bytes, 1) == 1;
  return format == PictureFormat::psd   ? byteAt(bytes, 13) > 3
         : format == PictureFormat::tga ? channels % 2 == 0 && (ofPalette || (byteAt(bytes, 17) & 0x0f) != 0)
                                        : channels % 2 == 0;
}

// Says whether the pixels of a TGA have 15 bits of color and one of alpha, which the decoder drops.
bool hasAlphaBit(const std::vector<uint8_t>& bytes) {
  return (byteAt(bytes, 2) & 7) == 2 && byteAt(bytes, 16) == 16 && (byteAt(bytes, 17) & 0x0f) != 0;
}

// Returns such a TGA with pixels that are white where they are opaque, and otherwise black.
std::vector<uint8_t> maskOfAlphaBits(std::vector<uint8_t> bytes) {
  const bool runs = byteAt(bytes, 2) == 10;
  for (size_t at = 18 + bytes[0]; at + 1 < bytes.size();) {
    const int head = runs ? bytes[at++] : 0;
    for (int left = head < 128 ? head + 1 : 1; left > 0 && at + 1 < bytes.size(); --left, at += 2) {
      bytes[at] = bytes[at + 1] = bytes[at + 1] < 128 ? 0 : 255;
    }
  }
  return bytes;
}

// Content of a JPEG's markers.
struct JpegMarkers {
  int64_t scans = 0;
  bool quantized = false;  // there are quantisation tables
  int components = 0;
  bool adobe = false;  // there is Adobe's marker, and it says CMYK or YCCK
};

JpegMarkers markersOf(const std::vector<uint8_t>& bytes) {
  constexpr std::string_view adobe("Adobe\0", 6);
  JpegMarkers found;
  for (size_t at = 2; at + 4 <= bytes.size();) {
    const uint8_t marker = bytes[at] == 0xff ? bytes[at + 1] : uint8_t{0};
    if (marker == 0xd9) {
      break;
    }
    const bool hasLength = marker > 1 && marker != 0xff && (marker < 0xd0 || marker > 0xd7);
    const bool beginsFrame = marker >= 0xc0 && marker <= 0xc2;
    found.scans += marker == 0xda ? 1 : 0;
    found.quantized = found.quantized || marker == 0xdb;
    found.components = beginsFrame && at + 9 < bytes.size() ? bytes[at + 9] : found.components;
    found.adobe = found.adobe || (marker == 0xee && at + 16 <= bytes.size() &&
                                  std::equal(adobe.begin(), adobe.end(), &bytes[at + 4]) &&
                                  (bytes[at + 15] == 0 || bytes[at + 15] == 2));
    at += hasLength ? 2 + size_t{bytes[at + 2]} * 256 + bytes[at + 3] : 1;
  }
  return found;
}

[[noreturn]] void throwDamaged(const std::filesystem::path& file, const std::string& reason) {
  throw FileError(file, "the picture is damaged: " + reason, completeFile);
}

// Returns width and height. Those of a PNG are read here, because the decoder does not say that a picture is too large.
std::pair<int64_t, int64_t> sizeOf(const std::filesystem::path& file, const std::vector<uint8_t>& bytes,
                                   PictureFormat format) {
  if (format == PictureFormat::png && bytes.size() >= 24) {
    return {numberAt(bytes, 16), numberAt(bytes, 20)};
  }
  int width = 0;
  int height = 0;
  if (!readPictureSize(bytes, width, height)) {
    throwDamaged(file, decodeFailure());
  }
  return {width, height};
}

// Checks sizes before decoding, because a small file can claim any size. Each scan of a JPEG, which may be as short
// as 14 bytes, goes through all pixels.
void checkHeader(const std::filesystem::path& file, const std::vector<uint8_t>& bytes, PictureFormat format) {
  constexpr int64_t most = int64_t{1} << 26;
  constexpr int64_t mostInScans = int64_t{1} << 30;
  const auto [width, height] = sizeOf(file, bytes, format);
  const std::string size = std::to_string(width) + "x" + std::to_string(height) + " pixels";
  if (std::max(width, height) > most || width * height > most) {
    throw FileError(file, "the picture has " + size, "at most 2^26, such as 8192x8192, are read");
  }
  if (format != PictureFormat::jpeg) {
    return;
  }
  const int64_t pixels = width * height;
  const JpegMarkers jpeg = markersOf(bytes);
  if (jpeg.scans == 0 || !jpeg.quantized) {
    throwDamaged(file, jpeg.scans == 0 ? "there is no scan" : "there is no quantisation table");
  }
  if (jpeg.scans * pixels > mostInScans) {
    throw FileError(file, "the picture has " + std::to_string(jpeg.scans) + " scans of " + size,
                    "at most 2^30 pixels in all scans are read");
  }
  // The decoder would take the first three channels for YCbCr and drop the fourth.
  if (jpeg.components == 4 && !jpeg.adobe) {
    throw FileError(file, "the picture has four channels, but no Adobe marker that says which colors they are",
                    "save it in RGB");
  }
}

// Returns the most bytes that a PNG of this header unpacks to: rows of either kind of interlacing, each after its
// filter.
int64_t largestUnpacked(int64_t width, int64_t height, int64_t bitsPerPixel) {
  return (width * bitsPerPixel + 7) / 8 * height + 4 * height + 64;
}

// The decoder allocates as much as a chunk claims to have, and unpacks all that the compressed data hold, however much
// more than the pixels need. Such files are unpacked once before, into no more than is needed.
void checkPngChunks(const std::filesystem::path& file, const std::vector<uint8_t>& bytes) {
  constexpr size_t signature = 8;
  constexpr int64_t mostPerByte = 1032;  // bytes that deflate unpacks from one
  constexpr int64_t harmless = int64_t{1} << 28;
  constexpr std::array<int64_t, 7> channelsOf{1, 0, 3, 1, 2, 0, 4};  // by color type
  if (bytes.size() < signature + 25) {
    return;
  }
  const size_t header = signature + 8;
  const int64_t channels = bytes[header + 9] < channelsOf.size() ? channelsOf[bytes[header + 9]] : 0;
  // Some files hold a little more than they need.
  const int64_t most = (int64_t{1} << 26) + largestUnpacked(numberAt(bytes, header), numberAt(bytes, header + 4),
                                                            channels * bytes[header + 8]);
  std::vector<char> packed;
  for (size_t at = signature; at + 8 <= bytes.size();) {
    const auto size = static_cast<size_t>(numberAt(bytes, at));
    const std::string_view kind(reinterpret_cast<const char*>(&bytes[at + 4]), 4);
    if (kind == "IEND") {
      break;
    }
    if (size + 12 > bytes.size() - at) {
      throwDamaged(file, "a chunk ends beyond the file");
    }
    if (kind == "IDAT") {
      packed.insert(packed.end(), &bytes[at + 8], &bytes[at + 8] + size);
    }
    at += size + 12;
  }
  if (static_cast<int64_t>(packed.size()) * mostPerByte <= most + harmless || most > INT32_MAX) {
    return;
  }
  std::vector<char> unpacked(static_cast<size_t>(most));
  if (unpackZlib(packed, unpacked) < 0) {
    throw FileError(file, "the picture is damaged, or unpacks to more than its pixels", completeFile);
  }
}

Image8 decoded(const std::filesystem::path& file, const std::vector<uint8_t>& bytes, PictureFormat format) {
  checkKind(file, bytes, format);
  checkHeader(file, bytes, format);
  if (format == PictureFormat::png) {
    checkPngChunks(file, bytes);
  }
  int width = 0;
  int height = 0;
  int channels = 0;
  const auto decode = [&](const std::vector<uint8_t>& content) {
    auto pixels = decodePicture(content, width, height, channels);
    if (!pixels) {
      throwDamaged(file, decodeFailure());
    }
    return pixels;
  };
  const auto pixels = decode(bytes);
  Image8 image(width, height);
  std::copy_n(pixels.get(), image.rgba.size(), image.rgba.begin());
  image.hasAlpha = hasAlpha(bytes, format, channels, image);
  for (size_t i = 3; format == PictureFormat::tga && !image.hasAlpha && i < image.rgba.size(); i += 4) {
    image.rgba[i] = 255;
  }
  if (format == PictureFormat::tga && hasAlphaBit(bytes)) {
    const auto mask = decode(maskOfAlphaBits(bytes));
    for (size_t i = 3; i < image.rgba.size(); i += 4) {
      image.rgba[i] = mask.get()[i - 1];
    }
    image.hasAlpha = true;
  }
  return image;
}

void appendBytes(void* context, void* data, int size) {
  auto& bytes = *static_cast<std::vector<uint8_t>*>(context);
  const auto* first = static_cast<const uint8_t*>(data);
  bytes.insert(bytes.end(), first, first + size);
}

}  // namespace

Image8 readImage8(const std::filesystem::path& file) {
  const std::vector<uint8_t> bytes = readFile(file);
  const PictureFormat format = formatOf(file, bytes);
  if (format != PictureFormat::png && format != PictureFormat::jpeg) {
    throw FileError(file, "is not a picture that can be read", "a PNG or JPEG file is needed");
  }
  return decoded(file, bytes, format);
}

Image8 readTexture(const std::filesystem::path& file) {
  return readTexture(file, readFile(file));
}

Image8 readTexture(const std::filesystem::path& name, const std::vector<uint8_t>& bytes) {
  const PictureFormat format = formatOf(name, bytes);
  if (format == PictureFormat::unknown) {
    throwUnknown(name, bytes);
  }
  return decoded(name, bytes, format);
}

void writePng(const std::filesystem::path& file, const Image8& image) {
  if (image.width < 1 || image.height < 1) {
    throw FileError(file, "the picture has no pixels", "width and height of 1 or more are needed");
  }
  [[maybe_unused]] static const int level = stbi_write_png_compression_level = 9;
  std::vector<uint8_t> bytes;
  if (!stbi_write_png_to_func(&appendBytes, &bytes, image.width, image.height, 4, image.rgba.data(), image.width * 4)) {
    throw FileError(file, "cannot be encoded as PNG", "is there memory left?");
  }
  replaceFile(file, bytes);
}

std::vector<uint8_t> encodeJpeg(const Image8& image, int quality) {
  constexpr int largestSide = 65535;  // the format counts in 16 bits
  if (image.width < 1 || image.height < 1 || image.width > largestSide || image.height > largestSide) {
    throw std::runtime_error("a picture of " + std::to_string(image.width) + "x" + std::to_string(image.height) +
                             " cannot be a JPEG (1 to 65535 pixels in either direction can)");
  }
  if (quality < 1 || quality > 100) {
    throw std::runtime_error("JPEG quality " + std::to_string(quality) + " is out of range (1 .. 100)");
  }
  std::vector<uint8_t> bytes;
  if (!stbi_write_jpg_to_func(&appendBytes, &bytes, image.width, image.height, 4, image.rgba.data(), quality)) {
    throw std::runtime_error("a picture of " + std::to_string(image.width) + "x" + std::to_string(image.height) +
                             " could not be encoded as JPEG (is there memory left?)");
  }
  return bytes;
}

}  // namespace speculum
