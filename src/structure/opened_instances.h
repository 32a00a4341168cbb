#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "boxwood/scene.h"
#include "tree/tree.h"

namespace boxwood {

/// Meshes in parts, subtrees of their trees, and instances of the parts: partial re-braiding after Benthin et al. 2017.
/// Where instances overlap, a ray then enters what it meets of each of them, and in order. Theirs opens instances one
/// by one, which needs kernels that begin at any node; here a part is a structure of its own, which any layout can be,
/// so that all instances of a mesh are opened alike and nothing is stored twice.
struct OpenedInstances {
  std::vector<Tree> parts;
  std::vector<std::uint32_t> mesh_of;  ///< of each part
  std::vector<Instance> instances;     ///< of which `mesh` is a part
  std::vector<std::uint32_t> numbers;  ///< of each of them, that of the scene's instance
  std::vector<Box> boxes;              ///< of each of them, in world space
};

/// Opens what overlaps most as long as there are at most `references_per_instance` references per instance. `trees` are
/// those of the scene's meshes. O(r log r + r s) for r references and the s sampled instances that overlap them.
OpenedInstances open_instances(const Scene& scene, std::vector<Tree> trees, float references_per_instance);

}  // namespace boxwood
