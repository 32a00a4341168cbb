// What a ray makes of a plane, for each of the six sides a plane can be. Compiled once per instruction set.
#if defined(BOXWOOD_LAYOUT_SLAB_PLANE_ROWS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef BOXWOOD_LAYOUT_SLAB_PLANE_ROWS_INL_H
#undef BOXWOOD_LAYOUT_SLAB_PLANE_ROWS_INL_H
#else
#define BOXWOOD_LAYOUT_SLAB_PLANE_ROWS_INL_H
#endif

#include <limits>

#include "layout/segment_walk-inl.h"
#include "layout/slab/split_word.h"

HWY_BEFORE_NAMESPACE();
namespace boxwood {
namespace HWY_NAMESPACE {

/// A plane changes one end of the ray's part: where the ray meets it from the geometry's side, the exit, else the
/// entry. That is decided once per ray and side, by the sign bit of the direction; the other end gets a distance that
/// changes nothing, so that no node test branches. Distances are those of the box test, offsets widened alike, so all
/// of architecture.md's rules hold; a part may be a single point (flat geometry), and no NaN arises.
struct PlaneRow {
  float near_inverse, near_offset, far_inverse, far_offset;
};

struct PlaneRows {
  PlaneRow rows[8];  ///< by side; the last two leave nothing of any part

  explicit HWY_INLINE PlaneRows(const PreparedRay& ray) {
    constexpr float infinity = std::numeric_limits<float>::infinity();
    for (BoxSide side = 0; side < 6; ++side) {
      const BoxSide axis = side >> 1;
      const bool exits = (side & 1) != static_cast<std::uint32_t>(ray.negative[axis]);
      rows[side] = exits ? PlaneRow{0, infinity, ray.inverse[axis], ray.far_offset[axis]}
                         : PlaneRow{ray.inverse[axis], ray.near_offset[axis], 0, -infinity};
    }
    rows[6] = rows[7] = {0, -infinity, 0, infinity};
  }

  HWY_INLINE Part narrow(float plane, BoxSide side, Part part) const {
    const PlaneRow& row = rows[side];
    const float t0 = fused(plane, row.near_inverse, -row.near_offset);
    const float t1 = fused(plane, row.far_inverse, -row.far_offset);
    return {t0 > part.from ? t0 : part.from, t1 < part.exit ? t1 : part.exit};
  }
};

}  // namespace HWY_NAMESPACE
}  // namespace boxwood
HWY_AFTER_NAMESPACE();
#endif
