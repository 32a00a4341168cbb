#pragma once
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "boxwood/scene.h"
#include "study/study.h"

namespace boxwood {

/// A scene of a study, loaded, and from where it is looked at.
struct StudyScene {
  std::string name;
  std::string source;     ///< the entry of `find` that was used
  bool stand_in = false;  ///< not the first entry
  std::uint64_t hash = 0;
  Scene scene;
  std::vector<Camera> views;
};

/// Loads the first entry of `find` that is there: a generator, an absolute file, or a file below one of `folders`.
/// Throws Error naming all that was tried; UsageError when a camera that the study names does not exist.
StudyScene find_scene(const SceneSpec& spec, std::span<const std::filesystem::path> folders, std::uint32_t frames);

/// How many views find_scene() will give, known before loading.
std::size_t view_count(const SceneSpec& spec, std::uint32_t frames);

}  // namespace boxwood
