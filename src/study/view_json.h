#pragma once
#include <string>

#include "boxwood/scene.h"
#include "study/study.h"

namespace boxwood {

/// What the study says of how a view's rays are made, as the store keeps it with the camera; of settings that have
/// their defaults nothing. Figures of other settings are not this study's.
std::string ray_settings_json(const RunSpec& run, const SceneSpec& scene);

/// The camera as the store keeps it, with `ray_settings`.
std::string view_json(const Camera& camera, const std::string& ray_settings);

/// Whether a stored view was made with `ray_settings`.
bool has_ray_settings(const std::string& view, const std::string& ray_settings);

}  // namespace boxwood
