// Sixty-four rays side by side, a register of them at a time, prepared together. Compiled once per instruction set that
// has eight lanes.
#if defined(BOXWOOD_LAYOUT_SIMD_RAY_GROUP_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef BOXWOOD_LAYOUT_SIMD_RAY_GROUP_INL_H
#undef BOXWOOD_LAYOUT_SIMD_RAY_GROUP_INL_H
#else
#define BOXWOOD_LAYOUT_SIMD_RAY_GROUP_INL_H
#endif

#include <algorithm>
#include <limits>
#include <span>

#include "layout/simd/lanes-inl.h"
#include "trace/prepared_ray-inl.h"

HWY_BEFORE_NAMESPACE();
namespace boxwood {
namespace HWY_NAMESPACE {
#if HWY_MAX_BYTES >= 32

inline constexpr std::size_t group_size = 64;
/// A register of the rays of a group.
using GroupLanes = hn::CappedTag<float, 16>;
inline constexpr int group_lanes = lanes_of<GroupLanes>;
inline constexpr int group_vectors = static_cast<int>(group_size) / group_lanes;

/// One value per ray of a group.
struct alignas(64) GroupFloats {
  float lanes[group_vectors][group_lanes];

  /// Of one ray.
  HWY_INLINE float& of(int ray) { return (&lanes[0][0])[ray]; }
  HWY_INLINE float of(int ray) const { return (&lanes[0][0])[ray]; }
};

/// The fields of PreparedRay for 64 rays that share the signs of their directions and their dominant axis, and the
/// intervals that hold them all. The same bits as prepare() where the triangle test reads them.
struct RayGroup {
  GroupFloats origin[3], inverse[3], near_offset[3], far_offset[3], t_near, t_limit;
  GroupFloats shear_x, shear_y;
  int negative[3];
  int kx, ky, kz;

  float least_origin[3], largest_origin[3];
  float least_inverse[3], largest_inverse[3];
  float least_shear[2], largest_shear[2];
  float slack[3];  // error bound of plane distances: more than any ray's own
  float error;     // of the triangle test, where rays see corners: more than any ray's own
  float least_t_near;

  /// 1 / dominant component, which is never so small that another is taken for it.
  HWY_INLINE const GroupFloats& scale_z() const { return inverse[kz]; }
};

/// Rays of a coherent group differ at most this much in the ratios of their direction's components to the dominant one.
inline constexpr float widest_spread = 0.25f;

HWY_INLINE int dominant_axis(const Vec3& direction) {
  const float x = std::fabs(direction.x), y = std::fabs(direction.y), z = std::fabs(direction.z);
  return x > y ? (x > z ? 0 : 2) : (y > z ? 1 : 2);
}

HWY_INLINE std::uint32_t direction_class(const Ray& ray) {
  const Vec3& d = ray.direction;
  return static_cast<std::uint32_t>(dominant_axis(d)) | (std::signbit(d.x) ? 4u : 0) | (std::signbit(d.y) ? 8u : 0) |
         (std::signbit(d.z) ? 16u : 0);
}

/// A look at a few rays that rejects nearly every incoherent group, most by the first two, which share a line.
HWY_INLINE bool looks_coherent(std::span<const Ray> rays) {
  const std::uint32_t first = direction_class(rays[0]);
  if (direction_class(rays[1]) != first || direction_class(rays[63]) != first) return false;
  bool same = true;
  for (const std::size_t i : {7, 31, 56, 20, 42, 13}) same &= direction_class(rays[i]) == first;
  return same;
}

HWY_INLINE float least_of(const GroupFloats& values) {
  const GroupLanes d;
  auto least = hn::Load(d, values.lanes[0]);
  for (int g = 1; g < group_vectors; ++g) least = hn::Min(least, hn::Load(d, values.lanes[g]));
  return hn::GetLane(hn::MinOfLanes(d, least));
}

HWY_INLINE float largest_of(const GroupFloats& values) {
  const GroupLanes d;
  auto largest = hn::Load(d, values.lanes[0]);
  for (int g = 1; g < group_vectors; ++g) largest = hn::Max(largest, hn::Load(d, values.lanes[g]));
  return hn::GetLane(hn::MaxOfLanes(d, largest));
}

/// A register of rays, one field in each.
struct GroupRays {
  using V = hn::Vec<GroupLanes>;
  V origin[3], direction[3], t_near, t_far;

  HWY_INLINE explicit GroupRays(const Ray* rays) {
    const float* values = &rays[0].origin.x;
    V low[4], high[4];  // by coordinate, origins and directions of half the rays
    load_half(values, low);
    load_half(values + 4 * group_lanes, high);
    for (int axis = 0; axis < 3; ++axis) {
      origin[axis] = origins(low[axis], high[axis]);
      direction[axis] = directions(low[axis], high[axis]);
    }
    t_near = origins(low[3], high[3]);
    t_far = directions(low[3], high[3]);
  }

 private:
#if HWY_TARGET <= HWY_AVX3
  static HWY_INLINE void load_half(const float* values, V (&out)[4]) {
    const GroupLanes d;
    const hn::Half<GroupLanes> half;
    const hn::Repartition<double, GroupLanes> pairs;
    V rays[4];  // the i-th and the one four behind it
    for (int i = 0; i < 4; ++i) {
      rays[i] = hn::Combine(d, hn::LoadU(half, values + 8 * (i + 4)), hn::LoadU(half, values + 8 * i));
    }
    for (int coordinate = 0; coordinate < 4; coordinate += 2) {
      const auto two = [&](int i) HWY_ATTR {
        return hn::BitCast(pairs, coordinate == 0 ? hn::InterleaveLower(d, rays[i], rays[i + 1])
                                                  : hn::InterleaveUpper(d, rays[i], rays[i + 1]));
      };
      out[coordinate] = hn::BitCast(d, hn::InterleaveLower(pairs, two(0), two(2)));
      out[coordinate + 1] = hn::BitCast(d, hn::InterleaveUpper(pairs, two(0), two(2)));
    }
  }
  static HWY_INLINE V origins(V low, V high) { return V{_mm512_shuffle_f32x4(low.raw, high.raw, 0x88)}; }
  static HWY_INLINE V directions(V low, V high) { return V{_mm512_shuffle_f32x4(low.raw, high.raw, 0xdd)}; }
#else
  /// Lanes are origin and direction of a ray in turn.
  static HWY_INLINE void load_half(const float* values, V (&out)[4]) {
    hn::LoadInterleaved4(GroupLanes(), values, out[0], out[1], out[2], out[3]);
  }
  static HWY_INLINE V origins(V low, V high) { return hn::ConcatEven(GroupLanes(), high, low); }
  static HWY_INLINE V directions(V low, V high) { return hn::ConcatOdd(GroupLanes(), high, low); }
#endif
};

/// Prepares the rays of one register. False when one of them is outside the limits of `Ray` or not of the class.
HWY_INLINE bool prepare_register(const Ray* rays, float reach, int g, RayGroup& group) {
  const GroupLanes d;
  using V = hn::Vec<GroupLanes>;
  const GroupRays in(rays);
  const auto& [origin, direction, t_near, t_far] = in;

  const V limit = hn::Set(d, largest_coordinate);
  const V dominant = hn::Abs(direction[group.kz]);
  auto fit = hn::And(hn::Le(t_near, t_far), hn::Ge(dominant, hn::Set(d, 1 / largest_coordinate)));
  fit = hn::And(fit, hn::Gt(t_near, hn::Set(d, -std::numeric_limits<float>::infinity())));  // what marks blocked rays
  V magnitude = hn::Set(d, 0x1p-26f);
  for (int axis = 0; axis < 3; ++axis) {
    const V size = hn::Abs(direction[axis]), distance = hn::Abs(origin[axis]);
    fit = hn::And(fit, hn::And(hn::Le(size, limit), hn::Le(distance, limit)));
    // Ties between axes go as in dominant_axis().
    if (axis != group.kz) fit = hn::And(fit, axis < group.kz ? hn::Le(size, dominant) : hn::Lt(size, dominant));
    const V sign = hn::Set(d, group.negative[axis] != 0 ? -1.0f : 1.0f);
    fit = hn::And(fit, hn::Eq(hn::CopySignToAbs(hn::Set(d, 1.0f), direction[axis]), sign));
    magnitude = hn::Max(magnitude, hn::Add(distance, hn::Set(d, reach)));
  }
  if (!hn::AllTrue(d, fit)) return false;

  const V bound = hn::Mul(magnitude, hn::Set(d, 0x1p-19f));
  const V least = hn::Mul(dominant, hn::Set(d, 1e-9f));
  const V one = hn::Set(d, 1.0f);
  for (int axis = 0; axis < 3; ++axis) {
    const V size = hn::Max(hn::Abs(direction[axis]), least);
    const V inverse = hn::Div(one, hn::CopySignToAbs(size, direction[axis]));
    const V center = hn::Mul(origin[axis], inverse);
    const V slack = hn::Mul(bound, hn::Abs(inverse));
    hn::Store(origin[axis], d, group.origin[axis].lanes[g]);
    hn::Store(inverse, d, group.inverse[axis].lanes[g]);
    hn::Store(hn::Add(center, slack), d, group.near_offset[axis].lanes[g]);
    hn::Store(hn::Sub(center, slack), d, group.far_offset[axis].lanes[g]);
  }
  hn::Store(t_near, d, group.t_near.lanes[g]);
  hn::Store(t_far, d, group.t_limit.lanes[g]);
  hn::Store(hn::Div(direction[group.kx], direction[group.kz]), d, group.shear_x.lanes[g]);
  hn::Store(hn::Div(direction[group.ky], direction[group.kz]), d, group.shear_y.lanes[g]);
  return true;
}

/// Fills `group` from 64 rays. False when they are not coherent enough to be traced as one. `likely`: those before
/// were.
HWY_INLINE bool prepare_group(std::span<const Ray> rays, float reach, bool likely, RayGroup& group) {
  if (!likely && !looks_coherent(rays)) return false;
  const Vec3& first = rays[0].direction;
  group.kz = dominant_axis(first);
  group.kx = group.kz == 2 ? 0 : group.kz + 1;
  group.ky = group.kx == 2 ? 0 : group.kx + 1;
  for (int axis = 0; axis < 3; ++axis)
    group.negative[axis] = std::signbit(first[static_cast<std::size_t>(axis)]) ? 1 : 0;
  for (int g = 0; g < group_vectors; ++g) {
    if (!prepare_register(rays.data() + g * group_lanes, reach, g, group)) return false;
  }
  for (int side = 0; side < 2; ++side) {
    const GroupFloats& shear = side == 0 ? group.shear_x : group.shear_y;
    group.least_shear[side] = least_of(shear);
    group.largest_shear[side] = largest_of(shear);
    if (group.largest_shear[side] - group.least_shear[side] > widest_spread) return false;
  }
  float magnitude = 0x1p-26f;
  for (int axis = 0; axis < 3; ++axis) {
    group.least_origin[axis] = least_of(group.origin[axis]);
    group.largest_origin[axis] = largest_of(group.origin[axis]);
    group.least_inverse[axis] = least_of(group.inverse[axis]);
    group.largest_inverse[axis] = largest_of(group.inverse[axis]);
    if (!(group.largest_origin[axis] - group.least_origin[axis] <= widest_spread * reach)) return false;
    magnitude = std::max(
        {magnitude, std::fabs(group.least_origin[axis]) + reach, std::fabs(group.largest_origin[axis]) + reach});
  }
  for (int axis = 0; axis < 3; ++axis) {
    const float inverse = std::max(std::fabs(group.least_inverse[axis]), std::fabs(group.largest_inverse[axis]));
    group.slack[axis] = magnitude * 0x1p-18f * inverse;
  }
  group.error = magnitude * 0x1p-19f;
  group.least_t_near = least_of(group.t_near);
  return true;
}

#endif  // HWY_MAX_BYTES >= 32
}  // namespace HWY_NAMESPACE
}  // namespace boxwood
HWY_AFTER_NAMESPACE();
#endif
