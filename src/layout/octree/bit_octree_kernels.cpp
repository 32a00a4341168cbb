#include "trace/scalar_targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "layout/octree/bit_octree_kernels.cpp"
#include <hwy/foreach_target.h>
//
#include "layout/octree/bit_octree_navigators.h"
#include "layout/octree/octree_walk-inl.h"

HWY_BEFORE_NAMESPACE();
namespace boxwood {
namespace HWY_NAMESPACE {

template <class Leaves>
Kernels<BitOctreeNodes, Leaves> chunk_kernels(WordBits word) {
  switch (word) {
    case WordBits::w8:
      return octree_kernels<ChunkNavigator<std::uint8_t>, BitOctreeNodes, Leaves>();
    case WordBits::w16:
      return octree_kernels<ChunkNavigator<std::uint16_t>, BitOctreeNodes, Leaves>();
    case WordBits::w32:
      return octree_kernels<ChunkNavigator<std::uint32_t>, BitOctreeNodes, Leaves>();
    case WordBits::w64:
      break;
  }
  return octree_kernels<ChunkNavigator<std::uint64_t>, BitOctreeNodes, Leaves>();
}

template <class Leaves>
Kernels<BitOctreeNodes, Leaves> bit_kernels(BitForm form, WordBits word) {
  switch (form) {
    case BitForm::chunks:
      break;
    case BitForm::free:
      return octree_kernels<FreeNavigator, BitOctreeNodes, Leaves>();
    case BitForm::milestones:
      return octree_kernels<FieldNavigator<true>, BitOctreeNodes, Leaves>();
    case BitForm::flat:
      return octree_kernels<FieldNavigator<false>, BitOctreeNodes, Leaves>();
  }
  return chunk_kernels<Leaves>(word);
}

Kernels<BitOctreeNodes, TriangleLeaves> choose_bit_octree_over_triangles(BitForm form, WordBits word) {
  return bit_kernels<TriangleLeaves>(form, word);
}

Kernels<BitOctreeNodes, InstanceLeaves> choose_bit_octree_over_instances(BitForm form, WordBits word) {
  return bit_kernels<InstanceLeaves>(form, word);
}

}  // namespace HWY_NAMESPACE
}  // namespace boxwood
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace boxwood {

HWY_EXPORT(choose_bit_octree_over_triangles);
HWY_EXPORT(choose_bit_octree_over_instances);

Kernels<BitOctreeNodes, TriangleLeaves> bit_octree_triangle_kernels(BitForm form, WordBits word) {
  return HWY_DYNAMIC_DISPATCH(choose_bit_octree_over_triangles)(form, word);
}

Kernels<BitOctreeNodes, InstanceLeaves> bit_octree_instance_kernels(BitForm form, WordBits word) {
  return HWY_DYNAMIC_DISPATCH(choose_bit_octree_over_instances)(form, word);
}

}  // namespace boxwood
#endif
