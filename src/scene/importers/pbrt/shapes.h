#pragma once
#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include "boxwood/scene.h"
#include "scene/importers/pbrt/notes.h"
#include "scene/importers/pbrt/parameters.h"

namespace boxwood::pbrt {

/// Where a file named in a scene is; nothing, with a note, when it is missing.
using FindFile = std::function<std::optional<std::filesystem::path>(const std::string& name, const Parameters&)>;

/// The triangles of a Shape directive in object space; nothing, with a note, for a shape that is not known or whose
/// file is missing. Curved ones are cut into triangles. Normals are kept, texture coordinates are not. Throws Error
/// with file and line on parameters that make no sense.
std::optional<Mesh> make_shape(const std::string& type, const Parameters& parameters, const FindFile& find_file,
                               Notes& notes);

}  // namespace boxwood::pbrt
