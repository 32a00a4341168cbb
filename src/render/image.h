#pragma once
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <vector>

#include "boxwood/vec3.h"

namespace boxwood {

/// Linear RGB picture, row-major, top row first. pixels.size() == width * height.
struct Image {
  std::uint32_t width = 0, height = 0;
  std::vector<Vec3> pixels;

  Image() = default;
  Image(std::uint32_t w, std::uint32_t h) : width(w), height(h), pixels(std::size_t{w} * h) {}
  Vec3& at(std::uint32_t x, std::uint32_t y) { return pixels[std::size_t{y} * width + x]; }
  const Vec3& at(std::uint32_t x, std::uint32_t y) const { return pixels[std::size_t{y} * width + x]; }
  friend bool operator==(const Image&, const Image&) = default;
};

/// 8-bit sRGB, three bytes a pixel, values clamped to [0, 1], NaN black.
std::vector<unsigned char> srgb_bytes(const Image& image);
/// 8-bit sRGB, values clamped to [0, 1], NaN black. The same image gives the same bytes. The file appears only once it
/// is complete. Throws Error naming the file and the cause.
void write_png(const std::filesystem::path& file, const Image& image);
/// 32-bit float scan lines, as they are. Otherwise like write_png.
void write_exr(const std::filesystem::path& file, const Image& image);
/// Whether a file of that name holds linear values of any size (.exr) or 8-bit ones (.png).
bool keeps_radiance(const std::filesystem::path& file);
/// By extension, .png or .exr in any case; throws UsageError on another one.
void write_image(const std::filesystem::path& file, const Image& image);

}  // namespace boxwood
