#pragma once
#include <span>
#include <string>
#include <string_view>

#include "recipe/stage.h"
#include "scene/generators.h"
#include "scene/scene_sources.h"

namespace boxwood {

/// "builder", "refinement", "layout", "trace" or "peer".
std::string_view stage_kind_name(StageKind kind);

/// All stages with their options, and the presets, for a terminal.
std::string recipes_text(std::span<const Stage> stages, std::span<const Preset> presets);
/// The same as the page docs/recipes.md.
std::string recipes_markdown(std::span<const Stage> stages, std::span<const Preset> presets);

/// What can be generated with which options, and what packages bring scenes.
std::string scenes_text(std::span<const Generator> generators, std::span<const SceneSource> sources);

}  // namespace boxwood
