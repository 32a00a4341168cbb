// Nodes that keep their children's boxes in rows: six rows of k planes, then links in the bits of two floats each. What
// testers of such nodes share. Compiled once per instruction set.
#if defined(BOXWOOD_LAYOUT_ROWS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef BOXWOOD_LAYOUT_ROWS_INL_H
#undef BOXWOOD_LAYOUT_ROWS_INL_H
#else
#define BOXWOOD_LAYOUT_ROWS_INL_H
#endif

#include <cstring>

#include "boxwood/box.h"
#include "layout/link.h"
#include "trace/prepared_ray-inl.h"

HWY_BEFORE_NAMESPACE();
namespace boxwood {
namespace HWY_NAMESPACE {

/// A ray in the frame of some nodes, with the places of its near and far planes in a node, in floats.
struct RowRay {
  float inverse[3];
  float near_offset[3], far_offset[3];
  std::uint32_t near_plane[3], far_plane[3];

  RowRay() = default;
  RowRay(const PreparedRay& ray, std::uint32_t k) {
    for (int axis = 0; axis < 3; ++axis) {
      inverse[axis] = ray.inverse[axis];
      near_offset[axis] = ray.near_offset[axis];
      far_offset[axis] = ray.far_offset[axis];
      set_planes(axis, ray.negative[axis], k);
    }
  }

  HWY_INLINE void set_planes(int axis, int negative, std::uint32_t k) {
    near_plane[axis] = static_cast<std::uint32_t>(axis + 3 * negative) * k;
    far_plane[axis] = static_cast<std::uint32_t>(axis + 3 * (1 - negative)) * k;
  }

  /// As hit_box(), of the box in the column that begins at `lane`.
  HWY_INLINE bool test(const float* lane, float from, float limit, float& t) const {
    float entry = from, exit = limit;
    for (int axis = 0; axis < 3; ++axis) {
      const float t0 = fused(lane[near_plane[axis]], inverse[axis], -near_offset[axis]);
      const float t1 = fused(lane[far_plane[axis]], inverse[axis], -far_offset[axis]);
      entry = t0 > entry ? t0 : entry;
      exit = t1 < exit ? t1 : exit;
    }
    t = entry;
    return entry <= exit;
  }
};

/// The parts of a tester that only read. A slot is the place of a link in memory, in units of a link's size.
template <class Nodes>
class RowReader {
 public:
  using Slot = std::uint32_t;

  explicit RowReader(const Nodes& nodes) : nodes_(nodes), memory_(nodes.memory.data()) {}

  const Box& root_box() const { return nodes_.root_box; }
  std::uint32_t root_slot() const { return 0; }
  const Link& root_link() const { return nodes_.root; }
  HWY_INLINE Link link(std::uint32_t slot) const {
    Link link;
    std::memcpy(static_cast<void*>(&link), memory_ + std::size_t{slot} * 2, sizeof link);
    return link;
  }

 protected:
  const Nodes& nodes_;
  const float* memory_;
};

}  // namespace HWY_NAMESPACE
}  // namespace boxwood
HWY_AFTER_NAMESPACE();
#endif
