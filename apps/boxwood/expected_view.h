#pragma once
#include <optional>
#include <span>
#include <vector>

#include "boxwood/expected_use.h"
#include "boxwood/ray_set.h"
#include "boxwood/recipe.h"
#include "boxwood/scene.h"
#include "shared_options.h"

namespace boxwood::cli {

/// What will be traced when the scene is looked at as `view` says: primary, shadow, ao and diffuse rays; one pixel of
/// each block starts some. What is seen is found with all pixels.
ExpectedUse expected_view(const Scene& scene, const ViewOptions& view, unsigned threads);
/// Likewise by a camera of the caller's.
ExpectedUse expected_view(const Scene& scene, const Camera& camera, const ViewOptions& view, unsigned threads);
/// For recipes that want to know; nothing when none of `recipes` does.
std::optional<ExpectedUse> expected_view(const Scene& scene, std::span<const Recipe> recipes, const ViewOptions& view,
                                         unsigned threads);

/// Likewise of rays that are there already: as large a part of them stands for all.
ExpectedUse expected_rays(const Scene& scene, std::span<const RaySet> ray_sets, const ViewOptions& view,
                          unsigned threads);

/// For BuildOptions::use.
inline const ExpectedUse* pointer_to(const std::optional<ExpectedUse>& use) { return use ? &*use : nullptr; }

}  // namespace boxwood::cli
