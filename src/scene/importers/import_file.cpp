// Which importer reads which file.
#include <fmt/format.h>

#include <algorithm>
#include <assimp/Importer.hpp>
#include <cctype>

#include "scene/importers/gzip_file.h"
#include "scene/importers/importer.h"

namespace boxwood {
namespace {

std::string extension_of(const std::filesystem::path& file) {
  std::string extension = file.extension().string();
  if (is_gzip_name(file)) extension = file.stem().extension().string() + extension;
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension;
}

Import find_importer(const std::filesystem::path& file) {
  const std::string extension = extension_of(file);
  for (const Importer& importer : importers()) {
    const auto& known = importer.extensions;
    if (std::find(known.begin(), known.end(), extension) != known.end()) return importer.import;
  }
  if (!extension.empty() && Assimp::Importer().IsExtensionSupported(extension)) return import_with_assimp;
  throw Error(fmt::format("{}: '{}' is no mesh format known here; convert it to OBJ, PLY, glTF, GLB, STL, OFF or pbrt",
                          file.string(), extension));
}

}  // namespace

std::span<const Importer> importers() {
  static const std::vector<Importer> all = {{{".obj"}, import_obj},
                                            {{".ply", ".ply.gz"}, import_ply},
                                            {{".stl"}, import_stl},
                                            {{".pbrt", ".pbrt.gz"}, import_pbrt},
                                            {{".gltf", ".glb", ".off"}, import_with_assimp}};
  return all;
}

Imported import_file(const std::filesystem::path& file) {
  const auto fail = [&](std::string_view what) { throw Error(fmt::format("{}: {}", file.string(), what)); };
  std::error_code error;
  const auto status = std::filesystem::status(file, error);
  if (!std::filesystem::exists(status)) {
    fail("there is no such file; check the path, or write generate:NAME for a procedural scene");
  }
  if (std::filesystem::is_directory(status)) fail("is a folder; name the scene file in it");
  const Import import = find_importer(file);
  if (std::filesystem::is_regular_file(status) && std::filesystem::file_size(file, error) == 0) {
    fail("is empty; get it again");
  }
  return import(file);
}

}  // namespace boxwood
