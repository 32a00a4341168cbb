// The one place that compiles stb_image.
#include "scene/texture_file.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <memory>

#include "scene/importers/repeated_note.h"
#include "scene/importers/text_file.h"

#define STB_IMAGE_IMPLEMENTATION
#define STB_IMAGE_STATIC
#define STBI_NO_STDIO
#define STBI_ONLY_PNG
#define STBI_ONLY_JPEG
#define STBI_ONLY_TGA
#define STBI_ONLY_BMP
#define STBI_FAILURE_USERMSG
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#include <stb/stb_image.h>
#pragma GCC diagnostic pop

namespace boxwood {
namespace {

constexpr std::int64_t most_pixels = std::int64_t{1} << 26;

}  // namespace

std::uint32_t add_texture(Scene& scene, const std::filesystem::path& file) {
  const std::string name = file.string();
  const auto number = std::ranges::find(scene.textures, name, &Texture::file) - scene.textures.begin();
  if (number == std::ssize(scene.textures)) scene.textures.push_back({name, 0, 0, {}});
  return static_cast<std::uint32_t>(number);
}

Texture decode_texture(std::span<const std::byte> bytes, const std::string& name) {
  const auto* data = reinterpret_cast<const stbi_uc*>(bytes.data());
  const int size = static_cast<int>(std::min<std::size_t>(bytes.size(), 0x7fffffff));
  int width = 0, height = 0, channels = 0;
  if (!stbi_info_from_memory(data, size, &width, &height, &channels)) {
    throw Error(fmt::format("{}: is no PNG, JPEG, TGA or BMP image that can be read; convert it", name));
  }
  if (std::int64_t{width} * height > most_pixels) {
    throw Error(fmt::format("{}: has {} x {} pixels, more than 2^26; make it smaller", name, width, height));
  }
  const std::unique_ptr<stbi_uc, void (*)(void*)> pixels(
      stbi_load_from_memory(data, size, &width, &height, &channels, STBI_rgb), stbi_image_free);
  if (!pixels) throw Error(fmt::format("{}: is damaged ({}); get it again", name, stbi_failure_reason()));
  Texture texture;
  texture.width = static_cast<std::uint32_t>(width);
  texture.height = static_cast<std::uint32_t>(height);
  texture.pixels.assign(pixels.get(), pixels.get() + std::size_t{3} * texture.width * texture.height);
  return texture;
}

void read_textures(Scene& scene) {
  std::vector<std::string> problems(scene.textures.size());
  tbb::parallel_for(std::size_t{0}, scene.textures.size(), [&](std::size_t i) {
    Texture& texture = scene.textures[i];
    if (texture.file.empty()) return;
    std::error_code ignored;
    if (!std::filesystem::is_regular_file(texture.file, ignored)) {
      problems[i] = fmt::format("{}: the texture is missing; the material's colour is used alone", texture.file);
      return;
    }
    try {
      const std::string bytes = read_whole_file(texture.file);
      Texture read = decode_texture(std::as_bytes(std::span(bytes)), texture.file);
      read.file = texture.file;
      texture = std::move(read);
    } catch (const Error& error) {
      problems[i] = error.what();
    }
  });
  RepeatedNote note;
  for (const std::string& problem : problems) {
    if (!problem.empty()) note.add([&] { return problem; });
  }
  note.report(scene.notes.messages);
}

}  // namespace boxwood
