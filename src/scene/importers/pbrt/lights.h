#pragma once
#include <optional>
#include <string>

#include "boxwood/scene.h"
#include "scene/importers/pbrt/colors.h"

namespace boxwood::pbrt {

/// A LightSource directive; nothing, with a note, for a type that is not known.
std::optional<Light> make_light(const std::string& type, const Parameters& parameters, const Transform& to_world,
                                Colors& colors, Notes& notes);

}  // namespace boxwood::pbrt
