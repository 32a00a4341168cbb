#pragma once
#include <span>
#include <vector>

#include "boxwood/scene.h"
#include "cost/known_use.h"

namespace boxwood {

/// An expected use as the builder of one level sees it.
///
/// Of a mesh: rays are mapped into its space through every instance of it whose world box they meet (`boxes` by
/// instance; t stays what it was), cameras through every instance, and triangles seen in any instance are seen. Of many
/// instances so many rays may come that only every n-th is kept, so that a mesh has at most 4 million. O(instances *
/// rays), in parallel.
KnownUse use_of_mesh(const ExpectedUse& use, const Scene& scene, std::uint32_t mesh, std::span<const Box> boxes);

/// Of the level above, whose primitives are the instances.
KnownUse use_of_instances(const ExpectedUse& use, const Scene& scene);

}  // namespace boxwood
