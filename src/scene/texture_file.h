#pragma once
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>

#include "boxwood/scene.h"

namespace boxwood {

/// The number of the texture read from `file`, which is added unless the scene has it already. Its pixels come later.
std::uint32_t add_texture(Scene& scene, const std::filesystem::path& file);

/// A PNG, JPEG, TGA or BMP image in memory. Throws Error that begins with `name` when it is none, or has more than
/// 2^26 pixels.
Texture decode_texture(std::span<const std::byte> bytes, const std::string& name);

/// Reads the pixels of every texture that has none, in parallel. What is missing or no image is said in one note, and
/// the colour alone counts.
void read_textures(Scene& scene);

}  // namespace boxwood
