#include "image/stb_decoder.hpp"

#include <cstdlib>
#include <string_view>

// The distribution's build of stb takes memory as it is, so that damaged pictures show what the memory held before.
// Here the memory that stb allocates is zero at first, and an option of the compiler sets its palette (CMakeLists.txt).
#define STBI_MALLOC(size) std::calloc(1, size)
#define STBI_REALLOC(memory, size) std::realloc(memory, size)
#define STBI_FREE(memory) std::free(memory)
#define STBI_NO_HDR
#define STBI_NO_PIC
#define STBI_NO_PNM
#define STBI_NO_STDIO
#define STBI_MAX_DIMENSIONS (1 << 26)
#define STB_IMAGE_STATIC
#define STB_IMAGE_IMPLEMENTATION
#include <stb_image.h>

namespace speculum {

std::unique_ptr<uint8_t, void (*)(void*)> decodePicture(std::span<const uint8_t> bytes, int& width, int& height,
                                                        int& channels) {
  return {stbi_load_from_memory(bytes.data(), static_cast<int>(bytes.size()), &width, &height, &channels, 4),
          &stbi_image_free};
}

bool readPictureSize(std::span<const uint8_t> bytes, int& width, int& height) {
  int channels = 0;
  return stbi_info_from_memory(bytes.data(), static_cast<int>(bytes.size()), &width, &height, &channels) != 0;
}

const char* decodeFailure() {
  // Some failures set no reason. Then the text is empty or left over from the tests whether the file is a PNG.
  const char* reason = stbi_failure_reason();
  const std::string_view text = reason != nullptr ? reason : "";
  return text.empty() || text == "bad png sig" || text == "unknown image type" ? "it is incomplete" : reason;
}

int unpackZlib(std::span<const char> packed, std::span<char> unpacked) {
  return stbi_zlib_decode_buffer(unpacked.data(), static_cast<int>(unpacked.size()), packed.data(),
                                 static_cast<int>(packed.size()));
}

}  // namespace speculum
