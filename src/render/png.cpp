// The one place that compiles stb_image_write.
#include "render/png.h"

#include "boxwood/error.h"

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wunused-function"
#pragma GCC diagnostic ignored "-Wmissing-field-initializers"
#define STB_IMAGE_WRITE_IMPLEMENTATION
#define STB_IMAGE_WRITE_STATIC
#define STBI_WRITE_NO_STDIO
#include <stb/stb_image_write.h>
#pragma GCC diagnostic pop

namespace boxwood {

std::vector<unsigned char> encode_png(std::span<const unsigned char> rgb, std::uint32_t width, std::uint32_t height) {
  std::vector<unsigned char> bytes;
  const auto append = [](void* context, void* data, int size) {
    const auto* begin = static_cast<const unsigned char*>(data);
    static_cast<std::vector<unsigned char>*>(context)->insert(static_cast<std::vector<unsigned char>*>(context)->end(),
                                                              begin, begin + size);
  };
  const int w = static_cast<int>(width), h = static_cast<int>(height);
  if (!stbi_write_png_to_func(append, &bytes, w, h, 3, rgb.data(), w * 3)) {
    throw Error("out of memory while encoding a PNG image");
  }
  return bytes;
}

}  // namespace boxwood
