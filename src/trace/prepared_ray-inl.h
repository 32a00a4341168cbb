// A ray with everything a node test and a triangle test need, computed once. Compiled once per instruction set.
#if defined(BOXWOOD_TRACE_PREPARED_RAY_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef BOXWOOD_TRACE_PREPARED_RAY_INL_H
#undef BOXWOOD_TRACE_PREPARED_RAY_INL_H
#else
#define BOXWOOD_TRACE_PREPARED_RAY_INL_H
#endif

#include <hwy/highway.h>

#include <cmath>

#include "boxwood/box.h"
#include "boxwood/ray.h"
#include "boxwood/scene.h"

HWY_BEFORE_NAMESPACE();
namespace boxwood {
namespace HWY_NAMESPACE {

// Fused where the instruction set has it, the (slow, equally rounded) library function elsewhere: same bits everywhere.
HWY_INLINE float fused(float a, float b, float c) { return __builtin_fmaf(a, b, c); }
HWY_INLINE double fused(double a, double b, double c) { return __builtin_fma(a, b, c); }

/// Plane distances are fused(plane, inverse, -near_offset) and fused(plane, inverse, -far_offset). The two offsets
/// differ by twice an error bound, which widens every box by 2^-19 of the largest coordinate involved. That is more
/// than the rounding of both tests together (28 * 2^-24), so a box that holds a triangle is never missed by a ray that
/// `hit_triangle` lets hit it, and its entry distance is never above the triangle's t. No NaN: directions parallel to
/// an axis are tilted by 1e-9, far below the bound, and offsets that overflow become infinities that let the ray enter.
struct PreparedRay {
  float origin[3];
  float inverse[3];
  float near_offset[3], far_offset[3];
  int negative[3];  // 1 where the direction is negative: the near plane is the upper one
  int kx, ky, kz;   // kz: the direction's dominant axis, for the triangle test
  float shear_x, shear_y, scale_z;
  float t_near, t_far;
  bool valid;  // false: outside the limits of `Ray`; hits nothing
};

HWY_INLINE bool within_limits(const Ray& ray) {
  const float dx = std::fabs(ray.direction.x), dy = std::fabs(ray.direction.y), dz = std::fabs(ray.direction.z);
  const float largest = dx > dy ? (dx > dz ? dx : dz) : (dy > dz ? dy : dz);
  constexpr float limit = largest_coordinate;
  return dx <= limit && dy <= limit && dz <= limit && largest >= 1 / limit && std::fabs(ray.origin.x) <= limit &&
         std::fabs(ray.origin.y) <= limit && std::fabs(ray.origin.z) <= limit && ray.t_near <= ray.t_far;
}

/// `reach`: largest absolute coordinate of anything the ray can meet. `gain` >= 1 multiplies the error bound; levels
/// whose leaves map the ray by a transform need more than 1 (see instance_error.h).
/// Both forms give the same bits.
#if HWY_TARGET == HWY_SCALAR
HWY_INLINE PreparedRay prepare(const Ray& ray, float reach, float gain = 1) {
  PreparedRay out;
  out.valid = within_limits(ray);
  out.t_near = ray.t_near;
  out.t_far = ray.t_far;
  const float d[3] = {ray.direction.x, ray.direction.y, ray.direction.z};
  out.origin[0] = ray.origin.x, out.origin[1] = ray.origin.y, out.origin[2] = ray.origin.z;

  const float ax = std::fabs(d[0]), ay = std::fabs(d[1]), az = std::fabs(d[2]);
  out.kz = ax > ay ? (ax > az ? 0 : 2) : (ay > az ? 1 : 2);
  out.kx = out.kz == 2 ? 0 : out.kz + 1;
  out.ky = out.kx == 2 ? 0 : out.kx + 1;
  out.shear_x = d[out.kx] / d[out.kz];
  out.shear_y = d[out.ky] / d[out.kz];
  out.scale_z = 1.0f / d[out.kz];

  const float least = std::fabs(d[out.kz]) * 1e-9f;
  // Below 2^-26 the triangle test's products leave the range of normal floats; its errors are then absolute.
  float magnitude = 0x1p-26f;
  for (const float o : out.origin) magnitude = std::fabs(o) + reach > magnitude ? std::fabs(o) + reach : magnitude;
  const float bound = magnitude * gain * 0x1p-19f;
  for (int axis = 0; axis < 3; ++axis) {
    const float size = std::fabs(d[axis]) < least ? least : std::fabs(d[axis]);
    out.negative[axis] = std::signbit(d[axis]) ? 1 : 0;
    out.inverse[axis] = 1.0f / (out.negative[axis] ? -size : size);
    const float center = out.origin[axis] * out.inverse[axis];
    const float slack = bound * std::fabs(out.inverse[axis]);
    out.near_offset[axis] = center + slack;
    out.far_offset[axis] = center - slack;
  }
  return out;
}
#else
/// The axes in the order of a ray's own space by comparisons of the direction's sizes: x > y, x > z, y > z, lowest bit
/// first. The dominant axis is last.
alignas(16) inline constexpr std::int32_t ray_axes[8][4] = {{0, 1, 2, 3}, {0, 1, 2, 3}, {0, 1, 2, 3}, {1, 2, 0, 3},
                                                            {2, 0, 1, 3}, {0, 1, 2, 3}, {2, 0, 1, 3}, {1, 2, 0, 3}};

alignas(16) inline constexpr std::int32_t compare_left[4] = {0, 0, 1, 3}, compare_right[4] = {1, 2, 2, 3};

using FourFloats = hwy::HWY_NAMESPACE::FixedTag<float, 4>;

HWY_INLINE std::uint32_t bits_of_four(hwy::HWY_NAMESPACE::Mask<FourFloats> mask) {
#if HWY_TARGET <= HWY_AVX3
  return static_cast<std::uint32_t>(mask.raw) & 0xf;
#else
  std::uint8_t bits[8];
  hwy::HWY_NAMESPACE::StoreMaskBits(FourFloats(), mask, bits);
  return bits[0];
#endif
}

/// Without branches: which axis of incoherent rays is the longest cannot be predicted.
HWY_INLINE PreparedRay prepare(const Ray& ray, float reach, float gain = 1) {
  namespace hn = hwy::HWY_NAMESPACE;
  const FourFloats d;
  const hn::RebindToSigned<FourFloats> di;
  PreparedRay out;
  // The fourth lanes hold t_near and t_far, and are ignored.
  const auto origin = hn::LoadU(d, &ray.origin.x), direction = hn::LoadU(d, &ray.direction.x);
  const auto size = hn::Abs(direction), distance = hn::Abs(origin);
  const auto limit = hn::Set(d, largest_coordinate);
  const std::uint32_t longer = bits_of_four(hn::Gt(hn::TableLookupLanes(size, hn::SetTableIndices(d, compare_left)),
                                                   hn::TableLookupLanes(size, hn::SetTableIndices(d, compare_right))));
  const std::int32_t* axes = ray_axes[longer & 7];
  out.kx = axes[0], out.ky = axes[1], out.kz = axes[2];
  const float dominant = (&ray.direction.x)[out.kz];
  const float largest = std::fabs(dominant);
  const std::uint32_t within = bits_of_four(hn::Le(size, limit)) & bits_of_four(hn::Le(distance, limit)) & 7;
  out.valid = (static_cast<int>(within == 7) & static_cast<int>(largest >= 1 / largest_coordinate) &
               static_cast<int>(ray.t_near <= ray.t_far)) != 0;
  out.t_near = ray.t_near;
  out.t_far = ray.t_far;

  // {x, y, 1} / z in the ray's own axes.
  alignas(16) float shear[4];
  const auto own = hn::TableLookupLanes(direction, hn::SetTableIndices(d, axes));
  const auto third = hn::RebindMask(d, hn::Eq(hn::Iota(di, 0), hn::Set(di, 2)));
  hn::Store(hn::Div(hn::IfThenElse(third, hn::Set(d, 1.0f), own), hn::Set(d, dominant)), d, shear);
  out.shear_x = shear[0], out.shear_y = shear[1], out.scale_z = shear[2];

  // Below 2^-26 the triangle test's products leave the range of normal floats; its errors are then absolute.
  float magnitude = 0x1p-26f;
  const float far_out[3] = {std::fabs(ray.origin.x) + reach, std::fabs(ray.origin.y) + reach,
                            std::fabs(ray.origin.z) + reach};
  for (const float value : far_out) magnitude = value > magnitude ? value : magnitude;
  const auto bound = hn::Set(d, magnitude * gain * 0x1p-19f);
  const auto inverse = hn::Div(hn::Set(d, 1.0f), hn::CopySign(hn::Max(size, hn::Set(d, largest * 1e-9f)), direction));
  const auto center = hn::Mul(origin, inverse), slack = hn::Mul(bound, hn::Abs(inverse));
  alignas(16) float values[4][4];
  hn::Store(origin, d, values[0]);
  hn::Store(inverse, d, values[1]);
  hn::Store(hn::Add(center, slack), d, values[2]);
  hn::Store(hn::Sub(center, slack), d, values[3]);
  const std::uint32_t negative = bits_of_four(hn::RebindMask(d, hn::Lt(hn::BitCast(di, direction), hn::Zero(di))));
  for (int axis = 0; axis < 3; ++axis) {
    out.origin[axis] = values[0][axis];
    out.inverse[axis] = values[1][axis];
    out.near_offset[axis] = values[2][axis];
    out.far_offset[axis] = values[3][axis];
    out.negative[axis] = static_cast<int>(negative >> axis & 1);
  }
  return out;
}
#endif

/// Largest absolute coordinate of a box; 0 for an empty one.
HWY_INLINE float reach_of(const Box& box) {
  if (box.empty()) return 0;
  float reach = 0;
  for (int axis = 0; axis < 3; ++axis) {
    reach = std::fabs(box.lower[axis]) > reach ? std::fabs(box.lower[axis]) : reach;
    reach = std::fabs(box.upper[axis]) > reach ? std::fabs(box.upper[axis]) : reach;
  }
  return reach;
}

/// Whether the ray enters `box` with t in [t_from, t_limit], and where.
HWY_INLINE bool hit_box(const Box& box, const PreparedRay& ray, float t_from, float t_limit, float& t_entry) {
  const Vec3* planes = &box.lower;  // [0] lower, [1] upper
  float entry = t_from, exit = t_limit;
  for (int axis = 0; axis < 3; ++axis) {
    const float t0 = fused(planes[ray.negative[axis]][axis], ray.inverse[axis], -ray.near_offset[axis]);
    const float t1 = fused(planes[1 - ray.negative[axis]][axis], ray.inverse[axis], -ray.far_offset[axis]);
    entry = t0 > entry ? t0 : entry;
    exit = t1 < exit ? t1 : exit;
  }
  t_entry = entry;
  return entry <= exit;
}

/// The same from the ray's t_near on.
HWY_INLINE bool hit_box(const Box& box, const PreparedRay& ray, float t_limit, float& t_entry) {
  return hit_box(box, ray, ray.t_near, t_limit, t_entry);
}

}  // namespace HWY_NAMESPACE
}  // namespace boxwood
HWY_AFTER_NAMESPACE();
#endif
