#pragma once
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "boxwood/scene.h"

namespace boxwood {

/// What an importer makes of a file: meshes and placements as the file has them, nothing merged or counted yet.
struct Imported {
  Scene scene;
  /// Every file that was read or looked for, the scene's own first.
  std::vector<std::filesystem::path> files;
};

/// Reads one file that exists. Throws Error naming the file, the place and the cure.
using Import = Imported (*)(const std::filesystem::path& file);

struct Importer {
  std::vector<std::string> extensions;  ///< lower case, with the dot
  Import import;
};

/// Our own readers first, then Assimp's for everything else that it knows.
std::span<const Importer> importers();

/// Picks the importer by extension and runs it. Throws Error for a missing file, a folder, an unknown extension.
Imported import_file(const std::filesystem::path& file);

// Polygons are triangulated, faces with less than three corners or with indices out of range are left out with a note;
// degenerate triangles and the order of the file are kept.
Imported import_obj(const std::filesystem::path& file);   ///< Wavefront OBJ with its MTL
Imported import_ply(const std::filesystem::path& file);   ///< ASCII, binary little and big endian; also gzipped
Imported import_stl(const std::filesystem::path& file);   ///< ASCII and binary
Imported import_pbrt(const std::filesystem::path& file);  ///< pbrt versions 3 and 4, see docs/pbrt.md
Imported import_with_assimp(const std::filesystem::path& file);

/// The mesh of a PLY file, which may be compressed by gzip (.ply.gz); what was left out is said in `messages`.
Mesh read_ply(const std::filesystem::path& file, std::vector<std::string>& messages);

/// Materials of an MTL file, in its order; their textures are added to the scene. Throws Error naming the line.
std::vector<Material> read_mtl(const std::filesystem::path& file, Scene& scene);

}  // namespace boxwood
