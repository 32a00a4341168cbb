#include "render/image.h"

#include <fmt/format.h>
#include <tinyexr.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <memory>
#include <span>
#include <string>

#include "boxwood/error.h"
#include "files/output_file.h"
#include "render/png.h"

namespace boxwood {
namespace {

// The encoders count bytes in int; 16 bytes a pixel leave them room.
void check_size(const std::filesystem::path& file, const Image& image) {
  const std::uint64_t pixels = std::uint64_t{image.width} * image.height;
  if (pixels == 0 || pixels != image.pixels.size() || pixels > std::numeric_limits<int>::max() / 16) {
    throw Error(fmt::format(
        "cannot write '{}': an image of {}x{} with {} pixels can not be encoded; use 1 to {} pixels", file.string(),
        image.width, image.height, image.pixels.size(), std::numeric_limits<int>::max() / 16));
  }
}

void write_bytes(const std::filesystem::path& file, std::span<const unsigned char> bytes) {
  OutputFile out(file);
  out.write(std::as_bytes(bytes));
  out.commit();
}

std::string lower_extension(const std::filesystem::path& file) {
  std::string extension = file.extension().string();
  std::ranges::transform(extension, extension.begin(), [](unsigned char c) { return std::tolower(c); });
  return extension;
}

/// Transfer function of IEC 61966-2-1, to 8 bits.
unsigned char srgb(float linear) {
  if (!(linear > 0)) return 0;
  if (linear >= 1) return 255;
  const double value = linear;
  const double encoded = value <= 0.0031308 ? 12.92 * value : 1.055 * std::pow(value, 1 / 2.4) - 0.055;
  return static_cast<unsigned char>(std::lround(255 * encoded));
}

}  // namespace

std::vector<unsigned char> srgb_bytes(const Image& image) {
  std::vector<unsigned char> rgb;
  rgb.reserve(image.pixels.size() * 3);
  for (const Vec3& pixel : image.pixels) {
    for (const float channel : {pixel.x, pixel.y, pixel.z}) rgb.push_back(srgb(channel));
  }
  return rgb;
}

std::vector<unsigned char> encode_png(const Image& image) {
  return encode_png(srgb_bytes(image), image.width, image.height);
}

void write_png(const std::filesystem::path& file, const Image& image) {
  check_size(file, image);
  write_bytes(file, encode_png(image));
}

void write_exr(const std::filesystem::path& file, const Image& image) {
  check_size(file, image);
  // EXR keeps each channel apart, in alphabetical order.
  constexpr int channel_count = 3;
  constexpr std::size_t axis_of[channel_count] = {2, 1, 0};
  constexpr char name_of[channel_count] = {'B', 'G', 'R'};
  std::vector<float> planes[channel_count];
  unsigned char* plane_pointers[channel_count];
  EXRChannelInfo channels[channel_count] = {};
  int types[channel_count];
  for (int channel = 0; channel < channel_count; ++channel) {
    for (const Vec3& pixel : image.pixels) planes[channel].push_back(pixel[axis_of[channel]]);
    plane_pointers[channel] = reinterpret_cast<unsigned char*>(planes[channel].data());
    channels[channel].name[0] = name_of[channel];
    types[channel] = TINYEXR_PIXELTYPE_FLOAT;
  }

  EXRHeader header;
  InitEXRHeader(&header);
  header.num_channels = channel_count;
  header.channels = channels;
  header.pixel_types = types;
  header.requested_pixel_types = types;
  header.compression_type = TINYEXR_COMPRESSIONTYPE_ZIP;
  EXRImage exr;
  InitEXRImage(&exr);
  exr.num_channels = channel_count;
  exr.images = plane_pointers;
  exr.width = static_cast<int>(image.width);
  exr.height = static_cast<int>(image.height);

  unsigned char* memory = nullptr;
  const char* message = nullptr;
  const std::size_t size = SaveEXRImageToMemory(&exr, &header, &memory, &message);
  const std::unique_ptr<unsigned char, decltype(&std::free)> owner(memory, &std::free);
  if (size == 0) {
    const std::string cause = message ? message : "the encoder failed";
    FreeEXRErrorMessage(message);
    throw Error(fmt::format("cannot write '{}': {}", file.string(), cause));
  }
  write_bytes(file, {memory, size});
}

bool keeps_radiance(const std::filesystem::path& file) { return lower_extension(file) == ".exr"; }

void write_image(const std::filesystem::path& file, const Image& image) {
  if (keeps_radiance(file)) return write_exr(file, image);
  if (lower_extension(file) == ".png") return write_png(file, image);
  throw UsageError(
      fmt::format("'{}' does not end in .png or .exr, the image formats that can be written", file.string()));
}

}  // namespace boxwood
