#pragma once
#include <cstdint>
#include <span>

#include "boxwood/scene.h"

namespace boxwood {

/// One world-space mesh of the triangles of some instances, in the order given; each keeps its vertex order, also under
/// mirroring transforms. Attributes that only some meshes have are filled up with zeros; triangles without a material
/// get a default one, appended to `materials`. Parallel; O(triangles). Throws Error beyond 2^32 - 2 vertices or
/// triangles.
Mesh merge_placed(std::span<const Mesh> meshes, std::span<const Instance> instances, std::vector<Material>& materials);

/// Maps a normal as the surface around it is mapped; unit length, or zero.
Vec3 map_normal(const Transform& transform, const Vec3& normal);

/// Merges everything that is placed once, or by a transform that has no inverse, into one world-space mesh, the first;
/// meshes placed several times stay as they are. Meshes that are not placed are dropped.
Scene merge_single_placements(Scene scene);

/// Counts what is_usable refuses into scene.notes, each mesh once. Parallel; O(n).
void count_unusable(Scene& scene);

/// Empty, or one sentence that says which index of the scene points nowhere. Parallel; O(n).
std::string find_bad_index(const Scene& scene);

}  // namespace boxwood
