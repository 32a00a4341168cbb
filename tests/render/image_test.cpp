#include "render/image.h"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>
#include <tinyexr.h>

#include <cstdlib>
#include <fstream>
#include <iterator>
#include <limits>

#include "boxwood/error.h"
#include "render/test_scenes.h"

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wunused-function"
#define STB_IMAGE_IMPLEMENTATION
#define STB_IMAGE_STATIC
#define STBI_ONLY_PNG
#include <stb/stb_image.h>
#pragma GCC diagnostic pop

namespace boxwood {
namespace {

using testing_scenes::ScratchFolder;

Image gradient(std::uint32_t width, std::uint32_t height) {
  Image image(width, height);
  for (std::uint32_t y = 0; y < height; ++y) {
    for (std::uint32_t x = 0; x < width; ++x) {
      image.at(x, y) = {static_cast<float>(x) / 7.0f, static_cast<float>(y) / 5.0f, -0.25f};
    }
  }
  return image;
}

std::string bytes_of(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

std::string error_of(const std::filesystem::path& file, const Image& image) {
  try {
    write_image(file, image);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(Image, PngReadsBackAsSrgb) {
  const ScratchFolder folder;
  Image image(4, 2);
  image.at(0, 0) = {0, 0.5f, 1};
  image.at(3, 0) = {-1, 7, std::numeric_limits<float>::quiet_NaN()};
  image.at(1, 1) = {0.001f, 0.2158605f, 0.0031308f};
  write_png(folder.file("a.png"), image);

  int width = 0, height = 0, channels = 0;
  unsigned char* rgb = stbi_load(folder.file("a.png").c_str(), &width, &height, &channels, 0);
  ASSERT_NE(rgb, nullptr);
  EXPECT_EQ(width, 4);
  EXPECT_EQ(height, 2);
  EXPECT_EQ(channels, 3);
  const auto pixel = [&](int x, int y) { return std::vector<int>(rgb + (y * 4 + x) * 3, rgb + (y * 4 + x) * 3 + 3); };
  EXPECT_EQ(pixel(0, 0), (std::vector<int>{0, 188, 255}));
  EXPECT_EQ(pixel(3, 0), (std::vector<int>{0, 255, 0}));
  EXPECT_EQ(pixel(1, 1), (std::vector<int>{3, 128, 10}));
  EXPECT_EQ(pixel(2, 1), (std::vector<int>{0, 0, 0}));
  stbi_image_free(rgb);
}

TEST(Image, ExrReadsBackToTheBit) {
  const ScratchFolder folder;
  const Image image = gradient(37, 23);
  write_exr(folder.file("a.exr"), image);

  float* rgba = nullptr;
  int width = 0, height = 0;
  const char* message = nullptr;
  ASSERT_EQ(LoadEXR(&rgba, &width, &height, folder.file("a.exr").c_str(), &message), TINYEXR_SUCCESS);
  Image loaded(static_cast<std::uint32_t>(width), static_cast<std::uint32_t>(height));
  for (std::size_t i = 0; i < loaded.pixels.size(); ++i)
    loaded.pixels[i] = {rgba[4 * i], rgba[4 * i + 1], rgba[4 * i + 2]};
  std::free(rgba);
  EXPECT_EQ(loaded, image);
}

TEST(Image, SamePictureGivesSameBytesAndNothingElseInTheFolder) {
  const ScratchFolder folder;
  for (const std::string extension : {".png", ".EXR"}) {
    write_image(folder.file("a" + extension), gradient(65, 9));
    write_image(folder.file("b" + extension), gradient(65, 9));
    write_image(folder.file("b" + extension), gradient(65, 9));  // replaces
    EXPECT_EQ(bytes_of(folder.file("a" + extension)), bytes_of(folder.file("b" + extension)));
  }
  EXPECT_EQ(folder.entries(), 4u);
}

TEST(Image, UnwritablePlaceIsNamed) {
  const ScratchFolder folder;
  const std::string missing = error_of(folder.file("no/such/folder/a.png"), gradient(2, 2));
  EXPECT_NE(missing.find("no/such/folder/a.png"), std::string::npos);
  EXPECT_NE(missing.find("No such file"), std::string::npos);
  std::filesystem::create_directory(folder.file("folder.png"));
  EXPECT_NE(error_of(folder.file("folder.png"), gradient(2, 2)).find("directory"), std::string::npos);
  EXPECT_EQ(folder.entries(), 1u);
}

TEST(Image, FullDiskKeepsTheOldFile) {
  const ScratchFolder folder;
  const auto file = folder.file("a.exr");
  write_image(file, gradient(8, 8));
  const std::string before = bytes_of(file);

  // A file size limit stands in for a full disk.
  rlimit old_limit;
  getrlimit(RLIMIT_FSIZE, &old_limit);
  const auto old_handler = signal(SIGXFSZ, SIG_IGN);
  rlimit limit = old_limit;
  limit.rlim_cur = 512;
  setrlimit(RLIMIT_FSIZE, &limit);
  const std::string message = error_of(file, gradient(300, 300));
  setrlimit(RLIMIT_FSIZE, &old_limit);
  signal(SIGXFSZ, old_handler);

  EXPECT_NE(message.find("a.exr"), std::string::npos);
  EXPECT_EQ(bytes_of(file), before);
  EXPECT_EQ(folder.entries(), 1u);
}

TEST(Image, UnknownExtensionAndEmptyImageAreRefused) {
  const ScratchFolder folder;
  EXPECT_THROW(write_image(folder.file("a.jpg"), gradient(2, 2)), UsageError);
  EXPECT_THROW(write_image(folder.file("a.png"), Image()), Error);
  EXPECT_EQ(folder.entries(), 0u);
}

}  // namespace
}  // namespace boxwood
