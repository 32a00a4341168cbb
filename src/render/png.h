#pragma once
#include <cstdint>
#include <span>
#include <vector>

namespace boxwood {

/// PNG bytes of an 8-bit RGB picture, row-major, top row first; rgb.size() == width * height * 3. Throws Error when
/// memory runs out.
std::vector<unsigned char> encode_png(std::span<const unsigned char> rgb, std::uint32_t width, std::uint32_t height);

struct Image;

/// PNG bytes of an image: 8-bit sRGB, as write_png() writes it.
std::vector<unsigned char> encode_png(const Image& image);

}  // namespace boxwood
