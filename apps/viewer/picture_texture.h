#pragma once
#include <cstdint>

#include "render/image.h"

namespace boxwood::viewer {

/// How a picture gets to the graphics card: handed over in one call, or written into a buffer that the driver owns.
enum class Transfer { texture_upload, pixel_buffer };

/// A picture on the screen.
class PictureTexture {
 public:
  PictureTexture();
  ~PictureTexture();
  PictureTexture(const PictureTexture&) = delete;
  PictureTexture& operator=(const PictureTexture&) = delete;

  /// Returns the milliseconds the transfer took, until OpenGL had finished; turning the picture into bytes is not in
  /// it.
  double upload(const Image& image, Transfer transfer);
  unsigned id() const { return texture_; }
  std::uint32_t width() const { return width_; }
  std::uint32_t height() const { return height_; }

 private:
  unsigned texture_ = 0, buffer_ = 0;
  std::uint32_t width_ = 0, height_ = 0;
};

}  // namespace boxwood::viewer
