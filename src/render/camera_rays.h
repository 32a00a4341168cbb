#pragma once
#include <cstdint>
#include <vector>

#include "boxwood/ray.h"
#include "boxwood/scene.h"

namespace boxwood {

/// Primary rays of a pinhole camera. Unit directions, t from 0 to infinity.
class CameraRays {
 public:
  /// `samples` rays per pixel. One goes through the pixel's centre; more are spread over the pixel by an R2 sequence
  /// (Roberts 2018), shifted at random in every pixel, which keeps any number of them evenly apart. An up vector that
  /// is zero or parallel to the direction is replaced by the coordinate axis least parallel to it. Throws UsageError on
  /// a direction or eye that is zero (direction only) or not finite, a fov outside (0, 180) degrees, an image without
  /// pixels or with more than 2^31, or no samples.
  CameraRays(const Camera& camera, std::uint32_t width, std::uint32_t height, std::uint32_t samples,
             std::uint64_t seed);

  /// Pixel (0, 0) is top left; `sample` < samples.
  Ray ray(std::uint32_t x, std::uint32_t y, std::uint32_t sample) const;
  /// `pixel` = y * width + x.
  Ray ray(std::uint32_t pixel, std::uint32_t sample) const { return ray(pixel % width_, pixel / width_, sample); }

 private:
  std::uint32_t width_, height_, samples_;
  std::uint64_t seed_;
  Vec3 eye_, forward_, right_, up_;  // right_ and up_ reach from the centre to the edge of the image plane
};

/// Pixel numbers y * width + x of an image, in 8x8 tiles, row by row: neighbours in the list are neighbours in the
/// image.
std::vector<std::uint32_t> pixels_in_tiles(std::uint32_t width, std::uint32_t height);

/// One pixel of each block of block x block pixels, picked at random; likewise in tiles, of blocks. 1: every pixel.
std::vector<std::uint32_t> pixels_in_blocks(std::uint32_t width, std::uint32_t height, std::uint32_t block,
                                            std::uint64_t seed);

}  // namespace boxwood
