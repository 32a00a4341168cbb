#include "transfer_times.h"

#include <fmt/format.h>

#include <vector>

#include "measure/statistics.h"
#include "picture_texture.h"
#include "window.h"

namespace boxwood::viewer {
namespace {

constexpr int repetitions = 200, warm_up = 10;

/// Different each time, so that nothing can be left out.
Image picture(int width, int height, int number) {
  Image image(static_cast<std::uint32_t>(width), static_cast<std::uint32_t>(height));
  for (std::size_t i = 0; i < image.pixels.size(); ++i) {
    const auto level = static_cast<float>((i + static_cast<std::size_t>(number) * 7) % 256) / 255;
    image.pixels[i] = {level, 1 - level, 0.5f};
  }
  return image;
}

}  // namespace

std::string transfer_times(int width, int height) {
  const Window window(width, height, "Boxwood - transfer times");
  PictureTexture texture;
  std::vector<double> upload, buffer;
  for (int i = 0; i < warm_up + repetitions; ++i) {
    const Image image = picture(width, height, i);
    const double by_upload = texture.upload(image, Transfer::texture_upload);
    const double by_buffer = texture.upload(image, Transfer::pixel_buffer);
    if (i < warm_up) continue;
    upload.push_back(by_upload);
    buffer.push_back(by_buffer);
  }
  const Estimate ratio = estimate_ratio(upload, buffer);
  return fmt::format(
      "a picture of {}x{} takes {:.3f} ms by texture upload and {:.3f} ms by pixel buffer: medians of {}, interleaved; "
      "ratio {:.2f} ({:.2f} to {:.2f})",
      width, height, median(upload), median(buffer), repetitions, ratio.median, ratio.low, ratio.high);
}

}  // namespace boxwood::viewer
