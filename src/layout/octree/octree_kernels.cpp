#include "trace/scalar_targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "layout/octree/octree_kernels.cpp"
#include <hwy/foreach_target.h>
//
#include "layout/octree/octree_nodes.h"
#include "layout/octree/octree_walk-inl.h"

HWY_BEFORE_NAMESPACE();
namespace boxwood {
namespace HWY_NAMESPACE {

class WordNavigator {
 public:
  struct Node {
    std::uint32_t number, word;
  };
  explicit WordNavigator(const OctreeNodes& nodes) : words_(nodes.words.data()), sizes_(nodes.sizes.data()) {}

  Node root() const { return {0, words_[0]}; }
  HWY_INLINE static bool is_empty(const Node& node) { return node.word == OctreeNodes::empty_leaf; }
  HWY_INLINE static bool is_leaf(const Node& node) { return (node.word & 1) == 0; }
  HWY_INLINE OctreeLeaf leaf(const Node& node) const { return {node.word >> 1, sizes_[node.number]}; }
  HWY_INLINE static std::uint32_t children(const Node& node) { return node.word >> 1; }
  HWY_INLINE Node child(std::uint32_t first, std::uint32_t octant) const {
    return {first + octant, words_[first + octant]};
  }

 private:
  const std::uint32_t *words_, *sizes_;
};

Kernels<OctreeNodes, TriangleLeaves> choose_octree_over_triangles() {
  return octree_kernels<WordNavigator, OctreeNodes, TriangleLeaves>();
}

Kernels<OctreeNodes, InstanceLeaves> choose_octree_over_instances() {
  return octree_kernels<WordNavigator, OctreeNodes, InstanceLeaves>();
}

}  // namespace HWY_NAMESPACE
}  // namespace boxwood
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace boxwood {

HWY_EXPORT(choose_octree_over_triangles);
HWY_EXPORT(choose_octree_over_instances);

Kernels<OctreeNodes, TriangleLeaves> octree_triangle_kernels() {
  return HWY_DYNAMIC_DISPATCH(choose_octree_over_triangles)();
}

Kernels<OctreeNodes, InstanceLeaves> octree_instance_kernels() {
  return HWY_DYNAMIC_DISPATCH(choose_octree_over_instances)();
}

}  // namespace boxwood
#endif
