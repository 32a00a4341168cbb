#pragma once
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "boxwood/counters.h"
#include "boxwood/ray.h"
#include "boxwood/recipe.h"
#include "boxwood/scene.h"
#include "boxwood/structure.h"

namespace boxwood {

/// Three doubles: a point or a direction. Plain data, 24 bytes.
struct DoubleVec3 {
  double x = 0, y = 0, z = 0;

  constexpr double& operator[](std::size_t axis) { return axis == 0 ? x : axis == 1 ? y : z; }
  constexpr double operator[](std::size_t axis) const { return axis == 0 ? x : axis == 1 ? y : z; }
  friend constexpr bool operator==(const DoubleVec3&, const DoubleVec3&) = default;
};

constexpr DoubleVec3 operator+(const DoubleVec3& a, const DoubleVec3& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
constexpr DoubleVec3 operator-(const DoubleVec3& a, const DoubleVec3& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
constexpr DoubleVec3 operator*(const DoubleVec3& a, double s) { return {a.x * s, a.y * s, a.z * s}; }

/// Coordinates beyond this magnitude are treated like non-finite ones: products of three of them must stay finite.
inline constexpr double largest_double_coordinate = 1e80;

/// A Ray in double precision: a segment origin + t * direction, t in [t_near, t_far]. 64 bytes. The direction's largest
/// component must lie in [1e-80, 1e80] and origin coordinates in [-1e80, 1e80]; a ray outside these limits (NaN,
/// infinite and zero directions included), or with t_near > t_far, hits nothing.
struct PreciseRay {
  DoubleVec3 origin;
  double t_near = 0;
  DoubleVec3 direction;
  double t_far = std::numeric_limits<double>::infinity();
};
static_assert(sizeof(PreciseRay) == 64);

/// Closest hit of a ray. Among hits at the same t the smallest primitive wins.
struct PreciseHit {
  double t = std::numeric_limits<double>::infinity();  ///< distance in units of the direction; infinite on a miss
  double u = 0, v = 0;                                 ///< barycentric weights of the second and third vertex
  std::uint32_t primitive = no_primitive;              ///< triangle number; no_primitive on a miss

  constexpr bool valid() const { return primitive != no_primitive; }
  friend constexpr bool operator==(const PreciseHit&, const PreciseHit&) = default;
};

struct PreciseLevel;
struct PreciseKernels;

/// An immutable structure over triangles in double precision: for scenes the size of a planet with details of a
/// millimetre. Triangles are tested in double, watertight as all of this library; the boxes above them are single and
/// conservative, in frames of their own wherever details are small beside what is around them. Hits are those of
/// testing every triangle in double, to the bit, whatever the recipe. Copies share it; queries are thread safe, run on
/// the calling thread and allocate nothing. Rays outside the limits of PreciseRay hit nothing.
class PreciseStructure {
 public:
  PreciseStructure(std::shared_ptr<const PreciseLevel> level, BuildReport report, Recipe recipe);

  /// The nearest hit with t in [ray.t_near, ray.t_far]; PreciseHit::valid() is false on a miss.
  PreciseHit closest_hit(const PreciseRay& ray) const;
  /// Whether anything is hit with t in [ray.t_near, ray.t_far].
  bool any_hit(const PreciseRay& ray) const;
  /// One hit per ray. Throws UsageError when the spans differ in length.
  void closest_hits(std::span<const PreciseRay> rays, std::span<PreciseHit> hits) const;
  /// 1 where a ray is blocked, 0 where it is not. Throws UsageError when the spans differ in length.
  void any_hits(std::span<const PreciseRay> rays, std::span<std::uint8_t> blocked) const;
  /// As closest_hits(), with what each ray cost. Slower; the answers are the same.
  void closest_hits_counted(std::span<const PreciseRay> rays, std::span<PreciseHit> hits,
                            std::span<RayCounters> counters) const;

  /// `bounds` are rounded to floats outwards, and infinite where floats end.
  const BuildReport& report() const { return report_; }
  const Recipe& recipe() const { return recipe_; }
  /// Local frames of single-precision boxes: 1 unless details are thousands of times smaller than the whole.
  std::size_t frames() const;

 private:
  std::shared_ptr<const PreciseLevel> level_;
  const PreciseKernels* kernels_;
  BuildReport report_;
  Recipe recipe_;
};

/// Builds over a mesh in double precision, which is copied (80 bytes per triangle). Vertices are in world units, any
/// from 1e-80 to 1e80; the larger of them and of a ray's origin times 2^-48 is what hits are off at most. Triangles
/// with coordinates that are not finite or beyond the limit, or without area, are left out and counted. The layout of
/// the recipe is `wide(k)` or `compressed(k)` of up to 16 children, under the default walk; builders see nothing but
/// boxes. Deterministic for any number of threads; O(n log n). Throws UsageError on other recipes, Error on an index
/// out of range or too many triangles.
PreciseStructure build_precise(std::span<const DoubleVec3> vertices, std::span<const Triangle> triangles,
                               const Recipe& recipe, const BuildOptions& options = {});
PreciseStructure build_precise(std::span<const DoubleVec3> vertices, std::span<const Triangle> triangles,
                               std::string_view recipe = "default", const BuildOptions& options = {});

}  // namespace boxwood
