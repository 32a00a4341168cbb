#pragma once
#include <cstdint>

#include "boxwood/scene.h"

namespace boxwood {

/// About `triangles` of the scene's unique triangles, picked at random and enlarged about their centres so that every
/// mesh keeps its area: what rays meet stays about as dense as it was. Stochastic simplification after Cook, Halstead,
/// Planck, Ryu 2007. Instances, materials and cameras stay. The same for the same seed; O(n).
Scene thin_scene(const Scene& scene, std::uint64_t triangles, std::uint64_t seed = 1);

}  // namespace boxwood
